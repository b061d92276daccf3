"""A model, led to a goal in a time, as joints of an arm: no physics but the geometry and the limits.

>>> from dmpcpp import arms, planning
>>> found = planning.plan(model, arms.find("panda"), duration=4.0)        # doctest: +SKIP
>>> found.ok, found.joints.position.shape                                 # doctest: +SKIP
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp import export, simulation
from dmpcpp._atomic import write_text
from dmpcpp._core import Arm, InverseKinematics, JointTrajectory, PoseDmp, PoseTrajectory, duration_factor, stretched
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import arms
from dmpcpp.robot._reach import require_within_reach
from dmpcpp.simulation import Check, Checked, Simulator, Tolerances

__all__ = ["JointPlan", "plan", "write"]

_SAMPLES = 1000
_BRANCHES = 12  # other starts that are tried where the best one touches itself
_RESERVE = 1.02  # on the duration that the joint limits ask for: a controller's feedback needs some of them


@dataclass(frozen=True, eq=False)
class JointPlan(Checked):
    """What an arm would do.

    Attributes
    ----------
    arm : Arm
    motion : PoseTrajectory
        Of the arm's tip in its base frame.
    joints : JointTrajectory
    slowdown : float
        Its duration over the one that was wanted, 1 where the limits allow that.
    checks : tuple of Check
    """

    arm: Arm
    motion: PoseTrajectory
    joints: JointTrajectory
    slowdown: float
    checks: tuple[Check, ...]

    def summary(self) -> dict[str, Any]:
        """Return what summary.json holds; m, rad, s."""
        return {
            **self.judged(),
            "arm": self.arm.name,
            "base": self.arm.base,
            "tip": self.arm.tip,
            "duration": float(self.joints.time[-1]),
            "slowdown": self.slowdown,
            "samples": len(self.joints.time),
            "goal": self.motion.pose[-1].tolist(),
        }


def plan(
    model: PoseDmp,
    arm: Arm,
    *,
    goal: ArrayLike | None = None,
    duration: float | None = None,
    start: ArrayLike | None = None,
    slow_down: bool = True,
    simulator: Callable[..., Simulator] | None = None,
) -> JointPlan:
    """Lead a model to a goal and find the joints for it.

    Parameters
    ----------
    model : PoseDmp
        Of poses of the arm's tip in its base frame.
    arm : Arm
    goal : (4, 4), optional
        The demonstrated one unless given.
    duration : float, optional
        s; the demonstrated one unless given.
    start : (n,), optional
        Joints where the arm stands; by default the best are searched.
    slow_down : bool
        Take longer where velocity or acceleration limits ask for it; otherwise a check says so.
    simulator : callable, optional
        In whose geometry the path is looked at for contacts with the arm itself and the floor.

    Raises
    ------
    InvalidArgument
        A model that is not one of poses, or what `PoseDmp.rollout` and `InverseKinematics.follow` refuse.
    """
    if not isinstance(model, PoseDmp):
        raise InvalidArgument(
            f"model: a {type(model).__name__}, expected a PoseDmp: an arm's tip has position and rotation."
        )
    wanted = model.duration if duration is None else duration
    if not 0.0 < wanted < np.inf:
        raise InvalidArgument(f"duration: {wanted}, expected a positive number of seconds.")
    samples = max(_SAMPLES, 10 * model.options.basis_count)
    motion = model.rollout(goal, wanted, wanted / samples)
    end = np.asarray(model.goal if goal is None else goal, dtype=np.float64)
    require_within_reach(end[:3, 3], arm, "goal: the end of the motion")
    joints = _joints(arm, motion, start, simulator)
    factor = _RESERVE * duration_factor(joints, arm.velocity_limit, arms.acceleration_limit(arm))
    slowdown = max(1.0, factor) if slow_down and np.isfinite(factor) else 1.0
    if slowdown > 1.0:
        joints = stretched(joints, slowdown)
        motion = model.rollout(goal, slowdown * wanted, slowdown * wanted / samples)
    checks = tuple(_checks(arm, joints))
    if simulator is not None:
        checks = (*checks, *simulation.path_checks(arm, joints, simulator=simulator))
    return JointPlan(arm, motion, joints, slowdown, checks)


def _joints(
    arm: Arm, motion: PoseTrajectory, start: ArrayLike | None, simulator: Callable[..., Simulator] | None
) -> JointTrajectory:
    """Return the joints from `start`, or from the first start that keeps the arm clear of itself and the floor."""
    solver = InverseKinematics(arm)
    if start is not None:
        joints = np.asarray(start, dtype=np.float64)
        if joints.shape != (arm.joint_count,):
            raise InvalidArgument(
                f"start: shape {joints.shape}, expected ({arm.joint_count},): {', '.join(arm.joint_names)}."
            )
        return solver.follow(motion, start=joints)
    best = solver.follow(motion)
    if simulator is None or not best.report.complete or _clear(arm, best, simulator):
        return best
    for branch in islice(solver.branches(motion.pose[0]), _BRANCHES):
        other = solver.follow(motion, start=branch.joints)
        if other.report.complete and _clear(arm, other, simulator):
            return other
    return best


def _clear(arm: Arm, joints: JointTrajectory, simulator: Callable[..., Simulator]) -> bool:
    return all(check.ok for check in simulation.path_checks(arm, joints, simulator=simulator))


def write(found: JointPlan, folder: str | PathLike[str]) -> None:
    """Write plan.npz, joints.csv and summary.json, each whole or not at all; the summary comes last.

    joints.csv is what a robot may be sent, so it is written of a plan whose every check held; of any other, one that an
    earlier plan left is removed.

    Raises
    ------
    FileError
        The folder or a file can not be written.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for stale in ("summary.json", "joints.csv"):
        (folder / stale).unlink(missing_ok=True)
    export.write_plan(folder / "plan.npz", found.motion, base=found.arm.base, tip=found.arm.tip)
    if found.ok:
        export.write_joints(folder / "joints.csv", found.joints)
    write_text(folder / "summary.json", json.dumps(found.summary(), indent=2, allow_nan=False) + "\n")


def _checks(arm: Arm, joints: JointTrajectory) -> Iterator[Check]:
    limits, report, names = Tolerances(), joints.report, arm.joint_names
    for name, values, limit, unit in (
        ("ik_position_residual", report.position_error, limits.ik_position, "m"),
        ("ik_angle_residual", report.angle_error, limits.ik_angle, "rad"),
    ):
        worst = int(np.argmax(values))
        yield Check(name, bool(values[worst] <= limit), float(values[worst]), limit, unit, float(joints.time[worst]))
    margin = np.minimum(joints.position - arm.lower, arm.upper - joints.position)
    row, column = np.unravel_index(np.argmin(margin), margin.shape)
    lowest = float(margin[row, column])
    yield Check(
        "joint_margin",
        lowest >= limits.joint_margin - 1e-6,
        lowest,
        limits.joint_margin,
        "rad",
        float(joints.time[row]),
        names[column],
    )
    for name, ratio, most in (
        ("velocity_ratio", np.abs(joints.velocity) / arm.velocity_limit, limits.velocity_ratio),
        ("acceleration_ratio", np.abs(joints.acceleration) / arms.acceleration_limit(arm), limits.acceleration_ratio),
    ):
        row, column = np.unravel_index(np.argmax(ratio), ratio.shape)
        worst_ratio = float(ratio[row, column])
        held = worst_ratio <= most * (1.0 + 1e-6)
        yield Check(name, held, worst_ratio, most, "1", float(joints.time[row]), names[column])
