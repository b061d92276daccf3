"""Whether a recording can be the motion of a hand: it moves, and no faster than hands do."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._smoothing import noise
from dmpcpp.recordings import Recording, jumps

__all__ = ["implausible", "plausible"]

_STILL_POSITION, _STILL_ANGLE = 1e-3, np.radians(0.5)  # m, rad; who moves less than both stands still
_TURNS = np.radians(20.0)  # rad; a hand that turns so far moves, too
_FASTEST = 30.0  # m/s; above what any hand does, far below cm or mm read as m
_WINDOW = 0.05  # s; over less than that a glitch or noise passes for speed
_WITHIN, _MEDIAN = 5.0, 7  # times the noise, of the median of as many samples, that a hand at rest may seem to move
_MOST_NOISE = 0.008, np.radians(1.5)  # m, rad; what deviates by more is a motion too fast for its rate
_NEIGHBOURS = 3  # samples whose median takes a single glitch out


def plausible(recording: Recording) -> Recording:
    """Return the recording if it can be the motion of a hand; its history warns of one that turns on the spot, as one
    does whose lengths were read in too small a unit.

    Raises
    ------
    InvalidArgument
        Saying what `implausible` found and what to do.
    """
    if reason := implausible(recording):
        source = f" in {recording.source}" if recording.source else ""
        raise InvalidArgument(f"position: the body {recording.body!r}{source} {reason}")
    extent, angle = _covered(recording, ~recording.missing)
    if extent < _STILL_POSITION and angle > _TURNS:
        return recording.with_(
            Note(
                "warning",
                f"moves over {1e3 * extent:.2g} mm only and turns by {np.degrees(angle):.0f} deg: is the unit of its "
                "lengths right?",
            )
        )
    return recording


def implausible(recording: Recording) -> str:
    """Return why a recording cannot be the motion of a hand, and what to do; "" of one that can.

    Reasons: at rest (box diagonal < 1 mm and turn < 0.5 deg, or within 5x its noise); > 30 m/s over 50 ms, or over all
    of a shorter recording; a lasting jump. Single outliers and gaps are ignored.
    """
    there = ~recording.missing
    time, position = recording.time[there], recording.position[there]
    return _stillness(recording, there) or _haste(time, position) or _teleport(time, position)


def _stillness(recording: Recording, there: NDArray[np.bool_]) -> str:
    extent, angle = _covered(recording, there)
    if extent >= _STILL_POSITION or angle >= _STILL_ANGLE:
        return _stillness_in_noise(recording, there)
    return (
        f"stands still: it moves over {1e3 * extent:.2g} mm and turns by {np.degrees(angle):.2g} deg in "
        f"{recording.duration:.4g} s, expected at least {1e3 * _STILL_POSITION:g} mm or "
        f"{np.degrees(_STILL_ANGLE):g} deg. Choose another body or another part of the recording, or state the unit of "
        "its lengths."
    )


def _stillness_in_noise(recording: Recording, there: NDArray[np.bool_]) -> str:
    """Return why a recording is at rest although its noise moves it; "" where it moves, or has no more than 1 mm."""
    if there.sum() < _MEDIAN:
        return ""
    rotation = Rotation.from_matrix(recording.rotation[there])
    away = _farthest(recording.position[there])
    turned = _farthest((rotation.mean().inv() * rotation).as_rotvec())
    if away > _WITHIN * _MOST_NOISE[0] or turned > max(_STILL_ANGLE, _WITHIN * _MOST_NOISE[1]):
        return ""
    found = noise(recording)
    position, angle = min(found.position, _MOST_NOISE[0]), min(found.angle, _MOST_NOISE[1])
    if away > _WITHIN * position or turned > _WITHIN * angle:
        return ""
    return (
        f"stands still: it stays within {1e3 * away:.2g} mm and {np.degrees(turned):.2g} deg, which its noise of "
        f"{found.describe()} explains. Choose another body or another part of the recording."
    )


def _farthest(values: Array) -> float:
    """Return how far values (T, 3) go from their median, single ones left aside."""
    median = np.median(sliding_window_view(values, _MEDIAN, axis=0), axis=-1)
    return float(np.linalg.norm(median - np.median(values, axis=0), axis=1).max())


def _covered(recording: Recording, there: NDArray[np.bool_]) -> tuple[float, float]:
    """Return the diagonal of the box that holds the positions [m] and the largest turn from the first sample [rad]."""
    rotation = Rotation.from_matrix(recording.rotation[there])
    extent = float(np.linalg.norm(np.ptp(recording.position[there], axis=0)))
    return extent, float((rotation[0].inv() * rotation).magnitude().max())


def _haste(time: Array, position: Array) -> str:
    if len(time) < 2 * _NEIGHBOURS:
        return ""  # too few samples to tell a glitch from speed; such a recording is refused elsewhere
    median = np.median(sliding_window_view(position, _NEIGHBOURS, axis=0), axis=-1)
    time = time[_NEIGHBOURS // 2 : -(_NEIGHBOURS // 2)]
    path = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(median, axis=0), axis=1))))
    begin, end = _windows(time)
    pace = (path[end] - path[begin]) / (time[end] - time[begin])
    k = int(np.argmax(pace))
    if pace[k] <= _FASTEST:
        return ""
    return (
        f"moves at {pace[k]:.3g} m/s from {time[begin[k]]:.4g} to {time[end[k]]:.4g} s, expected at most "
        f"{_FASTEST:g} m/s: no hand moves so fast. State the unit of lengths (unit='cm', unit='mm'), the rate "
        "(rate=...) or the unit of times (time_unit='ms') that the recording has, or crop a jump out."
    )


def _teleport(time: Array, position: Array) -> str:
    """Return where a body is elsewhere within one step, and stays there."""
    found = jumps(time, position)
    if not found:
        return ""
    k, distance = found[0]
    more = f" and {len(found) - 1} more" if len(found) > 1 else ""
    return (
        f"jumps by {distance:.3g} m in one step between {time[k]:.4g} and {time[k + 1]:.4g} s{more}: no hand moves "
        f"like "
        f"that. Use the part before or behind it: end={time[k]:.4g} or start={time[k + 1]:.4g}."
    )


def _windows(time: Array) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
    """Return first and last samples of the shortest windows that last long enough, or of all there is."""
    end = np.searchsorted(time, time + _WINDOW * (1.0 - 1e-9))  # rounding must not cost a sample
    begin = np.flatnonzero(end < len(time))
    return (begin, end[begin]) if len(begin) else (np.array([0]), np.array([len(time) - 1]))
