"""A way from placements that an arm nearly carries to one that it does: small changes that bring missed poses closer.

Arms with narrow wrists carry a motion from few places, which random ones miss.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.planning._candidates import neighbour
from dmpcpp.planning._placement import Placement

__all__ = ["approached", "missed_by"]

_FAR = 0.1  # m that a miss of 1 rad counts as; a pose that is missed by more counts as 1
_TOO_LOW = 10.0  # per m
_LONGER, _SHORTER = 1.5, 0.9  # of the next change, after one that helped and after one that did not: one in five helps
_STEPS = (0.02, 2.0)
_PATIENCE = 400  # changes in a row that help nothing, after which no further one is tried


def missed_by(solved: Any, poses: Array, floor: float) -> float:
    """Return how much poses (T, 4, 4) are missed by a batch or report of inverse kinematics; 0 where all are met.

    A pose that is met, and not below the floor, counts nothing.
    """
    met = solved.solved == len(poses)
    errors = np.asarray(solved.position_error) / _FAR + np.asarray(solved.angle_error)
    low = np.maximum(floor - poses[:, 2, 3], 0.0).sum()
    return float((0.0 if met else np.minimum(errors, 1.0).sum()) + _TOO_LOW * low)


def approached(
    placement: Placement,
    miss: Callable[[Placement], float],
    random: np.random.Generator,
    scale: tuple[float, float],
    changes: int,
    tilt: float = np.pi,
) -> tuple[Placement, float]:
    """Return the placement after small random changes of which each missed less than the last, and what it misses.

    `tilt` is how far the tool may be turned in the hand [rad].
    """
    least, step, idle = miss(placement), 1.0, 0
    for _ in range(changes):
        if least <= 0.0 or idle == _PATIENCE:
            break
        other = neighbour(placement, random, step, scale, tilt)
        missed = miss(other)
        step = float(np.clip(step * (_LONGER if missed < least else _SHORTER), *_STEPS))
        idle = 0 if missed < least else idle + 1
        if missed < least:
            placement, least = other, missed
    return placement, least
