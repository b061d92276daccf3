#include "dmp_controller.hpp"

#include <dmp/error.hpp>
#include <dmp/file.hpp>
#include <dmp/time_scaling.hpp>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <stdexcept>

namespace dmp_controller {

using controller_interface::CallbackReturn;
using controller_interface::InterfaceConfiguration;
using controller_interface::return_type;

namespace {

constexpr double kAcceleration = 5.0;  // rad/s^2, where a URDF can state none
constexpr double kStep = 0.01;         // s between the poses that joints are found for

}  // namespace

CallbackReturn DmpController::on_init() {
  for (const char* name : {"model", "urdf", "base", "tip"}) auto_declare<std::string>(name, "");
  auto_declare<std::vector<std::string>>("joints", {});
  return CallbackReturn::SUCCESS;
}

std::vector<std::string> DmpController::interfaces(const std::string& kind) const {
  std::vector<std::string> names;
  for (const std::string& joint : joints_) names.push_back(joint + "/" + kind);
  return names;
}

InterfaceConfiguration DmpController::command_interface_configuration() const {
  return {controller_interface::interface_configuration_type::INDIVIDUAL, interfaces("position")};
}

InterfaceConfiguration DmpController::state_interface_configuration() const {
  return {controller_interface::interface_configuration_type::INDIVIDUAL, interfaces("position")};
}

CallbackReturn DmpController::on_configure(const rclcpp_lifecycle::State&) {
  const auto text = [this](const char* name) { return get_node()->get_parameter(name).as_string(); };
  try {
    model_ = dmp::load_pose_dmp(text("model"));
    arm_ = dmp::Arm::from_urdf_file(text("urdf"), text("base"), text("tip"));
    joints_ = get_node()->get_parameter("joints").as_string_array();
    if (joints_ != arm_->joint_names())
      throw dmp::InvalidArgument("joints: expected those of the arm, in its order.");
  } catch (const std::exception& error) {
    RCLCPP_ERROR(get_node()->get_logger(), "%s", error.what());
    return CallbackReturn::ERROR;
  }
  return CallbackReturn::SUCCESS;
}

void DmpController::plan(const Eigen::VectorXd& measured) {
  // The robot stands where it stands: the motion begins there, and goes to the goal that was learned.
  dmp::PoseRun run(*model_);
  if (run.start_from(arm_->forward_kinematics(measured), Eigen::Matrix<double, 6, 1>::Zero()) ==
      dmp::Status::invalid_input)
    throw dmp::InvalidArgument("the measured joints give no pose.");
  dmp::Poses poses{run.pose()};
  while (run.step(kStep) == dmp::Status::running) poses.push_back(run.pose());
  const auto count = static_cast<Eigen::Index>(poses.size());
  dmp::FollowOptions options;
  options.start = measured;
  plan_ = dmp::InverseKinematics(*arm_).follow(
      Eigen::VectorXd::LinSpaced(count, 0.0, kStep * static_cast<double>(count - 1)), poses, options);
  if (!plan_.report.complete()) throw dmp::InvalidArgument(plan_.report.summary());
  const Eigen::VectorXd acceleration = Eigen::VectorXd::Constant(arm_->joint_count(), kAcceleration);
  plan_ =
      dmp::stretched(plan_, std::max(1.0, dmp::duration_factor(plan_, arm_->velocity_limit(), acceleration)));
}

Eigen::VectorXd DmpController::measured() const {
  Eigen::VectorXd joints(arm_->joint_count());
  for (Eigen::Index i = 0; i < joints.size(); ++i) {
    const auto& state = state_interfaces_[static_cast<std::size_t>(i)];
    const std::optional<double> position = state.get_optional();
    if (!position) throw std::runtime_error(state.get_name() + ": could not be read.");
    joints[i] = *position;
  }
  return joints;
}

CallbackReturn DmpController::on_activate(const rclcpp_lifecycle::State&) {
  try {
    plan(measured());
  } catch (const std::exception& error) {
    RCLCPP_ERROR(get_node()->get_logger(), "%s", error.what());
    return CallbackReturn::ERROR;
  }
  elapsed_ = 0.0;
  sample_ = 0;
  return CallbackReturn::SUCCESS;
}

return_type DmpController::update(const rclcpp::Time&, const rclcpp::Duration& period) {
  elapsed_ += period.seconds();
  const Eigen::Index last = plan_.time.size() - 1;
  while (sample_ < last && plan_.time[sample_ + 1] <= elapsed_) ++sample_;
  const Eigen::Index next = std::min(sample_ + 1, last);
  const double span = plan_.time[next] - plan_.time[sample_];
  const double share = span > 0.0 ? (elapsed_ - plan_.time[sample_]) / span : 0.0;
  bool taken = true;  // a joint that refuses keeps none of the others back
  for (Eigen::Index i = 0; i < plan_.position.cols(); ++i) {
    const double from = plan_.position(sample_, i);
    const double position = from + share * (plan_.position(next, i) - from);
    taken &= command_interfaces_[static_cast<std::size_t>(i)].set_value(position);
  }
  return taken ? return_type::OK : return_type::ERROR;
}

}  // namespace dmp_controller

PLUGINLIB_EXPORT_CLASS(dmp_controller::DmpController, controller_interface::ControllerInterface)
