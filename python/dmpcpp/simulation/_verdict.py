"""What held in an execution and what did not: one check per promise, each with its number and its limit."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dmpcpp._core import JointTrajectory
from dmpcpp.checks import Check, Checked, Series
from dmpcpp.metrics import position_errors
from dmpcpp.robot import (
    POSE,
    Follow,
    InertiaRepair,
    LimitUse,
    dimension_checks,
    jerk_check,
    judged_by_limits,
    links_of,
    tool_speed_check,
)
from dmpcpp.simulation._simulator import kind_of

if TYPE_CHECKING:
    from dmpcpp.simulation._execution_log import ExecutionLog


_JOINT = 3  # steps on either side of a motion whose differences reach into lead-in and lead-out


@dataclass(frozen=True)
class Tolerances:
    """Limits of the checks.

    position_*, settle_error, ik_position, kinematics_mismatch: m. angle_*, ik_angle: rad. joint_margin: least distance
    to a position limit, rad or m. *_ratio: peak/limit. *_collision, *_contact: steps. repaired_inertias: links.
    inertia_change, dynamics_mismatch: relative.

    ``inertia_change`` is how far an inertia that no body can have may be from the nearest possible one (the largest
    change of a principal moment over the largest moment); so many links as ``repaired_inertias`` may be beyond it.
    """

    position_rmse: float = 0.5e-3
    position_max: float = 2e-3
    angle_rmse: float = 2e-3
    angle_max: float = 10e-3
    settle_error: float = 0.1e-3
    ik_position: float = 1e-5
    ik_angle: float = 1e-5
    joint_margin: float = 0.0
    velocity_ratio: float = 1.0
    acceleration_ratio: float = 1.0
    jerk_ratio: float = 1.0
    torque_ratio: float = 1.0
    self_collision: int = 0
    floor_contact: int = 0
    object_contact: int = 0
    inertia_change: float = 0.05
    repaired_inertias: int = 0
    kinematics_mismatch: float = 1e-6
    dynamics_mismatch: float = 1e-6


@dataclass(frozen=True)
class Verdict(Checked):
    """All checks of an execution.

    Attributes
    ----------
    checks : tuple of Check
    caveat : str
        What the mode of the execution cannot see.
    """

    checks: tuple[Check, ...]
    caveat: str = ""


def judge(log: ExecutionLog, tolerances: Tolerances | None = None) -> Verdict:
    """Check an execution against tolerances.

    Tracking is judged over the motion itself; limits, contacts and torque over all steps, lead-in, lead-out
    and settling included. Limits forgive ROUNDING.
    """
    tolerances = tolerances or Tolerances()
    checks = [_finite(log)]
    for group in (_tracking, _limits, _contacts):
        checks += group(log, tolerances)
    checks += [*inverse_kinematics_checks(log.joints, tolerances, log.follow), *_model(log, tolerances)]
    return Verdict(tuple(checks), log.caveat)


def _finite(log: ExecutionLog) -> Check:
    missing = log.planned_steps - len(log.time)
    when = float(log.time[-1]) if missing and len(log.time) else None
    return Check(
        "finite",
        missing == 0,
        missing,
        0,
        "steps",
        when,
        "the state left the finite numbers" if missing else "",
    )


def _tracking(log: ExecutionLog, tolerances: Tolerances) -> Iterator[Check]:
    time = log.time[log.motion]
    desired, measured = log.desired_tool_pose[log.motion], log.tool_pose[log.motion]
    for name, errors, unit in (
        ("position", position_errors(desired, measured), "m"),
        ("angle", log.follow.angle_errors(desired, measured), "rad"),
    ):
        if errors is None:
            continue
        rmse = float(np.sqrt(np.mean(errors**2))) if errors.size else math.nan
        limit = getattr(tolerances, f"{name}_rmse")
        yield Check(f"tracking_{name}_rmse", rmse <= limit, rmse, limit, unit)
        yield Series(time, errors).at_most(f"tracking_{name}_max", getattr(tolerances, f"{name}_max"), unit)
    last = Series(log.time[-1:], position_errors(log.desired_tool_pose[-1:], log.tool_pose[-1:]))
    yield last.at_most("settle_error", tolerances.settle_error, "m")


def _limits(log: ExecutionLog, tolerances: Tolerances) -> Iterator[Check]:
    arm = log.arm
    acceleration = np.diff(log.velocity, axis=0) * log.rate  # of the measured velocity, over a step
    use = LimitUse.of(arm, log.time, log.position, log.velocity, acceleration)
    yield from use.checks(tolerances.joint_margin, tolerances.velocity_ratio, tolerances.acceleration_ratio)
    during = slice(log.motion.start + _JOINT, max(log.motion.stop - 1 - _JOINT, 0))  # without lead-in and lead-out
    yield from jerk_check(arm, log.time[1:][during], acceleration[during], tolerances.jerk_ratio)
    yield from tool_speed_check(arm, log.time, log.position)
    torque = Series(log.time, np.abs(log.torque_demand) / arm.effort_limit, use.names)
    limit = tolerances.torque_ratio
    yield judged_by_limits(torque, use.doubts_of("effort"), lambda s: s.at_most("torque_ratio", limit, "1"))
    clipped = (np.abs(log.torque) >= arm.effort_limit).any(axis=1)
    when = float(log.time[np.argmax(clipped)]) if clipped.any() else None
    yield Check("torque_clipped", not clipped.any(), int(clipped.sum()), 0, "steps", when)


def _contacts(log: ExecutionLog, tolerances: Tolerances) -> Iterator[Check]:
    links = links_of(log.arm)
    for name, kind in (("self_collision", "self"), ("floor_contact", "floor"), ("object_contact", "object")):
        events = [event for event in log.contacts if kind_of(event.contact.other, links) == kind]
        count, limit = len({event.step for event in events}), getattr(tolerances, name)
        deepest = max(events, key=lambda event: event.contact.depth, default=None)
        detail = ""
        if deepest:
            contact = deepest.contact
            detail = f"{contact.link} and {contact.other}, {contact.depth * 1e3:.1f} mm deep"
        yield Check(name, count <= limit, count, limit, "steps", deepest.time if deepest else None, detail)


def inverse_kinematics_checks(
    joints: JointTrajectory, tolerances: Tolerances, follow: Follow = POSE
) -> Iterator[Check]:
    """Yield ik_position_residual and, where an orientation is followed, ik_angle_residual.

    Nothing where the joints were not solved for.
    """
    report = getattr(joints, "report", None)
    if report is None or len(report.position_error) == 0:
        return
    for name, errors, unit in (
        ("position", report.position_error, "m"),
        ("angle", report.angle_error, "rad"),
    ):
        if name == "angle" and follow.kind == "position":
            continue
        series = Series(joints.time - joints.time[0], np.asarray(errors))
        yield series.at_most(f"ik_{name}_residual", getattr(tolerances, f"ik_{name}"), unit)


def _inertia(log: ExecutionLog, tolerances: Tolerances) -> Check:
    """A repair within the tolerance is a note; beyond it nobody knows the inertia."""
    repairs, limit = log.inertia_repairs, tolerances.inertia_change
    beyond = [repair for repair in repairs if repair.change > limit]
    if len(beyond) > tolerances.repaired_inertias:
        links = ", ".join(map(str, beyond))
        why = f"no body can have the inertia of {links}, which the nearest possible replaces. Correct it in the URDF."
        if any(repair.missing for repair in beyond):
            why = (
                f"no mass or inertia is stated of {links}. State them in the URDF, or the density of its bodies with "
                "arms.with_stated(arm, density=...) [kg/m^3]."
            )
        return Check.not_judged("inertia", "1", why)
    most = max((repair.change for repair in repairs if math.isfinite(repair.change)), default=0.0)
    return Check("inertia", True, most, limit, "1", None, "; ".join(inertia_notes(repairs)))


def inertia_notes(repairs: Iterable[InertiaRepair]) -> Iterator[str]:
    """Yield one line for the inertias that were replaced, and one for those that are missing."""
    repairs = tuple(repairs)
    for what, missing in (("replaced by the nearest that a body can have", False), ("left out", True)):
        named = ", ".join(str(repair) for repair in repairs if repair.missing == missing)
        if named:
            yield f"inertia {what}: {named}"


def _model(log: ExecutionLog, tolerances: Tolerances) -> Iterator[Check]:
    """The arm that was simulated is the arm that was planned for."""
    yield _inertia(log, tolerances)
    mismatch = position_errors(log.arm.forward_kinematics(log.position), log.tool_pose)
    yield Series(log.time, mismatch).at_most("kinematics_mismatch", tolerances.kinematics_mismatch, "m")
    off, limit = log.dynamics, tolerances.dynamics_mismatch
    detail = "" if off.value <= limit else off.detail
    yield Check("dynamics_mismatch", off.value <= limit, off.value, limit, "1", None, detail)
    yield from dimension_checks(log.arm)
