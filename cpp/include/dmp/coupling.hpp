#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <type_traits>

namespace dmp {

/// What a coupling sees: the run at the start of an internal step.
template <class Space>
struct CouplingState {
  double phase = 0.0;                  ///< s, 0 at the start, 1 at the end
  double speed = 0.0;                  ///< ds/dt as it is now, 1/s; 1 / duration unless the tempo changes
  typename Space::Point point{};       ///< position, rotation or pose
  typename Space::Tangent velocity{};  ///< (d) per s; rotations in rad/s, world frame
  typename Space::Point goal{};        ///< the one set last
};

/// A coupling term of the user's own: a reference to a function that is called in each internal step (at most
/// 0.005 of the duration) and whose value c is added to the forcing term,
///   tau zd = alpha (beta (g - y) - z) + S f(s) + c
/// (Ijspeert et al. 2013, section 2.2.3). c is an acceleration over phase: c = a / speed^2 for an
/// acceleration a in m/s^2 or rad/s^2 (world frame). It is held over the step. A paused run does not ask it.
/// It promises nothing: a run with a coupling may miss its goal.
///
/// Made from any function object f, which must outlive the call that it is passed to, be noexcept, and
/// allocate nothing in a control loop:
///   f(state) -> Tangent             returns c, or
///   f(state, drive)                 adds it to `drive`, an Eigen::Map of d numbers.
/// A value of another size than d makes the run not_finite.
template <class Space>
class Coupling {
 public:
  using State = CouplingState<Space>;
  using Drive = Eigen::Map<typename Space::Tangent>;

  template <class Function, std::enable_if_t<!std::is_same_v<std::decay_t<Function>, Coupling>, int> = 0>
  Coupling(const Function& function) noexcept : function_(std::addressof(function)), call_(&call<Function>) {
    static_assert(std::is_invocable_v<const Function&, const State&> ||
                      std::is_invocable_v<const Function&, const State&, Drive&>,
                  "a coupling is called as f(state), returning a tangent, or as f(state, drive)");
    static_assert(std::is_nothrow_invocable_v<const Function&, const State&> ||
                      std::is_nothrow_invocable_v<const Function&, const State&, Drive&>,
                  "a coupling is called in the control loop: declare its call operator noexcept");
    if constexpr (!std::is_invocable_v<const Function&, const State&, Drive&>) {
      using Value = std::decay_t<std::invoke_result_t<const Function&, const State&>>;
      static_assert(
          std::is_base_of_v<Eigen::PlainObjectBase<Value>, Value>,
          "a coupling returns a vector, not an expression of vectors that are gone by then: state its return "
          "type, as in [](const State&) noexcept -> Eigen::Vector3d { .. }");
    }
  }

  void add_to(double* drive, Eigen::Index size, const State& state) const noexcept {
    call_(function_, Drive(drive, size), state);
  }

 private:
  template <class Function>
  static void call(const void* function, Drive drive, const State& state) noexcept {
    const Function& f = *static_cast<const Function*>(function);
    if constexpr (std::is_invocable_v<const Function&, const State&, Drive&>) {
      f(state, drive);
    } else {
      const auto& value = f(state);
      if (value.size() == drive.size()) {
        drive += value;
      } else {
        drive.setConstant(std::numeric_limits<double>::quiet_NaN());
      }
    }
  }

  const void* function_;
  void (*call_)(const void*, Drive, const State&) noexcept;
};

}  // namespace dmp
