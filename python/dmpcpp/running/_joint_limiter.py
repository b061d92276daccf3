"""Joints that go after a target that may jump, within limits of velocity, acceleration and jerk."""

from __future__ import annotations

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array

__all__ = ["JointLimiter"]

_SHARE = 0.95  # of the limits; rounding and the robot's differences need some
_BRAKING = 0.5  # of the acceleration that may be asked for when it brakes; the rest is for a target that moves
_POSITION_GAIN, _VELOCITY_GAIN = 15.0, 60.0  # 1/s
_RISE = 0.02  # s to the full acceleration where nobody states a limit of jerk


class JointLimiter:
    """A cascade of position, velocity and acceleration, each within its limit, for one control loop.

    A step has constant jerk. The velocity that is asked for lets a stop at half the acceleration end at the target; the
    acceleration is kept where jerk alone can take it to zero before the velocity's limit. Towards a target that stands
    still, and towards the limits of position, a joint slows down in time for both.

    Parameters
    ----------
    arm : Arm
        Whose limits hold.
    start : (n,)
        At rest [rad].
    """

    def __init__(self, arm: Arm, start: Array) -> None:
        """At rest."""
        self.position = np.array(start, dtype=np.float64)
        self.velocity, self.acceleration = np.zeros_like(self.position), np.zeros_like(self.position)
        self._velocity, self._acceleration = _SHARE * arm.velocity_limit, _SHARE * arm.acceleration_limit
        self._lower, self._upper = arm.lower, arm.upper
        self._jerk = _SHARE * np.minimum(arm.jerk_limit, arm.acceleration_limit / _RISE)

    def step(self, target: Array, moving: Array, dt: float) -> None:
        """Go on by dt seconds towards a target (n,) that moves at `moving` (n,) rad/s."""
        off = target - self.position
        fastest = np.sqrt(2.0 * _BRAKING * self._acceleration * np.abs(off))
        wished = moving + np.clip(_POSITION_GAIN * off, -fastest, fastest)
        wished = np.clip(
            wished, -self._slow_enough(self.position - self._lower), self._slow_enough(self._upper - self.position)
        )
        pushed = np.clip(_VELOCITY_GAIN * (wished - self.velocity), -self._acceleration, self._acceleration)
        step = self._jerk * dt
        up = np.sqrt(2.0 * self._jerk * np.maximum(self._velocity - self.velocity, 0.0))
        down = np.sqrt(2.0 * self._jerk * np.maximum(self._velocity + self.velocity, 0.0))
        pushed = np.clip(pushed, -np.maximum(down - step, 0.0), np.maximum(up - step, 0.0))
        before = self.acceleration
        self.acceleration = before + np.clip(pushed - before, -step, step)
        self.position = self.position + dt * (self.velocity + dt * (2.0 * before + self.acceleration) / 6.0)
        self.velocity = self.velocity + 0.5 * dt * (before + self.acceleration)

    def _slow_enough(self, room: Array) -> Array:
        """Return the largest speed from which a joint comes to rest within its room, the rise of a brake counted."""
        late = np.abs(self.velocity) * self._acceleration / self._jerk
        return np.minimum(self._velocity, np.sqrt(2.0 * _BRAKING * self._acceleration * np.maximum(room - late, 0.0)))
