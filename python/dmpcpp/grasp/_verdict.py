"""What a grasp must have done: one check per promise, each with its number and its limit."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Series
from dmpcpp.grasp._execution import GraspLog
from dmpcpp.metrics import position_errors
from dmpcpp.robot import judged_by_limits, unjudged
from dmpcpp.simulation import GraspWorld

__all__ = ["GraspTolerances", "judge", "rise", "slip", "tilt"]


@dataclass(frozen=True)
class GraspTolerances:
    """Limits of the checks: m, rad, ratios to the arm's limits."""

    rise: float = 0.080
    slip: float = 0.010
    tilt: float = math.radians(15.0)
    tracking: float = 5e-3


def rise(log: GraspLog) -> float:
    """How much higher the bottle's middle is at the end than at the beginning [m]."""
    return float(log.object_pose[-1, 2, 3] - log.object_pose[0, 2, 3])


def slip(log: GraspLog) -> Array:
    """How far the bottle's middle has moved in the hand since the lift began (M,) [m]."""
    lifted = log.during("lift")
    in_hand = np.linalg.inv(log.tool_pose[lifted]) @ log.object_pose[lifted]
    return np.asarray(np.linalg.norm(in_hand[:, :3, 3] - in_hand[:1, :3, 3], axis=1))


def tilt(log: GraspLog) -> Array:
    """Angle between the bottle's axis and the vertical since the lift began (M,) [rad]."""
    axis = log.object_pose[log.during("lift"), :3, 2]
    return np.arctan2(np.hypot(axis[:, 0], axis[:, 1]), axis[:, 2])


def judge(log: GraspLog, arm: Arm, tolerances: GraspTolerances | None = None) -> tuple[Check, ...]:
    """Hold a grasp against its tolerances: the bottle's rise, slip and tilt, the motors and what was touched."""
    allowed = tolerances or GraspTolerances()
    missing = log.planned_steps - log.steps
    finite = Check("finite", missing == 0, missing, 0, "steps")
    if missing:
        return (finite,)  # nothing else can be told
    return finite, *_bottle(log, allowed), *_arm(log, arm, allowed), *_contacts(log)


def _bottle(log: GraspLog, allowed: GraspTolerances) -> Iterator[Check]:
    height = rise(log)
    yield Check("rise", height > allowed.rise, height, allowed.rise, "m")
    for name, series, limit, unit in (
        ("slip", slip(log), allowed.slip, "m"),
        ("tilt", tilt(log), allowed.tilt, "rad"),
    ):
        worst = int(np.argmax(series))
        value, time = float(series[worst]), float(log.time[log.during("lift")][worst])
        yield Check(name, value <= limit, value, limit, unit, time)


def _arm(log: GraspLog, arm: Arm, allowed: GraspTolerances) -> Iterator[Check]:
    errors = position_errors(log.desired_tool_pose, log.tool_pose)
    worst = int(np.argmax(errors))
    off = float(errors[worst])
    yield Check("tracking", off <= allowed.tracking, off, allowed.tracking, "m", float(log.time[worst]))
    used = Series(np.zeros(1), log.torque_ratio[None], tuple(arm.joint_names))
    held = judged_by_limits(used, unjudged(arm, "effort"), lambda s: s.at_most("torque_ratio", 1.0, "1"))
    yield replace(held, time=None)  # of the whole run the largest alone is kept
    yield Check("torque_clipped", log.clipped_steps == 0, log.clipped_steps, 0, "steps")


def _contacts(log: GraspLog) -> Iterator[Check]:
    """No contact but that of the fingers with the bottle, which the log leaves out."""
    kinds: tuple[tuple[str, Callable[[str], bool]], ...] = (
        ("hand_on_bottle", lambda other: other == GraspWorld.object_name),
        ("arm_contact", lambda other: other != GraspWorld.object_name),
    )
    for name, concerned in kinds:
        events = [event for event in log.contacts if concerned(event.contact.other)]
        first = min(events, key=lambda event: event.step, default=None)
        count = len({event.step for event in events})
        where = f"{first.contact.link} and {first.contact.other}" if first else ""
        yield Check(name, count == 0, count, 0, "steps", first.time if first else None, where)
