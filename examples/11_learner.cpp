// A learner of your own: weights from the targets of demonstrations, here by ridge regression;
// and a model made from weights.
#include <dmp/dmp.hpp>

#include <Eigen/Cholesky>
#include <cmath>
#include <iostream>
#include <vector>

int main() {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);  // s
  std::vector<dmp::Demonstration> demonstrations;
  for (const double height : {0.2, 0.3, 0.4}) {
    dmp::RowMatrix positions(100, 1);  // m
    positions.col(0) = height * (M_PI * times.array()).sin().square();
    demonstrations.emplace_back(times, positions);
  }

  const auto ridge = [](const dmp::GaussianBasis& basis, const std::vector<dmp::ForcingTarget>& targets) {
    Eigen::MatrixXd gram = 1e-9 * Eigen::MatrixXd::Identity(basis.count(), basis.count());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(basis.count(), targets[0].value.cols());
    for (const dmp::ForcingTarget& target : targets) {
      const dmp::RowMatrix features = basis.features(target.s);  // (K x N): f = features * weights
      gram += features.transpose() * features;
      right += features.transpose() * target.value;
    }
    return dmp::RowMatrix(gram.llt().solve(right));
  };
  dmp::DmpOptions options;
  options.basis_count = 40;
  const dmp::Dmp bump = dmp::Dmp::fit(demonstrations, options, ridge);

  // The motion is linear in its weights: half of them are half the bump.
  const dmp::Dmp half = bump.with_weights(0.5 * bump.parameters().weights);
  const double full_height = bump.rollout().position.maxCoeff();
  const double half_height = half.rollout().position.maxCoeff();
  std::cout << "the mean bump is " << full_height << " m high, half of its weights make " << half_height
            << " m\n";
  return std::abs(full_height - 0.3) < 1e-3 && std::abs(half_height - 0.15) < 1e-3 ? 0 : 1;
}
