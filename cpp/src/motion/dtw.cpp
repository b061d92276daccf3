#include <dmp/dtw.hpp>
#include <dmp/error.hpp>
#include <dmp/so3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace dmp {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The samples of b that sample i of a may be paired with: first <= j < last.
struct Span {
  Index first;
  Index last;
  Index size() const { return last - first; }
};

/// The samples within reach of the straight line from (0, 0) to (rows - 1, columns - 1).
class Band {
 public:
  Band(Index rows, Index columns, std::optional<double> width)
      : columns_(columns),
        slope_(static_cast<double>(columns - 1) / static_cast<double>(std::max<Index>(rows - 1, 1))) {
    // Neighbouring spans must touch, or there is no path.
    const auto whole = static_cast<double>(columns);
    width_ = width && rows > 1 ? std::min(std::max({*width, 0.5, slope_ / 2}), whole) : whole;
  }

  Span at(Index i) const {
    const double middle = slope_ * static_cast<double>(i);
    const double slack = 1e-9 * static_cast<double>(columns_);  // the line is rounded
    const auto first = static_cast<Index>(std::ceil(middle - width_ - slack));
    const auto last = static_cast<Index>(std::floor(middle + width_ + slack)) + 1;
    return {std::max<Index>(first, 0), std::min(last, columns_)};
  }

 private:
  Index columns_;
  double slope_;
  double width_;
};

/// Where the best path to a pair comes from.
enum Step : std::uint8_t { kBoth, kFirst, kSecond };

/// The pairs that were looked at and how each was reached, row by row.
struct Steps {
  std::vector<Span> spans;
  std::vector<std::size_t> begin;  // of each row in `taken`
  std::vector<Step> taken;

  Step at(Index i, Index j) const {
    const auto row = static_cast<std::size_t>(i);
    return taken[begin[row] + static_cast<std::size_t>(j - spans[row].first)];
  }
};

Steps steps_within(const Band& band, Index rows) {
  Steps steps;
  std::size_t count = 0;
  for (Index i = 0; i < rows; ++i) {
    steps.spans.push_back(band.at(i));
    steps.begin.push_back(count);
    count += static_cast<std::size_t>(steps.spans.back().size());
  }
  steps.taken.resize(count);
  return steps;
}

/// One row of the recursion D(i, j) = c(i, j) + min(D(i-1, j-1), D(i-1, j), D(i, j-1)). `total` holds D of
/// the row before at j + 1 and is overwritten; its element 0 stands for what lies before the first column.
void advance(const ArrayXd& cost, Span span, Span before, ArrayXd& total, Step* taken) {
  double diagonal = total[span.first];  // D(i-1, first-1)
  double left = kInfinity;
  total[span.first] = kInfinity;
  for (Index j = span.first; j < span.last; ++j) {
    const double up = j < before.last ? total[j + 1] : kInfinity;
    double best = diagonal;
    Step step = kBoth;
    if (up < best) best = up, step = kFirst;
    if (left < best) best = left, step = kSecond;
    diagonal = up;
    left = total[j + 1] = best + cost[j - span.first];
    *taken++ = step;
  }
}

std::vector<std::pair<Index, Index>> path_to(Index i, Index j, const Steps& steps) {
  std::vector<std::pair<Index, Index>> path{{i, j}};
  while (i > 0 || j > 0) {
    const Step step = steps.at(i, j);
    if (step != kSecond) --i;
    if (step != kFirst) --j;
    path.emplace_back(i, j);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// `cost_row(i, span, cost)` fills in the distances of sample i of a from the samples `span` of b.
template <class CostRow>
Alignment warp(Index rows, Index columns, std::optional<double> width, const CostRow& cost_row) {
  Steps steps = steps_within(Band(rows, columns, width), rows);
  ArrayXd total = ArrayXd::Constant(columns + 1, kInfinity), cost(columns);
  total[0] = 0.0;
  for (Index i = 0; i < rows; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const Span span = steps.spans[row];
    cost_row(i, span, cost);
    advance(cost, span, steps.spans[row > 0 ? row - 1 : 0], total, steps.taken.data() + steps.begin[row]);
  }
  if (!std::isfinite(total[columns]))  // then no step was better than another: there is no path to go back
    throw InvalidArgument("a, b: so far apart that the sum of their distances overflows.");
  return {path_to(rows - 1, columns - 1, steps), total[columns]};
}

void require_band(std::optional<double> band) {
  if (band && !(*band >= 0.0))
    throw InvalidArgument("band: " + std::to_string(*band) + ", expected a number of samples, 0 or more.");
}

void require_finite(const RowMatrix& rows, const std::string& name) {
  if (rows.rows() == 0 || rows.cols() == 0)
    throw InvalidArgument(name + ": no samples, expected at least one.");
  for (Index k = 0; k < rows.rows(); ++k)
    if (!rows.row(k).allFinite())
      throw InvalidArgument(name + "[" + std::to_string(k) +
                            "]: not finite, expected numbers. Cut or fill the gap.");
}

void require_pair(const RowMatrix& a, const RowMatrix& b) {
  require_finite(a, "a");
  require_finite(b, "b");
  if (a.cols() != b.cols())
    throw InvalidArgument("b: " + std::to_string(b.cols()) + " columns, expected " +
                          std::to_string(a.cols()) + " as in a.");
}

/// Squared distances of row i of a from rows `span` of b, whose columns are `b_columns`' columns.
void squared_distances(const RowMatrix& a, const Eigen::MatrixXd& b_columns, Index i, Span span,
                       ArrayXd& out) {
  auto squared = out.head(span.size());
  squared.setZero();
  for (Index c = 0; c < a.cols(); ++c)
    squared += (b_columns.col(c).segment(span.first, span.size()).array() - a(i, c)).square();
}

/// Positions (T x 3) and unit quaternions (T x 4) of poses.
struct Parts {
  RowMatrix position;
  RowMatrix quaternion;
};

Parts parts_of(const Poses& poses, const std::string& name) {
  const auto count = static_cast<Index>(poses.size());
  Parts parts{RowMatrix(count, 3), RowMatrix(count, 4)};
  for (Index k = 0; k < count; ++k) {
    const Eigen::Matrix4d& pose = poses[static_cast<std::size_t>(k)];
    const Eigen::Matrix3d rotation = pose.topLeftCorner<3, 3>();
    so3::require_rotation(rotation, name + "[" + std::to_string(k) + "]");
    parts.position.row(k) = pose.topRightCorner<3, 1>().transpose();
    parts.quaternion.row(k) =
        Eigen::Quaterniond(so3::nearest_rotation(rotation)).normalized().coeffs().transpose();
  }
  require_finite(parts.position, name);
  return parts;
}

/// The angle between two rotations whose unit quaternions lie `chord`^2 apart: a chord is 2 sin(angle / 4),
/// exact where the arccosine of the scalar product loses half of the digits. q and -q are one rotation: of
/// the two chords, whose squares add up to 4, the shorter counts.
ArrayXd angles_of(const ArrayXd& chord_squared) {
  return 4.0 * (0.5 * chord_squared.min(4.0 - chord_squared).max(0.0).sqrt()).asin();
}

}  // namespace

Alignment align(const RowMatrix& a, const RowMatrix& b, std::optional<double> band) {
  require_pair(a, b);
  require_band(band);
  const Eigen::MatrixXd b_columns = b;
  return warp(a.rows(), b.rows(), band, [&](Index i, Span span, ArrayXd& cost) {
    squared_distances(a, b_columns, i, span, cost);
    cost.head(span.size()) = cost.head(span.size()).sqrt();
  });
}

Alignment align(const Poses& a, const Poses& b, double angle_weight, std::optional<double> band) {
  if (!(angle_weight >= 0.0 && angle_weight < kInfinity))
    throw InvalidArgument("angle_weight: " + std::to_string(angle_weight) + ", expected m/rad, 0 or more.");
  require_band(band);
  const Parts first = parts_of(a, "a"), second = parts_of(b, "b");
  const Eigen::MatrixXd position = second.position, quaternion = second.quaternion;
  ArrayXd chord_squared(position.rows());
  return warp(first.position.rows(), position.rows(), band, [&](Index i, Span span, ArrayXd& cost) {
    squared_distances(first.position, position, i, span, cost);
    cost.head(span.size()) = cost.head(span.size()).sqrt();
    if (angle_weight == 0.0) return;
    squared_distances(first.quaternion, quaternion, i, span, chord_squared);
    cost.head(span.size()) += angle_weight * angles_of(chord_squared.head(span.size()));
  });
}

double frechet(const RowMatrix& a, const RowMatrix& b) {
  require_pair(a, b);
  const Eigen::MatrixXd b_columns = b;
  ArrayXd leash = ArrayXd::Constant(b.rows() + 1, kInfinity), squared(b.rows());
  leash[0] = 0.0;  // nothing precedes the first pair
  for (Index i = 0; i < a.rows(); ++i) {
    squared_distances(a, b_columns, i, {0, b.rows()}, squared);
    double diagonal = leash[0];
    leash[0] = kInfinity;
    for (Index j = 0; j < b.rows(); ++j) {
      const double shortest = std::min({diagonal, leash[j], leash[j + 1]});
      diagonal = leash[j + 1];
      leash[j + 1] = std::max(shortest, squared[j]);
    }
  }
  return std::sqrt(leash[b.rows()]);
}

}  // namespace dmp
