#pragma once

#include <Eigen/Core>
#include <array>

#include "safety/axis_limits.hpp"

namespace dmp::detail {

/// The point nearest to a wanted one, as far as the interval of each axis allows that, with n_j . x >= b_j of
/// every row; the intervals count before the rows.
class HalfSpaces {
 public:
  static constexpr int kMost = 8;

  explicit HalfSpaces(const std::array<Interval, 3>& box) noexcept : box_(box) {}

  /// Refuses (false) a row that hardly bears on the axes, or beyond kMost.
  bool add(const Eigen::Vector3d& normal, double bound) noexcept;
  bool admits(const Eigen::Vector3d& x, double tolerance = 0.0) const noexcept;
  Eigen::Vector3d clamped(const Eigen::Vector3d& x) const noexcept;
  /// By alternate projection with memory, the dual coordinate ascent (Hildreth 1957; Dykstra 1983). Where no
  /// point keeps all, the rows are kept as far as the sweeps come and the intervals are kept.
  Eigen::Vector3d nearest(const Eigen::Vector3d& wanted) const noexcept;

 private:
  struct Row {
    Eigen::Vector3d normal;
    double bound;
    double square;
  };
  std::array<Interval, 3> box_;
  std::array<Row, kMost> rows_;
  int count_ = 0;
};

}  // namespace dmp::detail
