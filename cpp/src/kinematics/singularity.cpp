#include "kinematics/singularity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace dmp::detail {
namespace {
constexpr double least_singular_value = 1e-3;  // m/rad
constexpr double most = 0.5;                   // of the error
}  // namespace

bool is_singular(const PoseGoal& goal, const Frame& target, const Jacobian& jacobian, const Vector6& error) {
  const Jacobian rows = goal.weighted(target, jacobian);
  const Vector6 wanted = goal.weighted(target, error);
  const Matrix6 square = rows * rows.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(square);
  const Vector6 share = solver.eigenvectors().transpose() * wanted;
  const Eigen::Index lost =
      (solver.eigenvalues().array() < least_singular_value * least_singular_value).count();
  const Eigen::Index always = 6 - std::min(goal.dimension(), jacobian.cols());
  return lost > always && share.head(lost).squaredNorm() > most * most * wanted.squaredNorm();
}

}  // namespace dmp::detail
