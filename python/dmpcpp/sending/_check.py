"""The one decision on what a robot may get; every export and every driver asks it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Series
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import tool_speed_check
from dmpcpp.sending._between import JointMotion, interpolated
from dmpcpp.sending._effort import effort

__all__ = ["check", "ready", "require"]

_START = 1e-4  # rad (m) that a robot may stand off the first sample
_GAP = 1.5  # times both neighbours: a step that long holds a lost sample
_ORDERS = ("velocity", "acceleration", "jerk")


def check(joints: JointMotion, arm: Arm, *, rate: float = 1000.0, stands: ArrayLike | None = None) -> tuple[Check, ...]:
    """Decide whether a robot may get these joints, as its controller will see them.

    The joints are filled in by the quintic through their positions, velocities and accelerations to ``rate``, and
    velocity, acceleration and jerk are the differences of what then arrives, from the robot at rest to the robot at
    rest, as libfranka takes them.

    Parameters
    ----------
    joints : JointMotion
        (T, n), T >= 2, in the order of ``arm.joint_names``.
    arm : Arm
        Whose limits hold. What nobody states is not held against anything.
    rate : float
        At which the controller works [Hz].
    stands : array_like (n,), optional
        Joints in which the robot stands now.

    Returns
    -------
    tuple of Check
        robot_start (where ``stands`` is given), robot_end_velocity, robot_end_acceleration, robot_spacing,
        robot_joint_margin, robot_velocity, robot_acceleration, robot_jerk, robot_torque and robot_tool_speed. The last
        six are shares of limits, but for the margin [rad] and the speed [m/s]; jerk, torque and tool speed only where
        a limit is stated.

    Raises
    ------
    InvalidArgument
        Joints of another arm, too few samples, or numbers that are not finite.
    """
    _refuse(joints, arm)
    names = tuple(arm.joint_names)
    found = [] if stands is None else [_start(joints, np.asarray(stands, dtype=np.float64), names)]
    found += [*_ends(joints, names), _spacing(joints.time)]
    time, position = _as_seen(joints, rate)
    margin = np.minimum(position - arm.lower, arm.upper - position)
    found.append(Series(time, margin, names).at_least("robot_joint_margin", 0.0, "rad"))
    found += _differences(arm, time, position, rate)
    found += _torque(arm, joints, names)
    for one in tool_speed_check(arm, time, position):
        found.append(Check("robot_tool_speed", one.ok, one.value, one.limit, one.unit, one.time))
    return tuple(found)


def ready(checks: tuple[Check, ...]) -> Check:
    """Return one check for a verdict, robot_ready: the largest share of any limit, or what fails."""
    failed = [one for one in checks if not one.ok]
    shares = [one for one in checks if one.unit == "1" and one.name != "robot_spacing"]
    worst = max(failed or shares, key=lambda one: one.value if one.unit == "1" else math.inf)
    value = worst.value if worst.unit == "1" else math.nan
    detail = "; ".join(map(_said, failed)) if failed else f"{_quantity(worst)} {worst.detail}".strip()
    return Check("robot_ready", not failed, value, 1.0, "1", worst.time, detail)


def require(joints: JointMotion, arm: Arm, *, rate: float = 1000.0, stands: ArrayLike | None = None) -> None:
    """Refuse joints that a robot must not get.

    Raises
    ------
    InvalidArgument
        With joint, time and value of everything that fails.
    """
    failed = [one for one in check(joints, arm, rate=rate, stands=stands) if not one.ok]
    if failed:
        raise InvalidArgument(f"joints: no robot may get them: {'; '.join(map(_said, failed))}.")


def _said(one: Check) -> str:
    """Return the quantity, its value and limit, the joint and the time of a check."""
    amount = (
        f"{one.value:.4g} of its limit" if one.unit == "1" else f"{one.value:.4g} {one.unit} ({one.limit:g} allowed)"
    )
    joint = f" of joint '{one.detail}'" if one.detail else ""
    when = "" if one.time is None else f" at {one.time:.3f} s"
    return f"{_quantity(one)} {amount}{joint}{when}"


def _quantity(one: Check) -> str:
    return one.name.removeprefix("robot_").replace("_", " ")


def _refuse(joints: JointMotion, arm: Arm) -> None:
    if list(joints.joint_names) != list(arm.joint_names):
        raise InvalidArgument(
            f"joint_names: {list(joints.joint_names)}, expected those of arm {arm.name!r}: {list(arm.joint_names)}."
        )
    if len(joints.time) < 2:
        raise InvalidArgument(f"time: {len(joints.time)} sample(s), expected at least 2.")
    for name in ("time", "position", "velocity", "acceleration"):
        if not np.isfinite(getattr(joints, name)).all():
            raise InvalidArgument(f"{name}: numbers that are not finite.")


def _start(joints: JointMotion, stands: Array, names: tuple[str, ...]) -> Check:
    off = np.abs(joints.position[:1] - stands)
    return Series(joints.time[:1], off, names).at_most("robot_start", _START, "rad")


def _ends(joints: JointMotion, names: tuple[str, ...]) -> Iterator[Check]:
    """Exactly 0: a controller refuses a trajectory that ends at speed, however small."""
    for name, unit in (("velocity", "rad/s"), ("acceleration", "rad/s^2")):
        ends = Series(joints.time[[0, -1]], np.abs(getattr(joints, name)[[0, -1]]), names)
        value, time, joint = ends.worst(np.argmax)
        yield Check(f"robot_end_{name}", value == 0.0, value, 0.0, unit, time, joint)


def _spacing(time: Array) -> Check:
    """A step that is longer than both its neighbours: a sample is missing there."""
    step = np.diff(time)
    around = np.concatenate([step[:1] if len(step) == 1 else step[1:2], step, step[-2:-1] if len(step) > 1 else step])
    share = step / np.maximum(around[:-2], around[2:])
    return Series(time[1:], share).at_most("robot_spacing", _GAP, "1")


def _as_seen(joints: JointMotion, rate: float) -> tuple[Array, Array]:
    """Positions at the robot's rate, with the rest before and behind that jerk is felt against."""
    begin, end = float(joints.time[0]), float(joints.time[-1])
    steps = np.arange(-3, int(np.ceil((end - begin) * rate - 1e-6)) + 4)
    time = begin + steps / rate
    return time, interpolated(joints, np.clip(time, begin, end))[0]


def _differences(arm: Arm, time: Array, position: Array, rate: float) -> Iterator[Check]:
    values = position
    for order, limit in zip(_ORDERS, (arm.velocity_limit, arm.acceleration_limit, arm.jerk_limit), strict=True):
        time, values = time[1:], np.diff(values, axis=0) * rate
        if order != "jerk" or np.isfinite(limit).any():
            used = Series(time, np.abs(values) / limit, tuple(arm.joint_names))
            yield used.at_most(f"robot_{order}", 1.0, "1")


def _torque(arm: Arm, joints: JointMotion, names: tuple[str, ...]) -> Iterator[Check]:
    if np.isfinite(arm.effort_limit).any():
        torque = effort(arm, joints.position, joints.velocity, joints.acceleration)
        yield Series(joints.time, np.abs(torque) / arm.effort_limit, names).at_most("robot_torque", 1.0, "1")
