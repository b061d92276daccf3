"""Demonstrations of one motion brought to one tempo, so that equal times are equal places in the motion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from dmpcpp import _core
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._averaging import mean, spread
from dmpcpp.motion._poses import poses
from dmpcpp.motion._timing import evaluated
from dmpcpp.recordings._recording import Array, Recording

__all__ = ["aligned", "medoid"]

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
        m/rad, what a turn counts beside a distance.
    band : float, optional
        See `dmpcpp.align`.

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
