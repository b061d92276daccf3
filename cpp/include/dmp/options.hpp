#pragma once

#include <dmp/export.hpp>

#include <optional>

namespace dmp {

/// How the kernels lie over the phase; see GaussianBasis.
enum class Kernels { equal_in_time, source };

/// How the weights are found. Locally weighted regression (Schaal and Atkeson 1998; Ijspeert et al. 2013)
/// with passes over what it left over, or one ridge regression over all kernels, which comes closest.
/// automatic: ridge; lwr where `passes` is stated, the kernels are the source's or there are more than 4000.
enum class Regression { lwr, ridge, automatic };

/// By what the forcing term is multiplied when start and goal change.
enum class Scaling {
  none,               ///< nothing: the shape stays, the spring carries it to the goal
  per_axis,           ///< (g - y0), axis by axis (Ijspeert et al. 2013)
  per_axis_relative,  ///< (g - y0) / (g - y0) of the demonstration; an axis that did not move keeps 1
  rotation_dilation  ///< the rotation and dilation of g - y0 against the demonstration's (Ginesi et al. 2021)
};

/// The equation of motion of orientations; see OrientationDmp.
/// automatic: ude for demonstrations that stay within 2 rad of their goal; beyond, turning, which is stable
/// for every start, goal and number of turns. Where the forcing term is scaled, which turning does not bear,
/// log_linear beyond 3 rad.
enum class OrientationForm { automatic, ude, log_linear, turning };

/// What a rollout starts with: the velocity that was demonstrated, or rest.
enum class Start { demonstrated, rest };

/// exact: the linear part exactly, the forcing term by its parabola over the step; fourth order on SO(3).
enum class Integrator { exact, semi_implicit_euler };

/// Velocities and accelerations of a demonstration: of the quintic spline through its samples, of the one
/// that smooths them, or second-order differences taken twice. automatic: interpolate, or without its noise
/// where the samples show that they carry any (NoiseEstimate).
enum class Derivatives { interpolate, smooth, gradient, automatic };

/// Log(Rg R^T): followed through pi and 2 pi, or the shortest rotation at every moment.
enum class LogBranch { lifted, principal };

/// Every choice there is in a Dmp, OrientationDmp or PoseDmp. What is automatic, `fit` finds in the
/// demonstrations, and the options of the model say what it was.
struct DmpOptions {
  /// N, kernels. 0: the fewest of 25, 50, 100, .. 800 that reproduce the demonstrations as closely as their
  /// samples allow: to a quarter of the error that smoothing leaves, or to .4 of what the neighbours of a
  /// sample leave open of it, between 3e-6 and 3e-4 of the extent.
  int basis_count = 0;
  double alpha = 25.0;                      ///< spring and damper: tau zd = alpha (beta (g - y) - z) + f
  std::optional<double> beta;               ///< alpha / 4 unless given: critically damped
  std::optional<double> orientation_alpha;  ///< alpha unless given
  std::optional<double> orientation_beta;  ///< beta unless given; orientation_alpha / 4 if only that is given
  double alpha_x = 4.605170185988091;      ///< decay of the phase variable; ln 100: x = 0.01 at the end
  Kernels kernels = Kernels::equal_in_time;
  std::optional<double> overlap;  ///< neighbours cross at exp(-overlap / 4); ln 2 (lwr), 0.2 (ridge)
  Regression regression = Regression::automatic;
  int passes = 10;       ///< of locally weighted regression; 1 is the textbook's
  double ridge = 1e-12;  ///< times trace / N on the diagonal
  Scaling scaling = Scaling::none;
  OrientationForm orientation_form = OrientationForm::automatic;
  LogBranch log_branch = LogBranch::lifted;
  Derivatives derivatives = Derivatives::automatic;
  Start start = Start::demonstrated;
  Integrator integrator = Integrator::exact;
  bool force_after_end = false;  ///< the forcing term goes on after the duration
  double goal_filter = 25.0;     ///< alpha_g: a new goal is approached by tau gd = alpha_g (g* - g)
  double tempo_filter =
      0.1;  ///< s, time constant with which a change of tempo (duration, pause, phase stop) is approached
  double phase_stop = 0.0;  ///< k: a tracking error e slows the phase to sd = 1 / (tau (1 + k e))

  /// Throws InvalidArgument, naming the field, for one outside its range.
  DMP_EXPORT void validate() const;
  /// Whether kernels, regression or derivatives are left to the demonstrations.
  DMP_EXPORT bool automatic() const noexcept;
  /// The same options with every optional one filled in; validates them.
  DMP_EXPORT DmpOptions resolved() const;

  /// The equations of the thesis proposal of 2019, read at tau = 1 with its errata E1, E6 and E7 corrected:
  /// docs/formulation.md.
  DMP_EXPORT static DmpOptions source();
};

/// Whether all fields are equal; one that is not given differs from one that states its default.
DMP_EXPORT bool operator==(const DmpOptions& a, const DmpOptions& b) noexcept;
inline bool operator!=(const DmpOptions& a, const DmpOptions& b) noexcept { return !(a == b); }

}  // namespace dmp
