"""The order of a file's samples in time: written twice, written late, or at times that cannot be right."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._recording import MIN_SAMPLES
from dmpcpp.recordings._stamps import likely_rate

__all__ = ["block", "in_order"]

_CUT_OFF = 0.2  # share of steps of no time from which on the digits of the times, not the samples, are the trouble


_RESTART = 0.5  # share of a take's duration by which the times run back where the next take begins
_FEW_BACK = 0.01  # share of steps that run back which sorting may explain
_SHORT_BACK = 0.1  # share of the duration by which each of them may


def block(time: Array, episode: int | None) -> tuple[NDArray[np.int_], list[str]]:
    """Return the samples of one take among several below each other, each with times that begin anew, and a note.

    Raises
    ------
    NotStated
        There are several takes and `episode` is none of them.
    """
    everything = np.arange(len(time))
    begins = _begins(time)
    if len(begins) == 1 and episode in (None, 0):
        return everything, []
    if len(begins) == 1:
        raise InvalidArgument(f"episode: {episode!r}, but the times begin once only: there is one take, episode=0.")
    if isinstance(episode, int) and 0 <= episode < len(begins):
        end = [*begins[1:], len(time)][episode]
        return everything[begins[episode] : end], [f"take {episode} of {len(begins)}, whose times begin anew"]
    raise NotStated(
        "episode",
        f"episode: {episode!r}, but the times begin anew {len(begins) - 1} times (first at sample {begins[1]}): "
        f"{len(begins)} takes or episodes below each other. Specify one: episode=0 to episode={len(begins) - 1} (or "
        "learn them together: episode='all').",
        [{"episode": number} for number in range(len(begins))],
    )


def _begins(time: Array) -> list[int]:
    """Return the samples at which takes begin: the times run back there by more than half of the take before."""
    begins = [0]
    if not np.isfinite(time).all():
        return begins
    for k in np.flatnonzero(np.diff(time) < 0.0) + 1:
        before, taken = time[k - 1] - time[k], time[k - 1] - time[begins[-1]]
        if taken > 0.0 and before > _RESTART * taken and k - begins[-1] >= MIN_SAMPLES:
            begins.append(int(k))
    return begins if len(time) - begins[-1] >= MIN_SAMPLES else begins[:-1] or [0]


def in_order(
    time: Array, *values: Array, sort: bool | None = None, clock: float = 1.0
) -> tuple[NDArray[np.int_], list[str]]:
    """Return which samples to keep, in the order of their times, and the corrections made.

    A sample that repeats the one before, time and values alike, is left out. With `sort` samples are sorted by their
    times, and of several at one time the first in the file counts.

    Parameters
    ----------
    time : array (T,)
        As in the file, in any unit.
    *values : array (T, ...)
        What was sampled; NaN where lost.
    sort : bool, optional
    clock : float
        Seconds in the unit of `time`.

    Raises
    ------
    InvalidArgument
        Times that do not increase, without `sort`; the message names the first.
    """
    kept = np.arange(len(time))
    if not np.isfinite(time).all() or (np.diff(time) > 0.0).all():
        return kept, []  # what is not finite is for others to name
    notes = []
    again = _repeats(time, values)
    if again.any():
        kept = kept[~again]
        notes.append(f"{int(again.sum())} samples that were written twice left out (the first: {np.argmax(again)})")
    steps = np.diff(time[kept])
    if (steps > 0.0).all():
        return kept, notes
    if not sort:
        raise _refusal(time, kept, steps, clock)
    ordered = kept[np.argsort(time[kept], kind="stable")]
    first = np.concatenate(([True], np.diff(time[ordered]) > 0.0))
    notes.append(f"samples sorted by their times, {int((steps < 0.0).sum())} steps back in time")
    if not first.all():
        notes.append(f"{int((~first).sum())} samples at the time of another left out")
    return ordered[first], notes


def _repeats(time: Array, values: tuple[Array, ...]) -> NDArray[np.bool_]:
    """Return which samples (T,) are the one before, written again."""
    same = time[1:] == time[:-1]
    for array in values:
        flat = array.reshape(len(time), -1)
        same = same & ((flat[1:] == flat[:-1]) | (np.isnan(flat[1:]) & np.isnan(flat[:-1]))).all(axis=1)
    return np.concatenate(([False], same))


def _refusal(time: Array, kept: NDArray[np.int_], steps: Array, clock: float) -> InvalidArgument:
    k = int(np.argmax(steps <= 0.0)) + 1
    what = f"time[{kept[k]}]: {time[kept[k]]:.15g} after {time[kept[k - 1]]:.15g}, expected strictly increasing times."
    if (steps == 0.0).mean() > _CUT_OFF:
        span = clock * float(np.ptp(time[kept]))
        mean = likely_rate(len(steps) / span) if span > 0.0 else 100.0
        return InvalidArgument(
            f"{what} {int((steps == 0.0).sum())} samples have the time of the one before. Were digits of the times "
            f"cut off? "
            f"Export more of them, or specify the rate that the device had, by these times rate={mean:.4g}."
        )
    back = steps[steps < 0.0]
    few = len(back) <= max(1, _FEW_BACK * len(steps)) and (-back <= _SHORT_BACK * np.ptp(time[kept])).all()
    if few or len(back) == len(steps):  # some misplaced, or the whole file written backwards
        return InvalidArgument(
            f"{what} Specify sort_times=True to sort the samples by time and keep the first of each, or remove the "
            "misplaced ones."
        )
    return NotStated(
        "rate",
        f"{what} {len(back)} steps run back in time, too many to be misplaced samples. If the order of the rows is "
        f"right, "
        "specify the rate=... of the device; if rows of several bodies are mixed, keep one of them.",
    )
