"""OptiTrack Motive CSV: rigid bodies, skeleton bones and markers.

Source: OptiTrack documentation, "Data Export: CSV". The first line holds pairs of name and value; the lines headed
Type, Name, ID and the two above the data say what each column is. Rotations stand before positions; empty cells
are lost samples. The file does not say which axis is up: the export dialogue lets one choose, Motive's own is y.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

import numpy as np
from dmpcpp._text import Cells, Row, data_lines, read_text, split_all
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._orientation import from_quaternions
from dmpcpp.recordings._reader import COMMON, Reader, no_orientation, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER"]

_UNITS: dict[str, str | float] = {
    "Meters": "m",
    "Centimeters": "cm",
    "Millimeters": "mm",
    "Inches": 0.0254,
    "Feet": 0.3048,
}
_BODY_TYPES = ("Rigid Body", "Bone")
_MARKER_TYPES = ("Marker", "Rigid Body Marker", "Bone Marker", "Marker Set Marker")
_POSITION = (("Position", "X"), ("Position", "Y"), ("Position", "Z"))
_ROTATION = (("Rotation", "X"), ("Rotation", "Y"), ("Rotation", "Z"), ("Rotation", "W"))


@dataclass(frozen=True)
class _File:
    """A file's first line, its data, and the column of each quantity of each body and marker."""

    facts: dict[str, str]
    cells: Cells
    time: int
    bodies: dict[str, dict[tuple[str, str], int]]
    markers: dict[str, dict[tuple[str, str], int]]

    def times(self) -> Array:
        return self.cells.numbers([self.time], ["Time"])[:, 0]

    def world(self) -> World:
        unit = self.facts.get("Length Units", "")
        if unit not in _UNITS:
            raise NotStated("unit", f"Length Units is {unit!r}, expected one of {', '.join(_UNITS)}. State unit=...")
        return World(unit=_UNITS[unit], time_unit="s")


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the rigid bodies and bones."""
    return tuple(_read(path).bodies)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return one rigid body or bone."""
    file = _read(path)
    if not file.bodies:
        raise no_orientation(tuple(file.markers))
    body = pick_body(body, tuple(file.bodies))
    _check_facts(file.facts)
    where = file.bodies[body]
    wanted = (*_POSITION, *_ROTATION)
    values = file.cells.numbers([where[key] for key in wanted], [f"{what} {axis} of {body!r}" for what, axis in wanted])
    lost = np.isnan(values).any(axis=1)
    rotation, notes = from_quaternions(values[:, 3:], stated.quat_order or "xyzw", missing=lost)
    return stated.recording(
        time=file.times(),
        position=np.where(lost[:, None], np.nan, values[:, :3]),
        rotation=rotation,
        body=body,
        source=path.name,
        notes=notes,
        world=World() if stated.unit is not None else file.world(),
    )


def markers(path: Path, stated: Stated) -> Markers:
    """Return all markers."""
    file = _read(path)
    if not file.markers:
        raise InvalidArgument(f"markers: the file holds none, but the bodies {', '.join(file.bodies) or 'none'}.")
    columns = [where[key] for where in file.markers.values() for key in _POSITION]
    names = tuple(file.markers)
    called = [f"{axis} of {name!r}" for name in names for _, axis in _POSITION]
    points = file.cells.numbers(columns, called).reshape(len(file.cells.rows), len(names), 3)
    points[np.isnan(points).any(axis=2)] = np.nan
    world = World() if stated.unit is not None else file.world()
    return stated.marker_set(time=file.times(), position=points, names=names, source=path.name, notes=[], world=world)


def _check_facts(facts: dict[str, str]) -> None:
    for fact, expected in (("Rotation Type", "Quaternion"), ("Coordinate Space", "Global")):
        if facts.get(fact) != expected:
            raise InvalidArgument(f"{fact} is {facts.get(fact, 'not there')!r}. Export again with {fact} {expected}.")


def _read(path: Path) -> _File:
    rows = split_all(data_lines(read_text(path)), ",")
    first = [cell.strip() for cell in rows[0][1]] if rows else []
    facts = dict(zip(first[::2], first[1::2], strict=False))
    head, data = _headed(rows[1:])
    if not data:
        raise InvalidArgument("a Motive header without lines of data.")
    axes = head["Frame"]
    time = next((k for k, cell in enumerate(axes) if cell.startswith("Time")), None)
    if time is None:
        raise InvalidArgument("no column of times behind Frame.")
    found = _columns(head["Type"], head["Name"], head.get("ID", []), head["quantity"], axes)
    bodies = _whole(found, _BODY_TYPES, (*_POSITION, *_ROTATION))
    return _File(facts, Cells(data, blank=True), time, bodies, _whole(found, _MARKER_TYPES, _POSITION))


def _headed(rows: list[Row]) -> tuple[dict[str, list[str]], list[Row]]:
    """Return the lines above the data by what heads them, and the lines of data."""
    above = list(takewhile(lambda row: row[1][0].strip() != "Frame", rows))
    head: dict[str, list[str]] = {"quantity": [], **{_label(cells): cells for cells in map(_stripped, above)}}
    if len(above) < len(rows):
        head["Frame"] = _stripped(rows[len(above)])
    missing = [name for name in ("Type", "Name", "Frame") if name not in head]
    if missing:
        raise InvalidArgument(f"no line headed {' or '.join(missing)}. Export again with the header.")
    return head, rows[len(above) + 1 :]


def _stripped(row: Row) -> list[str]:
    return [cell.strip() for cell in row[1]]


def _label(cells: list[str]) -> str:
    """Return what heads a line; the line of Rotation and Position has no head."""
    if "Position" in cells or "Rotation" in cells:
        return "quantity"
    return next((cell for cell in cells[:3] if cell), "")


def _columns(
    types: list[str], names: list[str], ids: list[str], quantities: list[str], axes: list[str]
) -> dict[tuple[str, str, str], dict[tuple[str, str], int]]:
    """Return what is in the columns: (type, name, ID) -> (quantity, axis) -> column."""
    found: dict[tuple[str, str, str], dict[tuple[str, str], int]] = {}
    for column in range(min(len(types), len(names), len(quantities), len(axes))):
        identity = ids[column] if column < len(ids) else ""
        thing = found.setdefault((types[column], names[column], identity), {})
        thing.setdefault((quantities[column], axes[column]), column)
    return found


def _whole(
    found: dict[tuple[str, str, str], dict[tuple[str, str], int]],
    kinds: tuple[str, ...],
    wanted: tuple[tuple[str, str], ...],
) -> dict[str, dict[tuple[str, str], int]]:
    """Return the things of some types that have all columns that are wanted, by name."""
    kept = [
        (name, where) for (kind, name, _), where in found.items() if kind in kinds and all(w in where for w in wanted)
    ]
    return dict(zip(distinct([name for name, _ in kept]), (where for _, where in kept), strict=True))


READER = Reader(
    name="motive",
    summary="an OptiTrack Motive CSV of rigid bodies, bones or markers",
    takes=("fixed_orientation", "quat_order", "rotation", *COMMON),
    recognises=lambda path, head: head.lstrip(b"\xef\xbb\xbf").startswith(b"Format Version,"),
    bodies=bodies,
    read=read,
    markers=markers,
)
