"""Time stamps as producers write them: the usual step between samples, and samples that share one moment.

A stamp is often set when a sample is published, not when it was taken: several samples then lie microseconds apart, and
the next one comes late. Two cameras in one table give pairs of samples. Both make the median step useless.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import NotStated

__all__ = ["MADE_UP_EACH", "MADE_UP_IN_ALL", "likely_rate", "too_many", "usual_step", "without_bursts"]

MADE_UP_EACH, MADE_UP_IN_ALL = 10, 1_000_000
"""Most samples that a step may add: for each sample that was recorded, and altogether."""

_SPAN = 12  # samples over which the step is averaged
_UNEVEN = 0.5  # a median step below this share of the average one is one of bursts
_BURST = 0.05  # share of the usual step below which two samples share one moment
_FEW = 0.05  # share of samples in bursts that may be left out
_PAIR_MOTION = 0.2  # share of the motion between pairs that may lie within them


def usual_step(times: Array) -> float:
    """Return the usual time from one sample to the next, in the unit of `times` (T,), T >= 2.

    It is the median step. Where that is less than half of the median of (t[k + 12] - t[k]) / 12, most steps lie within
    bursts and the latter counts. The mean step will not do: one long gap would spoil it.
    """
    median = float(np.median(np.diff(times)))
    span = max(1, min(_SPAN, (len(times) - 1) // 2))  # of most spans no single gap is part
    average = float(np.median(times[span:] - times[:-span])) / span
    return average if median < _UNEVEN * average else median


def too_many(made_up: float, there: int) -> bool:
    """Return whether a step would add more samples than `there` recorded ones can carry."""
    return made_up > MADE_UP_EACH * there or made_up > MADE_UP_IN_ALL


def without_bursts(time: Array, position: Array, clock: float) -> tuple[NDArray[np.int_], list[str]]:
    """Return which samples to keep of those whose stamps lie in bursts, and a note.

    Parameters
    ----------
    time : array (T,)
        Strictly increasing, in any unit.
    position : array (T, ...)
        NaN where lost.
    clock : float
        Seconds in the unit of `time`.

    Raises
    ------
    NotStated
        The stamps lie in bursts and are neither few nor pairs of one moment; the message names `rate`.
    """
    kept = np.arange(len(time))
    steps = np.diff(time)
    usual = usual_step(time)
    short = steps < _BURST * usual
    if not short.any():
        return kept, []
    count, least = int(short.sum()), clock * float(steps.min())
    first = kept[np.concatenate(([True], ~short))]
    said = (
        f"{count} of {len(steps)} steps are shorter than {100 * _BURST:g} % of the usual one (the least {least:.3g} s)"
    )
    if _are_pairs(short, position):
        rate = 1.0 / (clock * usual_step(time[first]))
        return first, [f"stamps in pairs, as of two cameras: {said}; the first of each pair kept, {rate:.4g} Hz"]
    if count <= _FEW * len(steps):
        return first, [
            Note("warning", f"stamps in bursts: {said}; samples so close behind another left out", about="rate")
        ]
    raise NotStated(
        "rate",
        f"rate: the stamps lie in bursts: {said}. They tell when samples were written, not when they were taken. "
        f"State the rate of the device, by the usual step rate={likely_rate(1.0 / (clock * usual)):g}.",
    )


def _are_pairs(short: NDArray[np.bool_], position: Array) -> bool:
    """Return whether samples come in twos that hold nearly the same position."""
    if (short[1:] & short[:-1]).any() or short.mean() < 0.4:
        return False
    moved = np.abs(np.diff(position.reshape(len(position), -1), axis=0))
    moved = np.nan_to_num(moved).max(axis=1)
    return float(np.median(moved[short])) < _PAIR_MOTION * float(np.median(moved[~short]))


def likely_rate(rate: float) -> float:
    """Return a rate [Hz] as a device would have it: a whole number where it is within 1 % of one."""
    whole = round(rate)
    return float(whole) if whole and abs(rate / whole - 1.0) < 0.01 else float(f"{rate:.4g}")
