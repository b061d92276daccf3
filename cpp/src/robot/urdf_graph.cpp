#include "robot/urdf_graph.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <dmp/error.hpp>
#include <mutex>

namespace dmp::detail {
namespace {

// Catches what urdfdom would print. console_bridge has one handler for the whole process: hence the lock.
class CapturedLog : public console_bridge::OutputHandler {
 public:
  CapturedLog() : lock_(mutex()), level_(console_bridge::getLogLevel()) {
    console_bridge::useOutputHandler(this);
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
  }
  ~CapturedLog() override {
    console_bridge::setLogLevel(level_);
    console_bridge::restorePreviousOutputHandler();
  }
  CapturedLog(const CapturedLog&) = delete;
  CapturedLog& operator=(const CapturedLog&) = delete;

  void log(const std::string& line, console_bridge::LogLevel, const char*, int) override {
    text_ += (text_.empty() ? "" : " ") + line;
  }
  const std::string& text() const { return text_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> lock_;
  console_bridge::LogLevel level_;
  std::string text_;
};

// The scan reads XML in passing only: a name that it missed may still close a cycle, on which no walk ends.
void require_tree(const urdf::ModelInterface& model) {
  Parents parents;
  for (const auto& [name, joint] : model.joints_)
    add_parent(parents, joint->child_link_name, {name, joint->parent_link_name});
  refuse_cycles(parents);
}

std::string listed(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

ParsedUrdf parse_urdf(const std::string& text) {
  ParsedUrdf parsed;
  parsed.scan = scan_urdf(text);
  CapturedLog log;
  try {
    parsed.model = urdf::parseURDF(as_version_1_0(text));
  } catch (const std::exception& error) {
    throw InvalidArgument(std::string("urdf: ") + error.what());
  }
  if (!parsed.model || !parsed.model->getRoot())
    throw InvalidArgument("urdf: refused by urdfdom: " + (log.text().empty() ? "no root link." : log.text()));
  require_tree(*parsed.model);
  parsed.complaints = log.text();
  return parsed;
}

urdf::LinkConstSharedPtr find_link(const urdf::ModelInterface& model, const std::string& name,
                                   const std::string& argument) {
  if (const urdf::LinkConstSharedPtr link = model.getLink(name)) return link;
  std::vector<std::string> names;
  for (const auto& entry : model.links_) names.push_back(entry.first);
  throw InvalidArgument(argument + ": no link '" + name + "' in this URDF; it has: " + listed(names) + ".");
}

UrdfPath path_between(const urdf::ModelInterface& model, const std::string& base, const std::string& tip) {
  UrdfPath path;
  for (std::string link = tip; link != base;) {
    const urdf::JointConstSharedPtr joint = model.getLink(link)->parent_joint;
    if (!joint) throw InvalidArgument("tip: link '" + tip + "' does not hang below base '" + base + "'.");
    path.push_back(joint);
    link = joint->parent_link_name;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace dmp::detail
