#pragma once

#include <dmp/fit_report.hpp>
#include <dmp/forcing.hpp>
#include <dmp/noise.hpp>
#include <dmp/so3.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "primitive/parts.hpp"

namespace dmp::detail {

/// What one demonstration teaches: its ends, the forcing term that would reproduce it (its scale left at 1),
/// and the one that would take an offset of each part from 0 to 1 as the demonstration advances.
template <class Space>
struct Example {
  Ends<Space> ends;
  ForcingTarget target;
  RowMatrix advance = {};  ///< (K x parts)
  Eigen::VectorXd way =
      {};  ///< (d) what the scaling goes by: the displacement; in the turning form that of p
};

/// Axes that are scaled together.
struct AxisGroup {
  Eigen::Index size;
  bool turns;  ///< a rotation
};

/// What is decided where the options leave it open.
struct Decision {
  DmpOptions options;
  RowMatrix reference;  ///< of the rotation that turns along with the demonstrations; else empty
};

/// How far a part of a demonstration (positions or orientations) reaches, in its unit.
struct Extent {
  Eigen::Index axes;
  double size;
  double rounding;  ///< what is below this is none of its motion
};

template <class Space>
using Demonstrations = std::vector<const typename Space::Demonstration*>;

/// What a space has to say while a model is learned, checked and judged; its loop is its System. A space that
/// is made of two says what its parts do.
template <class Space>
struct Geometry;

template <>
struct Geometry<VectorSpace> {
  using Point = Eigen::VectorXd;
  /// Whether the loop takes a point, where the model has one `like` it.
  static bool accepts(VectorSpace::PointArgument point, const Point& like) noexcept {
    return point.size() == like.size() && point.allFinite();
  }
  /// Throws InvalidArgument, naming `name`, unless set-up takes it.
  static void require(const Point& point, const Point& like, const std::string& name);
  /// What is kept of a point that may be off by rounding.
  static Point projected(const Point& point) { return point; }
  static Point mean(const std::vector<Point>& points);
  /// From start to goal, on the branch nearest to `near` where there are several.
  static Eigen::VectorXd displacement(const Point& start, const Point& goal, const Eigen::VectorXd& near,
                                      const DmpOptions& options);

  static Ends<VectorSpace> ends_of(const DmpParameters& parameters);
  static void set_ends(DmpParameters& parameters, const Ends<VectorSpace>& ends);

  /// What is decided for demonstrations that are learned together; `may_turn`: the space has no rotation
  /// beside this one, so that a model can keep what it turns along with.
  static Decision decide(const DmpOptions& options, const Demonstrations<VectorSpace>&, bool /*may_turn*/) {
    return {options, {}};
  }
  /// The same for a model, from what it keeps; throws InvalidArgument where that does not suit its options.
  static DmpOptions settle(const DmpOptions& options, const Ends<VectorSpace>&) { return options; }
  static Example<VectorSpace> example_of(const Demonstration& demonstration, const DmpOptions& options,
                                         const RowMatrix& reference);
  static void add_groups(const Point& point, std::vector<AxisGroup>& groups) {
    groups.push_back({point.size(), false});
  }

  static Trajectory room_for(const Eigen::VectorXd& times, const Point& point);
  static void record(Trajectory& trajectory, Eigen::Index k, VectorSpace::Output output);

  /// (d) how far an output is from sample k of a demonstration.
  static void deviation(VectorSpace::Output output, const Demonstration& demonstration, Eigen::Index k,
                        double* away);
  /// The same without its noise; appends what each part shows of noise.
  static Demonstration denoised(const Demonstration& demonstration, std::vector<NoiseEstimate>& found);
  static void add_extents(const Demonstration& demonstration, std::vector<Extent>& extents);
  /// Appends the size of the acceleration of each part: of an output, and of the second difference of the
  /// samples k - 1, k and k + 1.
  static void add_accelerations(VectorSpace::Output output, std::vector<double>& sizes) {
    sizes.push_back(output.acceleration.norm());
  }
  static void add_second_differences(const Demonstration& demonstration, Eigen::Index k,
                                     std::vector<double>& sizes);
  static double largest_log(const Demonstration&, const DmpOptions&) { return 0.0; }
  /// How far the rmse goes beyond the tolerance: 1 is just within.
  static double excess(const Point&, const Eigen::VectorXd& rmse, const Tolerance& tolerance) {
    return rmse.norm() / tolerance.position;
  }
  /// The tangent from b to a.
  static Eigen::VectorXd minus(const Point& a, const Point& b) { return a - b; }
  /// Where a demonstration is at times in s from its start, on its spline.
  static std::vector<Point> points_at(const Demonstration& demonstration, const Eigen::VectorXd& times);
  static RowMatrix path_of(const std::vector<Point>& points);
};

template <>
struct Geometry<RotationSpace> {
  using Point = Eigen::Matrix3d;
  static bool accepts(const Point& point, const Point&) noexcept { return so3::is_rotation(point); }
  static void require(const Point& point, const Point&, const std::string& name) {
    so3::require_rotation(point, name);
  }
  static Point projected(const Point& point);
  static Point mean(const std::vector<Point>& points) { return so3::mean_rotation(points); }
  static Eigen::VectorXd displacement(const Point& start, const Point& goal, const Eigen::VectorXd& near,
                                      const DmpOptions& options);

  static Ends<RotationSpace> ends_of(const OrientationDmpParameters& parameters);
  static void set_ends(OrientationDmpParameters& parameters, const Ends<RotationSpace>& ends);

  static Decision decide(const DmpOptions& options, const Demonstrations<RotationSpace>& demonstrations,
                         bool may_turn);
  static DmpOptions settle(const DmpOptions& options, const Ends<RotationSpace>& ends);
  /// In the turning form without `reference` there is no target.
  static Example<RotationSpace> example_of(const OrientationDemonstration& demonstration,
                                           const DmpOptions& options, const RowMatrix& reference);
  static void add_groups(const Point&, std::vector<AxisGroup>& groups) { groups.push_back({3, true}); }

  static OrientationTrajectory room_for(const Eigen::VectorXd& times, const Point&);
  static void record(OrientationTrajectory& trajectory, Eigen::Index k, RotationSpace::Output output);

  static void deviation(RotationSpace::Output output, const OrientationDemonstration& demonstration,
                        Eigen::Index k, double* away);
  static OrientationDemonstration denoised(const OrientationDemonstration& demonstration,
                                           std::vector<NoiseEstimate>& found);
  static void add_extents(const OrientationDemonstration& demonstration, std::vector<Extent>& extents);
  static void add_accelerations(RotationSpace::Output output, std::vector<double>& sizes) {
    sizes.push_back(output.angular_acceleration.norm());
  }
  static void add_second_differences(const OrientationDemonstration& demonstration, Eigen::Index k,
                                     std::vector<double>& sizes);
  static double largest_log(const OrientationDemonstration& demonstration, const DmpOptions& options);
  static double excess(const Point&, const Eigen::VectorXd& rmse, const Tolerance& tolerance) {
    return rmse.norm() / tolerance.angle;
  }
  static Eigen::Vector3d minus(const Point& a, const Point& b) {
    return so3::log(Eigen::Matrix3d(a * b.transpose()));
  }
  static std::vector<Point> points_at(const OrientationDemonstration& demonstration,
                                      const Eigen::VectorXd& times) {
    return demonstration.at(times).rotation;
  }
  static Rotations path_of(const std::vector<Point>& points) { return points; }
};

}  // namespace dmp::detail
