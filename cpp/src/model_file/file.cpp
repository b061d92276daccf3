#include <dmp/error.hpp>
#include <dmp/file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/text_file.hpp"
#include "model_file/model_json.hpp"

namespace dmp {
namespace {

using detail::fail;
using detail::kLargestFile;

/// The file that a link stands for, so that the link stays one.
std::string behind_links(const std::string& path) {
  std::error_code none;
  const std::filesystem::path target = std::filesystem::canonical(path, none);
  return none ? path : target.string();
}

void flush(int descriptor, const std::string& path) {
  if (::fsync(descriptor) != 0) fail(path, "be flushed to disk");
}

/// A temporary file in the folder of `path` that is gone again unless it was moved into place. It has the
/// permissions of the file that it takes the place of, or those of any new file.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path) : path_(path) {
    for (int i = 0; descriptor_ < 0; ++i) {
      name_ = path + "." + std::to_string(::getpid()) + "." + std::to_string(i);
      descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && errno != EEXIST) fail(path, "be written");
    }
    struct stat before{};
    if (::stat(path.c_str(), &before) == 0 && S_ISREG(before.st_mode))
      ::fchmod(descriptor_, before.st_mode & 07777);
  }
  ~TemporaryFile() {
    ::close(descriptor_);
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
    flush(descriptor_, path_);
  }
  void move_into_place() {
    if (::rename(name_.c_str(), path_.c_str()) != 0) fail(path_, "be written");
    moved_ = true;
    const std::string folder = std::filesystem::path(path_).parent_path().string();
    const int names = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (names < 0) return;  // a folder that may be written and not read: the file is there all the same
    ::fsync(names);
    ::close(names);
  }

 private:
  std::string path_;
  std::string name_;
  int descriptor_ = -1;
  bool moved_ = false;
};

template <class Kind>
Kind load_kind(const std::string& path, const char* expected) {
  const Model model = load(path);
  if (const Kind* kind = std::get_if<Kind>(&model)) return *kind;
  throw InvalidArgument(path + ": holds another kind of model, expected " + expected + ".");
}

}  // namespace

std::string to_json(const Model& model) {
  detail::require_readable(model);
  const std::string text = detail::model_to_json(model).dump(1) + "\n";
  if (text.size() > kLargestFile)
    throw InvalidArgument("model: larger than 64 MiB as a file. Use fewer kernels.");
  return text;
}

Model from_json(const std::string& text) {
  if (text.size() > kLargestFile) throw InvalidArgument("model: larger than 64 MiB.");
  return detail::model_from_json(detail::parse_json(text));
}

void save(const Model& model, const std::string& path) {
  const std::string text = to_json(model);
  if (path.find('\0') != std::string::npos) throw FileError("path: holds a byte of zero, expected a name.");
  TemporaryFile file(behind_links(path));
  file.write(text);
  file.move_into_place();
}

Model load(const std::string& path) {
  try {
    return from_json(detail::read_text(path, "a model file"));
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(path + ": " + error.what());
  }
}

Dmp load_dmp(const std::string& path) { return load_kind<Dmp>(path, "a Dmp"); }
OrientationDmp load_orientation_dmp(const std::string& path) {
  return load_kind<OrientationDmp>(path, "an OrientationDmp");
}
PoseDmp load_pose_dmp(const std::string& path) { return load_kind<PoseDmp>(path, "a PoseDmp"); }
PoseGripperDmp load_pose_gripper_dmp(const std::string& path) {
  return load_kind<PoseGripperDmp>(path, "a PoseGripperDmp");
}

}  // namespace dmp
