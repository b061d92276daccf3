"""Times that are no plain numbers of seconds: ISO 8601 texts, FILETIME stamps, and integers that a double cannot "
"hold."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import UTC, datetime

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["clock_texts"]

_ISO = re.compile(r"\d{4}-?\d\d-?\d\d[T ]\d\d:?\d\d(:?\d\d([.,]\d+)?)?\s*(Z|[+-]\d\d:?\d\d)?")
_FRACTION = re.compile(r"[.,](\d+)")
_FILETIME = (1.2e17, 1.5e17)  # 100 ns since 1601: the years 1981 to 2076
_EXACT = 2**53  # integers above it lose digits as doubles
_EPOCH_NS = (1e18, 3e18)  # ns since 1970: the years 2001 to 2065


def clock_texts(cells: Sequence[str]) -> tuple[Array, str | float | None] | None:
    """Return times (T,) from the first and their unit, None if unknown; None of cells that are plain numbers.

    ISO 8601 texts are known by the T or blank between date and time and give seconds. Whole numbers of 1.3e17 or so are
    FILETIME, in 100 ns. Other whole numbers beyond 2^53 are counted from the first before they become doubles; those
    of ns since 1970 are known by their size.

    Raises
    ------
    InvalidArgument
        A text among ISO times that is none.
    """
    if not cells:
        return None
    if _ISO.fullmatch(cells[0].strip('"')):
        seconds = [_instant(k, cell) for k, cell in enumerate(cells)]
        return np.array([float(s - seconds[0][0]) + (f - seconds[0][1]) * 1e-9 for s, f in seconds]), "s"
    if not cells[0].isdigit() or int(cells[0][:400]) < _EXACT or not all(cell.isdigit() for cell in cells):
        return None
    stamps = [int(cell[:400]) for cell in cells]
    if max(stamps) > 10**30:
        return None
    unit: str | float | None = None
    if _FILETIME[0] <= stamps[0] <= _FILETIME[1]:
        unit = 1e-7
    elif _EPOCH_NS[0] <= stamps[0] <= _EPOCH_NS[1]:
        unit = "ns"
    return np.array([float(stamp - stamps[0]) for stamp in stamps]), unit


def _instant(row: int, cell: str) -> tuple[int, int]:
    """Return whole seconds since 1970 and the ns behind them; without a zone, as of one zone throughout."""
    text = cell.strip('"').strip()
    fraction = _FRACTION.search(text)
    nanoseconds = int((fraction[1] + "000000000")[:9]) if fraction else 0
    try:
        if not _ISO.fullmatch(text):
            raise ValueError
        moment = datetime.fromisoformat(_FRACTION.sub("", text))
        if moment.tzinfo is None:
            moment = moment.replace(tzinfo=UTC)
        return int(moment.timestamp()), nanoseconds
    except (ValueError, OverflowError):
        raise InvalidArgument(
            f"time[{row}]: {text[:30]!r}, expected a date and time such as 2025-03-01T10:00:00.5."
        ) from None
