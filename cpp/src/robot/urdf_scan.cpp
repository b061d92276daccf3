#include "robot/urdf_scan.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <dmp/error.hpp>
#include <locale>
#include <set>
#include <sstream>
#include <vector>

namespace dmp::detail {
namespace {

constexpr int deepest_nesting = 100;
constexpr std::size_t largest_text = 64u << 20;

constexpr const char* blanks = " \t\r\n";

std::string attribute(const std::string& tag, const std::string& name) {
  for (std::size_t at = tag.find(name); at != std::string::npos; at = tag.find(name, at + 1)) {
    const std::size_t equals = tag.find_first_not_of(blanks, at + name.size());
    if (at == 0 || !std::strchr(blanks, tag[at - 1]) || equals == std::string::npos || tag[equals] != '=')
      continue;
    const std::size_t quote = tag.find_first_not_of(blanks, equals + 1);
    if (quote == std::string::npos || (tag[quote] != '"' && tag[quote] != '\'')) continue;
    return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
  }
  return "";
}

/// The number, or 0 where it is none, not positive or not finite.
double positive(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  return stream >> value && value > 0.0 && std::isfinite(value) ? value : 0.0;
}

/// Where the tag at `at` ends: a '>' within quotes is a part of an attribute. npos if nowhere.
std::size_t end_of_tag(const std::string& text, std::size_t at) {
  while ((at = text.find_first_of("\"'>", at)) != std::string::npos && text[at] != '>') {
    const std::size_t closing = text.find(text[at], at + 1);
    if (closing == std::string::npos) return closing;
    at = closing + 1;
  }
  return at;
}

/// Whether a tag of TinyXML's begins an element or ends one; all else ('<6', '<?', '<!') it passes over up to
/// '>'.
bool is_element(char after) {
  const auto byte = static_cast<unsigned char>(after);
  return std::isalpha(byte) || byte >= 127 || after == '_' || after == '/';
}

/// Where what begins with '<' at `at` ends, as urdfdom's parser takes it: quotes count in elements alone.
std::size_t end_of_markup(const std::string& text, std::size_t at) {
  const auto is = [&](const char* start) { return text.compare(at, std::strlen(start), start) == 0; };
  if (is("<!--")) return text.find("-->", at);
  if (is("<![CDATA[")) return text.find("]]>", at);
  return is_element(text[at + 1]) ? end_of_tag(text, at) : text.find('>', at);
}

// Reads tag by tag and keeps what the graph needs. It need not understand all of XML: urdfdom judges the
// syntax.
class Scanner {
 public:
  void read(const std::string& text) {
    std::size_t at = 0;
    while ((at = text.find('<', at)) != std::string::npos) {
      const std::size_t end = end_of_markup(text, at);
      if (end == std::string::npos) return;
      take(text.substr(at, end - at + 1));
      at = end + 1;
    }
  }
  const Parents& parents() const { return parents_; }
  const UrdfScan& found() const { return found_; }

 private:
  void take(const std::string& tag) {
    if (!is_element(tag[1])) return;
    if (tag[1] == '/') {
      --depth_;
    } else {
      if (tag[tag.size() - 2] != '/') ++depth_;
      open(tag);
    }
    if (depth_ > deepest_nesting)
      throw InvalidArgument("urdf: elements nested deeper than " + std::to_string(deepest_nesting) + ".");
  }

  void open(const std::string& tag) {
    const std::string kind = tag.substr(1, tag.find_first_of(" \t\r\n/>", 1) - 1);
    if (kind == "limit") take_limit(tag);
    if (kind == "joint") {
      joint_ = attribute(tag, "name");
      above_ = {joint_, ""};
      child_.clear();
    }
    if (kind == "parent") above_.link = attribute(tag, "link");
    if (kind == "child") child_ = attribute(tag, "link");
    if (!child_.empty() && !above_.link.empty()) add();
  }

  void take_limit(const std::string& tag) {
    const bool lower = !attribute(tag, "lower").empty(), upper = !attribute(tag, "upper").empty();
    if (lower != upper) found_.missing[joint_] = lower ? "upper" : "lower";
    const double up = positive(attribute(tag, "acceleration")),
                 down = positive(attribute(tag, "deceleration"));
    const HigherLimits higher = {up > 0.0 && down > 0.0 ? std::min(up, down) : std::max(up, down),
                                 positive(attribute(tag, "jerk"))};
    if (higher.acceleration > 0.0 || higher.jerk > 0.0) found_.higher[joint_] = higher;
  }

  void add() {
    add_parent(parents_, child_, above_);
    child_.clear();
    above_.link.clear();
  }

  int depth_ = 0;
  Parent above_;
  std::string joint_, child_;
  Parents parents_;
  UrdfScan found_;
};

}  // namespace

void add_parent(Parents& parents, const std::string& child, const Parent& above) {
  const auto [at, is_new] = parents.emplace(child, above);
  if (!is_new)
    throw InvalidArgument("urdf: link '" + child + "' is the child of two joints, '" + at->second.joint +
                          "' and '" + above.joint + "'; expected a tree.");
}

void refuse_cycles(const Parents& parents) {
  std::set<std::string> cleared;  // links known to hang from a root
  for (const auto& entry : parents) {
    std::vector<std::string> walked;
    for (auto at = parents.find(entry.first); at != parents.end() && cleared.count(at->first) == 0;
         at = parents.find(at->second.link)) {
      if (walked.size() > parents.size())
        throw InvalidArgument("urdf: joint '" + at->second.joint + "': its child link '" + at->first +
                              "' is also above it (a cycle); expected a tree.");
      walked.push_back(at->first);
    }
    cleared.insert(walked.begin(), walked.end());
  }
}

UrdfScan scan_urdf(const std::string& text) {
  if (text.size() > largest_text) throw InvalidArgument("urdf: larger than 64 MiB.");
  Scanner scanner;
  scanner.read(text);
  refuse_cycles(scanner.parents());
  return scanner.found();
}

std::string as_version_1_0(std::string text) {
  for (std::size_t at = text.find("<robot"); at != std::string::npos; at = text.find("<robot", at + 1)) {
    const std::size_t end = end_of_tag(text, at);
    if (end == std::string::npos) return text;
    const std::string tag = text.substr(at, end - at);
    const std::string version = attribute(tag, "version");
    if (version != "1.1" && version != "1.2") continue;
    for (const char quote : {'"', '\''}) {
      const std::size_t value = tag.find(quote + version + quote, tag.find("version"));
      if (value != std::string::npos) text[at + value + 3] = '0';
    }
  }
  return text;
}

}  // namespace dmp::detail
