"""The order of a file's samples in time: written twice, written late, or at times that can not be right."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["in_order"]

_CUT_OFF = 0.2  # share of steps of no time from which on the digits of the times, not the samples, are the trouble


def in_order(time: Array, *values: Array, mend: bool | None = None) -> tuple[NDArray[np.int_], list[str]]:
    """Return which samples to keep, in the order of their times, and what was mended.

    A sample that repeats the one before, time and values alike, is left out. With `mend` samples are sorted by their
    times, and of several at one time the first in the file counts.

    Parameters
    ----------
    time : array (T,)
        As in the file, in any unit.
    *values : array (T, ...)
        What was sampled; NaN where lost.
    mend : bool, optional

    Raises
    ------
    InvalidArgument
        Times that do not increase, without `mend`; the message names the first.
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
    if not mend:
        raise _refusal(time, kept, steps)
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


def _refusal(time: Array, kept: NDArray[np.int_], steps: Array) -> InvalidArgument:
    k = int(np.argmax(steps <= 0.0)) + 1
    what = f"time[{kept[k]}]: {time[kept[k]]:.15g} after {time[kept[k - 1]]:.15g}, expected strictly increasing times."
    if (steps == 0.0).mean() > _CUT_OFF:
        return InvalidArgument(f"{what} Were digits of the times cut off? Export more of them, or state rate=...")
    return InvalidArgument(
        f"{what} State mend_times=True to sort the samples by time and keep the first of each, or remove the misplaced "
        "ones."
    )
