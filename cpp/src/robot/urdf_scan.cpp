#include "robot/urdf_scan.hpp"

#include <cctype>
#include <cstring>
#include <dmp/error.hpp>
#include <set>
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
  const MissingLimits& missing() const { return missing_; }

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
    if (kind == "limit") take_limit(attribute(tag, "lower"), attribute(tag, "upper"));
    if (kind == "joint") {
      joint_ = attribute(tag, "name");
      above_ = {joint_, ""};
      child_.clear();
    }
    if (kind == "parent") above_.link = attribute(tag, "link");
    if (kind == "child") child_ = attribute(tag, "link");
    if (!child_.empty() && !above_.link.empty()) add();
  }

  void take_limit(const std::string& lower, const std::string& upper) {
    if (lower.empty() != upper.empty()) missing_[joint_] = lower.empty() ? "lower" : "upper";
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
  MissingLimits missing_;
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

MissingLimits scan_urdf(const std::string& text) {
  if (text.size() > largest_text) throw InvalidArgument("urdf: larger than 64 MiB.");
  Scanner scanner;
  scanner.read(text);
  refuse_cycles(scanner.parents());
  return scanner.missing();
}

}  // namespace dmp::detail
