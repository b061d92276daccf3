"""Even times at a rate that the caller or the file states, in place of a file's own times.

A rate that is stated wins over what the file says: stamps that jitter are better replaced. The history tells what was
left aside, and warns where that is another tempo.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._world import LIKELY_STEP, seconds

__all__ = ["left_aside", "times_at_rate"]

_OTHER_TEMPO = 0.2  # share by which a file's own rate differs from the stated one before that is a warning


def times_at_rate(count: int, rate: float | None) -> Array:
    """Return `count` times in s at a stated sampling rate [Hz].

    Raises
    ------
    NotStated
        No rate stated.
    InvalidArgument
        One that is not a positive number.
    """
    if rate is None:
        raise NotStated("rate", "rate: the file holds no times. State the sampling rate in Hz: rate=100.")
    if isinstance(rate, bool) or not isinstance(rate, int | float | np.number) or not 0.0 < rate < 1e6:
        raise InvalidArgument(f"rate: {rate!r}, expected a sampling rate in Hz above 0.")
    return np.arange(count) / float(rate)


def left_aside(
    stated: float,
    times: Callable[[], Array] | None = None,
    unit: str | float | None = None,
    rate: float | None = None,
) -> str:
    """Return what to tell of a file's own times, or of the rate that it states, where another rate was specified."""
    if times is not None:
        return _note("times", stated, _rate_of(times, unit))
    return _note("rate", stated, rate)


def _note(what: str, stated: float, own: float | None) -> str:
    said = f"{what} of the file left aside: {stated:.6g} Hz as stated"
    if own is None:
        return said
    said += f"; by its own {what} {own:.4g} Hz"
    if abs(own / stated - 1.0) <= _OTHER_TEMPO:
        return said
    said = f"{said}, so the motion is taken {stated / own:.3g} times as fast as the file says"
    return Note("warning", said, about="rate")


def _rate_of(times: Callable[[], Array], unit: str | float | None) -> float | None:
    """Return the mean rate [Hz] of a file's own times; None where they tell none, in no unit for instance."""
    try:
        own = times()
    except InvalidArgument:
        return None
    own = own[np.isfinite(own)]
    with np.errstate(over="ignore"):
        step = seconds(unit) * float(np.ptp(own)) / (len(own) - 1) if len(own) > 1 else 0.0
    likely = unit is not None or LIKELY_STEP[0] <= step <= LIKELY_STEP[1]
    return 1.0 / step if likely and 0.0 < step < np.inf and 1.0 / step < np.inf else None
