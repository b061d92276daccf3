#include <dmp/error.hpp>
#include <dmp/safety_filter.hpp>

#include <cmath>
#include <string>

#include "base/text.hpp"
#include "safety/safety_step.hpp"

namespace dmp {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kFar = 1e9;  // m

void require(bool holds, const std::string& name, double value, const char* expected) {
  if (!holds) throw InvalidArgument(name + ": " + detail::number(value) + ", expected " + expected + ".");
}

void require_each(const VectorXd& values, const char* name, Index axes, double least, const char* expected) {
  if (values.size() != 0 && values.size() != axes)
    throw InvalidArgument(std::string(name) + ": " + std::to_string(values.size()) + " numbers, expected " +
                          std::to_string(axes) + ", as many as the other limits have.");
  for (Index axis = 0; axis < values.size(); ++axis)
    require(values[axis] > least, detail::indexed(name, axis), values[axis], expected);
}

void require_limits(const SafetyLimits& limits) {
  Index axes = 0;
  for (const VectorXd* values : {&limits.lower, &limits.upper, &limits.velocity, &limits.acceleration})
    axes = std::max(axes, values->size());
  constexpr double kAny = -std::numeric_limits<double>::infinity();
  require_each(limits.velocity, "velocity", axes, 0.0, "a limit above 0");
  require_each(limits.acceleration, "acceleration", axes, 0.0, "a limit above 0");
  require_each(-limits.lower, "lower", axes, kAny, "a number");
  require_each(limits.upper, "upper", axes, kAny, "a number");
  for (Index axis = 0; axis < std::min(limits.lower.size(), limits.upper.size()); ++axis)
    require(limits.upper[axis] > limits.lower[axis], detail::indexed("upper", axis), limits.upper[axis],
            "more than lower");
  require(limits.angular_velocity > 0.0, "angular_velocity", limits.angular_velocity, "a limit above 0");
  require(limits.angular_acceleration > 0.0, "angular_acceleration", limits.angular_acceleration,
          "a limit above 0");
}

void require_options(int obstacles, const SafetyOptions& options) {
  require(obstacles >= 1 && obstacles <= 256, "obstacles", obstacles, "room for 1 to 256");
  require(options.margin > 0.0 && options.margin <= kFar, "margin", options.margin,
          "a length in m above 0, to 1e9");
  require(options.radius >= 0.0 && options.radius <= kFar, "radius", options.radius,
          "a length in m, 0 to 1e9");
  require(options.gain >= 1.0 && options.gain <= 100.0, "gain", options.gain, "1 to 100");
  require(options.largest_step > 0.0 && options.largest_step <= 1e3, "largest_step", options.largest_step,
          "a time in s above 0, to 1000");
}

std::unique_ptr<detail::SafetyStep> checked_step(const SafetyLimits& limits, int obstacles,
                                                 const SafetyOptions& options) {
  require_limits(limits);
  require_options(obstacles, options);
  return std::make_unique<detail::SafetyStep>(limits, obstacles, options);
}

}  // namespace

SafetyFilter::SafetyFilter(const SafetyLimits& limits, int obstacles, const SafetyOptions& options)
    : step_(checked_step(limits, obstacles, options)) {}
SafetyFilter::SafetyFilter(const SafetyFilter& other)
    : step_(std::make_unique<detail::SafetyStep>(*other.step_)) {}
SafetyFilter::SafetyFilter(SafetyFilter&& other) noexcept = default;
SafetyFilter& SafetyFilter::operator=(const SafetyFilter& other) {
  if (this != &other) step_ = std::make_unique<detail::SafetyStep>(*other.step_);
  return *this;
}
SafetyFilter& SafetyFilter::operator=(SafetyFilter&& other) noexcept = default;
SafetyFilter::~SafetyFilter() = default;

int SafetyFilter::room() const noexcept { return static_cast<int>(step_->obstacles().size()); }

Status SafetyFilter::set(int index, const Obstacle& obstacle) noexcept {
  if (index < 0 || index >= room() || !is_obstacle(obstacle)) return Status::invalid_input;
  std::optional<Obstacle>& place = step_->obstacles()[static_cast<std::size_t>(index)];
  if (!place) ++step_->count;
  place = obstacle;
  return Status::running;
}

Status SafetyFilter::remove(int index) noexcept {
  if (index < 0 || index >= room()) return Status::invalid_input;
  std::optional<Obstacle>& place = step_->obstacles()[static_cast<std::size_t>(index)];
  if (place) --step_->count;
  place.reset();
  return Status::running;
}

void SafetyFilter::clear() noexcept {
  for (int index = 0; index < room(); ++index) remove(index);
}

const Obstacle* SafetyFilter::obstacle(int index) const noexcept {
  if (index < 0 || index >= room()) return nullptr;
  const std::optional<Obstacle>& place = step_->obstacles()[static_cast<std::size_t>(index)];
  return place ? &*place : nullptr;
}

Status SafetyFilter::set_tracking_error(double error) noexcept {
  if (!(error >= 0.0 && error <= kFar)) return Status::invalid_input;
  step_->error = error;
  return Status::running;
}

double SafetyFilter::clearance() const noexcept { return step_->clearance(); }
bool SafetyFilter::changed() const noexcept { return step_->changed(); }
const SafetyLimits& SafetyFilter::limits() const noexcept { return step_->limits(); }
const SafetyOptions& SafetyFilter::options() const noexcept { return step_->options(); }

}  // namespace dmp
