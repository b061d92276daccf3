#include "robot/urdf_chain.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <dmp/error.hpp>
#include <limits>
#include <map>

#include "base/text.hpp"
#include "robot/arm_choice.hpp"
#include "robot/kdl_chain.hpp"

namespace dmp::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check_kind(const urdf::Joint& joint) {
  if (joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::PLANAR ||
      joint.type == urdf::Joint::UNKNOWN)
    refuse(joint,
           "floating, planar and unknown joints cannot stand between base and tip; choose another base.");
}

// URDF asks for a unit axis and urdfdom takes any. To Bullet the length is a factor on a prismatic joint.
void check_axis(const urdf::Joint& joint, std::vector<std::string>& warnings) {
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  const double length = axis.stableNorm();
  const std::string stated =
      "axis (" + number(axis.x()) + " " + number(axis.y()) + " " + number(axis.z()) + ")";
  if (!(length >= shortest_axis) || !std::isfinite(length))
    refuse(joint, stated + " is zero or not finite; expected a direction such as xyz=\"0 0 1\".");
  if (std::abs(length - 1.0) > 1e-3)
    warnings.push_back("joint '" + joint.name + "': " + stated + " has length " + number(length) +
                       ", expected 1; kinematics normalise it, a simulator may not.");
}

struct Range {
  double lower, upper;
};

// Soft limits narrow the range; a pair of zeros is how exporters write "none".
Range with_soft_limits(const urdf::Joint& joint, Range range, std::vector<std::string>& warnings) {
  if (!joint.safety) return range;
  const Range soft = {joint.safety->soft_lower_limit, joint.safety->soft_upper_limit};
  const Range both = {std::max(range.lower, soft.lower), std::min(range.upper, soft.upper)};
  if ((soft.lower == 0.0 && soft.upper == 0.0) || !(both.lower < both.upper)) {
    warnings.push_back("joint '" + joint.name + "': safety limits " + std::to_string(soft.lower) + " to " +
                       std::to_string(soft.upper) + " leave no range and were ignored.");
    return range;
  }
  return both;
}

Range range_of(const urdf::Joint& joint, std::vector<std::string>& warnings) {
  if (joint.type == urdf::Joint::CONTINUOUS) return {-infinity, infinity};
  if (!joint.limits) refuse(joint, "it has no <limit>; expected lower and upper.");
  const Range range = {joint.limits->lower, joint.limits->upper};
  if (!(range.lower < range.upper))
    refuse(joint, "limits lower = " + std::to_string(range.lower) +
                      ", upper = " + std::to_string(range.upper) +
                      ", expected lower < upper (a <limit> without them counts as 0 and 0).");
  return with_soft_limits(joint, range, warnings);
}

// A limit of zero would forbid every motion: exporters write it for "not known".
double positive_or_none(double limit, const urdf::Joint& joint, const char* what,
                        std::vector<std::string>& warnings) {
  if (limit > 0.0) return limit;
  warnings.push_back("joint '" + joint.name + "': " + what + " limit " + std::to_string(limit) +
                     " was ignored.");
  return infinity;
}

// Collects the free joints with their limits, then lets mimic joints follow them.
class JointTable {
 public:
  JointTable(ChainModel& model, const UrdfScan& scan) : model_(model), scan_(scan) {}

  void add_free(const urdf::Joint& joint) {
    index_[joint.name] = static_cast<Eigen::Index>(model_.joint_names.size());
    model_.joint_names.push_back(joint.name);
    ranges_.push_back(range_of(joint, model_.warnings));
    const bool stated = joint.limits != nullptr;
    velocity_.push_back(stated ? positive_or_none(joint.limits->velocity, joint, "velocity", model_.warnings)
                               : infinity);
    effort_.push_back(stated ? positive_or_none(joint.limits->effort, joint, "effort", model_.warnings)
                             : infinity);
    const auto higher = scan_.higher.find(joint.name);
    higher_.push_back(higher == scan_.higher.end() ? HigherLimits() : higher->second);
  }

  Coupling couple(const urdf::Joint& joint) {
    if (!joint.mimic) return {index_.at(joint.name), 1.0, 0.0};
    const auto master = index_.find(joint.mimic->joint_name);
    if (master == index_.end())
      refuse(joint,
             "it mimics '" + joint.mimic->joint_name + "', which is not a free joint between base and tip.");
    const Coupling coupling = {master->second, joint.mimic->multiplier, joint.mimic->offset};
    narrow(joint, coupling);
    return coupling;
  }

  void finish() {
    const auto n = static_cast<Eigen::Index>(ranges_.size());
    model_.lower.resize(n);
    model_.upper.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      model_.lower[i] = ranges_[static_cast<std::size_t>(i)].lower;
      model_.upper[i] = ranges_[static_cast<std::size_t>(i)].upper;
    }
    model_.velocity_limit = Eigen::Map<const Eigen::VectorXd>(velocity_.data(), n);
    model_.effort_limit = Eigen::Map<const Eigen::VectorXd>(effort_.data(), n);
    model_.acceleration_limit.resize(n);
    model_.jerk_limit.resize(n);
    std::vector<LimitSource> of_acceleration;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto [acceleration, jerk] = higher_[static_cast<std::size_t>(i)];
      model_.acceleration_limit[i] = acceleration > 0.0 ? acceleration : assumed_acceleration;
      model_.jerk_limit[i] = jerk > 0.0 ? jerk : infinity;
      of_acceleration.push_back(acceleration > 0.0 ? LimitSource::urdf : LimitSource::assumed);
    }
    model_.limit_sources = {sources(model_.lower.cwiseAbs().cwiseMin(model_.upper.cwiseAbs())),
                            sources(model_.velocity_limit), of_acceleration, sources(model_.jerk_limit),
                            sources(model_.effort_limit)};
  }

 private:
  static std::vector<LimitSource> sources(const Eigen::VectorXd& limit) {
    std::vector<LimitSource> found;
    for (const double value : limit)
      found.push_back(std::isfinite(value) ? LimitSource::urdf : LimitSource::unstated);
    return found;
  }

  // The master may go only where the joint that follows it may go too, and only so fast.
  void narrow(const urdf::Joint& joint, const Coupling& coupling) {
    const double m = coupling.multiplier;
    if (m == 0.0 || !std::isfinite(m) || !std::isfinite(coupling.offset))
      refuse(joint, "its mimic multiplier is zero or not finite.");
    const auto i = static_cast<std::size_t>(coupling.joint);
    const Range own = range_of(joint, model_.warnings);
    const auto [low, high] =
        std::minmax({(own.lower - coupling.offset) / m, (own.upper - coupling.offset) / m});
    ranges_[i] = {std::max(ranges_[i].lower, low), std::min(ranges_[i].upper, high)};
    if (!(ranges_[i].lower < ranges_[i].upper))
      refuse(joint, "its limits leave no range to the joint it mimics.");
    if (joint.limits && joint.limits->velocity > 0.0)
      velocity_[i] = std::min(velocity_[i], joint.limits->velocity / std::abs(m));
  }

  ChainModel& model_;
  const UrdfScan& scan_;
  std::map<std::string, Eigen::Index> index_;
  std::vector<Range> ranges_;
  std::vector<double> velocity_, effort_;
  std::vector<HigherLimits> higher_;
};

void read_joints(const UrdfPath& path, const UrdfScan& scan, ChainModel& model) {
  JointTable table(model, scan);
  for (const auto& joint : path)
    if (moves(*joint)) {
      check_kind(*joint);
      check_axis(*joint, model.warnings);
    }
  for (const auto& joint : path)
    if (moves(*joint) && !joint->mimic) table.add_free(*joint);
  for (const auto& joint : path)
    if (moves(*joint)) model.couplings.push_back(table.couple(*joint));
  if (model.joint_names.empty())
    throw InvalidArgument("urdf: no moving joint between '" + model.base + "' and '" + model.tip + "'.");
  table.finish();
}

// Inertia plays no part in kinematics, but a simulator that loads the same robot may fail on it.
void warn_of_inertia(const urdf::Link& link, std::vector<std::string>& warnings) {
  if (!link.inertial) return;
  const urdf::Inertial& body = *link.inertial;
  Eigen::Matrix3d inertia;
  inertia << body.ixx, body.ixy, body.ixz, body.ixy, body.iyy, body.iyz, body.ixz, body.iyz, body.izz;
  const Eigen::Vector3d moments = inertia.selfadjointView<Eigen::Lower>().eigenvalues();
  const double tolerance = 1e-9 * moments.cwiseAbs().maxCoeff();
  const bool possible = (body.mass > 0.0 || inertia.isZero(0.0)) && body.mass >= 0.0 &&
                        moments[0] >= -tolerance && moments[2] <= moments[0] + moments[1] + tolerance;
  if (!possible)
    warnings.push_back("link '" + link.name +
                       "': no body has this mass and inertia; kinematics ignore them, a simulator may not.");
}

// What urdfdom passes over: parts that it could not read, and limits of which one half is stated.
void warn_of_what_is_missing(const ParsedUrdf& parsed, const UrdfPath& path,
                             std::vector<std::string>& warnings) {
  if (!parsed.complaints.empty()) warnings.push_back("urdfdom: " + parsed.complaints);
  for (const auto& joint : path) {
    const auto missing = parsed.scan.missing.find(joint->name);
    if (missing != parsed.scan.missing.end() && joint->type != urdf::Joint::CONTINUOUS)
      warnings.push_back("joint '" + joint->name + "': its <limit> states no " + missing->second +
                         ", which counts as 0.");
  }
}

}  // namespace

ChainModel read_urdf(const std::string& text, const std::string& base, const std::string& tip) {
  const ParsedUrdf parsed = parse_urdf(text);
  const urdf::ModelInterfaceSharedPtr urdf = parsed.model;
  ChainModel model;
  model.name = urdf->getName();
  const ArmChoice choice = choose_arm(*urdf, base, tip);
  model.base = choice.base;
  model.tip = choice.tip;
  model.choice = choice.reason;
  const UrdfPath path = path_between(*urdf, model.base, model.tip);
  read_joints(path, parsed.scan, model);
  warn_of_what_is_missing(parsed, path, model.warnings);
  model.chain = chain_of(path, *urdf);
  model.up = up_in(*urdf, urdf->getLink(model.base));
  for (const auto& joint : path) warn_of_inertia(*urdf->getLink(joint->child_link_name), model.warnings);
  model.urdf = text;
  return model;
}

}  // namespace dmp::detail
