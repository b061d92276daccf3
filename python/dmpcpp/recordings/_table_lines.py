"""The lines of a table of text: what parts their cells, which line names the columns, which hold numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from dmpcpp._text import Lines, Row, data_lines, split
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._columns import known_unit

__all__ = ["VIDEO_HEADER", "TableLines", "is_data", "shown", "table_lines"]

_COMMENTS = ("#", "%")
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:e[+-]?\d+)?", re.IGNORECASE)
VIDEO_HEADER = "DeepLabCut or Anipose"
"""How the note on a table of poses found in a video begins."""

_POSE_NETWORK = ("scorer", "individuals", "bodyparts", "coords")
_LOOKED_AT = 20  # lines of data that show whether commas are decimal


@dataclass(frozen=True)
class TableLines:
    """A table's lines of data, the names of its columns, none if no line names them, and what was done to read it.

    `units` are those of a line below the names, one a column, none if there is no such line; `commented` says that the
    names stand in a comment above the data, as NumPy writes them.
    """

    rows: Sequence[Row]
    names: list[str]
    units: list[str]
    delimiter: str
    commented: bool
    notes: list[str]


def table_lines(text: str, delimiter: str | None, skip: int = 0) -> TableLines:
    """Return a table's lines; the delimiter is found in the first of them unless given.

    Lines that are blank or comments (`#` or `%` first) are left out, and the first `skip` lines of the text. The first
    line names the columns unless it holds numbers; then a comment above with as many words does. Where the
    delimiter is not the comma, commas in numbers are decimal points.

    Raises
    ------
    InvalidArgument
        No line of data, or a line that cannot be split, named; an unclear delimiter (`NotStated`).
    """
    lines = list(data_lines(text, _COMMENTS, skip))
    if not lines:
        raise InvalidArgument("no lines of data.")
    delimiter = _delimiter(lines[0][1], delimiter)
    lines, several = _with_one_header(lines, delimiter)
    first = [cell.strip() for cell in split(lines[0][1], delimiter, lines[0][0])]
    headed = not is_data(first)
    names = first if headed else _commented(text, lines[0][0], len(first), delimiter)
    units = _units(lines[1:2], delimiter) if headed else []
    data = lines[headed + bool(units) :]
    data, notes = _with_points(data, delimiter)
    notes = [*several, *notes]
    return TableLines(Lines(data, delimiter), names, units, delimiter, bool(names) and not headed, notes)


def _with_one_header(lines: list[tuple[int, str]], delimiter: str) -> tuple[list[tuple[int, str]], list[str]]:
    """Return the lines of a DeepLabCut or Anipose table with one line of names in place of three, and a note.

    Its lines scorer, bodyparts (and individuals) and coords name each column by part and coordinate.
    """
    heads = [(split(text, delimiter, line), line) for line, text in lines[:4] if text.lower().startswith(_POSE_NETWORK)]
    if len(heads) < 3 or heads[0][0][0].strip().lower() != "scorer":
        return lines, []
    parts = [[cell.strip() for cell in cells] for cells, _ in heads[1:]]
    width = min(map(len, parts))
    names = ["frame", *("_".join(row[k] for row in parts) for k in range(1, width))]
    note = f"{VIDEO_HEADER}: three lines of names; positions without orientations, frames without times"
    return [(heads[0][1], delimiter.join(names)), *lines[len(heads) :]], [note]


def is_data(cells: list[str]) -> bool:
    """Return whether a line holds numbers rather than names; some cells may be text, or empty."""
    return sum(map(_is_number, cells)) * 2 > sum(1 for cell in cells if cell)


def shown(names: list[str]) -> str:
    """Return the names of columns, shortened, as messages show them."""
    short = ", ".join(name if len(name) <= 30 else name[:30] + "..." for name in names[:20])
    return f"[{short}{', ...' if len(names) > 20 else ''}]"


def _delimiter(line: str, stated: str | None) -> str:
    if stated is not None:
        if not isinstance(stated, str) or len(stated) != 1:
            raise InvalidArgument(f"delimiter: {stated!r}, expected one character.")
        return stated
    held = [candidate for candidate in ",;\t" if candidate in line]
    if len(held) == 1:
        return held[0]
    if not held and len(line.split()) > 1:
        return " "
    raise NotStated(
        "delimiter",
        f"delimiter: the first line holds {' and '.join(map(repr, held)) or 'none of , ; tab'}. State it.",
    )


def _units(below: list[tuple[int, str]], delimiter: str) -> list[str]:
    """Return the units in the line below the names, "" of a column without one; none if it is no line of units."""
    cells = [cell for line, content in below for cell in split(content, delimiter, line)]
    units = [known_unit(cell) for cell in cells]
    return units if any(units) and not any(map(_is_number, cells)) else []


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return _DECIMAL_COMMA.fullmatch(cell) is not None
    return True


def _commented(text: str, above: int, count: int, delimiter: str) -> list[str]:
    """Return the names in the last comment above a line that holds as many as there are columns; else none."""
    for line in reversed(text.split("\n", above)[: above - 1]):
        content = line.strip().lstrip("".join(_COMMENTS)).strip()
        for candidate in (content.split(delimiter) if delimiter != " " else [], content.split()):
            if line.strip().startswith(_COMMENTS) and len(candidate) == count:
                return [name.strip() for name in candidate]
    return []


def _with_points(lines: list[tuple[int, str]], delimiter: str) -> tuple[list[tuple[int, str]], list[str]]:
    """Return lines with points where numbers hold decimal commas, none holding a point; and what was done."""
    if delimiter == ",":
        return lines, []
    cells = [cell.strip() for line, content in lines[:_LOOKED_AT] for cell in split(content, delimiter, line)]
    numbers = " ".join(filter(_is_number, cells))
    if "," not in numbers or "." in numbers:
        return lines, []
    return [(line, content.replace(",", ".")) for line, content in lines], ["decimal commas read as points"]
