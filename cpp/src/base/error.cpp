#include <dmp/error.hpp>

#include <cctype>

namespace dmp {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// The end of "[2]" or "[0, 3]" at `i`.
std::size_t after_index(const std::string& message, std::size_t i) {
  while (i < message.size() && message[i] == '[') {
    const std::size_t close = message.find(']', i);
    if (close == std::string::npos) return i;
    i = close + 1;
  }
  return i;
}

std::size_t after_word(const std::string& message, std::size_t i) {
  while (i < message.size() && is_word(message[i])) ++i;
  return i;
}

}  // namespace

std::string InvalidArgument::argument_of(const std::string& message) {
  const std::size_t end = after_word(message, 0);
  if (end == 0 || std::isdigit(static_cast<unsigned char>(message[0]))) return "";
  const std::string name = message.substr(0, end);
  // A group of options has fields; any other name with a dot is that of a file.
  const bool field = name == "options" && message[end] == '.';
  const std::size_t colon = after_index(message, field ? after_word(message, end + 1) : end);
  return message.compare(colon, 2, ": ") == 0 ? name : "";
}

}  // namespace dmp
