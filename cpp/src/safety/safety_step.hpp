#pragma once

#include <dmp/safety_filter.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "safety/braking.hpp"
#include "safety/half_spaces.hpp"

namespace dmp::detail {

/// Axes over one step: where they were, and where they will be unless that is changed.
struct AxesStep {
  Eigen::Index axes;
  const double* position;
  const double* velocity;
  const double* goal;  ///< where the motion goes in the end
  double* next_position;
  double* next_velocity;
  double* next_acceleration;
};
/// The same of a rotation; angular, world frame.
struct TurnStep {
  const Eigen::Quaterniond& rotation;
  const Eigen::Vector3d& velocity;
  Eigen::Quaterniond& next_rotation;
  Eigen::Vector3d& next_velocity;
  Eigen::Vector3d& next_acceleration;
};

/// The safety filter at work: it takes the parts of a motion over a step, one after another, and changes
/// where each will be.
class SafetyStep {
 public:
  SafetyStep(const SafetyLimits& limits, int obstacles, const SafetyOptions& options);

  /// Whether it is one for a motion of so many axes, `place` of which are what obstacles are for.
  bool fits(Eigen::Index axes, Eigen::Index place) const noexcept;
  /// Into how many pieces a step is divided; more than kMostPieces are too many.
  double pieces(double dt, double duration) const noexcept;
  static constexpr double kMostPieces = 1e5;

  void begin_call() noexcept;
  void begin(double dt, double duration) noexcept;
  /// Whether the part was changed. `first`: how many axes stand before it; `place`: it is one for obstacles.
  bool keep(Eigen::Index first, bool place, const AxesStep& step) noexcept;
  bool keep(const TurnStep& step) noexcept;
  /// Obstacles go on to where they are at the end of the step.
  void end() noexcept;

  double dt() const noexcept { return dt_; }
  bool changed() const noexcept { return changed_; }
  bool blocked() const noexcept { return blocked_; }
  double clearance() const noexcept;

  const SafetyLimits& limits() const noexcept { return given_; }
  const SafetyOptions& options() const noexcept { return options_; }
  std::vector<std::optional<Obstacle>>& obstacles() noexcept { return obstacles_; }
  const std::vector<std::optional<Obstacle>>& obstacles() const noexcept { return obstacles_; }
  int count = 0;       ///< of the obstacles
  double error = 0.0;  ///< of the tracking, m

 private:
  const AxisLimits& limit(Eigen::Index axis) const noexcept;
  bool keep_axis(const AxisLimits& limits, const AxesStep& step, Eigen::Index axis) noexcept;

  struct Place;
  bool keep_place(Eigen::Index first, const AxesStep& step) noexcept;
  HalfSpaces half_spaces(Place& place, Eigen::Vector3d& wanted) const noexcept;
  bool is_within_reserve(const Eigen::Vector3d& position) const noexcept;
  bool is_safe(const Place& place, const Eigen::Vector3d& position,
               const Eigen::Vector3d& velocity) const noexcept;
  bool is_admitted(const Place& place, const HalfSpaces& spaces) const noexcept;
  Eigen::Vector3d chosen(const Place& place, const HalfSpaces& spaces,
                         const Eigen::Vector3d& wanted) noexcept;
  void remember(const Eigen::Vector3d& position) noexcept;

  SafetyLimits given_;
  SafetyOptions options_;
  std::vector<AxisLimits> axes_;
  std::vector<std::optional<Obstacle>> obstacles_;
  AxisLimits free_{};
  double dt_ = 0.0;
  double duration_ = 1.0;
  bool changed_ = false;
  bool blocked_ = false;
  static constexpr int kPlaces = 4;
  std::array<Eigen::Vector3d, kPlaces> place_;  // where the motion is, of each part that obstacles are for
  int places_ = 0;
};

/// What the primitives have of a filter.
struct SafetyAccess {
  static SafetyStep& of(SafetyFilter& filter) noexcept { return *filter.step_; }
};

}  // namespace dmp::detail
