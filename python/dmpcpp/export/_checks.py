"""Validates joint trajectories before export."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.sending import JointMotion, phases_of, require

if TYPE_CHECKING:
    from dmpcpp import Arm

__all__ = ["JointMotion", "JointSamples", "check_limits", "checked", "finite", "strict_times"]

_ROUNDING = 1e-9  # of a limit; joints may lie on it


@dataclass(frozen=True, eq=False)
class JointSamples:
    """Joints over time, as they are read: time (T,) s; position, velocity, acceleration (T, n) in rad and s.

    `motion` are the samples of the motion itself, between a lead-in and a lead-out; None where the file does not say.
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    joint_names: tuple[str, ...]
    motion: slice | None = None

    @property
    def phase(self) -> tuple[str, ...]:
        """ "lead-in", "motion" or "lead-out" for every sample."""
        return phases_of(self.motion or slice(0, len(self.time)), len(self.time))

    def of_motion(self) -> JointSamples:
        """Return the samples of the motion, without lead-in and lead-out."""
        during = self.motion or slice(0, len(self.time))
        parts = (self.time, self.position, self.velocity, self.acceleration)
        return JointSamples(*(part[during] for part in parts), self.joint_names)


def checked(trajectory: JointMotion, arm: Arm | None = None) -> JointSamples:
    """Return the trajectory as finite arrays of fitting sizes, with distinct joint names and increasing times.

    Parameters
    ----------
    trajectory : JointTrajectory
    arm : Arm, optional
        Which gets it: it must hold the limits, see `check_limits`, and be what `sending.require` lets a robot have.
    """
    names = tuple(trajectory.joint_names)
    time = strict_times(trajectory.time)
    if len(set(names)) != len(names) or not all(names):
        raise InvalidArgument(f"joint_names: {list(names)}, expected a different name for each joint.")
    shape = (len(time), len(names))
    parts = [finite(what, getattr(trajectory, what), shape, names) for what in ("position", "velocity", "acceleration")]
    samples = JointSamples(time, *parts, names, getattr(trajectory, "motion", None))
    if arm is not None:
        check_limits(samples, arm)
        require(samples, arm)
    return samples


def check_limits(trajectory: JointMotion, arm: Arm) -> None:
    """Check position and velocity limits (not acceleration or effort).

    Raises
    ------
    InvalidArgument
        Naming the first sample outside, its joint, the value and the limit; or joints that are not the arm's.
    """
    if tuple(trajectory.joint_names) != tuple(arm.joint_names):
        raise InvalidArgument(
            f"joint_names: {list(trajectory.joint_names)}, expected those of arm {arm.name!r}: {list(arm.joint_names)}."
        )
    names = trajectory.joint_names
    _within("position", trajectory.position, arm.lower, arm.upper, names, "rad")
    _within("velocity", trajectory.velocity, -arm.velocity_limit, arm.velocity_limit, names, "rad/s")


def _within(what: str, values: Array, lower: Array, upper: Array, names: Sequence[str], unit: str) -> None:
    slack = _ROUNDING * (1.0 + np.abs(values))
    outside = (values < lower - slack) | (values > upper + slack)
    if outside.any():
        k, j = np.argwhere(outside)[0]
        raise InvalidArgument(
            f"{what}[{k}, {j}]: {values[k, j]:.6g} {unit} of joint {names[j]!r}, expected {lower[j]:.6g} to "
            f"{upper[j]:.6g}. Slow the motion down, or place it elsewhere."
        )


def strict_times(time: ArrayLike) -> Array:
    """Return times as float64, at least one and strictly increasing."""
    time = _array("time", time)
    time = finite("time", time, (time.size,))
    if time.size == 0 or (np.diff(time) <= 0.0).any():
        k = int(np.argmax(np.diff(time) <= 0.0)) + 1 if time.size else 0
        raise InvalidArgument(f"time[{k}]: expected at least one time, and strictly increasing ones.")
    return time


def finite(name: str, values: ArrayLike, shape: tuple[int, ...], joints: Sequence[str] = ()) -> Array:
    """Return the values as float64 of that shape; the message of an error names the joint of a column."""
    array = _array(name, values)
    if array.shape != shape:
        raise InvalidArgument(f"{name}: shape {array.shape}, expected {shape}.")
    if not np.isfinite(array).all():
        index = np.argwhere(~np.isfinite(array))[0].tolist()
        of = f" of joint {joints[index[-1]]!r}" if joints else ""
        raise InvalidArgument(f"{name}{index}: {array[tuple(index)]}{of}, expected a finite number.")
    return array


def _array(name: str, values: ArrayLike) -> Array:
    try:
        return np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InvalidArgument(f"{name}: not an array of numbers.") from None
