"""White noise of a recording, told from its samples alone."""

from __future__ import annotations

from math import comb

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp.recordings.recording import Array, Recording

__all__ = ["noise", "white_noise"]

_DIFFERENCES = 6  # of this order remove any motion slower than an eighth of the rate or so and keep white noise
_CHI_MEDIAN = 2.365973884375338  # median of chi-squared with three degrees of freedom


def noise(recording: Recording) -> tuple[float, float]:
    """Estimate the white noise of a recording from its samples' sixth differences.

    Returns the standard deviation along one axis [m] and about one axis [rad]. Motion much slower than the rate leaves
    no trace in them, and the median ignores jumps; a recording that was filtered shows less noise than it has errors.
    0 where fewer than seven samples stand in a row.
    """
    there = ~recording.missing
    quaternion = np.full((len(recording), 4), np.nan)
    quaternion[there] = _continuous(Rotation.from_matrix(recording.rotation[there]).as_quat())
    return white_noise(recording.position), 2.0 * white_noise(
        quaternion
    )  # a turn by a small angle moves q by half of it


def white_noise(samples: Array) -> float:
    """Return the noise per axis of a quantity (T, n) that has noise in three directions."""
    differences = np.diff(samples, n=_DIFFERENCES, axis=0)
    squared = np.square(differences).sum(axis=1) / comb(2 * _DIFFERENCES, _DIFFERENCES)
    squared = squared[~np.isnan(squared)]
    return float(np.sqrt(np.median(squared) / _CHI_MEDIAN)) if len(squared) else 0.0


def _continuous(quaternion: Array) -> Array:
    """Return quaternions (T, 4), each in the hemisphere of the one before."""
    turns = np.einsum("ij,ij->i", quaternion[1:], quaternion[:-1]) < 0.0
    return quaternion * np.concatenate(([1.0], np.where(np.cumsum(turns) % 2 == 1, -1.0, 1.0)))[:, None]
