#pragma once
// What dmp_controller uses of ros2_control, so that it compiles and runs where ROS is not. Names and
// signatures are those of ROS 2 Jazzy.

#include <map>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

namespace rclcpp_lifecycle {
class State {};
}  // namespace rclcpp_lifecycle

namespace hardware_interface {
class LoanedStateInterface {
 public:
  explicit LoanedStateInterface(double value = 0.0) : value_(value) {}
  double get_value() const { return value_; }

 private:
  double value_;
};
class LoanedCommandInterface {
 public:
  void set_value(double value) { value_ = value; }
  double get_value() const { return value_; }

 private:
  double value_ = 0.0;
};
}  // namespace hardware_interface

namespace controller_interface {

enum class CallbackReturn { SUCCESS, FAILURE, ERROR };
enum class return_type { OK, ERROR };
enum class interface_configuration_type { ALL, INDIVIDUAL, NONE };
struct InterfaceConfiguration {
  interface_configuration_type type;
  std::vector<std::string> names;
};

class ControllerInterface {
 public:
  virtual ~ControllerInterface() = default;
  virtual CallbackReturn on_init() = 0;
  virtual InterfaceConfiguration command_interface_configuration() const = 0;
  virtual InterfaceConfiguration state_interface_configuration() const = 0;
  virtual CallbackReturn on_configure(const rclcpp_lifecycle::State& previous) = 0;
  virtual CallbackReturn on_activate(const rclcpp_lifecycle::State& previous) = 0;
  virtual return_type update(const rclcpp::Time& time, const rclcpp::Duration& period) = 0;
  std::shared_ptr<rclcpp::Node> get_node() const { return node_; }

  std::vector<hardware_interface::LoanedCommandInterface> command_interfaces_;
  std::vector<hardware_interface::LoanedStateInterface> state_interfaces_;

 protected:
  template <class Value>
  void auto_declare(const std::string& name, const Value& value) {
    node_->declare_parameter(name, rclcpp::Parameter(value));
  }

 private:
  std::shared_ptr<rclcpp::Node> node_ = std::make_shared<rclcpp::Node>();
};

}  // namespace controller_interface
