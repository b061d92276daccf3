#include "spline/denoising.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace dmp::detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewest = 16;           // samples that a decision needs
constexpr double kUsualRepeats = 0.3;   // share of repeated samples from which on repeating is no failure
constexpr Index kLongestHeld = 3;       // samples: a longer run of one value is a rest
constexpr double kMostFreedom = 0.5;    // the motion fills less than half of what the sampling can hold
constexpr double kMostFlatness = 1.55;  // white noise 1.15 to 1.29, motions 1.9 and more
constexpr double kLeastEvenness = 0.5;
// What is uneven is noise all the same (clocks that jitter, rounded values) if neighbouring residuals of the
// busy part do not resemble each other, in a slow motion.
constexpr double kMostCorrelation = 0.1;
constexpr double kMostFreedomUneven = 0.35;
constexpr double kLeastSharpness = 1.25;
constexpr double kMostUneven = 1.5;  // busy over calm residual that smoothing may leave
constexpr Index kEndSamples = 4;     // of an interpolating spline that are no evidence

// Coloured noise shows at rests.
constexpr double kSpeedCutoff = 2.0;    // Hz
constexpr double kRestWindow = 0.4;     // s
constexpr double kRestContrast = 12.0;  // busy over calm speed
constexpr double kFirstCutoff = 12.0;   // Hz
constexpr double kLowestCutoff = 1.5;   // Hz
constexpr double kCutoffStep = 0.85;
constexpr double kMostWander = 0.06;  // of the extent: a motion that vibrates all along is no noise
constexpr double kRestUneven = 1.4;
constexpr double kRestSharpness = 2.0;
constexpr std::size_t kRestWindows = 6;

/// The weights of the divided difference of sixth order over seven samples, of length 1.
std::array<double, 7> sixth_difference(const double* t) {
  std::array<double, 7> weights;
  const double step = (t[6] - t[0]) / 6.0;
  double squares = 0.0;
  for (int i = 0; i < 7; ++i) {
    double product = 1.0;
    for (int j = 0; j < 7; ++j)
      if (j != i) product *= (t[i] - t[j]) / step;
    weights[static_cast<std::size_t>(i)] = 1.0 / product;
    squares += 1.0 / (product * product);
  }
  for (double& weight : weights) weight /= std::sqrt(squares);
  return weights;
}

bool evenly_spaced(const VectorXd& times) {
  const Index n = times.size();
  const double step = (times[n - 1] - times[0]) / static_cast<double>(n - 1);
  return ((times.tail(n - 1) - times.head(n - 1)).array() - step).abs().maxCoeff() < 1e-6 * step;
}

/// RMS of the sixth differences over measured samples: the deviation of noise with nothing else in it, an
/// upper bound of it otherwise; and by how much the sample in the middle differs from the prediction.
struct Unpredicted {
  double sigma = 0.0;   // all columns together
  double middle = 0.0;  // likewise
};
Unpredicted unpredicted(const VectorXd& times, const VectorXd& weights, const RowMatrix& values) {
  Unpredicted sum;
  double count = 0.0;
  const bool even = evenly_spaced(times);
  std::array<double, 7> w = sixth_difference(times.data());
  for (Index k = 0; k + 7 <= times.size(); ++k) {
    if (weights.segment<7>(k).sum() < 7.0) continue;
    if (!even) w = sixth_difference(times.data() + k);
    double squares = 0.0;
    for (Index c = 0; c < values.cols(); ++c) {
      double difference = 0.0;
      for (Index i = 0; i < 7; ++i) difference += w[static_cast<std::size_t>(i)] * values(k + i, c);
      squares += difference * difference;
    }
    sum.sigma += squares;
    sum.middle += squares / (w[3] * w[3]);
    count += 1.0;
  }
  if (count == 0.0) return {std::numeric_limits<double>::infinity(), 0.0};  // no evidence of clean samples
  return {std::sqrt(sum.sigma / count), std::sqrt(sum.middle / count)};
}

double largest_second_difference(const VectorXd& weights, const RowMatrix& values) {
  double largest = 0.0;
  for (Index k = 1; k + 1 < values.rows(); ++k)
    if (weights.segment<3>(k - 1).minCoeff() > 0.0)
      largest =
          std::max(largest, (values.row(k + 1) - 2.0 * values.row(k) + values.row(k - 1)).squaredNorm());
  return std::sqrt(largest);
}

/// Noise so small that it cannot be seen in the accelerations: at the samples, white noise of an
/// interpolating spline has peaks of twenty times sigma / step^2.
bool plainly_clean(const Unpredicted& noise, const VectorXd& weights, const RowMatrix& values) {
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
  return noise.sigma <= std::max(largest_second_difference(weights, values) / 200.0, rounding);
}

/// Values and the sizes of the first two derivatives of a curve at the samples.
struct Looked {
  RowMatrix value;
  VectorXd speed;
  VectorXd acceleration;
};
Looked looked_at(const SmoothingFit::Curve& curve, const VectorXd& times) {
  const Spline::Samples at = spline_of(curve.knots, curve.coefficients).sample(times);
  return {at.value, at.first.rowwise().norm(), at.second.rowwise().norm()};
}

double inner_peak(const VectorXd& sizes) {
  return sizes.segment(kEndSamples, sizes.size() - 2 * kEndSamples).maxCoeff();
}

/// The mean of `order` and the mean square residual in windows of so many samples, by `order`.
struct Window {
  double order;
  double residual;
  double weight;
};
std::vector<Window> windows(const VectorXd& order, const VectorXd& squares, const VectorXd& weights,
                            Index length) {
  std::vector<Window> found;
  for (Index first = 0; first + length <= order.size(); first += length) {
    const double weight = weights.segment(first, length).sum();
    if (weight < 0.5) continue;
    found.push_back({order.segment(first, length).mean(),
                     squares.segment(first, length).dot(weights.segment(first, length)), weight});
  }
  std::sort(found.begin(), found.end(), [](const Window& a, const Window& b) { return a.order < b.order; });
  return found;
}

/// Mean of `order` and RMS of the residual in a third of the windows.
std::pair<double, double> third_of(const std::vector<Window>& all, bool busy) {
  const std::size_t count = all.size() / 3;
  const std::size_t first = busy ? all.size() - count : 0;
  double order = 0.0;
  double squares = 0.0;
  double weight = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    order += all[i].order / static_cast<double>(count);
    squares += all[i].residual;
    weight += all[i].weight;
  }
  return {order, std::sqrt(squares / weight)};
}

/// Residual where `order` is small over that where it is large; 1 with too few windows to tell.
double evenness_of(const std::vector<Window>& all) {
  if (all.size() < 3) return 1.0;
  const double busy = third_of(all, true).second;
  return busy > 0.0 ? third_of(all, false).second / busy : 1.0;
}

/// One decision about one table of values.
class Decision {
 public:
  Decision(SmoothingGrid& grid, const RowMatrix& values, int axes, const Spline& through)
      : fit_(grid, values), values_(values), axes_(axes), times_(grid.times()) {
    const VectorXd sizes = through.sample(times_).second.rowwise().norm();
    peak_ = inner_peak(sizes);
  }

  /// The lambda to smooth with, if any.
  std::optional<double> white(NoiseEstimate& found) {
    const SmoothingFit::Point best = fit_.best();
    found.freedom = best.freedom / fit_.grid().measured();
    found.flatness = std::sqrt(fit_.variance(fit_.with_freedom(0.6)) / fit_.variance(fit_.with_freedom(0.8)));
    look(best.lambda);
    found.evenness = evenness();
    found.sharpness = sharpness();
    found.correlation = correlation();
    const bool uncorrelated = found.correlation <= kMostCorrelation && found.freedom <= kMostFreedomUneven;
    const bool even = found.evenness >= kLeastEvenness || uncorrelated;
    const bool noise = found.freedom <= kMostFreedom && found.flatness <= kMostFlatness && even &&
                       found.sharpness >= kLeastSharpness;
    if (!noise) return {};
    for (int i = 0; i < 10 && evenness() < 1.0 / kMostUneven && correlation() > kMostCorrelation; ++i)
      look(lambda_ / std::sqrt(10.0));
    describe(NoiseKind::white, found);
    return lambda_;
  }

  /// Noise that wanders, by a rest in which it alone moves.
  std::optional<double> coloured(NoiseEstimate& found) {
    look(fit_.lambda_of(kSpeedCutoff));
    const VectorXd speed = looked_.speed;
    const auto by_speed = [&] { return windows(speed, squares(), fit_.grid().weights(), rest_window()); };
    const std::vector<Window> rests = by_speed();
    if (rests.size() < kRestWindows) return {};
    const double calm = third_of(rests, false).first;
    found.resting = calm > 0.0 ? third_of(rests, true).first / calm : std::numeric_limits<double>::infinity();
    if (found.resting < kRestContrast) return {};
    double cutoff = 0.0;
    for (double next = kFirstCutoff; next >= kLowestCutoff; next *= kCutoffStep) {
      look(fit_.lambda_of(next));
      if (evenness_of(by_speed()) < 1.0 / kRestUneven) break;
      cutoff = next;
    }
    if (cutoff == 0.0) return {};
    look(fit_.lambda_of(cutoff));
    const double extent = (values_.colwise().maxCoeff() - values_.colwise().minCoeff()).norm();
    const double moved = std::sqrt(squares().dot(fit_.grid().weights()) / fit_.grid().measured());
    if (sharpness() < kRestSharpness || moved > kMostWander * extent) return {};
    found.sharpness = sharpness();
    found.evenness = evenness_of(by_speed());
    describe(NoiseKind::coloured, found);
    return lambda_;
  }

  /// After white noise was found: whether a rest shows that more of it wanders. True in any case.
  bool settle_with_rests(NoiseEstimate& found) {
    const double before = std::exchange(peak_, inner_peak(looked_.acceleration));
    const double stiffness = lambda_;
    NoiseEstimate more = found;
    if (coloured(more)) {
      more.sharpness *= before / peak_;
      found = more;
    } else {
      found.resting = more.resting;
      look(stiffness);
    }
    return true;
  }

  SmoothingFit::Curve curve() { return fit_.curve(lambda_); }

 private:
  void look(double lambda) {
    lambda_ = lambda;
    looked_ = looked_at(fit_.curve(lambda), times_);
  }
  VectorXd squares() const { return (values_ - looked_.value).rowwise().squaredNorm(); }
  double sharpness() const {
    const double smooth = inner_peak(looked_.acceleration);
    return smooth > 0.0 ? peak_ / smooth : std::numeric_limits<double>::infinity();
  }
  /// In windows of one period of the half-power frequency.
  double evenness() const {
    const double period = 1.0 / (fit_.frequency_of(lambda_) * fit_.grid().step());
    const Index length = std::max<Index>(6, static_cast<Index>(std::lround(std::min(period, 1e9))));
    return evenness_of(windows(looked_.acceleration, squares(), fit_.grid().weights(), length));
  }
  /// Of neighbouring residuals where accelerations are in their largest third: noise has none or a negative
  /// one, detail of the motion a positive one.
  double correlation() const {
    const RowMatrix residual = values_ - looked_.value;
    const VectorXd& weights = fit_.grid().weights();
    std::vector<double> sorted(looked_.acceleration.data(), looked_.acceleration.data() + values_.rows());
    const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 2 / 3);
    std::nth_element(sorted.begin(), nth, sorted.end());
    double products = 0.0;
    double squares = 0.0;
    for (Index k = 1; k < residual.rows(); ++k) {
      if (looked_.acceleration[k] < *nth || weights[k] * weights[k - 1] == 0.0) continue;
      products += residual.row(k).dot(residual.row(k - 1));
      squares += 0.5 * (residual.row(k).squaredNorm() + residual.row(k - 1).squaredNorm());
    }
    return squares > 0.0 ? products / squares : 0.0;
  }
  Index rest_window() const {
    const double mean_step = (times_[times_.size() - 1] - times_[0]) / static_cast<double>(times_.size() - 1);
    return std::max<Index>(2, static_cast<Index>(std::lround(kRestWindow / mean_step)));
  }
  void describe(NoiseKind kind, NoiseEstimate& found) {
    const SmoothingFit::Point point = fit_.at(lambda_);
    found.kind = kind;
    found.sigma = std::sqrt(fit_.variance(point) / axes_);
    found.freedom = point.freedom / fit_.grid().measured();
    found.removed = std::sqrt(squares().dot(fit_.grid().weights()) / fit_.grid().measured());
    found.cutoff = fit_.frequency_of(lambda_);
  }

  SmoothingFit fit_;
  const RowMatrix& values_;
  int axes_;
  const VectorXd& times_;
  double peak_;
  double lambda_ = 0.0;
  Looked looked_;
};

}  // namespace

VectorXd measured_weights(const VectorXd& measured, Index count, const std::function<bool(Index)>& repeats) {
  VectorXd weights = measured.size() == count ? measured : VectorXd(VectorXd::Ones(count));
  std::vector<Index> repeated;
  for (Index k = 1; k < count;) {
    Index end = k;
    while (end < count && repeats(end)) ++end;
    for (Index i = k; end - k <= kLongestHeld && i < end; ++i) repeated.push_back(i);
    k = std::max(end, k + 1);
  }
  if (static_cast<double>(repeated.size()) >= kUsualRepeats * static_cast<double>(count)) return weights;
  for (const Index k : repeated) weights[k] = 0.0;
  return weights;
}

SmoothingGrid& LazyGrid::get() {
  if (!grid_) grid_.emplace(times_, weights_);
  return *grid_;
}

Denoised denoise(LazyGrid& grid, const RowMatrix& values, int axes, const Spline& through) {
  Denoised result;
  NoiseEstimate& found = result.estimate;
  found.measured = static_cast<int>(grid.weights().sum());
  if (found.measured < kFewest) return result;
  const Unpredicted noise = unpredicted(grid.times(), grid.weights(), values);
  found.unpredicted = noise.middle;
  if (plainly_clean(noise, grid.weights(), values)) return result;
  Decision decision(grid.get(), values, axes, through);
  if (decision.white(found) ? decision.settle_with_rests(found) : decision.coloured(found).has_value())
    result.curve = decision.curve();
  return result;
}

}  // namespace dmp::detail
