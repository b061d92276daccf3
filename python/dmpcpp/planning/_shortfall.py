"""Why an arm does not carry a motion where it was placed: reach, joints at their limits, or too few joints."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.robot import Follow, farthest_reach

__all__ = ["Shortfall"]

_AT_LIMIT = 1e-4  # rad or m


@dataclass(frozen=True)
class Shortfall:
    """What the best placement lacks.

    Attributes
    ----------
    share : float
        Of the poses that are met, 0 to 1.
    first : str
        Which pose is missed first, and by how much.
    cause : str
    """

    share: float
    first: str
    cause: str

    @staticmethod
    def of(joints: JointTrajectory, poses: Array, arm: Arm, frame: Callable[[int], str]) -> Shortfall:
        """Look at joints that follow poses (T, 4, 4) as far as they can; `frame` names a sample."""
        report = joints.report
        if report.complete:
            return Shortfall(1.0, "", "")
        k = report.missed[0][0]
        first = (
            f"first misses the pose at {frame(k)}, by {1e3 * report.position_error[k]:.3g} mm and "
            f"{np.degrees(report.angle_error[k]):.3g} deg"
        )
        missed = np.concatenate([np.arange(one, last + 1) for one, last in report.missed])
        return Shortfall(report.solved / len(poses), first, _cause(joints.position[missed], poses[missed], arm))

    def describe(self, follow: Follow) -> str:
        """Return the shortfall, its cause and what to do, for an error."""
        met = math.floor(1000.0 * self.share) / 10.0  # never 100 % for less
        way = "Allow a smaller scale, crop the motion, or try another seed"
        if follow.kind != "position":
            way += "; or follow less of it: follow=position" + (" or follow=axis:z" if follow.kind == "pose" else "")
        return f"the best one carries {met:g} % of it and {self.first}: {self.cause}. {way}."


def _cause(joints: Array, poses: Array, arm: Arm) -> str:
    """Return what stops an arm at missed poses (T, 4, 4), which its joints (T, n) come closest to."""
    centre, reach = farthest_reach(arm)
    beyond = np.linalg.norm(poses[:, :3, 3] - centre, axis=1) > reach
    if beyond.mean() > 0.5:
        return f"{beyond.sum()} of the {len(poses)} missed poses lie beyond the arm's reach of {reach:.3g} m"
    at_limit = (joints - arm.lower < _AT_LIMIT) | (arm.upper - joints < _AT_LIMIT)
    counts = at_limit.sum(axis=0)
    worst = int(np.argmax(counts))
    if counts[worst]:
        share = math.floor(100.0 * counts[worst] / len(joints))
        return f"joint '{arm.joint_names[worst]}' is at its limit in {share} % of the missed frames"
    return "no joint stands at a limit there: the arm cannot take the tool's orientation at these places, or reach them"
