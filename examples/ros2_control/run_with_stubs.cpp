// The life of the controller without ROS: refused while a joint cannot be read, configured, activated,
// updated at 1 kHz until it stands at the goal, and an error while a joint takes no command.
#include <dmp/file.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <utility>

#include "allocations.hpp"
#include "dmp_controller.hpp"

namespace {

using controller_interface::CallbackReturn;
using controller_interface::return_type;

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

/// What the controller manager does: the joints of the hardware, lent to a controller.
struct Hardware {
  std::vector<std::shared_ptr<hardware_interface::StateInterface>> states;
  std::vector<hardware_interface::CommandInterface::SharedPtr> commands;

  void lend_to(dmp_controller::DmpController& controller, const Eigen::VectorXd& stand) {
    std::vector<hardware_interface::LoanedStateInterface> lent_states;
    std::vector<hardware_interface::LoanedCommandInterface> lent_commands;
    for (const std::string& name : controller.state_interface_configuration().names)
      lent_states.emplace_back(states.emplace_back(std::make_shared<hardware_interface::StateInterface>(
          name, stand[static_cast<Eigen::Index>(states.size())])));
    for (const std::string& name : controller.command_interface_configuration().names)
      lent_commands.emplace_back(
          commands.emplace_back(std::make_shared<hardware_interface::CommandInterface>(name)));
    controller.assign_interfaces(std::move(lent_commands), std::move(lent_states));
  }
  Eigen::VectorXd commanded() const {
    Eigen::VectorXd joints(static_cast<Eigen::Index>(commands.size()));
    for (Eigen::Index i = 0; i < joints.size(); ++i) joints[i] = commands[static_cast<std::size_t>(i)]->value;
    return joints;
  }
};

void set_parameters(dmp_controller::DmpController& controller, const std::string& urdf, const dmp::Arm& arm) {
  const auto set = [&](const char* name, auto value) {
    controller.get_node()->set_parameter(name, rclcpp::Parameter(value));
  };
  set("model", std::string(kModel));
  set("urdf", urdf);
  set("base", std::string("link0"));
  set("tip", std::string("tool"));
  set("joints", arm.joint_names());
}

/// `true` where all of so many updates at 1 kHz gave `expected`, without asking for memory.
bool updates_give(dmp_controller::DmpController& controller, int count, return_type expected) {
  bool as_expected = true;
  const long allocated = allocations_in([&] {
    for (int k = 0; k < count; ++k)
      as_expected &= controller.update({}, rclcpp::Duration::from_seconds(1e-3)) == expected;
  });
  return as_expected && allocated == 0;
}

int failed(const char* what) {
  std::cerr << "failed: " << what << "\n";
  return 1;
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
  set_parameters(controller, urdf, arm);
  const bool configured = controller.on_configure({}) == CallbackReturn::SUCCESS;
  std::remove(kModel);
  if (!configured) return failed("on_configure");

  Hardware hardware;
  hardware.lend_to(controller, stand);
  hardware.states[3]->locked = true;
  if (controller.on_activate({}) != CallbackReturn::ERROR) return failed("a joint that cannot be read");
  hardware.states[3]->locked = false;
  if (controller.on_activate({}) != CallbackReturn::SUCCESS) return failed("on_activate");

  if (!updates_give(controller, 100, return_type::OK)) return failed("update");
  const Eigen::VectorXd before = hardware.commanded();
  hardware.commands[3]->locked = true;
  if (!updates_give(controller, 100, return_type::ERROR)) return failed("a joint that takes no command");
  const Eigen::VectorXd moved = hardware.commanded() - before;
  if (moved[3] != 0.0 || moved[1] == 0.0 || moved[5] == 0.0)
    return failed("only the locked joint is held back");
  hardware.commands[3]->locked = false;
  if (!updates_give(controller, 5000, return_type::OK)) return failed("update after an error");

  const Eigen::Matrix4d reached = arm.forward_kinematics(hardware.commanded());
  std::cout << "at " << reached.topRightCorner<3, 1>().transpose() << " m\n";
  return (reached - model.goal()).norm() < 1e-3 ? 0 : failed("the goal");
}
