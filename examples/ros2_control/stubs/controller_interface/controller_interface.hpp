#pragma once
// What dmp_controller uses of ros2_control, so that it compiles and runs where ROS is not. Names and
// signatures are those of ROS 2 Jazzy.

#include <cstdint>
#include <hardware_interface/loaned_interfaces.hpp>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <utility>
#include <vector>

namespace rclcpp_lifecycle {
class State {};
}  // namespace rclcpp_lifecycle

namespace controller_interface {

enum class CallbackReturn { SUCCESS, FAILURE, ERROR };
enum class return_type : std::uint8_t { OK = 0, ERROR = 1 };
enum class interface_configuration_type : std::uint8_t { ALL = 0, INDIVIDUAL = 1, NONE = 2 };
struct InterfaceConfiguration {
  interface_configuration_type type;
  std::vector<std::string> names = {};
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
  virtual void assign_interfaces(std::vector<hardware_interface::LoanedCommandInterface>&& commands,
                                 std::vector<hardware_interface::LoanedStateInterface>&& states) {
    command_interfaces_ = std::move(commands);
    state_interfaces_ = std::move(states);
  }
  std::shared_ptr<rclcpp::Node> get_node() { return node_; }

 protected:
  template <class Value>
  void auto_declare(const std::string& name, const Value& value) {
    node_->declare_parameter(name, rclcpp::Parameter(value));
  }

  std::vector<hardware_interface::LoanedCommandInterface> command_interfaces_;
  std::vector<hardware_interface::LoanedStateInterface> state_interfaces_;

 private:
  std::shared_ptr<rclcpp::Node> node_ = std::make_shared<rclcpp::Node>();
};

}  // namespace controller_interface
