#pragma once

namespace dmp {

/// What a call inside the control loop says; nothing there throws.
enum class Status {
  running,        ///< The motion goes on.
  finished,       ///< The phase has reached the duration; the spring holds the goal.
  invalid_input,  ///< The argument was refused (not finite, wrong size, wrong sign); nothing changed.
  not_finite,     ///< The state left the finite numbers; the last finite output is kept.
  too_late,       ///< The place lies behind, or so little ahead that it cannot be reached; nothing changed.
  blocked         ///< Obstacles leave no way on: the motion brakes, or stands before them (SafetyFilter).
};

}  // namespace dmp
