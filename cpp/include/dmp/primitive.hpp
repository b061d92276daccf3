#pragma once

#include <dmp/export.hpp>
#include <dmp/forcing.hpp>
#include <dmp/options.hpp>
#include <dmp/trajectory.hpp>
#include <dmp/via.hpp>

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dmp {

/// Takes the m-th of many motions, on the thread that made it.
template <class Motion>
using Take = std::function<void(Eigen::Index m, const Motion& motion)>;

/// The space that demonstrations of a type, or paths of it, lie in.
template <class Demonstrated>
struct SpaceOf;

/// A dynamic movement primitive, learned from demonstrations: what it learned, not one run of it. Immutable:
/// share it between threads and give each its own run.
///
///   tau zd = alpha (beta (g - y) - z) + S f(s),   tau yd = z,   f(s) = x(s) sum psi w / sum psi
///
/// (Ijspeert et al. 2013, Neural Computation 25(2); tau is the duration in s; S after DmpOptions::scaling.)
/// `Space` says what y is and how points differ: VectorSpace (Dmp), RotationSpace (OrientationDmp), PoseSpace
/// (PoseDmp) or a Product of two of them (PoseGripperDmp). A space names the types of its points, its
/// demonstrations, its trajectories and its parameters.
template <class Space>
class DMP_EXPORT Primitive {
 public:
  using Point = typename Space::Point;
  using Demonstration = typename Space::Demonstration;
  using Trajectory = typename Space::Trajectory;
  using Path = typename Space::Path;
  using Parameters = typename Space::Parameters;

  /// Learns from one demonstration, or from several together: each counts with its own start, goal and
  /// duration; the model's are their means (of rotations, on SO(3)). The weights come from `learner`, or,
  /// without one, from the regression that the options name. Throws InvalidArgument for options outside
  /// their ranges, no demonstration, demonstrations of different dimensions, or weights of another size.
  static Primitive fit(const Demonstration& demonstration, const DmpOptions& options = {},
                       const Learner& learner = {});
  static Primitive fit(const std::vector<Demonstration>& demonstrations, const DmpOptions& options = {},
                       const Learner& learner = {});
  /// What `fit` learns from: the forcing term along each demonstration, one target each. Throws as `fit`.
  static std::vector<ForcingTarget> targets(const std::vector<Demonstration>& demonstrations,
                                            const DmpOptions& options = {});

  /// One model for each demonstration: what fit(demonstrations[j], options) gives, bit for bit.
  /// Demonstrations with the same time grid one after another share what depends on the times alone. threads:
  /// as parallel_for. Throws InvalidArgument as fit does, before it the number of the demonstration.
  static std::vector<Primitive> fit_each(const std::vector<Demonstration>& demonstrations,
                                         const DmpOptions& options = {}, int threads = 1);
  /// The same for demonstrations on one time grid (T) s: T samples each, as a demonstration takes them.
  static std::vector<Primitive> fit_each(const Eigen::VectorXd& times, const std::vector<Path>& paths,
                                         const DmpOptions& options = {}, int threads = 1);

  /// Throws InvalidArgument, naming the field, unless sizes agree, all numbers are finite and rotations are
  /// rotations (so3::is_rotation; the nearest one is taken).
  explicit Primitive(const Parameters& parameters);
  /// The same model with other weights (N x d). Throws InvalidArgument as above.
  Primitive with_weights(const RowMatrix& weights) const;
  /// The same motion, led to new starts and goals by another scaling; automatic is advance. Between its own
  /// start and goal it does what it did, but for rounding and, of a model without an advance, what the
  /// kernels leave of one. Of several demonstrations that were learned together it is the mean that is
  /// scaled. Throws InvalidArgument for a scaling that the form of orientations does not bear.
  Primitive with_scaling(Scaling scaling) const;
  /// Where the guard of the scaling steps in on the way from the demonstrated start to `goal`, a line for
  /// each axis; see DmpOptions::scaling_guard. Empty where it does not, and for scalings that need none.
  std::vector<std::string> scaling_notes(const Point& goal) const;

  const Parameters& parameters() const noexcept;
  const ForcingTerm& forcing() const noexcept;
  /// What a run goes by: the same and, behind its axes, a column of Parameters::advance for each part.
  const ForcingTerm& forcing_of_run() const noexcept;
  const DmpOptions& options() const noexcept { return parameters().options; }
  double duration() const noexcept { return parameters().duration; }  ///< s, of the demonstration
  const Point& start() const noexcept { return parameters().start; }
  const Point& goal() const noexcept { return parameters().goal; }
  Eigen::Index dimension() const noexcept;  ///< d, axes of the motion: columns of the weights

  /// The motion from the demonstrated start to `goal` (the demonstrated one unless given) within `duration`
  /// (s; the demonstrated one unless given), at 0, dt, ... and the duration: where dt does not divide it, the
  /// last step is shorter. Throws InvalidArgument for a wrong size, a number that is not finite or not
  /// positive, more than 10^7 samples, or a motion that does not stay finite. It passes `vias`, in the order
  /// of their phases; throws InvalidArgument, naming the via-point, for phases, points, velocities or reaches
  /// out of range.
  Trajectory rollout(const std::optional<Point>& goal = {}, std::optional<double> duration = {},
                     double dt = 1e-3, const std::vector<Via<Space>>& vias = {}) const;
  /// The same at times (T) in s, increasing from 0 or later.
  Trajectory rollout_at(const Eigen::VectorXd& times, const std::optional<Point>& goal = {},
                        std::optional<double> duration = {}, const std::vector<Via<Space>>& vias = {}) const;
  /// One motion for each goal and duration, `samples` (2 or more) evenly from 0 to its duration: what
  /// rollout(goal, duration, duration / (samples - 1)) gives, bit for bit. goals or durations may be empty:
  /// the demonstrated one for all; otherwise there must be as many of both. None is kept: each is handed to
  /// take(m, motion), on the thread that made it.
  void rollout_each(const std::vector<Point>& goals, const Eigen::VectorXd& durations, Eigen::Index samples,
                    const Take<Trajectory>& take, int threads = 1) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace dmp
