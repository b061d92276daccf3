#pragma once

#include <dmp/export.hpp>
#include <stdexcept>
#include <string>

namespace dmp {

/// An argument cannot be used. The message names the argument, the index, what came, what was expected and
/// what to do. In Python: dmpcpp.InvalidArgument, a ValueError.
class DMP_EXPORT InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;

  /// The argument that the message names first: "goal" of "goal[2]: nan, expected a finite number.";
  /// "" where it begins otherwise.
  std::string argument() const { return argument_of(what()); }
  /// The same for any message.
  static std::string argument_of(const std::string& message);
};

/// A file cannot be read or written. In Python: dmpcpp.FileError, an OSError.
class DMP_EXPORT FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dmp
