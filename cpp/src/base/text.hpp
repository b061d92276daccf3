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

/// name[index]
inline std::string indexed(const std::string& name, long index) {
  return name + "[" + std::to_string(index) + "]";
}

}  // namespace dmp::detail
