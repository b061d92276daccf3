#include <dmp/demonstration.hpp>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "base/text.hpp"
#include "motion/continuous_quaternions.hpp"
#include "spline/denoising.hpp"

namespace dmp {

namespace detail {

template <class Demonstrated>
struct Cleaned {
  std::once_flag once;
  std::optional<Demonstrated> motion;  // where there is noise
  NoiseEstimate first;
  NoiseEstimate second;  // of the orientations of poses
};

}  // namespace detail

namespace {

using detail::Cleaned;
using detail::continuous_quaternions;
using detail::indexed;
using detail::number;
using Eigen::Index;
using Eigen::Quaterniond;

void require_times(const Eigen::VectorXd& times, Index count, const std::string& what) {
  if (times.size() != count)
    throw InvalidArgument("times: " + std::to_string(times.size()) +
                          " of them, expected one for each of the " + std::to_string(count) + " " + what +
                          ".");
  if (count < 2)
    throw InvalidArgument(what + ": " + std::to_string(count) +
                          " samples, expected at least 2 (a start and a goal).");
  for (Index k = 0; k < count; ++k) {
    if (!std::isfinite(times[k]))
      throw InvalidArgument(indexed("times", k) + ": " + number(times[k]) + ", expected a finite time in s.");
    if (k > 0 && !(times[k] > times[k - 1]))
      throw InvalidArgument(indexed("times", k) + ": " + number(times[k]) + " s after " +
                            number(times[k - 1]) +
                            " s, expected strictly increasing times. Remove or merge the repeated samples.");
  }
}

void require_count(Index given, Index expected, const char* what) {
  if (given != expected)
    throw InvalidArgument(std::string(what) + ": " + std::to_string(given) +
                          " samples, expected one for each of the " + std::to_string(expected) + " times.");
}

/// Checked times, from 0.
Eigen::VectorXd from_zero(const Eigen::VectorXd& times, Index count, const std::string& what) {
  require_times(times, count, what);
  return times.array() - times[0];
}

RowMatrix checked(const RowMatrix& positions) {
  if (positions.cols() == 0) throw InvalidArgument("positions: no columns, expected at least one dimension.");
  for (Index k = 0; k < positions.rows(); ++k)
    for (Index d = 0; d < positions.cols(); ++d)
      if (!std::isfinite(positions(k, d)))
        throw InvalidArgument("positions[" + std::to_string(k) + ", " + std::to_string(d) +
                              "]: " + number(positions(k, d)) +
                              ", expected a finite number. Remove or fill the gap.");
  return positions;
}

/// `what` the caller gave them as.
Rotations checked(const Rotations& rotations, const char* what = "rotations") {
  Rotations result = rotations;
  for (std::size_t k = 0; k < rotations.size(); ++k) {
    if (!so3::is_rotation(rotations[k]))  // the name costs more than the look
      so3::require_rotation(rotations[k], indexed(what, static_cast<long>(k)));
    result[k] = Quaterniond(rotations[k]).normalized().toRotationMatrix();
    if (k == 0) continue;
    const double angle = so3::distance(result[k], result[k - 1]);
    if (angle > M_PI / 2)
      throw InvalidArgument(
          indexed(what, static_cast<long>(k)) + ": " + number(angle * 180 / M_PI) +
          " deg from the sample before, expected at most 90. Sample faster, or remove the jump.");
  }
  return result;
}

Quaterniond quaternion(const RowMatrix& table, Index k) {
  return {table(k, 0), table(k, 1), table(k, 2), table(k, 3)};
}

Rotations rotations_along(const RowMatrix& table) {
  Rotations rotations;
  rotations.reserve(static_cast<std::size_t>(table.rows()));
  for (Index k = 0; k < table.rows(); ++k)
    rotations.push_back(quaternion(table, k).normalized().toRotationMatrix());
  return rotations;
}

/// Whether a sample repeats the one before.
auto repeats_in(const RowMatrix& table) {
  return [&table](Index k) { return table.row(k) == table.row(k - 1); };
}
auto repeats_in(const Rotations& rotations) {
  return [&rotations](Index k) {
    return rotations[static_cast<std::size_t>(k)] == rotations[static_cast<std::size_t>(k - 1)];
  };
}

/// A turn by v changes a quaternion by v / 2.
void as_turns(NoiseEstimate& found) {
  for (double* const value : {&found.sigma, &found.removed, &found.unpredicted}) *value *= 2.0;
}

void require_measured(const Eigen::VectorXd& measured, Index count) {
  if (measured.size() != count)
    throw InvalidArgument("measured: " + std::to_string(measured.size()) +
                          " of them, expected one for each of the " + std::to_string(count) + " samples.");
  for (Index k = 0; k < count; ++k)
    if (!(measured[k] == 0.0 || measured[k] == 1.0))
      throw InvalidArgument(indexed("measured", k) + ": " + number(measured[k]) +
                            ", expected 1 for a sample that was measured, 0 for one that was filled in.");
}

/// The motion that `clean` makes of `given`, made at the first call.
template <class Demonstrated, class Clean>
Demonstrated once(Cleaned<Demonstrated>& memory, const Demonstrated& given, NoiseEstimate* first,
                  NoiseEstimate* second, Clean clean) {
  std::call_once(memory.once, [&] {
    Demonstrated motion = clean(memory);
    if (memory.first.found() || memory.second.found()) memory.motion = std::move(motion);
  });
  if (first) *first = memory.first;
  if (second) *second = memory.second;
  return memory.motion.value_or(given);
}

RowMatrix positions_of(const Poses& poses) {
  RowMatrix positions(static_cast<Index>(poses.size()), 3);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Eigen::Vector3d position = poses[k].topRightCorner<3, 1>();
    if (!position.allFinite())
      throw InvalidArgument(indexed("poses", static_cast<long>(k)) +
                            ": its position is not finite. Remove or fill the gap.");
    positions.row(static_cast<Index>(k)) = position.transpose();
  }
  return positions;
}

RowMatrix positions_at(const Eigen::VectorXd& times, const Poses& poses) {
  require_times(times, static_cast<Index>(poses.size()), "poses");
  return positions_of(poses);
}

Rotations rotations_of(const Poses& poses) {
  Rotations rotations;
  rotations.reserve(poses.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Eigen::RowVector4d last = poses[k].row(3);
    if ((last - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-9 || !last.allFinite())
      throw InvalidArgument(indexed("poses", static_cast<long>(k)) +
                            ": its last row is not 0 0 0 1. Check the layout: [R p; 0 1].");
    rotations.push_back(poses[k].topLeftCorner<3, 3>());
  }
  return rotations;
}

Rotations rotations_of(const RowMatrix& quaternions, const std::string& order) {
  if (quaternions.cols() != 4)
    throw InvalidArgument("quaternions: " + std::to_string(quaternions.cols()) + " columns, expected 4.");
  if (order != "wxyz" && order != "xyzw")
    throw InvalidArgument("order: '" + order + "' is unknown, expected wxyz or xyzw.");
  const bool scalar_first = order == "wxyz";
  Rotations rotations;
  for (Index k = 0; k < quaternions.rows(); ++k) {
    const Eigen::Vector4d q = quaternions.row(k).transpose();
    if (!(std::abs(q.norm() - 1.0) < 1e-2))  // NaN too
      throw InvalidArgument(indexed("quaternions", k) + ": its length is " + number(q.norm()) +
                            ", expected 1. Remove or fill what was lost; check the columns.");
    const Quaterniond turn = scalar_first ? Quaterniond(q[0], q[1], q[2], q[3]) : Quaterniond(q);
    rotations.push_back(turn.normalized().toRotationMatrix());
  }
  return rotations;
}

}  // namespace

Demonstration::Demonstration(const Eigen::VectorXd& times, const RowMatrix& positions)
    : time_(from_zero(times, positions.rows(), "positions")),
      position_(checked(positions)),
      spline_(time_, position_),
      cleaned_(std::make_shared<Cleaned<Demonstration>>()) {}

Demonstration Demonstration::with(const RowMatrix& positions) const {
  require_count(positions.rows(), size(), "positions");
  RowMatrix position = checked(positions);
  Spline spline = spline_.through(position);
  return {time_, std::move(position), std::move(spline)};
}

Trajectory Demonstration::at(const Eigen::VectorXd& times) const {
  Spline::Samples samples = spline_.sample(times);
  return {times, std::move(samples.value), std::move(samples.first), std::move(samples.second)};
}

Demonstration::Demonstration(Eigen::VectorXd time, RowMatrix position, Spline spline)
    : time_(std::move(time)),
      position_(std::move(position)),
      spline_(std::move(spline)),
      cleaned_(std::make_shared<Cleaned<Demonstration>>()) {}

Demonstration Demonstration::denoised(NoiseEstimate* report) const {
  return once(*cleaned_, *this, report, nullptr, [this](auto& found) {
    detail::LazyGrid grid(time_, detail::measured_weights(measured_, size(), repeats_in(position_)));
    return denoised(grid, &found.first);
  });
}

Demonstration Demonstration::denoised(detail::LazyGrid& grid, NoiseEstimate* report) const {
  if (report) *report = {};
  if (!spline_.interpolates()) return *this;
  detail::Denoised result = detail::denoise(grid, position_, static_cast<int>(dimension()), spline_);
  if (report) *report = result.estimate;
  if (!result.curve) return *this;
  Spline spline = detail::spline_of(std::move(result.curve->knots), std::move(result.curve->coefficients));
  RowMatrix position = spline.sample(time_).value;
  return {time_, std::move(position), std::move(spline)};
}

Demonstration Demonstration::with_measured(const Eigen::VectorXd& measured) const {
  require_measured(measured, size());
  Demonstration copy = *this;
  copy.measured_ = measured;
  copy.cleaned_ = std::make_shared<Cleaned<Demonstration>>();
  return copy;
}

Demonstration Demonstration::smoothed(Smoothing* report) const {
  Spline spline = Spline::smoothing(time_, position_, report);
  RowMatrix position = spline.sample(time_).value;
  return {time_, std::move(position), std::move(spline)};
}

OrientationDemonstration::OrientationDemonstration(const Eigen::VectorXd& times, const Rotations& rotations)
    : time_(from_zero(times, static_cast<Index>(rotations.size()), "rotations")),
      rotation_(checked(rotations)),
      spline_(time_, continuous_quaternions(rotation_)),
      cleaned_(std::make_shared<Cleaned<OrientationDemonstration>>()) {}

OrientationDemonstration::OrientationDemonstration(Eigen::VectorXd time, Rotations rotation, Spline spline)
    : time_(std::move(time)),
      rotation_(std::move(rotation)),
      spline_(std::move(spline)),
      cleaned_(std::make_shared<Cleaned<OrientationDemonstration>>()) {}

OrientationDemonstration OrientationDemonstration::on(const Eigen::VectorXd& time, const Spline& grid,
                                                      const Rotations& rotations, const char* what) {
  require_count(static_cast<Index>(rotations.size()), time.size(), what);
  Rotations rotation = checked(rotations, what);
  Spline spline = grid.through(continuous_quaternions(rotation));
  return {time, std::move(rotation), std::move(spline)};
}

OrientationDemonstration OrientationDemonstration::with(const Rotations& rotations) const {
  return on(time_, spline_, rotations, "rotations");
}

OrientationDemonstration OrientationDemonstration::denoised(NoiseEstimate* report) const {
  return once(*cleaned_, *this, report, nullptr, [this](auto& found) {
    detail::LazyGrid grid(time_, detail::measured_weights(measured_, size(), repeats_in(rotation_)));
    return denoised(grid, &found.first);
  });
}

OrientationDemonstration OrientationDemonstration::denoised(detail::LazyGrid& grid,
                                                            NoiseEstimate* report) const {
  if (report) *report = {};
  if (!spline_.interpolates()) return *this;
  detail::Denoised result = detail::denoise(grid, continuous_quaternions(rotation_), 3, spline_);
  as_turns(result.estimate);
  if (report) *report = result.estimate;
  if (!result.curve) return *this;
  Spline spline = detail::spline_of(std::move(result.curve->knots), std::move(result.curve->coefficients));
  Rotations rotations = rotations_along(spline.sample(time_).value);
  return {time_, std::move(rotations), std::move(spline)};
}

OrientationDemonstration OrientationDemonstration::with_measured(const Eigen::VectorXd& measured) const {
  require_measured(measured, size());
  OrientationDemonstration copy = *this;
  copy.measured_ = measured;
  copy.cleaned_ = std::make_shared<Cleaned<OrientationDemonstration>>();
  return copy;
}

OrientationDemonstration OrientationDemonstration::smoothed(Smoothing* report) const {
  Smoothing found;
  Spline spline = Spline::smoothing(time_, continuous_quaternions(rotation_), &found);
  Rotations rotations = rotations_along(spline.sample(time_).value);
  // A turn by v changes a quaternion by v / 2, which has three free directions of its four.
  const auto per_axis = [](const Eigen::VectorXd& q) {
    return Eigen::VectorXd::Constant(1, 2.0 * q.norm() / std::sqrt(3.0));
  };
  if (report) *report = {per_axis(found.noise), per_axis(found.removed)};
  return {time_, std::move(rotations), std::move(spline)};
}

OrientationDemonstration OrientationDemonstration::from_euler(const Eigen::VectorXd& times,
                                                              const RowMatrix& angles,
                                                              const std::string& convention) {
  if (angles.cols() != 3)
    throw InvalidArgument("angles: " + std::to_string(angles.cols()) + " columns, expected 3 (rad).");
  Rotations rotations;
  for (Index k = 0; k < angles.rows(); ++k) {
    if (!angles.row(k).allFinite())
      throw InvalidArgument(indexed("angles", k) + ": not finite, expected three angles in rad.");
    rotations.push_back(so3::from_euler(angles.row(k).transpose(), convention));
  }
  return {times, rotations};
}

OrientationDemonstration OrientationDemonstration::from_quaternions(const Eigen::VectorXd& times,
                                                                    const RowMatrix& quaternions,
                                                                    const std::string& order) {
  return {times, rotations_of(quaternions, order)};
}

OrientationTrajectory OrientationDemonstration::at(const Eigen::VectorXd& times) const {
  const Spline::Samples samples = spline_.sample(times);
  OrientationTrajectory result{times, {}, RowMatrix(times.size(), 3), RowMatrix(times.size(), 3)};
  result.rotation.reserve(static_cast<std::size_t>(times.size()));
  for (Index k = 0; k < times.size(); ++k) {
    // q = rho u with |u| = 1: rho cancels in the vector parts of qd q^-1 and qdd q^-1 - (qd q^-1)^2.
    const Quaterniond q = quaternion(samples.value, k);
    const Quaterniond inverse(q.conjugate().coeffs() / q.squaredNorm());
    const Quaterniond rate = quaternion(samples.first, k) * inverse;
    const Quaterniond change = quaternion(samples.second, k) * inverse;
    result.rotation.push_back(q.normalized().toRotationMatrix());
    result.angular_velocity.row(k) = 2.0 * rate.vec().transpose();
    result.angular_acceleration.row(k) = 2.0 * (change.vec() - (rate * rate).vec()).transpose();
  }
  return result;
}

PoseDemonstration::PoseDemonstration(const Eigen::VectorXd& times, const Poses& poses)
    : position_(times, positions_at(times, poses)),
      orientation_(
          OrientationDemonstration::on(position_.time_, position_.spline_, rotations_of(poses), "poses")),
      cleaned_(std::make_shared<Cleaned<PoseDemonstration>>()) {}

PoseDemonstration PoseDemonstration::from_quaternions(const Eigen::VectorXd& times,
                                                      const RowMatrix& positions,
                                                      const RowMatrix& quaternions,
                                                      const std::string& order) {
  if (positions.cols() != 3)
    throw InvalidArgument("positions: " + std::to_string(positions.cols()) + " columns, expected 3 (m).");
  require_count(quaternions.rows(), positions.rows(), "quaternions");
  Demonstration position(times, positions);
  const Rotations rotations = rotations_of(quaternions, order);
  OrientationDemonstration orientation =
      OrientationDemonstration::on(position.time_, position.spline_, rotations, "quaternions");
  return {std::move(position), std::move(orientation)};
}

PoseDemonstration::PoseDemonstration(Demonstration position, OrientationDemonstration orientation)
    : position_(std::move(position)),
      orientation_(std::move(orientation)),
      cleaned_(std::make_shared<Cleaned<PoseDemonstration>>()) {}

PoseDemonstration PoseDemonstration::with(const Poses& poses) const {
  require_count(static_cast<Index>(poses.size()), size(), "poses");
  const OrientationDemonstration& known = orientation_;
  return {position_.with(positions_of(poses)),
          OrientationDemonstration::on(known.time_, known.spline_, rotations_of(poses), "poses")};
}

PoseDemonstration PoseDemonstration::smoothed(Smoothing* position, Smoothing* orientation) const {
  return {position_.smoothed(position), orientation_.smoothed(orientation)};
}

PoseDemonstration PoseDemonstration::denoised(NoiseEstimate* position, NoiseEstimate* orientation) const {
  return once(*cleaned_, *this, position, orientation, [this](auto& found) {
    const auto moved = repeats_in(position_.position_);
    const auto turned = repeats_in(orientation_.rotation_);
    detail::LazyGrid grid(time(), detail::measured_weights(position_.measured_, size(),
                                                           [&](Index k) { return moved(k) && turned(k); }));
    return PoseDemonstration(position_.denoised(grid, &found.first),
                             orientation_.denoised(grid, &found.second));
  });
}

PoseDemonstration PoseDemonstration::with_measured(const Eigen::VectorXd& measured) const {
  return {position_.with_measured(measured), orientation_.with_measured(measured)};
}

Poses PoseDemonstration::pose() const {
  Poses poses;
  poses.reserve(static_cast<std::size_t>(size()));
  for (Index k = 0; k < size(); ++k)
    poses.push_back(
        pose_of(orientation_.rotation()[static_cast<std::size_t>(k)], position_.position().row(k)));
  return poses;
}

Eigen::Matrix4d pose_of(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& position) noexcept {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = rotation;
  pose.topRightCorner<3, 1>() = position;
  return pose;
}

}  // namespace dmp
