"""Samples that were lost: short gaps filled, recordings cut at long ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.spatial.transform import Rotation, Slerp

from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import positive
from dmpcpp.recordings._recording import MIN_SAMPLES, Array, Recording

__all__ = ["LONGEST_GAP", "Gap", "fill", "gaps", "gaps_in", "skipped", "split"]

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
    usual = float(np.median(np.diff(times)))
    open_ = (np.diff(known) > 1) | (np.diff(time) > _SKIPPED * usual)
    return tuple(
        Gap(int(known[k]), int(known[k + 1]), float(time[k]), float(time[k + 1])) for k in np.flatnonzero(open_)
    )


def skipped(times: Array) -> int:
    """Return how many samples were never written at times (T,) [s]: those that a step more than 1.75 times as long as
    the usual (median) one leaves room for.
    """
    steps = np.diff(times)
    usual = float(np.median(steps))
    return int(np.sum(np.round(steps[steps > _SKIPPED * usual] / usual) - 1.0))


def fill(recording: Recording, longest: float = LONGEST_GAP) -> Recording:
    """Fill gaps of up to `longest` [s]; cut missing samples off both ends.

    Positions by monotone cubic interpolation (PCHIP: no overshoot), orientations along the shortest turn (Slerp).
    Where a step was skipped samples are put in at the usual rate. Nothing changes without gaps.

    Raises
    ------
    InvalidArgument
        A longer gap, named by its time; split the recording there, or allow it. Or fewer than 8 known samples.
    """
    positive("longest", longest)
    recording = _trimmed(recording)
    found = gaps(recording)
    for gap in found:
        if gap.duration > longest:
            raise InvalidArgument(
                f"position[{gap.first + 1}]: missing from {gap.start:.4g} to {gap.end:.4g} s, {gap.duration:.3g} s, "
                f"expected gaps of at most {longest:g} s. Split the recording there, crop it, or allow longer gaps."
            )
    if not found:
        return recording
    return _filled(recording, found)


def split(recording: Recording, longest: float = LONGEST_GAP) -> list[Recording]:
    """Cut the recording at gaps longer than `longest` [s] and fill the others; parts of fewer than 8 known samples
    are left out.

    Each part counts its time from its first sample; its history tells when that was.
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
    time = recording.time[begin:end]
    return recording.with_(
        note.format(time[0]),
        time=time - time[0],
        position=recording.position[begin:end],
        rotation=recording.rotation[begin:end],
    )


def _filled(recording: Recording, found: tuple[Gap, ...]) -> Recording:
    known = ~recording.missing
    time = np.union1d(recording.time, _skipped(recording, found))
    position = PchipInterpolator(recording.time[known], recording.position[known])(time)
    rotation = Slerp(recording.time[known], Rotation.from_matrix(recording.rotation[known]))(time).as_matrix()
    kept = np.searchsorted(time, recording.time[known])
    position[kept], rotation[kept] = recording.position[known], recording.rotation[known]  # to the last digit
    longest = max(found, key=lambda gap: gap.duration)
    return recording.with_(
        f"{len(found)} gaps filled with {len(time) - known.sum()} samples; the longest, {longest.duration:.3g} s, "
        f"at {longest.start:.4g} s",
        time=time,
        position=position,
        rotation=rotation,
    )


def _skipped(recording: Recording, found: tuple[Gap, ...]) -> Array:
    """Return the times [s] at which samples were never written."""
    usual = float(np.median(np.diff(recording.time)))
    times: list[Array] = [np.empty(0)]
    for gap in found:
        if gap.last == gap.first + 1:
            times.append(np.linspace(gap.start, gap.end, round(gap.duration / usual) + 1)[1:-1])
    return np.concatenate(times)
