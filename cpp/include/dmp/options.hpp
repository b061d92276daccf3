#pragma once

#include <dmp/export.hpp>

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace dmp {

/// How the kernels lie over the phase; see GaussianBasis.
enum class Kernels { equal_in_time, source };

/// How the weights are found. Locally weighted regression (Schaal and Atkeson 1998; Ijspeert et al. 2013)
/// with passes over what it left over, or one ridge regression over all kernels, which comes closest.
/// automatic: ridge; lwr where `passes` is stated, the kernels are the source's or there are more than 4000.
enum class Regression { lwr, ridge, automatic };

/// How the forcing term follows when start and goal change.
enum class Scaling {
  none,               ///< not at all: the spring alone carries the motion to the goal
  per_axis,           ///< (g - y0), axis by axis (Ijspeert et al. 2013)
  per_axis_relative,  ///< (g - y0) / (g - y0) of the demonstration; an axis that did not move keeps 1
  rotation_dilation,  ///< the rotation and dilation of g - y0 against the demonstration's (Ginesi et al.
                      ///< 2021)
  /// A term is added that takes the motion to its new start and goal as the demonstration itself advances: at
  /// rest where it rests, without going back. Linear and bounded for every start and goal.
  /// docs/formulation.md, "New starts and goals".
  advance,
  automatic  ///< advance; the default
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

/// From a start to a goal, or round and round about a centre, which is the goal then.
enum class Motion { discrete, rhythmic };

/// Log(Rg R^T): followed through pi and 2 pi, or the shortest rotation at every moment.
enum class LogBranch { lifted, principal };

/// The names of an enumeration's values, as model files and Python have them.
template <class Enum>
using Names = std::vector<std::pair<Enum, const char*>>;

inline const Names<Kernels>& names_of(Kernels) {
  static const Names<Kernels> names{{Kernels::equal_in_time, "equal_in_time"}, {Kernels::source, "source"}};
  return names;
}
inline const Names<Regression>& names_of(Regression) {
  static const Names<Regression> names{
      {Regression::lwr, "lwr"}, {Regression::ridge, "ridge"}, {Regression::automatic, "automatic"}};
  return names;
}
inline const Names<Scaling>& names_of(Scaling) {
  static const Names<Scaling> names{{Scaling::none, "none"},
                                    {Scaling::per_axis, "per_axis"},
                                    {Scaling::per_axis_relative, "per_axis_relative"},
                                    {Scaling::rotation_dilation, "rotation_dilation"},
                                    {Scaling::advance, "advance"},
                                    {Scaling::automatic, "automatic"}};
  return names;
}
inline const Names<OrientationForm>& names_of(OrientationForm) {
  static const Names<OrientationForm> names{{OrientationForm::automatic, "automatic"},
                                            {OrientationForm::ude, "ude"},
                                            {OrientationForm::log_linear, "log_linear"},
                                            {OrientationForm::turning, "turning"}};
  return names;
}
inline const Names<LogBranch>& names_of(LogBranch) {
  static const Names<LogBranch> names{{LogBranch::lifted, "lifted"}, {LogBranch::principal, "principal"}};
  return names;
}
inline const Names<Derivatives>& names_of(Derivatives) {
  static const Names<Derivatives> names{{Derivatives::interpolate, "interpolate"},
                                        {Derivatives::smooth, "smooth"},
                                        {Derivatives::gradient, "gradient"},
                                        {Derivatives::automatic, "automatic"}};
  return names;
}
inline const Names<Start>& names_of(Start) {
  static const Names<Start> names{{Start::demonstrated, "demonstrated"}, {Start::rest, "rest"}};
  return names;
}
inline const Names<Integrator>& names_of(Integrator) {
  static const Names<Integrator> names{{Integrator::exact, "exact"},
                                       {Integrator::semi_implicit_euler, "semi_implicit_euler"}};
  return names;
}

inline const Names<Motion>& names_of(Motion) {
  static const Names<Motion> names{{Motion::discrete, "discrete"}, {Motion::rhythmic, "rhythmic"}};
  return names;
}

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
  Scaling scaling = Scaling::automatic;
  /// Guards the scalings that multiply by a ratio: an axis (for rotation_dilation, the whole displacement)
  /// whose ends lie closer than a quarter of its range follows `advance` instead, and ratios are held within
  /// 4; `advance` adds what is beyond. Primitive::scaling_notes says where.
  bool scaling_guard = true;
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
  /// rhythmic: a demonstration is one cycle, its last sample the first one again (find_cycle), its duration
  /// the period. Without gate and scaling; orientations in the turning form, about what turns on evenly.
  Motion motion = Motion::discrete;

  /// Throws InvalidArgument, naming the field, for one outside its range.
  DMP_EXPORT void validate() const;
  /// Whether kernels, regression or derivatives are left to the demonstrations.
  DMP_EXPORT bool automatic() const noexcept;
  /// The same options with every optional one filled in; validates them.
  DMP_EXPORT DmpOptions resolved() const;

  /// The equations of the thesis proposal of 2019, read at tau = 1 with its errata E1, E6 and E7 corrected:
  /// docs/formulation.md.
  DMP_EXPORT static DmpOptions source();

  /// Every field but `motion` once, by its name in a model file: files, comparison and checks go by this
  /// list.
  static constexpr auto fields() {
    using O = DmpOptions;
    return std::make_tuple(
        std::pair("basis_count", &O::basis_count), std::pair("alpha", &O::alpha), std::pair("beta", &O::beta),
        std::pair("orientation_alpha", &O::orientation_alpha),
        std::pair("orientation_beta", &O::orientation_beta), std::pair("alpha_x", &O::alpha_x),
        std::pair("kernels", &O::kernels), std::pair("overlap", &O::overlap),
        std::pair("regression", &O::regression), std::pair("passes", &O::passes),
        std::pair("ridge", &O::ridge), std::pair("scaling", &O::scaling),
        std::pair("scaling_guard", &O::scaling_guard), std::pair("orientation_form", &O::orientation_form),
        std::pair("log_branch", &O::log_branch), std::pair("derivatives", &O::derivatives),
        std::pair("start", &O::start), std::pair("integrator", &O::integrator),
        std::pair("force_after_end", &O::force_after_end), std::pair("goal_filter", &O::goal_filter),
        std::pair("tempo_filter", &O::tempo_filter), std::pair("phase_stop", &O::phase_stop));
  }
};

/// Whether all fields are equal; one that is not given differs from one that states its default.
DMP_EXPORT bool operator==(const DmpOptions& a, const DmpOptions& b) noexcept;
inline bool operator!=(const DmpOptions& a, const DmpOptions& b) noexcept { return !(a == b); }

}  // namespace dmp
