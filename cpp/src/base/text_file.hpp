#pragma once

#include <dmp/error.hpp>

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace dmp::detail {

constexpr std::size_t kLargestFile = 64u << 20;

[[noreturn]] inline void fail(const std::string& path, const std::string& action) {
  throw FileError(path + ": cannot " + action + ": " + std::strerror(errno) + ".");
}

/// A whole file. Throws FileError for what cannot be read or is no file (a folder, a device, a pipe),
/// InvalidArgument, with what was `expected`, for more than 64 MiB.
inline std::string read_text(const std::string& path, const char* expected) {
  if (path.find('\0') != std::string::npos) throw FileError("path: holds a byte of zero, expected a name.");
  struct stat about{};
  if (::stat(path.c_str(), &about) != 0) fail(path, "be read");
  if (!S_ISREG(about.st_mode)) throw FileError(path + ": not a file.");
  if (static_cast<std::size_t>(about.st_size) > kLargestFile)
    throw InvalidArgument(path + ": larger than 64 MiB, expected " + expected + ".");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "be read");
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) fail(path, "be read");
  return text.str();
}

}  // namespace dmp::detail
