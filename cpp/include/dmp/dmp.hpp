#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/primitive.hpp>
#include <dmp/stepper.hpp>

#include <Eigen/Core>
#include <tuple>

namespace dmp {

/// All that a Dmp is: what a model file holds.
struct DMP_EXPORT DmpParameters {
  DmpOptions options;
  double duration = 1.0;           ///< tau of the demonstration, s
  Eigen::VectorXd start;           ///< (d) y0
  Eigen::VectorXd goal;            ///< (d) g
  Eigen::VectorXd start_velocity;  ///< (d) per s, at `duration`
  Eigen::VectorXd amplitude;       ///< (d) range that the demonstration covered, axis by axis
  RowMatrix weights;               ///< (N x d) of the forcing term
  /// (N x 1) of Scaling::advance: weights of the forcing term that takes an offset from 0 to 1 as the
  /// demonstration advances. Empty in the other scalings.
  RowMatrix advance;

  /// Every field beside the options and those that may be empty, by its name in a model file.
  static constexpr auto fields() {
    return std::make_tuple(
        std::pair("duration", &DmpParameters::duration), std::pair("start", &DmpParameters::start),
        std::pair("goal", &DmpParameters::goal), std::pair("start_velocity", &DmpParameters::start_velocity),
        std::pair("amplitude", &DmpParameters::amplitude), std::pair("weights", &DmpParameters::weights));
  }
  /// Fields that may be empty, which a model file leaves out then.
  static constexpr auto optional_fields() {
    return std::make_tuple(std::pair("advance", &DmpParameters::advance));
  }
};

/// R^d: positions, or any other values over time, such as joints.
struct DMP_EXPORT VectorSpace {
  using Point = Eigen::VectorXd;
  using PointArgument = const Eigen::Ref<const Eigen::VectorXd>&;
  using PointView = const Eigen::VectorXd&;
  using Tangent = Eigen::VectorXd;
  using TangentArgument = const Eigen::Ref<const Eigen::VectorXd>&;
  using Path = RowMatrix;  ///< (T x d)
  using Demonstration = dmp::Demonstration;
  using Trajectory = dmp::Trajectory;
  using Parameters = DmpParameters;
  /// Of a run, as it stands: whoever keeps a reference reads the newest.
  struct Outputs {
    Eigen::VectorXd position;      ///< (d)
    Eigen::VectorXd velocity;      ///< (d) per s
    Eigen::VectorXd acceleration;  ///< (d) per s^2
  };
  using Output = const Outputs&;
};

/// A dynamic movement primitive for positions in R^d.
using Dmp = Primitive<VectorSpace>;
template <>
struct SpaceOf<Demonstration> {
  using type = VectorSpace;
};
template <>
struct SpaceOf<RowMatrix> {
  using type = VectorSpace;
};
extern template class Primitive<VectorSpace>;
extern template class Stepper<VectorSpace>;

/// One run of a Dmp, for one control loop; see Stepper.
class DMP_EXPORT Run : public Stepper<VectorSpace> {
 public:
  using Stepper::Stepper;
  const Eigen::VectorXd& position() const noexcept DMP_REALTIME { return output().position; }  ///< (d)
  const Eigen::VectorXd& velocity() const noexcept DMP_REALTIME { return output().velocity; }  ///< (d) per s
  /// (d) per s^2
  const Eigen::VectorXd& acceleration() const noexcept DMP_REALTIME { return output().acceleration; }
};

}  // namespace dmp
