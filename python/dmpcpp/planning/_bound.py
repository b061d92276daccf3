"""What an arm can do at all with a hand's motion: a bound on how fast it is carried out."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from dmpcpp._core import Arm, PoseTrajectory, fastest_tip
from dmpcpp.robot import Follow

__all__ = ["Bound", "arm_bound"]

_ENDS = 0.01  # of the motion at each end, left out: what a model does there is not the person's


@dataclass(frozen=True)
class Bound:
    """Factors on the duration below which no method comes that follows the motion exactly.

    Attributes
    ----------
    uniform : float
        Slowed down evenly; below 1 the arm could be that much faster.
    local : float
        Slowed down only where that is needed, >= 1.
    """

    uniform: float
    local: float

    def to_dict(self) -> dict[str, float]:
        """For JSON."""
        return {"uniform": self.uniform, "local": self.local}


def arm_bound(arm: Arm, motion: PoseTrajectory, follow: Follow) -> Bound:
    """Hold a motion at the wanted tempo against what the arm's tip can move and turn in any posture (`fastest_tip`).

    The first and last 1 % of the motion are left out; turning counts where the whole pose is followed.
    """
    linear, angular = _tip_speed(arm)
    inner = (motion.time >= motion.time[-1] * _ENDS) & (motion.time <= motion.time[-1] * (1.0 - _ENDS))
    twist = motion.twist[inner]
    need = np.linalg.norm(twist[:, :3], axis=1) / linear
    if follow.kind == "pose":
        need = np.maximum(need, np.linalg.norm(twist[:, 3:], axis=1) / angular)
    return Bound(float(need.max()), float(np.maximum(need, 1.0).mean())) if len(need) else Bound(0.0, 1.0)


@lru_cache(maxsize=16)
def _tip_speed(arm: Arm) -> tuple[float, float]:
    return fastest_tip(arm)
