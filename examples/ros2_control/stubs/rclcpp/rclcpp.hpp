#pragma once

#include <cstdio>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace rclcpp {

class Time {};

class Duration {
 public:
  static Duration from_seconds(double seconds) { return Duration(seconds); }
  double seconds() const { return seconds_; }

 private:
  explicit Duration(double seconds) : seconds_(seconds) {}
  double seconds_;
};

class Parameter {
 public:
  Parameter() = default;
  explicit Parameter(std::variant<std::string, std::vector<std::string>> value) : value_(std::move(value)) {}
  std::string as_string() const { return std::get<std::string>(value_); }
  std::vector<std::string> as_string_array() const { return std::get<std::vector<std::string>>(value_); }

 private:
  std::variant<std::string, std::vector<std::string>> value_;
};

class Logger {};

class Node {
 public:
  void declare_parameter(const std::string& name, const Parameter& value) {
    parameters_.emplace(name, value);
  }
  void set_parameter(const std::string& name, const Parameter& value) { parameters_[name] = value; }
  Parameter get_parameter(const std::string& name) const { return parameters_.at(name); }
  Logger get_logger() const { return {}; }

 private:
  std::map<std::string, Parameter> parameters_;
};

}  // namespace rclcpp

#define RCLCPP_ERROR(logger, ...) \
  ((void)(logger), std::fprintf(stderr, __VA_ARGS__), std::fputc('\n', stderr))
