#include <dmp/basis.hpp>
#include <dmp/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dmp {
namespace {

// A kernel that weighs less than this beside the largest adds nothing to a sum of doubles.
constexpr double kNegligible = 2e-17;
// exp of less would be denormal, which costs a hundred times more than a normal number.
constexpr double kSmallestExponent = -700.0;

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

GaussianBasis GaussianBasis::source(int count, double alpha_x) {
  GaussianBasis basis(count, alpha_x);
  basis.capacity_ = count;
  const Eigen::VectorXd centers = basis.centers();
  basis.center_.assign(centers.data(), centers.data() + count);
  for (const double center : basis.center_) basis.width_.push_back(std::pow(count, 1.5) / (alpha_x * center));
  return basis;
}

Eigen::VectorXd GaussianBasis::centers() const {
  if (count_ == 1) return Eigen::VectorXd::Ones(1);
  return (-alpha_x_ * Eigen::VectorXd::LinSpaced(count_, 0.0, 1.0)).array().exp();
}

int GaussianBasis::nearest(double s) const noexcept {
  const double u = s * (count_ - 1);
  return static_cast<int>(std::clamp(u + 0.5, 0.0, static_cast<double>(count_ - 1)));
}

GaussianBasis::Window GaussianBasis::equal_in_time_window(double s, double* psi) const noexcept {
  const int middle = nearest(s);
  const double offset = s * (count_ - 1) - middle;
  const Window window{std::max(middle - reach_, 0),
                      std::min(middle + reach_, count_ - 1) - std::max(middle - reach_, 0) + 1};
  double* const at_middle = psi + (middle - window.first);
  *at_middle = 1.0;
  // exp(-o (r - k)^2) = exp(-o r^2) exp(2 o r)^k exp(-o k^2): the first factor is common to all.
  const double exponent = std::clamp(2.0 * overlap_ * offset, kSmallestExponent, -kSmallestExponent);
  const double up = std::exp(exponent);
  const double down = 1.0 / up;
  double power = 1.0;
  const int above = window.first + window.count - 1 - middle;
  for (int k = 1; k <= above; ++k) at_middle[k] = (power *= up) * table_[static_cast<std::size_t>(k)];
  power = 1.0;
  for (int k = 1; k <= middle - window.first; ++k)
    at_middle[-k] = (power *= down) * table_[static_cast<std::size_t>(k)];
  return window;
}

GaussianBasis::Window GaussianBasis::source_window(double s, double* psi, bool proportional) const noexcept {
  const double x = std::exp(-alpha_x_ * s);
  double largest = proportional ? -std::numeric_limits<double>::max() : 0.0;
  for (std::size_t i = 0; i < center_.size(); ++i) {
    psi[i] = -width_[i] * (x - center_[i]) * (x - center_[i]);
    if (proportional) largest = std::max(largest, psi[i]);
  }
  for (std::size_t i = 0; i < center_.size(); ++i)
    psi[i] = std::exp(std::max(psi[i] - largest, kSmallestExponent));
  return {0, count_};
}

GaussianBasis::Window GaussianBasis::proportional(double s, double* psi) const noexcept {
  return overlap_ > 0.0 ? equal_in_time_window(s, psi) : source_window(s, psi, true);
}

GaussianBasis::Window GaussianBasis::activations(double s, double* psi) const noexcept {
  if (overlap_ == 0.0) return source_window(s, psi, false);
  const Window window = equal_in_time_window(s, psi);
  const double offset = s * (count_ - 1) - nearest(s);
  const double factor = std::exp(std::max(-overlap_ * offset * offset, kSmallestExponent));
  for (int k = 0; k < window.count; ++k) psi[k] *= factor;
  return window;
}

RowMatrix GaussianBasis::activations(const Eigen::VectorXd& s, bool normalised) const {
  require_phases(s);
  RowMatrix table = RowMatrix::Zero(s.size(), count_);
  for (Eigen::Index k = 0; k < s.size(); ++k) {
    std::vector<double> psi(static_cast<std::size_t>(capacity_));
    const Window window = normalised ? proportional(s[k], psi.data()) : activations(s[k], psi.data());
    table.row(k).segment(window.first, window.count) =
        Eigen::Map<Eigen::RowVectorXd>(psi.data(), window.count);
    if (normalised) table.row(k) /= table.row(k).sum();
  }
  return table;
}

}  // namespace dmp
