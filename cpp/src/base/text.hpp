#pragma once

#include <cstdio>
#include <string>

namespace dmp::detail {

/// A number as an error message shows it.
inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// A number with all digits that tell it from others.
inline std::string exact_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// name[index]
inline std::string indexed(const std::string& name, long index) {
  return name + "[" + std::to_string(index) + "]";
}

}  // namespace dmp::detail
