"""When the samples of a file were taken: as its own times or rate say, or as the caller says instead.

A rate that is stated wins over what the file says: stamps that jitter are better replaced. The history tells what was
left aside, and warns where that is another tempo.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._statement import Stated, times_at_rate
from dmpcpp.recordings._world import LIKELY_STEP, seconds

__all__ = ["Sampling", "sampling"]

_OTHER_TEMPO = 0.2  # share by which a file's own rate differs from the stated one before that is a warning


@dataclass(frozen=True)
class Sampling:
    """Times (T,), what was stated about them, and what was left aside for them."""

    time: Array
    stated: Stated
    notes: list[str]


def sampling(
    count: int,
    stated: Stated,
    *,
    times: Callable[[], Array] | None = None,
    unit: str | float | None = None,
    rate: float | None = None,
) -> Sampling:
    """Return when `count` samples were taken: at the stated rate, else at the file's times, else at its rate.

    Parameters
    ----------
    count : int
    stated : Stated
    times : callable, optional
        Returns those of the file (T,); what it raises does not matter where a rate is stated.
    unit : str or float, optional
        Of these times, as the file says.
    rate : float, optional
        That the file states, Hz.

    Raises
    ------
    InvalidArgument
        A rate that is not a positive number, none at all (`NotStated`), or what `times` raises.
    """
    if stated.rate is None:
        return Sampling(times_at_rate(count, rate) if times is None else times(), stated, [])
    even = times_at_rate(count, stated.rate)
    notes = []
    if times is not None:
        notes = [_left_aside("times", stated.rate, _rate_of(times, stated.time_unit or unit))]
    elif rate is not None and rate != stated.rate:
        notes = [_left_aside("rate", stated.rate, rate)]
    return Sampling(even, replace(stated, rate=None, time_unit=None if stated.time_unit is None else "s"), notes)


def _left_aside(what: str, stated: float, own: float | None) -> str:
    said = f"{what} of the file left aside: {stated:.6g} Hz as stated"
    if own is None:
        return said
    said += f"; by its own {what} {own:.4g} Hz"
    if abs(own / stated - 1.0) <= _OTHER_TEMPO:
        return said
    return f"WARNING: {said}, so the motion is taken {stated / own:.3g} times as fast as the file says"


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
