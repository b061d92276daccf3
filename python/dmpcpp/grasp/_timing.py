"""When the joints are where: every part of a grasp as fast as its own limits allow, with pauses between."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.planning import Slowed, slowed
from dmpcpp.simulation import Bullet

__all__ = ["PHASES", "TimedGrasp", "timed_grasp"]

PHASES = ("reach", "approach", "close", "lift", "hold")

_APPROACH, _LIFT = 1.0, 1.0  # s, at least
_CLOSING, _HOLDING = 0.6, 2.0  # s
_PAUSE_POSES = 10
_TORQUE_SHARE = 0.8  # of the effort limits; the rest is left to what is carried and to the feedback


@dataclass(frozen=True, eq=False)
class TimedGrasp:
    """The joints of a whole grasp.

    Attributes
    ----------
    joints : JointTrajectory
        From rest to rest, standing still while the fingers close and at the end.
    phases : dict of str to float
        When each of PHASES begins [s].
    """

    joints: JointTrajectory
    phases: dict[str, float]


def timed_grasp(arm: Arm, reach: Array, approach: Array, lift: Array, reach_duration: float) -> TimedGrasp | None:
    """Time joints so that the limits of their velocity, acceleration and torque hold.

    Parameters
    ----------
    arm : Arm
    reach, approach, lift : array_like (A, n), (B, n), (C, n)
        rad; each begins with the last joints of the one before.
    reach_duration : float
        s of the reach, unless the limits ask for more; approach and lift take at least 1 s each.

    Returns
    -------
    TimedGrasp or None
        None where the motors cannot even hold the arm.
    """
    parts = [(reach, reach_duration), (approach, _APPROACH), (lift, _LIFT)]
    slow = [_slowed(arm, JointTrajectory.through(np.linspace(0.0, time, len(q)), q)) for q, time in parts]
    if not all(part.possible for part in slow):
        return None
    times = [part.factor * time for part, (_, time) in zip(slow, parts, strict=True)]
    durations = (times[0], times[1], _CLOSING, times[2], _HOLDING)
    joints = _joined(arm, (reach, approach, approach[-1:], lift, lift[-1:]), durations)
    again = _slowed(arm, joints)  # the seams between the parts may ask for a little more
    begins = again.factor * np.cumsum((0.0, *durations[:-1]))
    return TimedGrasp(again.joints, dict(zip(PHASES, begins.tolist(), strict=True)))


def _slowed(arm: Arm, joints: JointTrajectory) -> Slowed:
    return slowed(arm, joints, Bullet, _TORQUE_SHARE)


def _joined(arm: Arm, parts: tuple[Array, ...], durations: tuple[float, ...]) -> JointTrajectory:
    """One spline through all parts; a part of one row is a pause."""
    rows = [part if len(part) > 1 else np.repeat(part, _PAUSE_POSES, axis=0) for part in parts]
    begins = np.cumsum((0.0, *durations[:-1]))
    times = [begin + np.linspace(0.0, d, len(q)) for begin, d, q in zip(begins, durations, rows, strict=True)]
    kept = [slice(0 if k == 0 else 1, None) for k in range(len(rows))]  # each begins where the last one ends
    time = np.concatenate([t[keep] for t, keep in zip(times, kept, strict=True)])
    position = np.concatenate([q[keep] for q, keep in zip(rows, kept, strict=True)])
    return JointTrajectory.through(time, position, arm.joint_names)
