"""Last and first frames that a recording system wrote twice."""

from __future__ import annotations

import numpy as np

from dmpcpp.recordings import MIN_SAMPLES, Recording

__all__ = ["without_repeated_ends"]

_MOVING = 0.1  # of the median speed; a hand that is slower there may rest


def without_repeated_ends(recording: Recording) -> Recording:
    """Return the recording without its last (first) sample where that repeats its neighbour exactly although the body
    moves there: taken for a sample, it would stop the body within one step. A rest is many equal samples and is kept.
    """
    for end, name in ((0, "first"), (-1, "last")):
        if len(recording) > MIN_SAMPLES and _repeats_in_motion(recording, end):
            kept = slice(1, None) if end == 0 else slice(None, -1)
            recording = recording.part(kept, f"{name} sample left out: it repeats its neighbour while the body moves")
    return recording


def _repeats_in_motion(recording: Recording, end: int) -> bool:
    place = np.concatenate([recording.position, recording.rotation.reshape(len(recording), 9)], axis=1)
    steps = np.linalg.norm(np.diff(place, axis=0), axis=1) / np.diff(recording.time)
    outer, next_one = (steps[0], steps[1]) if end == 0 else (steps[-1], steps[-2])
    return bool(outer == 0.0 and next_one > _MOVING * np.median(steps))
