"""When the samples of a file were taken: as its own times or rate say, or as the caller says instead.

A rate that is stated wins over what the file says: stamps that jitter are better replaced. The history tells what was
left aside, and warns where that is another tempo.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from dmpcpp._typing import Array
from dmpcpp.recordings._rate import left_aside, times_at_rate
from dmpcpp.recordings._statement import Stated

__all__ = ["Sampling", "sampling"]


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
        notes = [left_aside(stated.rate, times, stated.time_unit or unit)]
    elif rate is not None and rate != stated.rate:
        notes = [left_aside(stated.rate, rate=rate)]
    return Sampling(even, replace(stated, rate=None, time_unit=None if stated.time_unit is None else "s"), notes)
