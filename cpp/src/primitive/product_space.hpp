#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "geometry/pose.hpp"
#include "primitive/space.hpp"

namespace dmp::detail {

/// The geometry of a space that is made of two: what both of its parts say.
template <class Space>
struct ProductGeometry {
  using P = Parts<Space>;
  using First = Geometry<typename P::First>;
  using Second = Geometry<typename P::Second>;
  using Point = typename Space::Point;
  using Demonstration = typename Space::Demonstration;

  static Eigen::Index first_axes(const Point& point) {
    return dimension_of<typename P::First>(P::first(point));
  }
  static bool accepts(const Point& point, const Point& like) noexcept {
    return First::accepts(P::first(point), P::first(like)) &&
           Second::accepts(P::second(point), P::second(like));
  }
  static Point projected(const Point& point) {
    return P::join(First::projected(P::first(point)), Second::projected(P::second(point)));
  }
  static Point mean(const std::vector<Point>& points) {
    std::vector<typename P::First::Point> first;
    std::vector<typename P::Second::Point> second;
    for (const Point& point : points) {
      first.push_back(P::first(point));
      second.push_back(P::second(point));
    }
    return P::join(First::mean(first), Second::mean(second));
  }
  static Eigen::VectorXd displacement(const Point& start, const Point& goal, const Eigen::VectorXd& near,
                                      const DmpOptions& options) {
    const Eigen::Index axes = first_axes(start);
    Eigen::VectorXd both(near.size());
    both << First::displacement(P::first(start), P::first(goal), near.head(axes), options),
        Second::displacement(P::second(start), P::second(goal), near.tail(near.size() - axes), options);
    return both;
  }

  static Decision decide(const DmpOptions& options, const Demonstrations<Space>& demonstrations,
                         bool may_turn) {
    Demonstrations<typename P::First> first;
    Demonstrations<typename P::Second> second;
    for (const Demonstration* demonstration : demonstrations) {
      first.push_back(&P::first(*demonstration));
      second.push_back(&P::second(*demonstration));
    }
    const Decision one = First::decide(options, first, may_turn);
    const Decision other = Second::decide(options, second, may_turn);
    return {together(one.options, other.options), one.reference.rows() > 0 ? one.reference : other.reference};
  }
  static DmpOptions settle(const DmpOptions& options, const Ends<Space>& ends) {
    return together(First::settle(options, first_of(ends)), Second::settle(options, second_of(ends)));
  }
  static Example<Space> example_of(const Demonstration& demonstration, const DmpOptions& options,
                                   const RowMatrix& reference) {
    const auto first = First::example_of(P::first(demonstration), options, reference);
    const auto second = Second::example_of(P::second(demonstration), options, reference);
    const Eigen::Index axes = first.target.value.cols();
    const Eigen::Index dimension = axes + second.target.value.cols();
    Example<Space> both{joined<Space>(first.ends, second.ends), {}, {}, {}};
    both.way.resize(first.way.size() + second.way.size());
    both.way.head(first.way.size()) = first.way;
    both.way.tail(second.way.size()) = second.way;
    both.target = {first.target.s, RowMatrix(first.target.value.rows(), dimension),
                   Eigen::VectorXd::Ones(dimension)};
    both.target.value << first.target.value, second.target.value;
    both.advance.resize(first.target.value.rows(), first.advance.cols() + second.advance.cols());
    both.advance << first.advance, second.advance;
    return both;
  }
  static void add_groups(const Point& point, std::vector<AxisGroup>& groups) {
    First::add_groups(P::first(point), groups);
    Second::add_groups(P::second(point), groups);
  }

  static void deviation(const typename Space::Output& output, const Demonstration& demonstration,
                        Eigen::Index k, double* away) {
    First::deviation(output.first, P::first(demonstration), k, away);
    Second::deviation(output.second, P::second(demonstration), k,
                      away + dimension_of<typename P::First>(P::first(demonstration)));
  }
  static Demonstration denoised(const Demonstration& demonstration, std::vector<NoiseEstimate>& found) {
    auto first = First::denoised(P::first(demonstration), found);
    auto second = Second::denoised(P::second(demonstration), found);
    return {std::move(first), std::move(second)};
  }
  static void add_extents(const Demonstration& demonstration, std::vector<Extent>& extents) {
    First::add_extents(P::first(demonstration), extents);
    Second::add_extents(P::second(demonstration), extents);
  }
  static void add_accelerations(const typename Space::Output& output, std::vector<double>& sizes) {
    First::add_accelerations(output.first, sizes);
    Second::add_accelerations(output.second, sizes);
  }
  static void add_second_differences(const Demonstration& demonstration, Eigen::Index k,
                                     std::vector<double>& sizes) {
    First::add_second_differences(P::first(demonstration), k, sizes);
    Second::add_second_differences(P::second(demonstration), k, sizes);
  }
  static double largest_log(const Demonstration& demonstration, const DmpOptions& options) {
    return std::max(First::largest_log(P::first(demonstration), options),
                    Second::largest_log(P::second(demonstration), options));
  }
  static double excess(const Point& point, const Eigen::VectorXd& rmse, const Tolerance& tolerance) {
    const Eigen::Index axes = first_axes(point);
    return std::max(First::excess(P::first(point), rmse.head(axes), tolerance),
                    Second::excess(P::second(point), rmse.tail(rmse.size() - axes), tolerance));
  }
  static std::vector<Point> points_at(const Demonstration& demonstration, const Eigen::VectorXd& times) {
    const auto first = First::points_at(P::first(demonstration), times);
    const auto second = Second::points_at(P::second(demonstration), times);
    std::vector<Point> points;
    for (std::size_t k = 0; k < first.size(); ++k) points.push_back(P::join(first[k], second[k]));
    return points;
  }
  static Eigen::VectorXd minus(const Point& a, const Point& b) {
    const Eigen::VectorXd first = First::minus(P::first(a), P::first(b));
    const Eigen::VectorXd second = Second::minus(P::second(a), P::second(b));
    Eigen::VectorXd both(first.size() + second.size());
    both << first, second;
    return both;
  }

 private:
  /// What either part decided: the form for large turns (the last enumerator) if one of them turns that far;
  /// vectors leave it open (the first).
  static DmpOptions together(const DmpOptions& first, const DmpOptions& second) {
    return first.orientation_form > second.orientation_form ? first : second;
  }
};

template <>
struct Geometry<PoseSpace> : ProductGeometry<PoseSpace> {
  static bool accepts(const Point& pose, const Point&) noexcept { return is_pose(pose); }
  static void require(const Point& pose, const Point&, const std::string& name) { require_pose(pose, name); }

  static Ends<PoseSpace> ends_of(const PoseDmpParameters& parameters);
  static void set_ends(PoseDmpParameters& parameters, const Ends<PoseSpace>& ends);

  /// Both parts together: they share their samples' times, and which of them were measured.
  static PoseDemonstration denoised(const PoseDemonstration& demonstration,
                                    std::vector<NoiseEstimate>& found);

  static PoseTrajectory room_for(const Eigen::VectorXd& times, const Point&);
  static void record(PoseTrajectory& trajectory, Eigen::Index k, const PoseSpace::Output& output);
  static Poses path_of(const Poses& points) { return points; }
};

template <class A, class B>
struct Geometry<Product<A, B>> : ProductGeometry<Product<A, B>> {
  using Space = Product<A, B>;
  using Base = ProductGeometry<Space>;
  using typename Base::First;
  using typename Base::Point;
  using typename Base::Second;

  static void require(const Point& point, const Point& like, const std::string& name) {
    First::require(point.first, like.first, name + ".first");
    Second::require(point.second, like.second, name + ".second");
  }

  static Ends<Space> ends_of(const typename Space::Parameters& p) {
    return {p.start, p.goal, p.duration * p.start_velocity, p.displacement, p.amplitude, p.reference};
  }
  static void set_ends(typename Space::Parameters& p, const Ends<Space>& ends) {
    p.start = ends.start;
    p.goal = ends.goal;
    p.start_velocity = ends.z / p.duration;
    p.displacement = ends.displacement;
    p.amplitude = ends.amplitude;
    p.reference = ends.reference;
  }

  static typename Space::Trajectory room_for(const Eigen::VectorXd& times, const Point& point) {
    return {times, First::room_for(times, point.first), Second::room_for(times, point.second)};
  }
  static void record(typename Space::Trajectory& trajectory, Eigen::Index k,
                     const typename Space::Output& output) {
    First::record(trajectory.first, k, output.first);
    Second::record(trajectory.second, k, output.second);
  }
  static typename Space::Path path_of(const std::vector<Point>& points) {
    std::vector<typename A::Point> first;
    std::vector<typename B::Point> second;
    for (const Point& point : points) {
      first.push_back(point.first);
      second.push_back(point.second);
    }
    return {First::path_of(first), Second::path_of(second)};
  }
};

}  // namespace dmp::detail
