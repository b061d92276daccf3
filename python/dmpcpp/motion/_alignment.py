"""Demonstrations of one motion brought to one tempo, so that equal times are equal places in the motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation

from dmpcpp import _core
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import complete, poses, same_times
from dmpcpp.motion._timing import evaluated
from dmpcpp.recordings import Recording

__all__ = ["Spread", "aligned", "mean", "medoid", "spread"]

_KNOTS = 41  # of a change of tempo; more follow the noise of the warp


def medoid(recordings: Sequence[Recording], *, angle_weight: float = 0.2) -> int:
    """Return the index of the recording with the least sum of warped distances (`dmpcpp.align`) to all the others."""
    stacks = _stacks(recordings)
    total = np.zeros(len(stacks))
    for i, a in enumerate(stacks):
        for j in range(i):
            distance = _core.align(a, stacks[j], angle_weight=angle_weight).distance
            total[[i, j]] += distance
    return int(np.argmin(total))


def aligned(
    recordings: Sequence[Recording],
    reference: Recording | None = None,
    *,
    rounds: int = 3,
    angle_weight: float = 0.2,
    band: float | None = None,
) -> list[Recording]:
    """Bring recordings of one motion to one tempo by dynamic time warping.

    Each is warped onto the reference; without one the medoid is taken first and then, for the remaining rounds, the
    mean of what came out (Petitjean, Ketterlin and Gancarski, "A global averaging method for dynamic time warping",
    2011). A warp is made smooth: a monotone cubic through its mean at 41 even knots, both ends kept, so that what
    is aligned moves as smoothly as what was recorded.

    Parameters
    ----------
    recordings : sequence of Recording
    reference : Recording, optional
        What to align to; its samples set those of the result.
    rounds : int
        1 or more; with a reference one round is all there is.
    angle_weight : float
        Weight of rotation relative to translation [m/rad].
    band : float, optional
        Largest offset [samples] of a pair from the diagonal, widened where no path fits; None: unlimited.

    Returns
    -------
    list of Recording
        All with the same times: the reference's samples, over the mean of all durations.

    Raises
    ------
    InvalidArgument
        No recordings, or missing samples.
    """
    if rounds < 1:
        raise InvalidArgument(f"rounds: {rounds}, expected 1 or more.")
    onto = recordings[medoid(recordings, angle_weight=angle_weight)] if reference is None else reference
    duration = float(np.mean([recording.duration for recording in recordings]))
    for left in range(rounds - 1, -1, -1):
        warped = [_warped(recording, onto, duration, angle_weight, band) for recording in recordings]
        if reference is not None or left == 0:
            break
        onto = mean(warped)
    apart = spread(warped)
    name = "the reference" if reference is not None else f"their mean in {rounds} rounds"
    note = f"aligned to {name}, {len(warped)} recordings: {apart.describe()}"
    return [recording.with_(note) for recording in warped]


def _stacks(recordings: Sequence[Recording]) -> list[Array]:
    if not recordings:
        raise InvalidArgument("recordings: none, expected at least one.")
    return [poses(recording) for recording in recordings]


def _warped(
    recording: Recording, onto: Recording, duration: float, angle_weight: float, band: float | None
) -> Recording:
    path = _core.align(poses(onto), poses(recording), angle_weight=angle_weight, band=band).path
    at = _smooth_warp(path, onto.time / onto.duration, recording.time)
    warped = evaluated(recording, at, "", onto.time / onto.duration * duration)
    slowest, fastest = _tempo(at, warped.time)
    return recording.with_(
        f"warped in time: {slowest:.2f} to {fastest:.2f} x its tempo",
        time=warped.time,
        position=warped.position,
        rotation=warped.rotation,
        channels=warped.channels,
    )


def _smooth_warp(path: NDArray[np.int64], share: Array, time: Array) -> Array:
    """Return when [s] in the recording each sample of the reference, at `share` (0 to 1), happens."""
    matched = np.bincount(path[:, 0], time[path[:, 1]]) / np.bincount(path[:, 0])
    knots = np.linspace(0.0, 1.0, min(_KNOTS, len(share)))
    reach = 0.5 / (len(knots) - 1)
    at = np.array([matched[np.abs(share - knot) <= reach].mean() for knot in knots[1:-1]])
    warp = PchipInterpolator(knots, [time[0], *at, time[-1]])
    return np.asarray(np.clip(warp(share), time[0], time[-1]))


def _tempo(at: Array, time: Array) -> tuple[float, float]:
    rate = np.diff(at) / np.diff(time)
    return float(rate.min()), float(rate.max())


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
