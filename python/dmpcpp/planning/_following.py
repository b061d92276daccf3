"""How a placed motion is followed by an arm from end to end; what the searches share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from dmpcpp import motion
from dmpcpp._core import JointTrajectory
from dmpcpp.recordings._recording import Recording

__all__ = ["EFFORT", "Accept", "to_follow"]

Accept = Callable[[JointTrajectory], bool]
"""A last word on joints that carry the whole motion, for what kinematics does not see."""

EFFORT: dict[str, Any] = {"starts": 8, "anchors": 3, "thorough": False}
"""Of the search for joints along one candidate's path."""

_STEP_DISTANCE = 0.03  # m, recorded, between the poses that are followed
_STEP_ANGLE = 0.1  # rad, likewise
_LONG = 5000  # samples; a search follows a path hundreds of times
_RATE = 50.0  # Hz; a hand does nothing in between that an arm could follow


def to_follow(recording: Recording) -> Recording:
    """Return the motion with more samples where a fast hand moves further between two of them than joints can be
    followed with certainty; and with fewer, but 50 a second, where a long one was sampled faster than that.
    """
    every = max(1, int(recording.rate / _RATE)) if len(recording) > _LONG else 1
    if every > 1:
        kept = np.append(np.arange(0, len(recording) - 1, every), len(recording) - 1)
        recording = recording.with_(
            f"every {every}th sample taken",
            time=recording.time[kept],
            position=recording.position[kept],
            rotation=recording.rotation[kept],
        )
    return motion.refine(recording, _STEP_DISTANCE, _STEP_ANGLE)
