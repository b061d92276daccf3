#include "primitive/cycle_phase.hpp"

#include <dmp/error.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/text.hpp"

namespace dmp::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kUncorrelated = 0.2;  // below which a lag has left the peak around 0
constexpr double kAlmostBest = 0.9;    // of the best correlation: the first such lag is the period
constexpr double kNoPeriod = 0.4;
constexpr double kAround = 0.03;   // of a period, within which it is refined
constexpr double kOffTrack = 3.0;  // medians of what cycles differ by
constexpr double kKnots = 0.7;     // of a period between the knots of the phase
constexpr double kSmooth = 0.01;   // weight of its second differences, relative
constexpr int kRounds = 15;
constexpr int kTrims = 3;           // times that ends are cut by what the cycle leaves of them
constexpr double kSmallest = 0.01;  // of the motion: what a cycle may leave anywhere

RowMatrix without_trend(const Signal& signal) {
  MatrixXd line(signal.time.size(), 2);
  line.col(0).setOnes();
  line.col(1) = signal.time.array() - signal.time.mean();
  return signal.value - line * least_squares(line, signal.value);
}

/// The correlation of a signal with itself at each lag from 0 to half its length.
VectorXd autocorrelation(const RowMatrix& x) {
  const Index n = x.rows();
  VectorXd energy = VectorXd::Zero(n + 1);
  for (Index k = 0; k < n; ++k) energy[k + 1] = energy[k] + x.row(k).squaredNorm();
  VectorXd r(n / 2 + 1);
  for (Index lag = 0; lag < r.size(); ++lag) {
    const double product = x.topRows(n - lag).cwiseProduct(x.bottomRows(n - lag)).sum();
    const double both = 0.5 * (energy[n - lag] + energy[n] - energy[lag]);
    r[lag] = both > 0.0 ? product / both : 0.0;
  }
  return r;
}

[[noreturn]] void refuse(const std::string& why) {
  throw InvalidArgument(
      "recording: " + why +
      ". Expected a motion that repeats, two cycles or more; cut what does not belong to it, or "
      "state a minimum period.");
}

/// The first lag that correlates almost as well as the best one.
Index first_lag(const VectorXd& r, Index least) {
  Index from = 1;
  while (from < r.size() && r[from] >= kUncorrelated) ++from;
  from = std::max(from, least);
  double best = 0.0;
  std::vector<Index> peaks;
  for (Index lag = std::max<Index>(from, 1); lag + 1 < r.size(); ++lag) {
    if (!(r[lag] >= r[lag - 1] && r[lag] > r[lag + 1])) continue;
    peaks.push_back(lag);
    best = std::max(best, r[lag]);
  }
  if (best < kNoPeriod)
    refuse("no period found (the best correlation of the motion with itself, later, is " + number(best) +
           ")");
  for (const Index lag : peaks)
    if (r[lag] >= kAlmostBest * best) return lag;
  return peaks.front();
}

MatrixXd with_trend(const VectorXd& time, const MatrixXd& harmonics) {
  MatrixXd basis(time.size(), harmonics.cols() + 1);
  basis << harmonics, (time.array() - time.mean()).matrix();
  return basis;
}

/// The squares that harmonics of one period leave.
double left_by(const Signal& signal, double period, int harmonics) {
  const MatrixXd basis = with_trend(signal.time, harmonics_of(signal.time / period, harmonics));
  return (signal.value - basis * least_squares(basis, signal.value)).squaredNorm();
}

/// The period nearby that leaves least: on a grid, then by golden section between its neighbours.
double refined(const Signal& signal, double period, int harmonics) {
  constexpr int kGrid = 20;
  const double step = kAround * period / kGrid;
  const auto left = [&](double p) { return left_by(signal, p, harmonics); };
  double best = period;
  double least = left(period);
  for (int k = -kGrid; k <= kGrid; ++k) {
    const double now = left(period + k * step);
    if (now < least) best = period + k * step, least = now;
  }
  double low = best - step, high = best + step;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 40; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (left(a) < left(b) ? high : low) = left(a) < left(b) ? b : a;
  }
  return 0.5 * (low + high);
}

double median(VectorXd values) {
  double* const middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

/// First and last sample between which cycles are alike.
std::pair<Index, Index> alike(const Signal& signal, double period) {
  const Index n = signal.time.size();
  const double dt = signal.time[1] - signal.time[0];
  const Index lag = std::max<Index>(1, static_cast<Index>(std::lround(period / dt)));
  if (n - lag < 8) return {0, n - 1};
  const VectorXd away = (signal.value.bottomRows(n - lag) - signal.value.topRows(n - lag)).rowwise().norm();
  const Index width = std::max<Index>(1, lag / 4), m = away.size() - width + 1;
  if (m < 8) return {0, n - 1};
  VectorXd mean(m);
  for (Index k = 0; k < m; ++k) mean[k] = away.segment(k, width).mean();
  const double most = kOffTrack * median(mean.segment(m / 4, m / 2));
  Index first = 0, last = m - 1;
  for (Index k = 0; k < m / 3; ++k)
    if (mean[k] > most) first = k + 1;
  for (Index k = m - 1; k > m - 1 - m / 3; --k)
    if (mean[k] > most) last = k - 1;
  return {first, last == m - 1 ? n - 1 : std::min(n - 1, last + lag)};
}

/// Cubic B-splines at even knots, (n x count).
MatrixXd splines(const VectorXd& time, double spacing) {
  const double begin = time[0];
  const Index spans =
      std::max<Index>(1, static_cast<Index>(std::ceil((time[time.size() - 1] - begin) / spacing)));
  MatrixXd basis = MatrixXd::Zero(time.size(), spans + 3);
  for (Index k = 0; k < time.size(); ++k) {
    const double at = (time[k] - begin) / spacing;
    const Index span = std::min(static_cast<Index>(at), spans - 1);
    const double u = at - static_cast<double>(span), v = 1.0 - u;
    basis.row(k).segment<4>(span) << v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
        (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0;
  }
  return basis;
}

/// The phase along a signal: the bends of time with which one cycle of harmonics fits best (Gauss-Newton).
VectorXd bent_phase(const Signal& signal, double period, int harmonics) {
  const VectorXd even = (signal.time.array() - signal.time[0]) / period;
  const MatrixXd basis = splines(signal.time, kKnots * period);
  const Index count = basis.cols();
  MatrixXd bend = MatrixXd::Zero(count - 2, count);
  for (Index k = 0; k < bend.rows(); ++k) bend.row(k).segment<3>(k) << 1.0, -2.0, 1.0;
  const MatrixXd stiff = bend.transpose() * bend;
  VectorXd a = VectorXd::Zero(count);
  for (int round = 0; round < kRounds; ++round) {
    const VectorXd phase = even + basis * a;
    const MatrixXd features = with_trend(signal.time, harmonics_of(phase, harmonics));
    const MatrixXd c = least_squares(features, signal.value);
    const RowMatrix left = signal.value - features * c;
    MatrixXd rates = MatrixXd::Zero(features.rows(), features.cols());
    for (int h = 1; h <= harmonics; ++h) {
      rates.col(2 * h - 1) = -2.0 * M_PI * h * features.col(2 * h);
      rates.col(2 * h) = 2.0 * M_PI * h * features.col(2 * h - 1);
    }
    const RowMatrix slope = rates * c;
    const VectorXd weight = slope.rowwise().squaredNorm();
    MatrixXd gram = basis.transpose() * weight.asDiagonal() * basis;
    const MatrixXd pull = kSmooth * gram.trace() / static_cast<double>(count) * stiff;
    gram += pull;
    gram.diagonal().array() += 1e-9 * gram.trace() / static_cast<double>(count);
    const VectorXd along = slope.cwiseProduct(left).rowwise().sum();
    a += gram.ldlt().solve(basis.transpose() * along - pull * a);
  }
  return even + basis * a;
}

Signal part_of(const Signal& signal, Index first, Index last) {
  return {signal.time.segment(first, last - first + 1), signal.value.middleRows(first, last - first + 1)};
}

void require_cycles(const Signal& signal, double period) {
  const double cycles = (signal.time[signal.time.size() - 1] - signal.time[0]) / period;
  if (cycles < 1.9) refuse("only " + number(cycles) + " cycles of " + number(period) + " s that are alike");
}

PhaseTrack tracked(const Signal& signal, double period, int harmonics) {
  PhaseTrack track{signal, bent_phase(signal, period, harmonics), {}};
  track.phase.array() -= track.phase[0];
  return track;
}

/// What the cycle leaves at each sample.
RowMatrix left_by(const PhaseTrack& track, int harmonics) {
  const MatrixXd basis = with_trend(track.signal.time, harmonics_of(track.phase, harmonics));
  return track.signal.value - basis * least_squares(basis, track.signal.value);
}

/// First and last sample between which the cycle leaves no more than elsewhere.
std::pair<Index, Index> explained(const PhaseTrack& track, int harmonics) {
  const VectorXd left = left_by(track, harmonics).rowwise().norm();
  const double usual = median(left.segment(left.size() / 4, left.size() / 2));
  const double size = without_trend(track.signal).rowwise().norm().mean();
  const double most = kOffTrack * std::max(usual, kSmallest * size);
  const Index n = left.size();
  const Index width = std::max<Index>(1, n / 100);
  Index first = 0, last = n - 1;
  for (Index k = 0; k + width < n / 3; ++k)
    if (left.segment(k, width).mean() > most) first = k + width;
  for (Index k = n - width; k > n - n / 3; --k)
    if (left.segment(k, width).mean() > most) last = k - 1;
  return {first, last};
}

VectorXd lengths_of(const VectorXd& time, const VectorXd& phase) {
  const Index whole = static_cast<Index>(std::floor(phase[phase.size() - 1] - phase[0] + 1e-9));
  VectorXd lengths(std::max<Index>(whole, 0));
  for (Index k = 0; k < lengths.size(); ++k) {
    const double from = phase[0] + static_cast<double>(k);
    lengths[k] = time_at(time, phase, from + 1.0) - time_at(time, phase, from);
  }
  return lengths;
}

/// The report of what was tracked; refuses a phase that stands still or runs backwards.
PhaseTrack finished(PhaseTrack track, int harmonics) {
  const Index n = track.phase.size();
  const double gone = track.phase[n - 1];
  if (!(gone > 1.5) || !((track.phase.tail(n - 1) - track.phase.head(n - 1)).minCoeff() > 0.0))
    refuse("its cycles differ too much for one phase to run through all of them");
  const VectorXd& time = track.signal.time;
  track.report = {(time[n - 1] - time[0]) / gone, time[0], time[n - 1], lengths_of(time, track.phase),
                  left_by(track, harmonics).norm() / without_trend(track.signal).norm()};
  return track;
}

}  // namespace

MatrixXd harmonics_of(const VectorXd& phase, int harmonics) {
  MatrixXd basis(phase.size(), 1 + 2 * harmonics);
  basis.col(0).setOnes();
  for (int h = 1; h <= harmonics; ++h) {
    basis.col(2 * h - 1) = (2.0 * M_PI * h * phase).array().cos();
    basis.col(2 * h) = (2.0 * M_PI * h * phase).array().sin();
  }
  return basis;
}

MatrixXd least_squares(const MatrixXd& basis, const RowMatrix& value) {
  MatrixXd gram = basis.transpose() * basis;
  gram.diagonal().array() += 1e-13 * gram.trace() / static_cast<double>(gram.rows());
  return gram.ldlt().solve(basis.transpose() * value);
}

double time_at(const VectorXd& time, const VectorXd& phase, double wanted) {
  Index k = 1;
  while (k + 1 < phase.size() && phase[k] < wanted) ++k;
  const double step = phase[k] - phase[k - 1];
  const double share = step > 0.0 ? (wanted - phase[k - 1]) / step : 0.0;
  return time[k - 1] + share * (time[k] - time[k - 1]);
}

PhaseTrack track_phase(const Signal& signal, const CycleOptions& options) {
  if (!(options.minimum_period >= 0.0 && std::isfinite(options.minimum_period)))
    throw InvalidArgument("minimum_period: " + number(options.minimum_period) +
                          ", expected a time in s, 0 or more.");
  if (options.harmonics < 1 || options.harmonics > 40)
    throw InvalidArgument("harmonics: " + std::to_string(options.harmonics) + ", expected 1 to 40.");
  const double dt = signal.time[1] - signal.time[0];
  const RowMatrix x = without_trend(signal);
  if (!(x.norm() > 1e-9 * (1.0 + signal.value.norm()))) refuse("it does not move");
  const Index least = static_cast<Index>(std::ceil(options.minimum_period / dt));
  double period = dt * static_cast<double>(first_lag(autocorrelation(x), least));
  period = refined(signal, period, options.harmonics);
  const auto [first, last] = alike(signal, period);
  Signal kept = part_of(signal, first, last);
  require_cycles(kept, period);
  period = refined(kept, period, options.harmonics);
  PhaseTrack track = tracked(kept, period, options.harmonics);
  for (int round = 0; round < kTrims; ++round) {
    const auto [from, to] = explained(track, options.harmonics);
    if (from == 0 && to == track.phase.size() - 1) break;
    kept = part_of(track.signal, from, to);
    require_cycles(kept, period);
    track = tracked(kept, period, options.harmonics);
  }
  return finished(std::move(track), options.harmonics);
}

}  // namespace dmp::detail
