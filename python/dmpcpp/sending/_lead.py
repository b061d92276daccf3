"""How a motion comes to rest: by a ramp beyond its end, or where none fits by slowing down along the path."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.sending._between import JointMotion, States, interpolated
from dmpcpp.sending._effort import effort_share
from dmpcpp.sending._ramp import ramp

__all__ = ["Backwards", "Clear", "Lead", "lead_out"]

Clear = Callable[[Array], bool]
"""Whether the arm touches nothing along joints (N, n)."""

_RESERVE = 0.97  # of the limits that a slowed end uses
_GROWTH = 1.4  # from one length that is tried to the next


@dataclass(frozen=True, eq=False)
class Lead:
    """The samples that bring a motion to rest.

    Attributes
    ----------
    after : (N,) s
        Behind the last sample of the motion that is kept.
    position, velocity, acceleration : (N, n)
        The last velocity and acceleration are exactly 0.
    replaced : int
        Samples of the motion that it stands for: those of a path that is slowed down.
    cost : float
        s that these take longer.
    fits : bool
        Whether it holds the limits and touches nothing.
    """

    after: Array
    position: Array
    velocity: Array
    acceleration: Array
    replaced: int = 0
    cost: float = 0.0
    fits: bool = True


@dataclass(frozen=True, eq=False)
class Backwards:
    """A motion run backwards: its lead-out is the lead-in of the motion, seen backwards."""

    forwards: JointMotion
    time: Array = field(init=False)
    position: Array = field(init=False)
    velocity: Array = field(init=False)
    acceleration: Array = field(init=False)

    def __post_init__(self) -> None:
        """Turn the arrays around once."""
        for name, sign in (("time", -1.0), ("position", 1.0), ("velocity", -1.0), ("acceleration", 1.0)):
            object.__setattr__(self, name, sign * getattr(self.forwards, name)[::-1])

    @property
    def joint_names(self) -> Sequence[str]:
        """As forwards."""
        return self.forwards.joint_names


def lead_out(arm: Arm, joints: JointMotion, step: float, clear: Clear | None) -> Lead:
    """Bring a motion to rest beyond its last sample, in steps of ``step`` s; else slow it down before."""
    beyond = _beyond(arm, joints, step)
    if beyond.fits and (clear is None or len(beyond.after) == 0 or clear(beyond.position)):
        return beyond
    return _along(arm, joints) or Lead(beyond.after, beyond.position, beyond.velocity, beyond.acceleration, fits=False)


def _beyond(arm: Arm, joints: JointMotion, step: float) -> Lead:
    found = ramp(arm, joints.position[-1], joints.velocity[-1], joints.acceleration[-1], step)
    after = step * np.arange(1, 1 + round(float(found.length.max()) / step))
    states = found.states(joints.position[-1], after)
    return Lead(after, *states, fits=found.fits and effort_share(arm, *states) <= 1.0)


def _along(arm: Arm, joints: JointMotion) -> Lead | None:
    """Slow down over the shortest end of the path, half of it at most, on which the limits hold."""
    most = (len(joints.time) - 1) // 2
    count = 2
    while count <= most:
        slow = _slowed(joints, count)
        if _holds(arm, slow):
            return slow
        count = min(most, int(np.ceil(_GROWTH * count))) if count < most else most + 1
    return None


def _slowed(joints: JointMotion, count: int) -> Lead:
    """Go along the last ``count`` intervals in twice their time, with the rate of the path from 1 to 0.

    The rate is r^3 (10 - 15 r + 6 r^2), r = 1 - t / T: rate and its first two derivatives are continuous.
    """
    begin, end = joints.time[-1 - count], joints.time[-1]
    duration = 2.0 * (end - begin)
    r = np.arange(2 * count - 1, -1, -1) / (2 * count)
    rate = (r**3 * (10.0 - 15.0 * r + 6.0 * r**2))[:, None]
    slowing = (-30.0 * r**2 * (1.0 - r) ** 2 / duration)[:, None]
    p, v, a = interpolated(joints, end - duration * r**4 * (2.5 - 3.0 * r + r**2))
    after = duration * (1.0 - r)
    return Lead(after, p, v * rate + 0.0, a * rate**2 + v * slowing + 0.0, count, float(0.5 * duration))


def _holds(arm: Arm, lead: Lead) -> bool:
    acceleration = np.abs(lead.acceleration) / arm.acceleration_limit
    jerk = np.abs(np.diff(lead.acceleration, axis=0)) / np.diff(lead.after)[:, None] / arm.jerk_limit
    largest = max(acceleration.max(), jerk.max(initial=0.0))
    states: States = (lead.position, lead.velocity, lead.acceleration)
    return bool(largest <= _RESERVE and effort_share(arm, *states) <= 1.0)
