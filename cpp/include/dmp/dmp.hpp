#pragma once

#include <dmp/demonstration.hpp>
#include <dmp/export.hpp>
#include <dmp/forcing.hpp>
#include <dmp/options.hpp>
#include <dmp/realtime.hpp>
#include <dmp/status.hpp>
#include <dmp/trajectory.hpp>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace dmp {

namespace detail {
class ForcingFit;
struct BatchFit;
struct Timetable;
}  // namespace detail

/// All that a Dmp is: what a model file holds.
struct DmpParameters {
  DmpOptions options;
  double duration = 1.0;           ///< tau of the demonstration, s
  Eigen::VectorXd start;           ///< (d) y0
  Eigen::VectorXd goal;            ///< (d) g
  Eigen::VectorXd start_velocity;  ///< (d) per s, at `duration`
  Eigen::VectorXd amplitude;       ///< (d) range that the demonstration covered, axis by axis
  RowMatrix weights;               ///< (N x d) of the forcing term
};

/// A dynamic movement primitive for positions in R^d, learned from demonstrations. Immutable: share it
/// between threads and give each its own Run.
///
///   tau zd = alpha (beta (g - y) - z) + S f(x),   tau yd = z,   tau xd = -alpha_x x
///
/// (Ijspeert et al. 2013, Neural Computation 25(2); tau is the duration in s; S after DmpOptions::scaling.)
class DMP_EXPORT Dmp {
 public:
  /// Learns from one demonstration, or from several together: each counts with its own start, goal and
  /// duration; the model's are their means. Throws InvalidArgument for options outside their ranges, no
  /// demonstration, or demonstrations of different dimensions.
  static Dmp fit(const Demonstration& demonstration, const DmpOptions& options = {});
  static Dmp fit(const std::vector<Demonstration>& demonstrations, const DmpOptions& options = {});
  /// Throws InvalidArgument unless sizes agree and all numbers are finite.
  explicit Dmp(const DmpParameters& parameters);

  const DmpParameters& parameters() const noexcept;
  const DmpOptions& options() const noexcept { return parameters().options; }
  Eigen::Index dimension() const noexcept { return parameters().start.size(); }
  double duration() const noexcept { return parameters().duration; }            ///< s
  const Eigen::VectorXd& start() const noexcept { return parameters().start; }  ///< (d)
  const Eigen::VectorXd& goal() const noexcept { return parameters().goal; }    ///< (d)
  const ForcingTerm& forcing() const noexcept;

  /// The motion from the demonstrated start to `goal` (d; the demonstrated one unless given) within
  /// `duration` (s; the demonstrated one unless given), at 0, dt, ... up to the duration: floor(duration / dt
  /// + 1e-6) + 1 samples. Throws InvalidArgument for a wrong size, a number that is not finite or not
  /// positive, more than 10^7 samples, or a motion that does not stay finite.
  Trajectory rollout(const std::optional<Eigen::VectorXd>& goal = {}, std::optional<double> duration = {},
                     double dt = 1e-3) const;
  /// The same at times (T) in s, increasing from 0 or later.
  Trajectory rollout_at(const Eigen::VectorXd& times, const std::optional<Eigen::VectorXd>& goal = {},
                        std::optional<double> duration = {}) const;

 private:
  friend struct detail::BatchFit;
  /// From `count` demonstrations; `memory` keeps what later fits may share.
  static Dmp fit_together(const Demonstration* demonstrations, std::size_t count, const DmpOptions& options,
                          std::unique_ptr<detail::ForcingFit>& memory);
  friend class Run;
  Trajectory roll_out(const detail::Timetable& timetable, const std::optional<Eigen::VectorXd>& goal,
                      std::optional<double> duration) const;

  struct Data;
  std::shared_ptr<const Data> data_;
};

/// One run of a Dmp, for one control loop. The constructor takes all the memory; copies are independent.
class DMP_EXPORT Run {
 public:
  explicit Run(const Dmp& dmp);
  Run(const Run& other);
  Run(Run&& other) noexcept;
  Run& operator=(const Run& other);
  Run& operator=(Run&& other) noexcept;
  ~Run();

  /// Moves on by dt seconds, 0 to 10 durations (else invalid_input), in internal steps of at most 0.005 of
  /// the duration, or of half a duration over the largest of alpha and goal_filter where that is less.
  Status step(double dt) noexcept DMP_REALTIME;
  /// The goal (d) to go to from now on, approached through DmpOptions::goal_filter; before the
  /// first step it counts at once. Like start_from, it takes no memory for a vector; of an expression or a
  /// row of a matrix Eigen makes a copy before the call, which does.
  Status set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept DMP_REALTIME;
  /// The duration (s) of the whole motion from now on; the path stays the same. Before the
  /// first step at once, later through DmpOptions::tempo_filter.
  Status set_duration(double duration) noexcept DMP_REALTIME;
  /// How far the robot lags behind (0 or more): slows the phase by 1 + DmpOptions::phase_stop times it.
  Status set_tracking_error(double error) noexcept DMP_REALTIME;
  /// Comes to rest on the path, and goes on from there; both through DmpOptions::tempo_filter.
  void pause() noexcept DMP_REALTIME;
  void resume() noexcept DMP_REALTIME;
  bool paused() const noexcept DMP_REALTIME;
  /// Begins anew at position (d) with velocity (d, per s), at the goal and duration that were set last.
  Status start_from(const Eigen::Ref<const Eigen::VectorXd>& position,
                    const Eigen::Ref<const Eigen::VectorXd>& velocity) noexcept DMP_REALTIME;
  /// Begins anew at the demonstrated start, with the goal and duration that were set last. A pause goes on.
  void reset() noexcept DMP_REALTIME;

  const Eigen::VectorXd& position() const noexcept DMP_REALTIME;      ///< (d)
  const Eigen::VectorXd& velocity() const noexcept DMP_REALTIME;      ///< (d) per s
  const Eigen::VectorXd& acceleration() const noexcept DMP_REALTIME;  ///< (d) per s^2
  const Eigen::VectorXd& goal() const noexcept DMP_REALTIME;          ///< (d) the one set last
  double time() const noexcept DMP_REALTIME;                          ///< s since the start
  double phase() const noexcept DMP_REALTIME;                         ///< 0 at the start, 1 at the end
  double duration() const noexcept DMP_REALTIME;                      ///< s, the one set last
  Status status() const noexcept DMP_REALTIME;

 private:
  friend class Dmp;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dmp
