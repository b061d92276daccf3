"""How a placed motion is followed by an arm from end to end; what the searches share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from dmpcpp import motion
from dmpcpp._core import JointTrajectory
from dmpcpp.recordings.recording import Recording

__all__ = ["EFFORT", "Accept", "to_follow"]

Accept = Callable[[JointTrajectory], bool]
"""A last word on joints that carry the whole motion, for what kinematics does not see."""

EFFORT: dict[str, Any] = {"starts": 8, "anchors": 3, "thorough": False}
"""Of the search for joints along one candidate's path."""

_STEP_DISTANCE = 0.03  # m, recorded, between the poses that are followed
_STEP_ANGLE = 0.1  # rad, likewise


def to_follow(recording: Recording) -> Recording:
    """Return the motion with more samples where a fast hand moves further between two of them than joints can be
    followed with certainty.
    """
    return motion.refine(recording, _STEP_DISTANCE, _STEP_ANGLE)
