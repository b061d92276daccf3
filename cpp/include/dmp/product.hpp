#pragma once

#include <dmp/error.hpp>
#include <dmp/export.hpp>
#include <dmp/options.hpp>
#include <dmp/primitive.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <tuple>
#include <utility>

namespace dmp {

/// Two motions over time: what the rollout of a product's primitive returns.
template <class A, class B>
struct DMP_EXPORT ProductTrajectory {
  Eigen::VectorXd time;  ///< (T) s
  typename A::Trajectory first;
  typename B::Trajectory second;
};

/// Two motions of one performance, recorded at the same times.
template <class A, class B>
class DMP_EXPORT ProductDemonstration {
 public:
  using Path = std::pair<typename A::Path, typename B::Path>;

  /// Throws InvalidArgument unless both have the same times, counted from the first sample.
  ProductDemonstration(typename A::Demonstration first, typename B::Demonstration second)
      : first_(std::move(first)), second_(std::move(second)) {
    if (first_.time().size() != second_.time().size() || first_.time() != second_.time())
      throw InvalidArgument("second: recorded at other times than first, expected the same for both.");
  }
  /// times (T) s; paths of T samples each, as the two demonstrations take them.
  ProductDemonstration(const Eigen::VectorXd& times, const typename A::Path& first,
                       const typename B::Path& second)
      : first_(times, first), second_(times, second) {}
  ProductDemonstration(const Eigen::VectorXd& times, const Path& both)
      : ProductDemonstration(times, both.first, both.second) {}

  Eigen::Index size() const noexcept { return first_.size(); }
  double duration() const noexcept { return first_.duration(); }          ///< s
  const Eigen::VectorXd& time() const noexcept { return first_.time(); }  ///< (T) s, from 0
  const typename A::Demonstration& first() const noexcept { return first_; }
  const typename B::Demonstration& second() const noexcept { return second_; }
  /// Other samples at the same times: what the splines need of the times alone is shared.
  ProductDemonstration with(const Path& both) const {
    return {first_.with(both.first), second_.with(both.second)};
  }

 private:
  typename A::Demonstration first_;
  typename B::Demonstration second_;
};

/// All that a primitive of a product is: what a model file holds.
template <class A, class B>
struct DMP_EXPORT ProductParameters {
  using Point = std::pair<typename A::Point, typename B::Point>;
  DmpOptions options;
  double duration = 1.0;  ///< tau of the demonstration, s
  Point start;
  Point goal;
  Eigen::VectorXd start_velocity;  ///< (d) per s, at `duration`: of the first, then of the second
  Eigen::VectorXd displacement;    ///< (d) from start to goal; of rotations Log(Rg R0^T) on its branch
  Eigen::VectorXd amplitude;       ///< (d) range that the demonstration covered, axis by axis
  RowMatrix weights;               ///< (N x d) of the forcing term
  /// (M + 1 x 4), of OrientationForm::turning, as of PoseDmpParameters. Empty in the other forms, and in
  /// spaces of other than one rotation.
  RowMatrix reference;
  /// (N x parts) of Scaling::advance: weights of the forcing term that takes the offset of each part from 0
  /// to 1 as the demonstration advances. Empty in the other scalings.
  RowMatrix advance;

  /// Every field beside the options and those that may be empty, by its name in a model file.
  static constexpr auto fields() {
    using P = ProductParameters;
    return std::make_tuple(std::pair("duration", &P::duration), std::pair("start", &P::start),
                           std::pair("goal", &P::goal), std::pair("start_velocity", &P::start_velocity),
                           std::pair("displacement", &P::displacement), std::pair("amplitude", &P::amplitude),
                           std::pair("weights", &P::weights));
  }
  /// Fields that may be empty, which a model file leaves out then.
  static constexpr auto optional_fields() {
    return std::make_tuple(std::pair("reference", &ProductParameters::reference),
                           std::pair("advance", &ProductParameters::advance));
  }
};

/// Two spaces side by side, in one phase with one set of kernels and one duration: a pose and a gripper, two
/// hands. Neither depends on the other.
template <class A, class B>
struct DMP_EXPORT Product {
  using First = A;
  using Second = B;
  using Point = std::pair<typename A::Point, typename B::Point>;
  using PointArgument = const Point&;
  using PointView = std::pair<typename A::PointView, typename B::PointView>;
  using Tangent = Eigen::VectorXd;  ///< of the first, then of the second
  using TangentArgument = const Eigen::Ref<const Eigen::VectorXd>&;
  using Path = std::pair<typename A::Path, typename B::Path>;
  using Demonstration = ProductDemonstration<A, B>;
  using Trajectory = ProductTrajectory<A, B>;
  using Parameters = ProductParameters<A, B>;
  struct Output {
    typename A::Output first;
    typename B::Output second;
  };
};

template <class A, class B>
struct SpaceOf<ProductDemonstration<A, B>> {
  using type = Product<A, B>;
};
template <class PathA, class PathB>
struct SpaceOf<std::pair<PathA, PathB>> {
  using type = Product<typename SpaceOf<PathA>::type, typename SpaceOf<PathB>::type>;
};

}  // namespace dmp
