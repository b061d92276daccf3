"""The same joint trajectory in two engines: what one says alone may be its own invention."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.checks import Check
from dmpcpp.errors import InvalidArgument
from dmpcpp.metrics import angle_errors, position_errors
from dmpcpp.robot import limit_doubts
from dmpcpp.simulation._execution_log import ExecutionLog


@dataclass(frozen=True)
class AgreementTolerances:
    """How far two engines may be apart: the tool at any time [m, rad], the torque RMS over the effort limit."""

    position_max: float = 1e-4
    angle_max: float = math.radians(0.02)
    torque_rms: float = 0.01


def agreement(
    log: ExecutionLog, other: ExecutionLog, tolerances: AgreementTolerances | None = None
) -> tuple[Check, ...]:
    """Compare two executions of one trajectory, step by step, lead-in and settling included.

    Returns
    -------
    tuple of Check
        ``engines_position_max``, ``engines_angle_max``: the largest distance and angle of the two tool poses at
        equal times; ``engines_torque_rms``: root mean square of the difference of the torques over the effort
        limit, or without one over the largest torque of the run, of the joint where it is largest;
        ``engines_verdicts``: how many checks hold in only one of them.

    Raises
    ------
    InvalidArgument
        The two are not of the same arm, times and number of steps.
    """
    if not np.array_equal(log.time, other.time) or log.arm.joint_names != other.arm.joint_names:
        raise InvalidArgument(
            f"other: {len(other.time)} steps of '{other.arm.name}' in {other.simulator}, expected those of log: "
            f"{len(log.time)} steps of '{log.arm.name}'. Execute one trajectory with the same options in both."
        )
    tolerances = tolerances or AgreementTolerances()
    who = f"{log.simulator} and {other.simulator}"
    checks = []
    for name, errors, unit in (
        ("position_max", position_errors(log.tool_pose, other.tool_pose), "m"),
        ("angle_max", angle_errors(log.tool_pose, other.tool_pose), "rad"),
    ):
        worst, limit = int(np.argmax(errors)), getattr(tolerances, name)
        value = float(errors[worst])
        checks.append(Check(f"engines_{name}", value <= limit, value, limit, unit, float(log.time[worst]), who))
    share = np.sqrt(np.mean(((log.torque - other.torque) / _scale(log, other)) ** 2, axis=0))
    joint, value = log.arm.joint_names[int(np.argmax(share))], float(share.max())
    limit = tolerances.torque_rms
    checks.append(Check("engines_torque_rms", value <= limit, value, limit, "1", None, joint))
    differing = {check.name for check in log.verdict.failed} ^ {check.name for check in other.verdict.failed}
    count = len(differing)
    return (*checks, Check("engines_verdicts", count == 0, count, 0, "checks", None, ", ".join(sorted(differing))))


def _scale(log: ExecutionLog, other: ExecutionLog) -> Array:
    """What a difference of torques is measured by (n,) [Nm]: the effort limit where there is one."""
    limit = log.arm.effort_limit
    doubtful = {doubt.joint for doubt in limit_doubts(log.arm) if doubt.kind == "effort"}
    known = np.array([name not in doubtful for name in log.arm.joint_names])
    largest = max(float(np.abs(run.torque).max(initial=0.0)) for run in (log, other))
    return np.where(known, limit, largest or 1.0)
