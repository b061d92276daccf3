"""How far poses from cameras are likely off, from what the fit itself shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp.cameras._fit import Motion

__all__ = ["Accuracy", "accuracy_of", "accuracy_of_one"]

_TOGETHER = 1.5
"""Errors of neighbouring landmarks have a part in common, which no residual shows: found on rendered hands."""


@dataclass(frozen=True)
class Accuracy:
    """Root mean square errors of the poses: `position` [m] of all three axes, `angle` [rad] of the turn."""

    position: float
    angle: float


def accuracy_of(motion: Motion, scale: float = 0.0) -> Accuracy:
    """Return how far the poses are likely off, but for a constant offset of the body.

    The reprojection errors that the fit leaves, with the degrees of freedom it took, give the deviation of a
    landmark; the geometry of a single frame carries it over to the pose. Most of a net's error is slower than a hand
    moves and is not averaged away by a fit over time.

    Parameters
    ----------
    motion : Motion
    scale : float
        Relative uncertainty of the scale: it moves every position away from their mean by so much.
    """
    seen = np.isfinite(motion.error)
    measured = seen.any(axis=(0, 2, 3))
    freedom = max(1.0 - 6.0 * measured.sum() / seen.sum(), 0.1)
    deviation = _TOGETHER * np.sqrt(np.nanmean(motion.error**2) / freedom)
    turn, place = np.mean(motion.variance[measured].reshape(-1, 2, 3).sum(axis=2), axis=0)
    extent = np.sqrt(np.mean(np.sum((motion.position - motion.position.mean(axis=0)) ** 2, axis=1)))
    position = np.hypot(deviation * np.sqrt(place), scale * extent)
    return Accuracy(float(position), float(deviation * np.sqrt(turn)))


_ONE_VIEW = (1.5, 1.2)
"""What one camera's errors are to those that its residuals show, position and angle: found on drawn hands."""


def accuracy_of_one(motion: Motion) -> Accuracy:
    """Return the same of poses from one camera."""
    found = accuracy_of(motion)
    return Accuracy(_ONE_VIEW[0] * found.position, _ONE_VIEW[1] * found.angle)
