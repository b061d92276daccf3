#pragma once

#include <controller_interface/controller_interface.hpp>
#include <dmp/inverse_kinematics.hpp>
#include <dmp/pose_dmp.hpp>

#include <optional>
#include <string>
#include <vector>

namespace dmp_controller {

/// Carries out a PoseDmp on an arm: joints along the motion are found when the controller is activated, from
/// where the robot stands; update() interpolates between them. Parameters: model (a model file), urdf, base,
/// tip, joints.
class DmpController : public controller_interface::ControllerInterface {
 public:
  controller_interface::CallbackReturn on_init() override;
  controller_interface::InterfaceConfiguration command_interface_configuration() const override;
  controller_interface::InterfaceConfiguration state_interface_configuration() const override;
  /// Reads model and arm: files, memory, exceptions.
  controller_interface::CallbackReturn on_configure(const rclcpp_lifecycle::State& previous) override;
  /// Plans from the measured joints, slowed down to the joint limits. An error where a joint cannot be read.
  controller_interface::CallbackReturn on_activate(const rclcpp_lifecycle::State& previous) override;
  /// The next joints: takes no memory, throws nothing. An error where a joint's command was not taken.
  controller_interface::return_type update(const rclcpp::Time& time, const rclcpp::Duration& period) override;

 private:
  std::vector<std::string> interfaces(const std::string& kind) const;
  Eigen::VectorXd measured() const;  // rad
  void plan(const Eigen::VectorXd& measured);

  std::vector<std::string> joints_;
  std::optional<dmp::PoseDmp> model_;
  std::optional<dmp::Arm> arm_;
  dmp::JointTrajectory plan_;
  double elapsed_ = 0.0;  // s since activation
  Eigen::Index sample_ = 0;
};

}  // namespace dmp_controller
