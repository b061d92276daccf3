"""Rests before and behind a motion, which are none of it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.ndimage import uniform_filter1d
from scipy.spatial.transform import Rotation

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.motion._poses import complete, demonstration
from dmpcpp.motion._smoothing import noise
from dmpcpp.recordings import MIN_SAMPLES, Recording

__all__ = ["rests", "without_rests"]

_SHARE = 0.005  # of what the motion covers: who stays within that of where it began rests
_LEAST = 2e-4, np.radians(0.1)  # m, rad; likewise
_FAR = 8.0  # times as far: twice as late, for a motion that grows with the cube of time
_NOISE = 4.0  # deviations of a mean of samples that a rest may seem to move
_WINDOW = 0.1  # s, over which noise is averaged
_HOME = 0.4  # s, whose median is where the body rests: a smoothed recording is off at its very ends
_SHORTEST = 0.2  # s; a shorter pause is how a motion begins
_KEPT = 0.1  # s of a rest that stay, so that the motion begins and ends in it


def rests(recording: Recording) -> tuple[float, float]:
    """Return how long the body rests at the start and at the end [s]; 0 for what is shorter than 0.2 s.

    A body rests while it stays within 0.5 % of the motion (0.2 mm or 0.1 deg, or what its noise explains, if that is
    more) of where it began. A motion from rest grows with the cube of time, so it began as long before the moment when
    it has left that as it takes from there to eight times the distance: a gentle start is none of the rest.

    Raises
    ------
    InvalidArgument
        Missing samples.
    """
    away = _distances(complete(recording))
    time = recording.time
    first = _begin(time, away(0))
    last = _begin(time[-1] - time[::-1], away(-1)[::-1])
    if first + last >= recording.duration:
        return 0.0, 0.0  # it is all rest, or none of it is
    return tuple(rest if rest >= _SHORTEST else 0.0 for rest in (first, last))  # type: ignore[return-value]


def without_rests(recording: Recording, *, smooth: bool = True) -> Recording:
    """Return the recording without the rests before and behind the motion; its history says how long they were.

    Noise that wanders can be told from the motion by a rest alone. Where one shows it, it is taken out before the rests
    are, unless `smooth` is False.
    """
    settled = _without_wander(recording) if smooth else recording
    first, last = rests(settled)
    begin = int(np.searchsorted(recording.time, first - _KEPT)) if first else 0
    end = int(np.searchsorted(recording.time, recording.duration - last + _KEPT)) if last else len(recording)
    if (begin, end) == (0, len(recording)) or end - begin < MIN_SAMPLES:
        return recording
    told = " and ".join(f"{rest:.2g} s {where}" for rest, where in ((first, "before"), (last, "behind")) if rest)
    kept = settled.part(slice(begin, end), Note("changed", f"rests of {told} the motion left out", about="keep_rests"))
    return kept


def _without_wander(recording: Recording) -> Recording:
    """Return the recording without noise that a rest shows to wander, positions and orientations apart."""
    from dmpcpp._core import NoiseKind

    whole = demonstration(recording)
    found = whole.noise_estimates()
    if all(each.kind != NoiseKind.coloured for each in found):
        return recording
    clean = whole.denoised().pose
    moved, turned = (each.kind == NoiseKind.coloured for each in found)
    said = " and ".join(
        f"{scale * each.removed:.2g} {unit} of the {what} above {each.cutoff:.2g} Hz"
        for each, scale, unit, what in zip(
            found, (1e3, 180.0 / np.pi), ("mm", "deg"), ("positions", "orientations"), strict=True
        )
        if each.kind == NoiseKind.coloured
    )
    return recording.with_(
        f"noise that wanders, seen at rest, smoothed out: {said}",
        position=clean[:, :3, 3] if moved else recording.position,
        rotation=Rotation.from_matrix(clean[:, :3, :3]).as_matrix() if turned else recording.rotation,
    )


def _distances(recording: Recording) -> Callable[[int], Array]:
    """Return what gives the distances (T,) from where the body is at the first (0) or the last (-1) sample; 1 is as far
    as a rest may seem to go."""
    count, beside = (
        int(np.clip(np.sum(recording.time <= span), 3, max(3, len(recording) // 4))) for span in (_WINDOW, _HOME)
    )
    found = noise(recording)
    rotation = Rotation.from_matrix(recording.rotation)
    position = uniform_filter1d(recording.position, count, axis=0, mode="nearest")
    extent = float(np.linalg.norm(np.ptp(position, axis=0)))
    turn = float((rotation[0].inv() * rotation).magnitude().max())
    deviation = _NOISE * np.sqrt(3.0 / count)
    near = max(_SHARE * extent, deviation * found.position, _LEAST[0])
    slight = max(_SHARE * turn, deviation * found.angle, _LEAST[1])

    def away(end: int) -> Array:
        outer = slice(None, beside) if end == 0 else slice(-beside, None)
        turned = uniform_filter1d((rotation[outer].mean().inv() * rotation).as_rotvec(), count, axis=0, mode="nearest")
        homes = np.median(position[outer], axis=0), np.median(turned[outer], axis=0)
        moved = np.linalg.norm(position - homes[0], axis=1) / near
        return np.asarray(np.maximum(moved, np.linalg.norm(turned - homes[1], axis=1) / slight))

    return away


def _begin(time: Array, away: Array) -> float:
    """Return when a motion begins that is `away` (T,) from where it rests, at times (T,) [s] from one end."""
    far = int(np.argmax(away > _FAR))
    near = np.flatnonzero(away[:far] <= 1.0)
    if away[far] <= _FAR or not len(near):
        return 0.0
    return float(max(0.0, 2.0 * time[near[-1] + 1] - time[far]))
