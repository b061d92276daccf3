#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "detail/model_json.hpp"

namespace dmp {
namespace {

constexpr std::size_t kLargestFile = 64u << 20;

[[noreturn]] void fail(const std::string& path, const std::string& action) {
  throw FileError(path + ": can not " + action + ": " + std::strerror(errno) + ".");
}

/// A temporary file in the folder of `path` that is gone again unless it was moved into place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path) : path_(path), name_(path + ".XXXXXX") {
    descriptor_ = ::mkstemp(name_.data());
    if (descriptor_ < 0) fail(path, "be written");
    ::fchmod(descriptor_, S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!moved_) ::unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t count = ::write(descriptor_, text.data() + done, text.size() - done);
      if (count < 0 && errno != EINTR) fail(path_, "be written");
      if (count > 0) done += static_cast<std::size_t>(count);
    }
    if (::fsync(descriptor_) != 0) fail(path_, "be flushed to disk");
  }
  void move_into_place() {
    if (::rename(name_.c_str(), path_.c_str()) != 0) fail(path_, "be written");
    moved_ = true;
  }

 private:
  std::string path_;
  std::string name_;
  int descriptor_ = -1;
  bool moved_ = false;
};

std::string read(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) fail(path, "be read");
  if (!S_ISREG(about.st_mode)) throw FileError(path + ": not a file.");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "be read");
  if (static_cast<std::size_t>(about.st_size) > kLargestFile)
    throw InvalidArgument(path + ": larger than 64 MiB, expected a model file.");
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) fail(path, "be read");
  return text.str();
}

template <class Kind>
Kind load_kind(const std::string& path, const char* expected) {
  const Model model = load(path);
  if (const Kind* kind = std::get_if<Kind>(&model)) return *kind;
  throw InvalidArgument(path + ": holds another kind of model, expected " + expected + ".");
}

}  // namespace

std::string to_json(const Model& model) { return detail::model_to_json(model).dump(1) + "\n"; }

Model from_json(const std::string& text) {
  if (text.size() > kLargestFile) throw InvalidArgument("model: larger than 64 MiB.");
  return detail::model_from_json(detail::parse_json(text));
}

void save(const Model& model, const std::string& path) {
  TemporaryFile file(path);
  file.write(to_json(model));
  file.move_into_place();
}

Model load(const std::string& path) {
  try {
    return from_json(read(path));
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(path + ": " + error.what());
  }
}

Dmp load_dmp(const std::string& path) { return load_kind<Dmp>(path, "a Dmp"); }
OrientationDmp load_orientation_dmp(const std::string& path) {
  return load_kind<OrientationDmp>(path, "an OrientationDmp");
}
PoseDmp load_pose_dmp(const std::string& path) { return load_kind<PoseDmp>(path, "a PoseDmp"); }

}  // namespace dmp
