"""CSV, TSV and other tables: one line a sample, columns found by their names or stated by the caller.

Columns found by name, case ignored: `time`, `timestamp` or `t`; positions `x y z`, `tx ty tz` or `px py pz`;
quaternions `qx qy qz qw`, whose names tell their order. A prefix in front of them (`hand_x`, `hand.qw`,
`hand x`) names the body, so that one table can hold several.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings.cells import Cells, split_all
from dmpcpp.recordings.pose_columns import POSITION, QUATERNION, pose, stated_columns
from dmpcpp.recordings.reader import AXES, Reader, pick_body
from dmpcpp.recordings.recording import Array, Recording
from dmpcpp.recordings.stated import Stated, times_at_rate
from dmpcpp.recordings.text import data_lines, read_text

__all__ = ["READER", "bodies", "read"]

_TIME_NAMES = ("time", "timestamp", "t")
_COLUMN = re.compile(r"(?:(?P<body>.*?)[ _.:/-]+)?(?P<what>[tp]?[xyz]|q[xyzw])", re.IGNORECASE)
_WHOLE = "pose"  # the body of columns without a prefix


@dataclass(frozen=True)
class _Table:
    """The lines of a file with the columns of its bodies; columns counted from 0."""

    cells: Cells
    header: list[str]  # empty when the columns were stated by number
    bodies: dict[str, dict[str, int]]  # body -> x y z qx qy qz qw -> column
    time: int | None

    def called(self, column: int) -> str:
        return f"column {self.header[column]!r}" if self.header else f"column {column}"

    def times(self, rate: float | None) -> Array:
        if rate is not None or self.time is None:
            return times_at_rate(len(self.cells.rows), rate)
        return self.cells.numbers([self.time], [self.called(self.time)])[:, 0]


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies that the column names tell; "pose" for columns without a prefix."""
    return tuple(_table(path, stated).bodies)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return one body of a table."""
    table = _table(path, stated)
    body = pick_body(body, tuple(table.bodies))
    position, rotation, notes = pose(table.cells, table.bodies[body], table.called, stated)
    return stated.recording(
        time=table.times(stated.rate),
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=notes,
    )


def _table(path: Path, stated: Stated) -> _Table:
    lines = list(data_lines(read_text(path), skip=_skipped(stated.skip_lines)))
    if not lines:
        raise InvalidArgument("no lines of data.")
    delimiter = _delimiter(lines[0][1]) if stated.delimiter is None else stated.delimiter
    if not isinstance(delimiter, str) or len(delimiter) != 1:
        raise InvalidArgument(f"delimiter: {delimiter!r}, expected one character.")
    rows = split_all(lines, delimiter)
    columns = stated.columns
    if isinstance(columns, Mapping) and all(isinstance(column, int) for column in columns.values()):
        where = stated_columns(columns, lambda column: _place(column, {}))
        return _Table(Cells(rows), [], {_WHOLE: where}, where.get("time"))
    header = [cell.strip() for cell in rows[0][1]]
    if len(rows) < 2:
        raise InvalidArgument("a header line without lines of data.")
    return _named(Cells(rows[1:]), header, columns)


def _skipped(lines: int | None) -> int:
    if lines is None:
        return 0
    if isinstance(lines, bool) or not isinstance(lines, int) or lines < 0:
        raise InvalidArgument(f"skip_lines: {lines!r}, expected a number of lines from 0.")
    return lines


def _named(cells: Cells, header: list[str], columns: Mapping[str, str | int] | None) -> _Table:
    """Return the table under a header line, its columns stated by the caller or told by their names."""
    places = {name: column for column, name in enumerate(header)}
    if columns is not None:
        where = stated_columns(columns, lambda column: _place(column, places))
        return _Table(cells, header, {_WHOLE: where}, where.get("time"))
    found = _bodies(header)
    if not found:
        raise NotStated(
            "columns",
            f"no body with columns x y z qx qy qz qw in the header {_shown(header)}. State the columns: "
            "columns={'time': ..., 'x': ..., ..., 'qw': ...} by name, or by number from 0 without a header.",
        )
    times = [column for name, column in places.items() if name.lower() in _TIME_NAMES]
    if len(times) > 1:
        raise NotStated("columns", f"{len(times)} columns of time in the header {_shown(header)}. State the columns.")
    return _Table(cells, header, found, times[0] if times else None)


def _bodies(header: list[str]) -> dict[str, dict[str, int]]:
    """Return the complete bodies that column names tell."""
    found: dict[str, dict[str, int]] = {}
    for column, name in enumerate(header):
        match = _COLUMN.fullmatch(name)
        if match:
            what = match["what"].lower()
            what = what[-1] if what[0] in "tp" else what
            found.setdefault(match["body"] or _WHOLE, {}).setdefault(what, column)
    return {body: where for body, where in found.items() if all(what in where for what in (*POSITION, *QUATERNION))}


def _place(column: object, places: Mapping[str, int]) -> int:
    if isinstance(column, str):
        if column in places:
            return places[column]
        raise InvalidArgument(f"columns: no column {column!r} in the header {_shown(list(places))}.")
    if isinstance(column, bool) or not isinstance(column, int | np.integer) or column < 0:
        raise InvalidArgument(f"columns: {column!r}, expected the name of a column or its number from 0.")
    return int(column)


def _delimiter(header: str) -> str:
    held = [candidate for candidate in ",;\t" if candidate in header]
    if len(held) == 1:
        return held[0]
    if not held and len(header.split()) > 1:
        return " "
    raise NotStated(
        "delimiter",
        f"delimiter: the first line holds {' and '.join(map(repr, held)) or 'none of , ; tab'}. State it.",
    )


def _shown(header: list[str]) -> str:
    shown = ", ".join(name if len(name) <= 30 else name[:30] + "..." for name in header[:20])
    return f"[{shown}{', ...' if len(header) > 20 else ''}]"


READER = Reader(
    name="table",
    summary="a CSV or TSV with a header line, or any table with stated columns",
    takes=(
        "columns",
        "delimiter",
        "skip_lines",
        "rate",
        "time_unit",
        "missing",
        "euler_order",
        "angle_unit",
        *AXES,
    ),
    recognises=lambda path, head: path.suffix.lower() in (".csv", ".tsv"),
    bodies=bodies,
    read=read,
)
