// The life of the controller without ROS: configured, activated, updated at 1 kHz until it stands at the
// goal.
#include <dmp/file.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "dmp_controller.hpp"

namespace {

constexpr const char* kModel = "lift.json";

dmp::PoseDmp lift(const Eigen::Matrix4d& start) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
  dmp::Poses poses;
  for (const double t : times) {
    poses.push_back(start);
    poses.back()(2, 3) += 0.1 * t * t * (3 - 2 * t);
  }
  return dmp::PoseDmp::fit(dmp::PoseDemonstration(times, poses));
}

}  // namespace

int main(int count, char** arguments) {
  const std::string urdf = count > 1 ? arguments[1] : "arm.urdf";
  const dmp::Arm arm = dmp::Arm::from_urdf_file(urdf, "link0", "tool");
  const Eigen::VectorXd stand = (Eigen::VectorXd(7) << 0, 0.5, 0, 1.2, 0, 0.8, 0).finished();
  const dmp::PoseDmp model = lift(arm.forward_kinematics(stand));
  dmp::save(model, kModel);

  dmp_controller::DmpController controller;
  controller.on_init();
  const auto set = [&](const char* name, auto value) {
    controller.get_node()->set_parameter(name, rclcpp::Parameter(value));
  };
  set("model", std::string(kModel));
  set("urdf", urdf);
  set("base", std::string("link0"));
  set("tip", std::string("tool"));
  set("joints", arm.joint_names());
  using controller_interface::CallbackReturn;
  if (controller.on_configure({}) != CallbackReturn::SUCCESS) return 1;
  for (const double q : stand) controller.state_interfaces_.emplace_back(q);
  controller.command_interfaces_.resize(controller.command_interface_configuration().names.size());
  if (controller.on_activate({}) != CallbackReturn::SUCCESS) return 1;
  for (int k = 0; k < 5000; ++k) controller.update({}, rclcpp::Duration::from_seconds(1e-3));

  Eigen::VectorXd commanded(7);
  for (int i = 0; i < 7; ++i) commanded[i] = controller.command_interfaces_[i].get_value();
  const Eigen::Matrix4d reached = arm.forward_kinematics(commanded);
  std::cout << "at " << reached.topRightCorner<3, 1>().transpose() << " m\n";
  std::remove(kModel);
  return (reached - model.goal()).norm() < 1e-3 ? 0 : 1;
}
