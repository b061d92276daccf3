#pragma once

#include <dmp/export.hpp>
#include <stdexcept>

namespace dmp {

/// What the caller passed can not be used. The message names the argument, the index, what came, what was
/// expected and what to do. In Python: dmpcpp.InvalidArgument, a ValueError.
class DMP_EXPORT InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A file can not be read or written. In Python: dmpcpp.FileError, an OSError.
class DMP_EXPORT FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dmp
