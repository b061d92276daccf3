"""A long recording cut into motions: where it rests, or cycle by cycle."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import complete, positive, turn_angles
from dmpcpp.motion._smoothing import Noise, evenly_sampled, low_pass, noise
from dmpcpp.motion._timing import resample
from dmpcpp.recordings import MIN_SAMPLES, Recording

__all__ = ["cycles", "segments", "spans_of_cycles", "spans_of_segments", "speed"]

_REST = 0.05  # share of the peak speed below which a hand rests
_AWAY, _BACK = 0.6, 0.45  # shares of the largest distance from home; apart, so that a hand that dithers counts once

_CUTOFFS = (2.0, 10.0)  # Hz, least and most: a reach lies below the one, a hand below the other
_MEAN_LENGTH = 1.6  # of a vector of three normal numbers: sqrt(8 / pi)
_FILTERED = 20  # samples that a filter needs at least
_CLEAR = 3.0  # times slower than what counts as rest shall the noise that is left be

Span = tuple[int, int]  # samples, first and one past the last


def speed(recording: Recording, angle_weight: float = 0.2) -> Array:
    """Return |v| + angle_weight |omega| (T,) in m/s, by second-order differences; angle_weight in m/rad.

    Noise counts as speed; `segments` and `cycles` take it out before they look for rests.
    """
    linear = np.linalg.norm(np.gradient(complete(recording).position, recording.time, axis=0, edge_order=2), axis=1)
    travelled = np.concatenate(([0.0], np.cumsum(turn_angles(recording))))
    return linear + angle_weight * np.gradient(travelled, recording.time, edge_order=1)


def segments(
    recording: Recording, *, rest: float = _REST, shortest: float = 0.1, pause: float = 0.1, angle_weight: float = 0.2
) -> list[Recording]:
    """Cut at the rests: the parts whose speed stays above `rest` times its peak.

    If noise would pass for motion, rests are detected in speed low-passed at 2 to 10 Hz (see history); the returned
    parts are unfiltered.

    Parameters
    ----------
    rest : float
        Share of the peak speed, between 0 and 1.
    shortest : float
        s; shorter parts are left out.
    pause : float
        s; a shorter rest does not cut.
    angle_weight : float
        m/rad; how much turning counts as moving, see `speed`.

    Returns
    -------
    list of Recording
        In order, each from its own time 0; none for a recording that never moves.

    Raises
    ------
    InvalidArgument
        Missing samples; `rest` outside (0, 1).
    """
    _check_share("rest", rest)
    spans, how = _segment_spans(recording, rest, shortest, pause, angle_weight)
    return _cut(recording, spans, f"segment {{}} of {len(spans)} by speed{how}")


def spans_of_segments(recording: Recording) -> tuple[tuple[float, float], ...]:
    """Return begin and end [s] of each of the `segments`."""
    spans, _ = _segment_spans(recording, _REST, 0.1, 0.1, 0.2)
    return _times(recording, spans)


def _segment_spans(
    recording: Recording, rest: float, shortest: float, pause: float, angle_weight: float
) -> tuple[list[Span], str]:
    pace, how = _pace(recording, rest, angle_weight)
    spans = _runs(pace > rest * pace.max())
    spans = _joined(recording.time, spans, pause)
    return [
        (b, e) for b, e in spans if e - b >= MIN_SAMPLES and recording.time[e - 1] - recording.time[b] >= shortest
    ], how


def _times(recording: Recording, spans: list[Span]) -> tuple[tuple[float, float], ...]:
    return tuple((float(recording.time[b]), float(recording.time[e - 1])) for b, e in spans)


def cycles(
    recording: Recording, home: ArrayLike | None = None, *, rest: float = _REST, angle_weight: float = 0.2
) -> list[Recording]:
    """Cut a repeated motion into whole cycles: away from home and back.

    The hand is away once it is further from `home` than 60 % of the largest distance, and back once it is closer
    than 45 %; a cycle is one such excursion. It begins at the last rest (speed below `rest` times its peak) before
    the excursion and ends at the first rest after it, so that rests within it, at an object for instance, do not cut.
    A home where the hand does not come to rest is cut at its slowest moment. What comes before the hand is first
    at home is dropped, and what follows the last return, an excursion without return included.

    Parameters
    ----------
    home : array_like (3,), optional
        m; where the hand starts unless given.
    rest, angle_weight : float
        As in `segments`.

    Returns
    -------
    list of Recording
        One for each cycle, in order, each from its own time 0.

    Raises
    ------
    InvalidArgument
        Missing samples; `rest` outside (0, 1); or an invalid `home`.
    """
    _check_share("rest", rest)
    spans, how = _cycle_spans(recording, home, rest, angle_weight)
    return _cut(recording, spans, f"cycle {{}} of {len(spans)}{how}")


def spans_of_cycles(recording: Recording) -> tuple[tuple[float, float], ...]:
    """Return begin and end [s] of each of the `cycles`."""
    return _times(recording, _cycle_spans(recording, None, _REST, 0.2)[0])


def _cycle_spans(
    recording: Recording, home: ArrayLike | None, rest: float, angle_weight: float
) -> tuple[list[Span], str]:
    home = complete(recording).position[0] if home is None else np.asarray(home, dtype=np.float64)
    if np.shape(home) != (3,) or not np.isfinite(home).all():
        raise InvalidArgument(f"home: {home}, expected (3,) finite numbers in m.")
    distance = np.linalg.norm(recording.position - home, axis=1)
    share = distance / distance.max() if distance.max() > 0.0 else distance
    pace, how = _pace(recording, rest, angle_weight)
    resting = pace < rest * pace.max()
    stays = _stays_around(_excursions(share), share)
    return [(_leaving(pace, resting, *a), _arrival(pace, resting, *b) + 1) for a, b in pairwise(stays)], how


def _pace(recording: Recording, rest: float, angle_weight: float) -> tuple[Array, str]:
    """Return the speed (T,) to find rests in, and what was done about noise, "" if nothing.

    White noise of deviation s per axis, sampled at f, has below c the speed 2 pi s sqrt(2 c^3 / (3 f)) per axis.
    """
    pace = speed(recording, angle_weight)
    found, rate = noise(recording), recording.rate
    if _noise_speed(found, rate, angle_weight) <= rest * pace.max() or not _can_be_filtered(recording):
        return pace, ""
    even = recording if evenly_sampled(recording) else resample(recording, rate)
    least, most = min(_CUTOFFS[0], 0.2 * rate), min(_CUTOFFS[1], 0.4 * rate)
    wanted = rest * speed(low_pass(even, most), angle_weight).max() / _CLEAR
    deviation = _MEAN_LENGTH * (found.position + angle_weight * found.angle)
    cutoff = float(np.clip((wanted / (2 * np.pi * deviation)) ** (2 / 3) * (1.5 * rate) ** (1 / 3), least, most))
    smoothed = low_pass(even, cutoff)
    pace = np.interp(recording.time, smoothed.time, speed(smoothed, angle_weight))
    return pace, f" below {cutoff:.2g} Hz, as noise of {found.describe()} passes for motion"


def _noise_speed(found: Noise, rate: float, angle_weight: float) -> float:
    """Return the speed [m/s] that noise has in central differences of positions and in differences of orientations."""
    return float(_MEAN_LENGTH * rate * (found.position / np.sqrt(2) + np.sqrt(2) * angle_weight * found.angle))


def _can_be_filtered(recording: Recording) -> bool:
    return len(recording) >= _FILTERED and bool(turn_angles(recording).max() < np.pi / 2)


def _excursions(share: Array) -> list[Span]:
    """Return from the last sample at home to the first one back of every excursion that leaves home and returns."""
    found: list[Span] = []
    home: int | None = None  # the last sample at home
    left: int | None = None
    for k, distance in enumerate(share):
        if left is None and distance > _AWAY:
            left = home
        if distance < _BACK:
            home = k
            if left is not None:
                found.append((left, k))
                left = None
    return found


def _stays_around(excursions: list[Span], share: Array) -> list[Span]:
    """Return the spans of samples at home: before the first excursion, between them, after the last one."""
    if not excursions:
        return []
    before = np.flatnonzero(share[: excursions[0][0]] > _AWAY)
    after = np.flatnonzero(share[excursions[-1][1] :] > _AWAY)
    begins = [int(before[-1]) + 1 if len(before) else 0, *(back for _, back in excursions)]
    ends = [*(left + 1 for left, _ in excursions), excursions[-1][1] + int(after[0]) if len(after) else len(share)]
    return list(zip(begins, ends, strict=True))


def _leaving(pace: Array, resting: Array, begin: int, end: int) -> int:
    rests = np.flatnonzero(resting[begin:end])
    return begin + int(rests[-1] if len(rests) else np.argmin(pace[begin:end]))


def _arrival(pace: Array, resting: Array, begin: int, end: int) -> int:
    rests = np.flatnonzero(resting[begin:end])
    return begin + int(rests[0] if len(rests) else np.argmin(pace[begin:end]))


def _runs(flags: Array) -> list[Span]:
    """Return the spans in which the flags are set."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(int)))
    return [(int(b), int(e)) for b, e in edges.reshape(-1, 2)]


def _joined(time: Array, spans: list[Span], pause: float) -> list[Span]:
    joined: list[Span] = []
    for begin, end in spans:
        if joined and time[begin] - time[joined[-1][1] - 1] < pause:
            joined[-1] = (joined[-1][0], end)
        else:
            joined.append((begin, end))
    return joined


def _cut(recording: Recording, spans: list[Span], note: str) -> list[Recording]:
    return [
        recording.part(slice(b, e), f"{note.format(k)}: {recording.time[b]:.4g} .. {recording.time[e - 1]:.4g} s")
        for k, (b, e) in enumerate(spans, start=1)
    ]


def _check_share(name: str, value: float) -> None:
    positive(name, value)
    if value >= 1.0:
        raise InvalidArgument(f"{name}: {value:g}, expected a share of the peak below 1.")
