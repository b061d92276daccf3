"""CSV, TSV and other tables: one line a sample, columns found by their names or stated by the caller.

`column_names` says which names are known; a name that holds a unit, `x [mm]` or `time_ms`, states it. A prefix
(`hand_x`, `hand.qw`) names the body, so that one table can hold several.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from dmpcpp._text import Cells, read_text
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._columns import WHOLE, bodies_in, column, times_in, unit_of
from dmpcpp.recordings._pose_columns import ANGLES, POSITION, pose, stated_columns
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import Sampling, sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._table_lines import TableLines, shown, table_lines
from dmpcpp.recordings._world import World

__all__ = ["READER", "bodies", "read"]

_SUFFIXES = (".csv", ".tsv")
_TUM = ("x", "y", "z", "qx", "qy", "qz", "qw")  # columns behind the time


@dataclass(frozen=True)
class _Table:
    """The lines of a file with the columns of its bodies; columns counted from 0."""

    cells: Cells
    header: list[str]  # empty when no line names the columns
    bodies: dict[str, dict[str, int]]  # body -> x y z qx qy qz qw -> column
    time: int | None
    units: list[str]
    notes: list[str]

    def called(self, place: int) -> str:
        return f"column {self.header[place]!r}" if place < len(self.header) else f"column {place}"

    def sampling(self, stated: Stated) -> Sampling:
        if stated.rate is None and self.time is None and self.header:
            raise NotStated(
                "rate",
                f"rate: the file holds no times: no column of {shown(self.header)} is called time. State the sampling "
                "rate in Hz: rate=100, or which it is: columns={'time': ..., 'x': ..., ...}.",
            )
        if self.time is None:
            return sampling(len(self.cells.rows), stated)
        return sampling(len(self.cells.rows), stated, times=self._times, unit=self.unit("time_unit", [self.time]))

    def _times(self) -> Array:
        assert self.time is not None
        cells = replace(self.cells, advice=" Where times are no numbers, state the sampling rate in Hz: rate=100.")
        return cells.numbers([self.time], [self.called(self.time)])[:, 0]

    def unit(self, parameter: str, columns: list[int]) -> str | None:
        """Return the unit in the names of some columns, or in the line below them; None if there is none."""
        names, below = ([line[place] for place in columns if place < len(line)] for line in (self.header, self.units))
        return unit_of(parameter, names, below)

    def world(self, body: str, stated: Stated) -> World:
        """Return the units that the names of the columns say, where the caller does not."""
        length = [self.bodies[body][name] for name in POSITION]
        clock = [] if self.time is None else [self.time]
        return World(
            unit=None if stated.unit is not None else self.unit("unit", length),
            time_unit=None if stated.time_unit is not None or stated.rate else self.unit("time_unit", clock),
        )


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies that the column names tell; "pose" for columns without a prefix."""
    return tuple(_table(path, stated).bodies)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return one body of a table."""
    table = _table(path, stated)
    body = pick_body(body, tuple(table.bodies))
    where = table.bodies[body]
    if stated.angle_unit is None and "rx" in where:
        unit = table.unit("angle_unit", [where[name] for name in ANGLES])
        stated = replace(stated, angle_unit=unit)  # type: ignore[arg-type]  # another unit is refused below
    position, rotation, notes = pose(table.cells, where, table.called, stated)
    sampled = table.sampling(stated)
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*table.notes, *sampled.notes, *notes],
        world=table.world(body, stated),
    )


def _table(path: Path, stated: Stated) -> _Table:
    lines = table_lines(read_text(path), stated.delimiter, _skipped(stated.skip_lines))
    columns = stated.columns
    if isinstance(columns, Mapping) and all(isinstance(place, int) for place in columns.values()):
        where = stated_columns(columns, lambda stated: _place(stated, {}), bool(stated.fixed_orientation))
        return _Table(Cells(lines.rows), lines.names, {WHOLE: where}, where.get("time"), lines.units, lines.notes)
    if not lines.names:
        raise _nameless(lines)
    if not lines.rows:
        raise InvalidArgument("a header line without lines of data.")
    return _named(lines, columns, bool(stated.fixed_orientation))


def _skipped(lines: int | None) -> int:
    if lines is None:
        return 0
    if isinstance(lines, bool) or not isinstance(lines, int) or lines < 0:
        raise InvalidArgument(f"skip_lines: {lines!r}, expected a number of lines from 0.")
    return lines


def _named(lines: TableLines, columns: Mapping[str, str | int] | None, position_only: bool) -> _Table:
    """Return the table under a header line, its columns stated by the caller or told by their names."""
    cells, header = Cells(lines.rows), lines.names
    if columns is not None:
        places = {name: place for place, name in enumerate(header)}
        where = stated_columns(columns, lambda stated: _place(stated, places), position_only)
        return _Table(cells, header, {WHOLE: where}, where.get("time"), lines.units, lines.notes)
    found = bodies_in(header) or (bodies_in(header, position_only=True) if position_only else {})
    if not found:
        raise _bodyless(header)
    times = times_in(header)
    if len(times) > 1:
        raise NotStated("columns", f"{len(times)} columns of time in the header {shown(header)}. State the columns.")
    return _Table(cells, header, found, times[0] if times else None, lines.units, lines.notes)


def _nameless(lines: TableLines) -> NotStated:
    line, cells = lines.rows[0]
    return NotStated(
        "columns",
        f"line {line}: {len(cells)} numbers and no line above that names them. State the columns by number from 0: "
        "columns={'time': 0, 'x': 1, ..., 'qw': 7}.",
    )


def _bodyless(header: list[str]) -> NotStated:
    held = tuple(bodies_in(header, position_only=True))
    if held:
        return NotStated(
            ("fixed_orientation", "columns"),
            f"the columns of {', '.join(held[:5])} hold a position and no orientation in the header {shown(header)}. "
            "State fixed_orientation=True to hold the tool's fixed, or the columns: columns={'time': ..., 'x': ..., "
            "'y': ..., 'z': ..., 'qx': ..., ...}.",
        )
    return NotStated(
        "columns",
        f"no body with columns x y z qx qy qz qw in the header {shown(header)}. State the columns by name, "
        "columns={'time': ..., 'x': ..., ..., 'qw': ...}, or skip_lines=N where the header stands N lines below.",
    )


def _place(stated: object, places: Mapping[str, int]) -> int:
    if isinstance(stated, str):
        if stated in places:
            return places[stated]
        raise InvalidArgument(f"columns: no column {stated!r} in the header {shown(list(places))}.")
    if isinstance(stated, bool) or not isinstance(stated, int | np.integer) or stated < 0:
        raise InvalidArgument(f"columns: {stated!r}, expected the name of a column or its number from 0.")
    return int(stated)


def _recognises(path: Path, head: bytes) -> bool:
    """Return whether a file is called a table, or its first lines name the columns of a body."""
    if path.suffix.lower() in _SUFFIXES:
        return True
    try:
        lines = table_lines(head.decode("utf-8-sig", errors="replace"), None)
    except InvalidArgument:
        return False
    found = bodies_in(lines.names) if lines.rows else {}
    return bool(found) and not (lines.commented and lines.delimiter == " " and _is_tum(lines.names, found))


def _is_tum(header: list[str], found: dict[str, dict[str, int]]) -> bool:
    """Return whether a comment names the columns that every TUM file has, in their order and without other units."""
    order = [found.get(WHOLE, {}).get(what) for what in _TUM]
    units = {said.unit for said in map(column, header) if said is not None}
    return order == list(range(1, 8)) and times_in(header) == [0] and units <= {"", "m", "s"}


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
        "fixed_orientation",
        "euler_order",
        "angle_unit",
        *COMMON,
    ),
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
