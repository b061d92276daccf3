"""From where a robot stands to where a motion starts: the nearest whole turns, and slowly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.sending._between import JointMotion

__all__ = ["APPROACH_SHARE", "Joints", "approach", "farthest", "joined", "nearest_turns", "slowed_by", "turned"]

APPROACH_SHARE = 0.1
"""Of the limits of velocity, acceleration and jerk that an approach uses."""
_STEP = 0.02  # s between samples
_SHORTEST = 0.5  # s


@dataclass(frozen=True, eq=False)
class Joints:
    """Joints over time: time (T,) s; position, velocity, acceleration (T, n) in rad and s; names (n)."""

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    joint_names: tuple[str, ...]


def nearest_turns(arm: Arm, position: Array, stands: Array) -> Array:
    """Whole turns (n,) [rad] to add to a motion (T, n), so that it starts nearest to where the robot stands.

    Only as far as the whole motion stays within the limits of position; a joint that turns freely has none.
    """
    turn = 2.0 * np.pi
    wanted = turn * np.round((stands - position[0]) / turn)
    fits = (position.max(axis=0) + wanted <= arm.upper) & (position.min(axis=0) + wanted >= arm.lower)
    return np.where(fits, wanted, 0.0)


def approach(arm: Arm, stands: Array, start: Array) -> Joints | None:
    """Go straight in joint space from where the robot stands to a start (n,), from rest to rest.

    The minimum-jerk way, 10 u^3 - 15 u^4 + 6 u^5 (Flash and Hogan, J. Neuroscience 5, 1985), with at most a tenth of
    the limits of velocity, acceleration and jerk. None where the robot stands there already.
    """
    way = np.asarray(start - stands)
    if not way.any():
        return None
    far = np.abs(way) / APPROACH_SHARE
    needed = (
        1.875 * far / arm.velocity_limit,
        np.sqrt(10.0 / np.sqrt(3.0) * far / arm.acceleration_limit),
        np.cbrt(60.0 * far / arm.jerk_limit),
    )
    steps = int(np.ceil(max(_SHORTEST, float(np.max(needed))) / _STEP))
    u = np.arange(steps + 1)[:, None] / steps
    duration = steps * _STEP
    return Joints(
        _STEP * np.arange(steps + 1),
        np.where(u < 1.0, stands + way * u**3 * (10.0 - 15.0 * u + 6.0 * u**2), start),
        way * 30.0 * u**2 * (1.0 - u) ** 2 / duration,
        way * 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / duration**2,
        tuple(arm.joint_names),
    )


def farthest(arm: Arm, duration: float) -> float:
    """How far every joint may go from rest to rest in a time at a tenth of its limits [rad or m]."""
    ways = (
        arm.velocity_limit * duration / 1.875,
        arm.acceleration_limit * duration**2 * np.sqrt(3.0) / 10.0,
        arm.jerk_limit * duration**3 / 60.0,
    )
    return float(APPROACH_SHARE * np.min(ways))


def slowed_by(motion: JointMotion, speed: float) -> Joints:
    """Return a motion at a share of its speed, above 0 and at most 1; its clock goes on from the same zero."""
    return Joints(
        motion.time / speed,
        motion.position,
        motion.velocity * speed,
        motion.acceleration * speed**2,
        tuple(motion.joint_names),
    )


def turned(motion: JointMotion, turns: Array) -> Joints:
    """Return a motion with whole turns (n,) [rad] added."""
    plain = (motion.velocity, motion.acceleration, tuple(motion.joint_names))
    return Joints(motion.time, motion.position + turns, *plain)


def joined(before: JointMotion | None, motion: JointMotion) -> Joints:
    """Put one motion before another that starts where it ends; both rest there. The clock is that of the second."""
    if before is None:
        return Joints(motion.time, motion.position, motion.velocity, motion.acceleration, tuple(motion.joint_names))
    time = np.concatenate([before.time[:-1] - before.time[-1] + motion.time[0], motion.time])
    parts = [
        np.concatenate([getattr(before, name)[:-1], getattr(motion, name)])
        for name in ("position", "velocity", "acceleration")
    ]
    return Joints(time, *parts, tuple(motion.joint_names))
