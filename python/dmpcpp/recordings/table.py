"""CSV, TSV and other tables: one line a sample, columns found by their names or stated by the caller.

Columns found by name, case ignored: `time`, `timestamp` or `t`; positions `x y z`, `tx ty tz` or `px py pz`;
quaternions `qx qy qz qw`, whose names tell their order. A prefix in front of them (`hand_x`, `hand.qw`,
`hand x`) names the body, so that one table can hold several.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings.orientation import from_quaternions
from dmpcpp.recordings.reader import Reader, pick_body
from dmpcpp.recordings.recording import Array, Axis, Recording
from dmpcpp.recordings.stated import Stated, times_at_rate
from dmpcpp.recordings.text import data_lines, number, read_text

__all__ = ["READER", "bodies", "read"]

Columns = Mapping[str, "str | int"]

_POSITION = ("x", "y", "z")
_QUATERNION = ("qx", "qy", "qz", "qw")
_POSE = (*_POSITION, *_QUATERNION)
_TIME_NAMES = ("time", "timestamp", "t")
_COLUMN = re.compile(r"(?:(?P<body>.*?)[ _.:/-]+)?(?P<what>[tp]?[xyz]|q[xyzw])", re.IGNORECASE)
_WHOLE = "pose"  # the body of columns without a prefix


@dataclass(frozen=True)
class _Table:
    """The lines of a file with the columns of its bodies; columns counted from 0."""

    rows: list[tuple[int, list[str]]]  # (line number, cells)
    header: list[str]  # empty when the columns were stated by number
    bodies: dict[str, dict[str, int]]  # body -> x y z qx qy qz qw -> column
    time: int | None

    def values(self, column: int, name: str) -> list[float]:
        return [number(_cell(cells, column, line, name), line, name) for line, cells in self.rows]


def bodies(
    path: Path, *, columns: Columns | None = None, delimiter: str | None = None, **_stated: object
) -> tuple[str, ...]:
    """Return the bodies that the column names tell; "pose" for columns without a prefix."""
    return tuple(_table(path, columns, delimiter).bodies)


def read(
    path: Path,
    body: str | None,
    *,
    columns: Columns | None = None,
    delimiter: str | None = None,
    rate: float | None = None,
    unit: str | float | None = None,
    time_unit: str | float | None = None,
    up_axis: Axis | None = None,
) -> Recording:
    """Return one body of a table.

    Parameters
    ----------
    columns : mapping, optional
        From "time", "x", "y", "z", "qx", "qy", "qz", "qw" to the name of a column, or, for a table without a
        header line, to its number counted from 0. "time" may be missing when `rate` is stated.
    delimiter : str, optional
        Between the cells; " " stands for any blanks. Not stated: the one of `,` `;` and tab that the header
        holds.
    rate : float, optional
        Samples per second of a table without times.
    unit, time_unit, up_axis : optional
        See `Stated`.
    """
    table = _table(path, columns, delimiter)
    body = pick_body(body, tuple(table.bodies))
    where = table.bodies[body]
    pose = np.array([table.values(where[what], _called(table, where[what])) for what in _POSE]).T
    time = times_at_rate(len(pose), rate) if rate is not None or table.time is None else _times(table)
    rotation, notes = from_quaternions(pose[:, 3:], "xyzw")
    stated = Stated(unit=unit, time_unit=time_unit, up_axis=up_axis)
    return stated.recording(
        time=time, position=pose[:, :3], rotation=rotation, body=body, source=path.name, notes=notes
    )


def _times(table: _Table) -> Array:
    assert table.time is not None
    return np.array(table.values(table.time, _called(table, table.time)))


def _called(table: _Table, column: int) -> str:
    return f"column {table.header[column]!r}" if table.header else f"column {column}"


def _cell(cells: list[str], column: int, line: int, name: str) -> str:
    if column >= len(cells):
        raise InvalidArgument(f"line {line}, {name}: the line ends after {len(cells)} cells.")
    return cells[column]


def _table(path: Path, columns: Columns | None, delimiter: str | None) -> _Table:
    lines = list(data_lines(read_text(path)))
    if not lines:
        raise InvalidArgument("no lines of data.")
    delimiter = _delimiter(lines[0][1]) if delimiter is None else delimiter
    if not isinstance(delimiter, str) or len(delimiter) != 1:
        raise InvalidArgument(f"delimiter: {delimiter!r}, expected one character.")
    rows = [(line, _split(text, delimiter, line)) for line, text in lines]
    if columns is not None and all(isinstance(column, int) for column in columns.values()):
        return _Table(rows, [], {_WHOLE: _stated_pose(columns, {})}, _stated_time(columns, {}))
    header = [cell.strip() for cell in rows[0][1]]
    return _named(rows[1:], header, columns)


def _named(rows: list[tuple[int, list[str]]], header: list[str], columns: Columns | None) -> _Table:
    """Return the table under a header line, its columns stated by the caller or told by their names."""
    if not rows:
        raise InvalidArgument("a header line without lines of data.")
    places = {name: column for column, name in enumerate(header)}
    if columns is not None:
        return _Table(rows, header, {_WHOLE: _stated_pose(columns, places)}, _stated_time(columns, places))
    found = _bodies(header)
    if not found:
        raise InvalidArgument(
            f"no body with columns x y z qx qy qz qw in the header {_shown(header)}. State the columns: "
            "columns={'time': ..., 'x': ..., ..., 'qw': ...} by name, or by number from 0 without a header."
        )
    times = [column for name, column in places.items() if name.lower() in _TIME_NAMES]
    if len(times) > 1:
        raise InvalidArgument(f"{len(times)} columns of time in the header {_shown(header)}. State the columns.")
    return _Table(rows, header, found, times[0] if times else None)


def _bodies(header: list[str]) -> dict[str, dict[str, int]]:
    """Return the complete bodies that column names tell."""
    found: dict[str, dict[str, int]] = {}
    for column, name in enumerate(header):
        match = _COLUMN.fullmatch(name)
        if match:
            what = match["what"].lower()
            what = what[-1] if what[0] in "tp" else what
            found.setdefault(match["body"] or _WHOLE, {}).setdefault(what, column)
    return {body: where for body, where in found.items() if all(what in where for what in _POSE)}


def _stated_pose(columns: Columns, places: Mapping[str, int]) -> dict[str, int]:
    unknown = set(columns) - {"time", *_POSE}
    missing = [what for what in _POSE if what not in columns]
    if unknown or missing:
        wrong = f"unknown {', '.join(map(repr, sorted(unknown)))}" if unknown else f"missing {', '.join(missing)}"
        raise InvalidArgument(f"columns: {wrong}; expected time, {', '.join(_POSE)}.")
    return {what: _place(columns[what], places) for what in _POSE}


def _stated_time(columns: Columns, places: Mapping[str, int]) -> int | None:
    return _place(columns["time"], places) if "time" in columns else None


def _place(column: str | int, places: Mapping[str, int]) -> int:
    if isinstance(column, str):
        if column in places:
            return places[column]
        raise InvalidArgument(f"columns: no column {column!r} in the header {_shown(list(places))}.")
    if isinstance(column, bool) or column < 0:
        raise InvalidArgument(f"columns: {column!r}, expected the name of a column or its number from 0.")
    return int(column)


def _delimiter(header: str) -> str:
    held = [candidate for candidate in ",;\t" if candidate in header]
    if len(held) == 1:
        return held[0]
    if not held and len(header.split()) > 1:
        return " "
    raise InvalidArgument(
        f"delimiter: the first line holds {' and '.join(map(repr, held)) or 'none of , ; tab'}. State it."
    )


def _split(text: str, delimiter: str, line: int) -> list[str]:
    if delimiter == " ":
        return text.split()
    try:
        return next(csv.reader([text], delimiter=delimiter))
    except (csv.Error, ValueError, TypeError, StopIteration) as error:
        raise InvalidArgument(f"line {line}: not a line of cells ({error}).") from None


def _shown(header: list[str]) -> str:
    shown = ", ".join(name if len(name) <= 30 else name[:30] + "..." for name in header[:20])
    return f"[{shown}{', ...' if len(header) > 20 else ''}]"


READER = Reader(
    name="table",
    summary="a CSV or TSV with a header line, or any table with stated columns",
    recognises=lambda path, head: path.suffix.lower() in (".csv", ".tsv"),
    bodies=bodies,
    read=read,
)
