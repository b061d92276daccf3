"""The mean of demonstrations, and how far they lie from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import complete, same_times
from dmpcpp.recordings._recording import Array, Recording

__all__ = ["Spread", "mean", "spread"]


@dataclass(frozen=True)
class Spread:
    """Root mean square, over time and demonstrations, of the distance from the mean: `position` [m], `angle` [rad].

    `dmpcpp.spread` has the covariance at every phase.
    """

    position: float
    angle: float

    def describe(self) -> str:
        """Return it in mm and deg, for reports."""
        return f"{1e3 * self.position:.3g} mm and {np.degrees(self.angle):.3g} deg rms from their mean"


def mean(recordings: Sequence[Recording]) -> Recording:
    """Return the mean of recordings with the same times: of positions, and of orientations on SO(3).

    The mean orientation has the least sum of squared angles to all of them (Karcher mean; Moakher, "Means and
    averaging in the group of rotations", 2002), found from the chordal mean (Markley et al., "Averaging
    quaternions", 2007).

    Raises
    ------
    InvalidArgument
        No recordings, different times (align or resample them first), missing samples.
    """
    positions, rotations = _stacked(recordings)
    middle = _karcher(rotations)
    note = f"mean of {len(recordings)} recordings: {_spread(positions, rotations, middle).describe()}"
    return recordings[0].with_(note, position=positions.mean(axis=0), rotation=middle)


def spread(recordings: Sequence[Recording]) -> Spread:
    """Return how far recordings with the same times lie from their mean; errors as `mean`."""
    positions, rotations = _stacked(recordings)
    return _spread(positions, rotations, _karcher(rotations))


def _stacked(recordings: Sequence[Recording]) -> tuple[Array, Array]:
    """Return positions (M, T, 3) and rotations (M, T, 3, 3)."""
    if not recordings:
        raise InvalidArgument("recordings: none, expected at least one.")
    same_times(recordings)
    return (
        np.stack([complete(recording).position for recording in recordings]),
        np.stack([recording.rotation for recording in recordings]),
    )


def _spread(positions: Array, rotations: Array, middle: Array) -> Spread:
    away = positions - positions.mean(axis=0)
    turned = _logs(middle, rotations)
    return Spread(*(float(np.sqrt(np.mean(np.sum(x**2, axis=-1)))) for x in (away, turned)))


def _karcher(rotations: Array) -> Array:
    """Return the mean rotations (T, 3, 3) of (M, T, 3, 3)."""
    quaternion = Rotation.from_matrix(rotations.reshape(-1, 3, 3)).as_quat().reshape(*rotations.shape[:2], 4)
    _, vectors = np.linalg.eigh(np.einsum("mti,mtj->tij", quaternion, quaternion))
    middle = Rotation.from_quat(vectors[..., -1])
    for _ in range(20):
        step = _logs(middle.as_matrix(), rotations).mean(axis=0)
        middle = middle * Rotation.from_rotvec(step)
        if np.abs(step).max() < 1e-12:
            break
    return middle.as_matrix()


def _logs(middle: Array, rotations: Array) -> Array:
    """Return the rotation vectors (M, T, 3) from the mean to each, in its frame."""
    relative = np.swapaxes(middle, -1, -2) @ rotations
    return Rotation.from_matrix(relative.reshape(-1, 3, 3)).as_rotvec().reshape(*rotations.shape[:2], 3)
