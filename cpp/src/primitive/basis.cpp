#include <dmp/basis.hpp>
#include <dmp/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/text.hpp"
#include "primitive/gaussian_place.hpp"

namespace dmp {
namespace {

// A kernel that weighs less than this beside the largest adds nothing to a sum of doubles.
constexpr double kNegligible = 2e-17;

void require_positive(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0.0))
    throw InvalidArgument(std::string(name) + ": " + std::to_string(value) + ", expected a positive number.");
}

}  // namespace

void GaussianBasis::require_phases(const Eigen::VectorXd& s) {
  for (Eigen::Index k = 0; k < s.size(); ++k)
    if (!(s[k] >= 0.0 && std::isfinite(s[k])))
      throw InvalidArgument("phase[" + std::to_string(k) + "]: " + std::to_string(s[k]) +
                            ", expected a finite phase, 0 at the start and 1 at the end.");
}

GaussianBasis::GaussianBasis(int count, double alpha_x) : count_(count), alpha_x_(alpha_x) {
  if (count < 1 || count > 100000)
    throw InvalidArgument("basis_count: " + std::to_string(count) + ", expected 1 to 100000 kernels.");
  require_positive(alpha_x, "alpha_x");
  if (alpha_x > 50.0)
    throw InvalidArgument("alpha_x: " + std::to_string(alpha_x) +
                          ", expected at most 50: x would vanish before the end.");
}

GaussianBasis GaussianBasis::equal_in_time(int count, double alpha_x, double overlap) {
  GaussianBasis basis(count, alpha_x);
  require_positive(overlap, "overlap");
  if (overlap > kLargestOverlap)
    throw InvalidArgument("overlap: " + std::to_string(overlap) +
                          ", expected at most 300: narrower kernels leave gaps between them.");
  basis.overlap_ = overlap;
  // Beside the nearest kernel, at most half a spacing away, the one k further on weighs exp(-overlap (k^2 -
  // k)) or less.
  int reach = 1;
  while (reach < count && std::exp(-overlap * (reach + 1.0) * reach) > kNegligible) ++reach;
  basis.reach_ = reach;
  basis.capacity_ = std::min(2 * basis.reach_ + 1, count);
  for (int k = 0; k <= basis.reach_; ++k)
    basis.table_.push_back(std::exp(std::max(-overlap * k * k, kSmallestExponent)));
  return basis;
}

GaussianBasis GaussianBasis::periodic(int count, double overlap) {
  if (count < 4)
    throw InvalidArgument("basis_count: " + std::to_string(count) +
                          ", expected 4 or more kernels round a cycle.");
  GaussianBasis basis = equal_in_time(count, 1.0, overlap);
  basis.round_ = basis.overlap_;
  basis.overlap_ = 0.0;
  basis.alpha_x_ = 0.0;
  basis.reach_ = std::min(basis.reach_, (count - 1) / 2);
  basis.capacity_ = 2 * basis.reach_ + 1;
  return basis;
}

GaussianBasis GaussianBasis::source(int count, double alpha_x) {
  GaussianBasis basis(count, alpha_x);
  basis.capacity_ = count;
  const Eigen::VectorXd centers = basis.centers();
  basis.center_.assign(centers.data(), centers.data() + count);
  for (const double center : basis.center_) basis.width_.push_back(std::pow(count, 1.5) / (alpha_x * center));
  if (!std::isfinite(basis.width_.front()))
    throw InvalidArgument("alpha_x: " + detail::number(alpha_x) +
                          ", expected a larger one: the kernels of the source have no finite width.");
  return basis;
}

Eigen::VectorXd GaussianBasis::centers() const {
  if (count_ == 1 || is_periodic()) return Eigen::VectorXd::Ones(count_);
  return (-alpha_x_ * Eigen::VectorXd::LinSpaced(count_, 0.0, 1.0)).array().exp();
}

GaussianBasis::Window GaussianBasis::equal_in_time_window(double s, double* psi) const noexcept {
  const Place at = place(s);
  const double offset = s * (count_ - 1) - at.middle;
  const double up = std::exp(std::clamp(2.0 * overlap_ * offset, kSmallestExponent, -kSmallestExponent));
  double* const middle = psi + at.below;
  *middle = 1.0;
  double power = 1.0;
  for (int k = 1; k <= at.above; ++k) middle[k] = (power *= up) * table_[static_cast<std::size_t>(k)];
  const double down = 1.0 / up;
  power = 1.0;
  for (int k = 1; k <= at.below; ++k) middle[-k] = (power *= down) * table_[static_cast<std::size_t>(k)];
  return {at.middle - at.below, at.below + at.above + 1, -overlap_ * offset * offset};
}

GaussianBasis::Window GaussianBasis::round_window(double s, double* psi) const noexcept {
  const double u = (s - std::floor(s)) * count_;
  const int nearest = u >= 0.0 ? static_cast<int>(u + 0.5) : 0;  // 0 for what is not a number, too
  const double offset = u - nearest;
  const double up = std::exp(2.0 * round_ * offset);
  double* const middle = psi + reach_;
  *middle = 1.0;
  double above = 1.0, below = 1.0;
  for (int k = 1; k <= reach_; ++k) {
    middle[k] = (above *= up) * table_[static_cast<std::size_t>(k)];
    middle[-k] = (below /= up) * table_[static_cast<std::size_t>(k)];
  }
  return {nearest - reach_, capacity_, -round_ * offset * offset};
}

GaussianBasis::Window GaussianBasis::source_window(double s, double* psi) const noexcept {
  const double x = std::exp(-alpha_x_ * s);
  double largest = -std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < center_.size(); ++i) {
    psi[i] = -width_[i] * (x - center_[i]) * (x - center_[i]);
    largest = std::max(largest, psi[i]);
  }
  for (std::size_t i = 0; i < center_.size(); ++i)
    psi[i] = std::exp(std::max(psi[i] - largest, kSmallestExponent));
  return {0, count_, largest};
}

GaussianBasis::Window GaussianBasis::proportional(double s, double* psi) const noexcept {
  if (overlap_ > 0.0) return equal_in_time_window(s, psi);
  return is_periodic() ? round_window(s, psi) : source_window(s, psi);
}

GaussianBasis::Window GaussianBasis::activations(double s, double* psi) const noexcept {
  Window window = proportional(s, psi);
  const double factor = window.factor();
  for (int k = 0; k < window.count; ++k) psi[k] *= factor;
  window.exponent = 0.0;
  return window;
}

double GaussianBasis::Window::factor() const noexcept {
  return std::exp(std::max(exponent, kSmallestExponent));
}

double GaussianBasis::gate(double s) const noexcept {
  const double exponent = -alpha_x_ * s;
  return exponent > kLeastPhase ? std::exp(exponent) : 0.0;
}

RowMatrix GaussianBasis::features(const Eigen::VectorXd& s) const {
  RowMatrix table = activations(s, true);
  for (Eigen::Index k = 0; k < s.size(); ++k) table.row(k) *= gate(s[k]);
  return table;
}

RowMatrix GaussianBasis::activations(const Eigen::VectorXd& s, bool normalised) const {
  require_phases(s);
  RowMatrix table = RowMatrix::Zero(s.size(), count_);
  std::vector<double> psi(static_cast<std::size_t>(capacity_));
  for (Eigen::Index k = 0; k < s.size(); ++k) {
    const Window window = normalised ? proportional(s[k], psi.data()) : activations(s[k], psi.data());
    for (int j = 0; j < window.count; ++j)
      table(k, (window.first + j + count_) % count_) = psi[static_cast<std::size_t>(j)];
    if (normalised) table.row(k) /= table.row(k).sum();
  }
  return table;
}

}  // namespace dmp
