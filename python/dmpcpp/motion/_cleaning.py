"""Samples that were lost: short gaps filled, recordings cut at long ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation, Slerp

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import complete, positive
from dmpcpp.recordings import MADE_UP_EACH, MADE_UP_IN_ALL, MIN_SAMPLES, Recording, too_many, usual_step

__all__ = ["LONGEST_GAP", "Gap", "check_made_up", "fill", "gaps", "gaps_in", "outliers", "skipped", "split"]

LONGEST_GAP = 0.2
"""s; a hand turns back within a longer one, and nobody knows whether it did."""

_SKIPPED = 1.75  # times the usual step: a sample that was never written


@dataclass(frozen=True)
class Gap:
    """Where samples are missing: after the sample `first` and before the sample `last`, which are there.

    `start` and `end` are their times [s].
    """

    first: int
    last: int
    start: float
    end: float

    @property
    def duration(self) -> float:
        """Time without a sample [s]."""
        return self.end - self.start


def gaps(recording: Recording) -> tuple[Gap, ...]:
    """Return the gaps between the first and the last known sample: samples marked as missing (NaN), and steps more
    than 1.75 times as long as the usual (median) one.
    """
    return gaps_in(recording.time, ~recording.missing)


def gaps_in(times: Array, there: NDArray[np.bool_]) -> tuple[Gap, ...]:
    """Return the gaps, as `gaps` does, of samples at times (T,) [s] of which some are there (T,): of a marker, say."""
    known = np.flatnonzero(there)
    time = times[known]
    usual = usual_step(times)
    open_ = (np.diff(known) > 1) | (np.diff(time) > _SKIPPED * usual)
    return tuple(
        Gap(int(known[k]), int(known[k + 1]), float(time[k]), float(time[k + 1])) for k in np.flatnonzero(open_)
    )


def skipped(times: Array) -> int:
    """Return how many samples were never written at times (T,) [s]: those that a step more than 1.75 times as long as
    the usual (median) one leaves room for.
    """
    steps = np.diff(times)
    usual = usual_step(times)
    return int(np.sum(np.round(steps[steps > _SKIPPED * usual] / usual) - 1.0))


def fill(recording: Recording, longest: float = LONGEST_GAP) -> Recording:
    """Fill gaps of up to `longest` [s]; cut missing samples off both ends.

    Positions by monotone cubic interpolation (PCHIP: no overshoot), orientations along the shortest turn (Slerp).
    Where a step was skipped samples are put in at the usual rate. Nothing changes without gaps.

    Raises
    ------
    InvalidArgument
        A longer gap, named by its time; split the recording there, or allow it. Fewer than 8 known samples. Or more
        than 10 filled samples per recorded one, or more than 10^6.
    """
    positive("longest", longest)
    recording = _trimmed(recording)
    found = gaps(recording)
    for gap in found:
        if gap.duration > longest:
            raise InvalidArgument(
                f"position[{gap.first + 1}]: missing from {gap.start:.4g} to {gap.end:.4g} s, {gap.duration:.3g} s, "
                f"expected gaps of at most {longest:g} s. {_ways_out(gap, recording)}"
            )
    if not found:
        return recording
    return _filled(recording, found)


def _ways_out(gap: Gap, recording: Recording) -> str:
    """Return how to get around a gap that is too long."""
    allowed = np.ceil(100.0 * gap.duration) / 100.0
    before = f"end={np.floor(1e3 * gap.start) / 1e3:g} or " if gap.start > 0.0 else ""
    return (
        f"longest_gap={allowed:g} fills it; {before}start={np.ceil(1e3 * gap.end) / 1e3:g} uses one side of it only "
        f"(the recording lasts {recording.duration:.4g} s)."
    )


def split(recording: Recording, longest: float = LONGEST_GAP) -> list[Recording]:
    """Cut the recording at gaps longer than `longest` [s] and fill the others; parts of fewer than 8 known samples
    are left out.

    Each part counts its time from its first sample; its history says when that was.
    """
    positive("longest", longest)
    recording = _trimmed(recording)
    long = [gap for gap in gaps(recording) if gap.duration > longest]
    begins = [0, *(gap.last for gap in long)]
    ends = [*(gap.first + 1 for gap in long), len(recording)]
    spans = [(b, e) for b, e in zip(begins, ends, strict=True) if (~recording.missing[b:e]).sum() >= MIN_SAMPLES]
    dropped = len(begins) - len(spans)
    if not long:
        return [fill(recording, longest)]
    left_out = f", {dropped} of fewer than {MIN_SAMPLES} samples left out" if dropped else ""
    note = f"split at {len(long)} gaps longer than {longest:g} s{left_out}: from {{:.4g}} s"
    return [fill(_part(recording, b, e, note), longest) for b, e in spans]


def _trimmed(recording: Recording) -> Recording:
    known = np.flatnonzero(~recording.missing)
    if len(known) < MIN_SAMPLES:
        raise InvalidArgument(f"position: {len(known)} known samples, expected at least {MIN_SAMPLES}.")
    begin, end = int(known[0]), int(known[-1]) + 1
    if end - begin == len(recording):
        return recording
    lost = len(recording) - (end - begin)
    return _part(recording, begin, end, f"{lost} missing samples cut off the ends: from {{:.4g}} s")


def _part(recording: Recording, begin: int, end: int, note: str) -> Recording:
    return recording.part(slice(begin, end), note.format(recording.time[begin]))


def _filled(recording: Recording, found: tuple[Gap, ...]) -> Recording:
    known = ~recording.missing
    check_made_up(sum(_room(gap, usual_step(recording.time)) for gap in found), int(known.sum()))
    time = np.union1d(recording.time, _skipped(recording, found))
    position = PchipInterpolator(recording.time[known], recording.position[known])(time)
    rotation = Slerp(recording.time[known], Rotation.from_matrix(recording.rotation[known]))(time).as_matrix()
    kept = np.searchsorted(time, recording.time[known])
    position[kept], rotation[kept] = recording.position[known], recording.rotation[known]  # to the last digit
    measured = np.zeros(len(time), dtype=bool)
    measured[kept] = recording.measured[known]
    longest = max(found, key=lambda gap: gap.duration)
    return recording.with_(
        f"{len(found)} gaps filled with {len(time) - known.sum()} samples; the longest, {longest.duration:.3g} s, "
        f"at {longest.start:.4g} s",
        time=time,
        position=position,
        rotation=rotation,
        channels={name: np.interp(time, recording.time, values) for name, values in recording.channels.items()},
        measured=measured,
    )


def check_made_up(made_up: float, there: int) -> None:
    """Refuse to add more samples than were recorded ones can carry.

    Raises
    ------
    InvalidArgument
        More than 10 for each of `there`, or more than 10^6.
    """
    if too_many(made_up, there):
        raise InvalidArgument(
            f"{made_up:.0f} samples would be made up from {there}, expected at most {MADE_UP_EACH} for each and "
            f"{MADE_UP_IN_ALL:g} in all. Check the times: specify the rate=... of the device, or crop the gaps out."
        )


def _room(gap: Gap, usual: float) -> float:
    """Return how many samples are made up in a gap."""
    return float(gap.last - gap.first - 1 if gap.last > gap.first + 1 else round(gap.duration / usual) - 1)


def _skipped(recording: Recording, found: tuple[Gap, ...]) -> Array:
    """Return the times [s] at which samples were never written."""
    usual = usual_step(recording.time)
    times: list[Array] = [np.empty(0)]
    for gap in found:
        if gap.last == gap.first + 1:
            times.append(np.linspace(gap.start, gap.end, round(gap.duration / usual) + 1)[1:-1])
    return np.concatenate(times)


def outliers(
    recording: Recording, *, half_width: int = 5, threshold: float = 5.0, distance: float = 5e-3, angle: float = 0.05
) -> Recording:
    """Mark outliers as missing (NaN); `fill` replaces them.

    A Hampel identifier (Hampel, "The influence curve and its role in robust estimation", 1974) that goes with the
    motion: the neighbours are carried along the median velocity of the window to the sample's time; an outlier lies
    further from their median than `threshold` times the median of their own distances from it. So up to
    `half_width` - 1 bad samples in a row are found while the motion itself, however fast, is no outlier.

    Parameters
    ----------
    half_width : int
        Neighbours on either side, 2 or more. As many samples at either end are not judged: seen from one side only,
        a motion that starts to move is an outlier too.
    threshold : float
        Above 0; 5 is about eight standard deviations of white noise.
    distance, angle : float
        m, rad; what lies closer is never an outlier, however quiet its neighbours: 5 mm and 3 deg, well above the
        noise of recordings.

    Returns
    -------
    Recording
        Its history names how many there were and the largest; the recording itself where there were none.

    Raises
    ------
    InvalidArgument
        Missing samples, fewer than 2 half_width + 1, or a parameter outside its range.
    """
    for name, value in (("threshold", threshold), ("distance", distance), ("angle", angle)):
        positive(name, value)
    width = 2 * half_width + 1
    if half_width < 2 or len(complete(recording)) < width:
        raise InvalidArgument(
            f"half_width: {half_width}, expected 2 or more and a window of {width} within {len(recording)} samples."
        )
    window = sliding_window_view(np.arange(len(recording)), width)
    middle = window[:, half_width]
    away, usual = _deviation(recording.time[window], recording.position[window] - recording.position[middle, None])
    turned, usual_turn = _deviation(recording.time[window], _turns(recording.rotation, window, middle))
    off = (away > np.maximum(threshold * usual, distance)) | (turned > np.maximum(threshold * usual_turn, angle))
    return _marked(recording, middle[off], away[off], turned[off]) if off.any() else recording


def _turns(rotation: Array, window: NDArray[np.int_], middle: NDArray[np.int_]) -> Array:
    """Return the rotation vectors (K, W, 3) from the middle of each window to its samples."""
    relative = np.swapaxes(rotation[middle], 1, 2)[:, None] @ rotation[window]
    return Rotation.from_matrix(relative.reshape(-1, 3, 3)).as_rotvec().reshape(*window.shape, 3)


def _deviation(time: Array, offset: Array) -> tuple[Array, Array]:
    """Return how far the middle of each window lies from the median of its samples, carried along to its time, and
    the median of their own distances from that; of times (K, W) and offsets from the middle (K, W, 3).
    """
    velocity = np.median(np.diff(offset, axis=1) / np.diff(time, axis=1)[..., None], axis=1, keepdims=True)
    carried = offset - velocity * (time - time[:, [time.shape[1] // 2]])[..., None]
    expected = np.median(carried, axis=1, keepdims=True)
    usual = np.median(np.linalg.norm(carried - expected, axis=2), axis=1)
    return np.linalg.norm(expected[:, 0], axis=1), usual


def _marked(recording: Recording, off: NDArray[np.int_], away: Array, turned: Array) -> Recording:
    worst = int(np.argmax(away))
    position, rotation = recording.position.copy(), recording.rotation.copy()
    position[off], rotation[off] = np.nan, np.nan
    return recording.with_(
        f"{len(off)} outliers taken out, the first at {recording.time[off[0]]:.4g} s; the furthest by "
        f"{1e3 * away[worst]:.3g} mm and {np.degrees(turned[worst]):.3g} deg at {recording.time[off[worst]]:.4g} s",
        position=position,
        rotation=rotation,
    )
