"""Columns of a table that say which samples count, such as `left_visible`: offered, never used unasked."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from dmpcpp._notes import Note
from dmpcpp._text import Row

__all__ = ["flag_notes", "is_flag"]

_COUNTS = re.compile(
    r"(?:(?P<body>.*?)[_ .])?(?:is_?)?(?:tracking_?)?"
    r"(?:valid|visible|visibility|tracked|tracking|state|status|confidence|conf|quality|reliability|likelihood)"
)
_LOST = re.compile(r"(?:(?P<body>.*?)[_ .])?(?:is_?)?(?:occluded|occlusion|lost|missing|dropout)")
_YES, _NO = {"1", "1.0", "true", "yes", "y"}, {"0", "0.0", "-1", "-1.0", "false", "no", "n", ""}
_MOST_STATES = 10  # more values are a measurement
_LEAST = 0.5  # share of the largest confidence below which a sample is doubtful
_SCALES = (1.0, 100.0)  # of confidences


def is_flag(name: str) -> bool:
    """Return whether a column of this name says which samples count."""
    plain = name.strip().lower()
    return bool(_COUNTS.fullmatch(plain) or _LOST.fullmatch(plain))


def flag_notes(header: Sequence[str], rows: Sequence[Row], body: str, bodies: Sequence[str]) -> list[Note]:
    """Return a warning for each column that says of some rows that they do not count; all rows are used.

    Parameters
    ----------
    header : sequence of str
    rows : sequence of (line, cells)
    body : str
        Whose poses are read; columns that begin with the name of another body are left aside.
    bodies : sequence of str
    """
    others = {name.lower() for name in bodies if name != body}
    notes = []
    for column, name in enumerate(header):
        plain = name.strip().lower()
        lost = _LOST.fullmatch(plain)
        match = lost or _COUNTS.fullmatch(plain)
        if match and (match["body"] or "") not in others:
            cells = [row[1][column].strip() if column < len(row[1]) else "" for row in rows]
            said = _doubt(name, cells, inverse=lost is not None)
            notes += [Note("warning", said, about="where")] if said else []
    return notes


def _doubt(name: str, cells: Sequence[str], *, inverse: bool) -> str:
    """Return what a column says against rows, and the option that leaves these out; "" where it says nothing."""
    values = dict.fromkeys(cell.lower() for cell in cells)
    if len(values) < 2:
        return ""
    if all(value in _YES | _NO for value in values):
        wrong = _YES if inverse else _NO
        good = next(cell for cell in cells if cell.lower() not in wrong) if set(values) - wrong else ""
        count = sum(cell.lower() in wrong for cell in cells)
        return _said(name, count, len(cells), f"{name}={good}") if count else ""
    numbers = _numbers(cells)
    if numbers is not None and len(values) > _MOST_STATES:
        return _low_confidence(name, numbers)
    if len(values) > _MOST_STATES:
        return ""
    held = ", ".join(dict.fromkeys(cells))
    return f"the column {name!r} holds {held}, and all rows are used; where='{name}=VALUE' keeps those of one value"


def _low_confidence(name: str, numbers: np.ndarray) -> str:
    scale = next((scale for scale in _SCALES if numbers.max() <= scale), None)
    if scale is None:
        return ""
    low = int((numbers < _LEAST * scale).sum())
    return _said(name, low, len(numbers), f"{name}>={_LEAST * scale:g}") if low else ""


def _said(name: str, count: int, rows: int, where: str) -> str:
    return (
        f"the column {name!r} says of {count} of {rows} rows that they do not count, and all are used; "
        f"where='{where}' leaves them out"
    )


def _numbers(cells: Sequence[str]) -> np.ndarray | None:
    try:
        numbers = np.array([float(cell) for cell in cells])
    except ValueError:
        return None
    return numbers if np.isfinite(numbers).all() else None
