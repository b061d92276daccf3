"""The same joint trajectory in two engines: what one says alone may be its own invention."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from dmpcpp.checks import Check
from dmpcpp.errors import InvalidArgument
from dmpcpp.metrics import angle_errors, position_errors
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
        limit, of the joint where it is largest; ``engines_verdicts``: how many checks hold in only one of them.

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
    share = np.sqrt(np.mean(((log.torque - other.torque) / log.arm.effort_limit) ** 2, axis=0))
    joint, value = log.arm.joint_names[int(np.argmax(share))], float(share.max())
    limit = tolerances.torque_rms
    checks.append(Check("engines_torque_rms", value <= limit, value, limit, "1", None, joint))
    differing = {check.name for check in log.verdict.failed} ^ {check.name for check in other.verdict.failed}
    count = len(differing)
    return (*checks, Check("engines_verdicts", count == 0, count, 0, "checks", None, ", ".join(sorted(differing))))
