"""Vicon CSV: the markers of the section "Trajectories", the poses of "Segments" and of tracked "Objects".

Source: Vicon Nexus and Tracker documentation, "Export data to CSV", and their exports. A section is its name, the rate
in Hz, the names, the columns (Frame, Sub Frame, then X, Y, Z of a marker or RX, RY, RZ, TX, TY, TZ of a body), their
units and the data, up to a blank line. Empty cells were not seen. RX, RY, RZ are a rotation vector unless the export
was set otherwise, which the file does not say.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path

import numpy as np
from dmpcpp._text import Cells, Row, number, read_text, split_all
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._reader import COMMON, Reader, no_orientation, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._representation import ANGLES, QUATERNION, oriented
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import LENGTH_UNITS, World

__all__ = ["READER"]

_MARKERS = "Trajectories"
_BODIES = ("Segments", "Objects", "Global Angle (Quaternion)")
_SECTIONS = (_MARKERS, "Devices", "Joints", "Segments", "Model Outputs", "Events", "Objects", "Global")
_SHIFT = ("TX", "TY", "TZ")
_TURNS = {("RX", "RY", "RZ"): ANGLES, ("RX", "RY", "RZ", "RW"): QUATERNION}


@dataclass(frozen=True)
class _Section:
    """One section of a file; columns counted from 0."""

    rate: float
    names: list[str]
    columns: list[str]
    units: list[str]
    cells: Cells

    def times(self) -> Array:
        """Return the times [s] by the frame numbers; subframes lie between them."""
        frames = self.cells.numbers([0], ["Frame"])[:, 0]
        return (frames - frames[0]) / self.rate

    def named(self, first: int) -> str:
        """Return the name above a column."""
        return self.names[first] if first < len(self.names) else ""

    def unit(self, columns: list[int]) -> str:
        found = {self.units[k].strip() if k < len(self.units) else "" for k in columns}
        return found.pop() if len(found) == 1 else ""

    def length_unit(self, columns: list[int]) -> str:
        unit = self.unit(columns)
        if unit in LENGTH_UNITS:
            return unit
        raise NotStated("unit", f"unit: the columns say {unit!r}. State unit='mm' or another.")

    def bodies(self) -> dict[str, dict[str, int]]:
        """Return the bodies with the columns of what they hold."""
        starts = [k for k, cell in enumerate(self.columns) if cell == "RX"]
        ends = [*starts[1:], len(self.columns)][: len(starts)]
        named = dict(zip(distinct([self.named(k) for k in starts]), zip(starts, ends, strict=True), strict=True))
        held = {name: {self.columns[k]: k for k in reversed(range(*span))} for name, span in named.items()}
        return {
            name: where for name, where in held.items() if all(axis in where for axis in ("RX", "RY", "RZ", *_SHIFT))
        }


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the segments and objects."""
    found = _bodies(_sections(path))
    if not found:
        markers(path, stated)
    return tuple(found)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return one segment or object; a name may leave out the subject in front of it."""
    sections = _sections(path)
    held = _bodies(sections)
    if not held:
        raise no_orientation(markers(path, stated).names)
    body = pick_body(_whole(body, tuple(held)), tuple(held))
    section, where = held[body]
    turn = tuple(name for name in ("RX", "RY", "RZ", "RW") if name in where)
    columns = [where[name] for name in (*_SHIFT, *turn)]
    values = Cells(section.cells.rows, blank=True).numbers(
        columns, [f"{name} of {body!r}" for name in (*_SHIFT, *turn)]
    )
    lost = np.isnan(values).any(axis=1)
    if stated.angle_unit is None:
        stated = replace(stated, angle_unit=_angle_unit(section.unit([where[name] for name in turn])))
    rotation, notes = oriented(values[:, 3:], _TURNS[turn], stated, lost)
    return stated.recording(
        time=section.times(),
        position=np.where(lost[:, None], np.nan, values[:, :3]),
        rotation=rotation,
        body=body,
        source=path.name,
        notes=notes,
        world=World(unit=None if stated.unit is not None else section.length_unit(columns[:3]), time_unit="s"),
    )


def markers(path: Path, stated: Stated) -> Markers:
    """Return the markers of the section "Trajectories"."""
    sections = _sections(path)
    section = sections.get(_MARKERS)
    if section is None:
        raise _no_markers(_heads(path))
    starts = [k for k, cell in enumerate(section.columns) if cell.upper() == "X"]
    names = distinct([section.named(k) for k in starts])
    if not names:
        raise InvalidArgument(f"the section {_MARKERS} has no columns X, Y, Z.")
    return stated.marker_set(
        time=section.times(),
        position=Cells(section.cells.rows, blank=True).points(starts, names),
        names=names,
        source=path.name,
        notes=[],
        world=World(unit=None if stated.unit is not None else section.length_unit(starts), time_unit="s"),
    )


def _bodies(sections: dict[str, _Section]) -> dict[str, tuple[_Section, dict[str, int]]]:
    """Return the bodies of all sections that hold some, the first of a name counts."""
    found: dict[str, tuple[_Section, dict[str, int]]] = {}
    for section in (section for name, section in sections.items() if name in _BODIES):
        for body, where in section.bodies().items():
            found.setdefault(body, (section, where))
    return found


def _whole(body: str | None, held: tuple[str, ...]) -> str | None:
    """Return the only name that a name without its subject can mean; else the name as it is."""
    ending = [name for name in held if name.endswith(f":{body}")]
    return ending[0] if body not in held and len(ending) == 1 else body


def _angle_unit(unit: str) -> str | None:
    return unit if unit in ("deg", "rad") else None


def _sections(path: Path) -> dict[str, _Section]:
    """Return the sections of a file that hold frames, by name."""
    rows = _rows(path)
    wanted = {name: k for name, k in reversed(_begins(rows)) if name in (_MARKERS, *_BODIES)}  # the first of a name
    if not wanted:
        raise _no_markers(_heads(path))
    return {name: _section(rows, k) for name, k in wanted.items()}


def _rows(path: Path) -> list[Row]:
    lines = [(k, line.strip("\r")) for k, line in enumerate(read_text(path).split("\n"), start=1)]
    return split_all(lines, "\t" if any("\t" in text for _, text in lines[:8]) else ",")


def _begins(rows: list[Row]) -> list[tuple[str, int]]:
    """Return the sections in the order of the file, with the rows at which they begin."""
    heads = [(cells[0].strip(), k) for k, (_, cells) in enumerate(rows) if not "".join(cells[1:]).strip()]
    return [(name, k) for name, k in heads if name in _SECTIONS]


def _heads(path: Path) -> list[str]:
    return [name for name, _ in _begins(_rows(path))]


def _no_markers(heads: list[str]) -> InvalidArgument:
    held = ", ".join(heads) or "none that is known"
    return InvalidArgument(f"no section {_MARKERS!r}, the markers. Sections: {held}. Export the trajectories.")


def _section(rows: list[Row], begin: int) -> _Section:
    first = begin + 5
    if len(rows) <= first:
        raise InvalidArgument(
            f"line {len(rows)}: the file ends in the head of the section {rows[begin][1][0].strip()}."
        )
    (line, (rate, *_)), (_, names), (_, columns), (_, units) = rows[begin + 1 : first]
    data = list(takewhile(lambda row: "".join(row[1]).strip(), rows[first:]))
    frequency = number(rate, line, "rate")
    if not 0.0 < frequency < 1e6 or not data:
        raise InvalidArgument(f"line {line}: {frequency:g} Hz and {len(data)} frames, expected more than 0 of both.")
    return _Section(frequency, _stripped(names), _stripped(columns), units, Cells(data))


def _stripped(cells: list[str]) -> list[str]:
    return [cell.strip() for cell in cells]


def _recognises(path: Path, head: bytes) -> bool:
    first = head.lstrip(b"\xef\xbb\xbf").split(b"\n", 1)[0].strip(b"\r,\t ")
    return first.decode("latin-1") in _SECTIONS


READER = Reader(
    name="vicon",
    summary="a Vicon CSV of trajectories (markers), segments or objects",
    takes=("fixed_orientation", "rotation", "euler_order", "angle_unit", *COMMON),
    recognises=_recognises,
    bodies=bodies,
    read=read,
    markers=markers,
)
