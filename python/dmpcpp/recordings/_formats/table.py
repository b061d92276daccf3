"""CSV, TSV and other tables: one line a sample, columns found by their names or specified by the caller.

`_columns` says which names are known; a name that holds a unit, `x [mm]` or `time_ms`, states it. A prefix
(`hand_x`, `hand.qw`) names the body, so that one table can hold several. A column such as `hand` or `take` can tell the
rows of several bodies or takes apart, see `_keys`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from dmpcpp._notes import Note
from dmpcpp._text import Cells, read_text
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._clock import clock_texts
from dmpcpp.recordings._columns import WHOLE, bodies_in, column, repeated, times_in, unit_of
from dmpcpp.recordings._flag_columns import flag_notes
from dmpcpp.recordings._formats.hot3d import UP_OPEN
from dmpcpp.recordings._keys import Key, keys_in, rows_where
from dmpcpp.recordings._layout import layout_of
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._nameless import bodyless, from_shape, nameless
from dmpcpp.recordings._pose_columns import POSITION, pose, stated_columns
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Axis, Recording
from dmpcpp.recordings._representation import ANGLES, VECTOR
from dmpcpp.recordings._sampling import Sampling, sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._table_lines import TableLines, shown, table_lines
from dmpcpp.recordings._world import World

__all__ = ["READER", "bodies", "read"]

_SUFFIXES = (".csv", ".tsv")
_TUM = ("x", "y", "z", "qx", "qy", "qz", "qw")  # columns behind the time
_HOT3D = re.compile(r"[tq]_wo_[wxyz]")  # HOT3D and ADT: object to world
_HEADSET = re.compile(
    r"(?:.*[_. ])?(?:(?:Pos|Rot|Orient)[XYZW]|(?:pos|rot)_[xyzw])"
)  # names in logs of Unity, WebXR and OpenXR
_MOST_BODIES = 60  # values of a key that are listed as bodies


@dataclass(frozen=True)
class _Table:
    """The lines of a file with the columns of its bodies; columns counted from 0."""

    cells: Cells
    header: list[str]  # empty when no line names the columns
    bodies: dict[str, dict[str, int]]  # body -> x y z qx qy qz qw -> column
    time: int | None
    units: list[str]
    notes: list[str]
    channels: dict[str, int] = field(default_factory=dict)
    by_episode: bool = False  # whether rows were chosen by the episode

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
        return sampling(len(self.cells.rows), stated, times=self._times, unit=self.clock())

    def _times(self) -> Array:
        assert self.time is not None
        read = None
        if clock_texts(self._clock_cells(2)) is not None:
            read = clock_texts(self._clock_cells(len(self.cells.rows)))
        if read is not None:
            return read[0]
        cells = replace(self.cells, advice=" Where times are no numbers, state the sampling rate in Hz: rate=100.")
        return cells.numbers([self.time], [self.called(self.time)])[:, 0]

    def _clock_cells(self, count: int) -> list[str]:
        place = self.time or 0
        return [cells[place].strip() if place < len(cells) else "" for _, cells in self.cells.rows[:count]]

    def clock(self) -> str | float | None:
        """Return the unit of the times: by their look, or by the name of their column."""
        assert self.time is not None
        named = self.unit("time_unit", [self.time])
        look = clock_texts(self._clock_cells(2))
        return look[1] if look is not None and (named is None or look[1] == "s") else named

    def unit(self, parameter: str, columns: list[int]) -> str | None:
        """Return the unit in the names of some columns, or in the line below them; None if there is none."""
        names, below = ([line[place] for place in columns if place < len(line)] for line in (self.header, self.units))
        return unit_of(parameter, names, below)

    def world(self, body: str, stated: Stated) -> World:
        """Return the units that the names of the columns say, where the caller does not."""
        length = [self.bodies[body][name] for name in POSITION]
        known = None if self.time is None or stated.time_unit is not None or stated.rate else self.clock()
        unit = self.unit("unit", length) or ("m" if "TCP_pose" in body else None)
        return World(
            unit=None if stated.unit is not None else unit, time_unit=known, up_axis=self.up_axis(body), handedness=None
        )

    def up_axis(self, body: str) -> Axis | None:
        """Return the axis that points up by the dialect of the names: Unity's and other headset logs' is y."""
        names = [self.header[place] for place in self.bodies[body].values() if place < len(self.header)]
        return "y" if len(names) > len(POSITION) and all(map(_HEADSET.fullmatch, names)) else None


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies that the column names or a key tell; "pose" for columns without a prefix."""
    table, keys = _table(path, stated)
    key = _body_key(table, keys)
    return key.values if key is not None else tuple(table.bodies)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return one body of a table."""
    table, keys = _table(path, stated)
    stated = _left_to_state(table, stated)
    table, body = _chosen(table, keys, body)
    where = table.bodies[body]
    turn = next((kind for kind in (ANGLES, VECTOR) if kind[0] in where), ())
    if stated.angle_unit is None and turn:
        unit = table.unit("angle_unit", [where[name] for name in turn])
        stated = replace(stated, angle_unit=unit)  # type: ignore[arg-type]  # another unit is refused below
    position, rotation, notes = pose(table.cells, where, table.called, stated)
    sampled = table.sampling(stated)
    notes = [*table.notes, *sampled.notes, *notes, *_told_up(table, body, stated), *_flagged(table, body)]
    world = table.world(body, stated)
    channels = {name: _channel(table, place) for name, place in table.channels.items()}
    del table, keys  # the text of a long table takes as much memory as its numbers
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=notes,
        world=world,
        channels=channels,
    )


def markers(path: Path, stated: Stated) -> Markers:
    """Return all positions of a table as markers: landmarks of a hand, say."""
    table, keys = _table(path, replace(stated, fixed_orientation=True))
    stated = _left_to_state(table, stated)
    for key in keys:
        raise key.not_chosen()
    called = [f"{axis} of {name!r}" for name in table.bodies for axis in POSITION]
    columns = [where[axis] for where in table.bodies.values() for axis in POSITION]
    cells = replace(table.cells, blank=True, nan=True)
    points = cells.numbers(columns, called).reshape(len(cells.rows), len(table.bodies), 3)
    points[np.isnan(points).any(axis=2)] = np.nan
    sampled = table.sampling(stated)
    return sampled.stated.marker_set(
        time=sampled.time,
        position=points,
        names=distinct(list(table.bodies)),
        source=path.name,
        notes=[*table.notes, *sampled.notes],
        world=table.world(next(iter(table.bodies)), stated),
    )


def _told_up(table: _Table, body: str, stated: Stated) -> list[Note]:
    if stated.up_axis is not None:
        return []
    if table.up_axis(body) is not None:
        return [Note("assumed", "taken: up_axis: y, as in logs of Unity, WebXR and OpenXR", about="up_axis")]
    if all(_HOT3D.match(table.header[place]) for place in table.bodies[body].values() if place < len(table.header)):
        return [Note("assumed", UP_OPEN, about="up_axis")]
    return []


def _flagged(table: _Table, body: str) -> list[Note]:
    return flag_notes(table.header, table.cells.rows, body, tuple(table.bodies))


def _channel(table: _Table, place: int) -> Array:
    cells = replace(table.cells, blank=True, nan=True)
    return cells.numbers([place], [table.called(place)])[:, 0]


def _body_key(table: _Table, keys: list[Key]) -> Key | None:
    """Return the key whose values are the bodies of a table of one pose."""
    alone = len(keys) == 1 and len(table.bodies) == 1 and len(keys[0].values) <= _MOST_BODIES
    return keys[0] if alone and not keys[0].of_takes else None


def _chosen(table: _Table, keys: list[Key], body: str | None) -> tuple[_Table, str]:
    """Return the table with the rows of one body, and what it is called.

    Raises
    ------
    NotStated
        Rows of several bodies or takes, and none was chosen.
    """
    key = _body_key(table, keys)
    if key is not None and body in key.values:
        rows, notes = rows_where(table.header, table.cells.rows, {key.name: body})
        cells = replace(table.cells, rows=rows)
        (where,) = table.bodies.values()
        return replace(table, cells=cells, bodies={str(body): where}, notes=[*table.notes, *notes]), str(body)
    for each in keys:
        raise each.not_chosen()
    return table, pick_body(body, tuple(table.bodies))


def _table(path: Path, stated: Stated) -> tuple[_Table, list[Key]]:
    """Return the table, its rows chosen by what was specified, and the keys that are left to choose by."""
    lines = table_lines(read_text(path), stated.delimiter, _skipped(stated.skip_lines))
    table = _read(lines, stated)
    if stated.where is not None:
        rows, notes = rows_where(lines.names, table.cells.rows, stated.where)
        table = replace(table, cells=replace(table.cells, rows=rows), notes=[*table.notes, *notes])
    used = [place for where in table.bodies.values() for place in where.values()]
    used += [] if table.time is None else [table.time]
    keys = keys_in(lines.names, table.cells.rows, used, table.time)
    takes = [key for key in keys if key.of_takes and str(stated.episode) in key.values]
    if stated.episode is not None and takes:
        rows, notes = rows_where(lines.names, table.cells.rows, {takes[0].name: stated.episode})
        table = replace(table, cells=replace(table.cells, rows=rows), notes=[*table.notes, *notes], by_episode=True)
        keys = [key for key in keys if key is not takes[0]]
    return table, keys


def _left_to_state(table: _Table, stated: Stated) -> Stated:
    """Return what was specified, with what the layout says of a rotation, without an episode that chose rows."""
    if stated.layout is not None:
        stated = layout_of(stated)[1]
    return stated.without("episode") if table.by_episode else stated


def _read(lines: TableLines, stated: Stated) -> _Table:
    columns = stated.columns
    if stated.layout is not None:
        layout, _ = layout_of(stated)
        return _Table(
            Cells(lines.rows),
            lines.names,
            {WHOLE: layout.where},
            layout.where.get("time"),
            [],
            lines.notes,
            layout.channels,
        )
    if isinstance(columns, Mapping) and all(isinstance(place, int) for place in columns.values()):
        where = stated_columns(columns, lambda stated: _place(stated, {}), bool(stated.fixed_orientation))
        return _Table(Cells(lines.rows), lines.names, {WHOLE: where}, where.get("time"), lines.units, lines.notes)
    if not lines.names:
        shape = from_shape(lines)
        if shape is None:
            raise nameless(lines)
        where, note = shape
        return _Table(Cells(lines.rows), [], {WHOLE: where}, where.get("time"), [], [*lines.notes, note])
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
    """Return the table under a header line, its columns specified by the caller or told by their names."""
    cells, header = Cells(lines.rows), lines.names
    if columns is not None:
        places = {name: place for place, name in enumerate(header)}
        where = stated_columns(columns, lambda stated: _place(stated, places), position_only)
        return _Table(cells, header, {WHOLE: where}, where.get("time"), lines.units, lines.notes)
    if twice := repeated(header):
        name, first, second = twice
        raise NotStated(
            "columns",
            f"columns: the name {name!r} stands twice in the header, in the columns {first} and {second} (from 0). "
            f"Specify "
            f"the columns by number: columns={{'time': ..., 'x': {first if name == 'x' else '...'}, ...}}.",
        )
    found = bodies_in(header) or (bodies_in(header, position_only=True) if position_only else {})
    if not found:
        raise bodyless(lines)
    times = times_in(header)
    if len(times) > 1:
        raise NotStated("columns", f"{len(times)} columns of time in the header {shown(header)}. State the columns.")
    time, notes = (times[0], []) if times else _first_as_time(lines)
    return _Table(cells, header, found, time, lines.units, [*lines.notes, *notes], _grippers(header))


def _first_as_time(lines: TableLines) -> tuple[int | None, list[str]]:
    """Return the first column as time where it has no name and increases in equal steps that are no row numbers."""
    if lines.names[0].strip() not in ("", "Unnamed: 0"):
        return None, []
    try:
        first = np.array([float(cells[0]) for _, cells in lines.rows])
    except (ValueError, IndexError):
        return None, []
    steps = np.diff(first)
    if len(first) < 3 or not (steps > 0.0).all() or np.ptp(steps) > 0.5 * np.median(steps) or (first % 1 == 0.0).all():
        return None, []
    step = float(np.median(steps))
    return 0, [
        Note(
            "assumed",
            f"taken: rate: the first column has no name and increases by {step:.4g}: taken as the times",
            about="rate",
        )
    ]


def _grippers(header: list[str]) -> dict[str, int]:
    return {name: place for place, name in enumerate(header) if "gripper" in name.lower()}


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
    if not lines.names and lines.rows and len(lines.rows[0][1]) == 12 and from_shape(lines) is not None:
        return True
    return bool(found) and not (lines.commented and lines.delimiter == " " and _is_tum(lines.names, found))


def _is_tum(header: list[str], found: dict[str, dict[str, int]]) -> bool:
    """Return whether a comment names the columns that every TUM file has, in their order and without other units."""
    order = [found.get(WHOLE, {}).get(what) for what in _TUM]
    units = {said.unit for said in map(column, header) if said is not None}
    return order == list(range(1, 8)) and times_in(header) == [0] and units <= {"", "m", "s"}


READER = Reader(
    name="table",
    summary="a CSV or TSV with a header line, or any table with specified columns",
    takes=(
        "columns",
        "layout",
        "where",
        "delimiter",
        "skip_lines",
        "fixed_orientation",
        "rotation",
        "quat_order",
        "euler_order",
        "angle_unit",
        *COMMON,
    ),
    recognises=_recognises,
    bodies=bodies,
    read=read,
    markers=markers,
)
