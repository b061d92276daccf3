#include <dmp/reach_speed.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kinematics/random.hpp"
#include "robot/checks.hpp"
#include "robot/flat_chain.hpp"

namespace dmp {
namespace {

using detail::Jacobian;
using detail::Joints;
using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, detail::joint_capacity>;

constexpr int postures = 20000, kept = 50, changes = 100;
constexpr int all_corners = 10;  // joints up to which every corner of the box is looked at

// The longest sum of the columns with signs: corner by corner, each one sign away from the last (Gray code).
double longest_sum(const Rows& columns) {
  const Eigen::Index n = columns.cols();
  Eigen::Vector3d sum = columns.rowwise().sum();
  double longest = sum.squaredNorm();
  if (n > all_corners) {  // from each column's direction: signs that point along the sum, until none changes
    for (Eigen::Index j = 0; j < n; ++j) {
      Eigen::Vector3d along = columns.col(j);
      for (int i = 0; i < 20; ++i) along = columns * (columns.transpose() * along).cwiseSign();
      longest = std::max(longest, along.squaredNorm());
    }
    return std::sqrt(longest);
  }
  std::vector<double> sign(static_cast<std::size_t>(n), 1.0);
  for (unsigned k = 1; k < (1u << (n - 1)); ++k) {
    Eigen::Index flipped = 0;
    while (!((k >> flipped) & 1u)) ++flipped;
    double& s = sign[static_cast<std::size_t>(flipped)];
    s = -s;
    sum += 2.0 * s * columns.col(flipped);
    longest = std::max(longest, sum.squaredNorm());
  }
  return std::sqrt(longest);
}

class Search {
 public:
  explicit Search(const Arm& arm) : chain_(arm.model()), velocity_(arm.velocity_limit()) {
    lower_ = arm.lower().array().isFinite().select(arm.lower(), -3.14159265358979);
    upper_ = arm.upper().array().isFinite().select(arm.upper(), 3.14159265358979);
  }

  double largest(Eigen::Index first_row) {
    std::vector<std::pair<double, Joints>> found;
    for (int k = 0; k < postures; ++k) {
      const Joints q = random_.between(lower_, upper_);
      found.emplace_back(speed(q, first_row), q);
    }
    const auto better = [](const auto& a, const auto& b) { return a.first > b.first; };
    std::partial_sort(found.begin(), found.begin() + kept, found.end(), better);
    found.resize(kept);
    for (auto& one : found) improve(one, first_row);
    return std::max_element(found.begin(), found.end(),
                            [&](const auto& a, const auto& b) { return better(b, a); })
        ->first;
  }

 private:
  double speed(const Joints& q, Eigen::Index first_row) const {
    Jacobian jacobian;
    chain_.forward(q, jacobian);
    return longest_sum(jacobian.middleRows<3>(first_row) * velocity_.asDiagonal());
  }

  void improve(std::pair<double, Joints>& best, Eigen::Index first_row) {
    for (int i = 0; i < changes; ++i) {
      const double step = 0.1 * (1.0 - static_cast<double>(i) / changes);
      Joints q = best.second;
      for (Eigen::Index j = 0; j < q.size(); ++j)
        q[j] = std::clamp(q[j] + step * (2.0 * random_.uniform() - 1.0) * (upper_[j] - lower_[j]), lower_[j],
                          upper_[j]);
      const double faster = speed(q, first_row);
      if (faster > best.first) best = {faster, q};
    }
  }

  detail::FlatChain chain_;
  Joints velocity_, lower_, upper_;
  detail::Random random_{1};
};

}  // namespace

TipSpeed fastest_tip(const Arm& arm) {
  detail::check_capacity(arm);
  if (!arm.velocity_limit().allFinite())
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Search search(arm);
  const double linear = search.largest(0);
  return {linear, search.largest(3)};
}

}  // namespace dmp
