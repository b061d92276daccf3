"""Vicon Nexus CSV: the section "Trajectories", markers with their unit and rate.

Source: Vicon Nexus documentation, "Export data to CSV", and its exports. A section is its name, the rate in Hz, the
names of the markers, the columns (Frame, Sub Frame, X, Y, Z, ..), their units and the data, up to a blank line. Empty
cells are markers that were not seen.
"""

from __future__ import annotations

from itertools import takewhile
from pathlib import Path

from dmpcpp._text import Cells, Row, number, read_text, split_all
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._reader import marker_reader
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import LENGTH_UNITS, World

__all__ = ["READER"]

_SECTION = "Trajectories"
_SECTIONS = (_SECTION, "Devices", "Joints", "Segments", "Model Outputs", "Events", "Objects", "Global")


def markers(path: Path, stated: Stated) -> Markers:
    """Return the markers of the section "Trajectories"."""
    rate, names_row, columns, units, data = _section(path)
    starts = [k for k, cell in enumerate(columns) if cell.strip().upper() == "X"]
    names = distinct([names_row[k] if k < len(names_row) else "" for k in starts])
    if not names:
        raise InvalidArgument(f"the section {_SECTION} has no columns X, Y, Z.")
    cells = Cells(data, blank=True)
    frames = cells.numbers([0], ["Frame"])[:, 0]
    return stated.marker_set(
        time=(frames - frames[0]) / rate,
        position=cells.points(starts, names),
        names=names,
        source=path.name,
        notes=[],
        world=World(unit=None if stated.unit is not None else _unit(units, starts), time_unit="s"),
    )


def _section(path: Path) -> tuple[float, list[str], list[str], list[str], list[Row]]:
    """Return rate, names, columns, units and data of the section of markers."""
    lines = [(k, line.strip("\r")) for k, line in enumerate(read_text(path).split("\n"), start=1)]
    delimiter = "\t" if any("\t" in text for _, text in lines[:8]) else ","
    rows = split_all(lines, delimiter)
    begin = _begin([cells[0].strip() for _, cells in rows])
    first = begin + 5
    if len(rows) <= first:
        raise InvalidArgument(f"line {len(rows)}: the file ends in the head of the section {_SECTION}.")
    (line, (rate, *_)), (_, names), (_, columns), (_, units) = rows[begin + 1 : first]
    data = list(takewhile(lambda row: "".join(row[1]).strip(), rows[first:]))
    frequency = number(rate, line, "rate")
    if not 0.0 < frequency < 1e6 or not data:
        raise InvalidArgument(f"line {line}: {frequency:g} Hz and {len(data)} frames, expected more than 0 of both.")
    return frequency, names, columns, units, data


def _begin(heads: list[str]) -> int:
    """Return the row at which the section of markers begins."""
    if _SECTION not in heads:
        held = ", ".join(head for head in heads if head in _SECTIONS) or "none that is known"
        raise InvalidArgument(f"no section {_SECTION!r}, the markers. Sections: {held}. Export the trajectories.")
    return heads.index(_SECTION)


def _unit(units: list[str], starts: list[int]) -> str:
    found = {units[k].strip() if k < len(units) else "" for k in starts}
    if len(found) == 1 and found <= set(LENGTH_UNITS):
        return found.pop()
    raise NotStated("unit", f"unit: the columns say {', '.join(map(repr, sorted(found)))}. State unit='mm' or another.")


def _recognises(path: Path, head: bytes) -> bool:
    first = head.lstrip(b"\xef\xbb\xbf").split(b"\n", 1)[0].strip(b"\r,\t ")
    return first.decode("latin-1") in _SECTIONS


READER = marker_reader(
    name="vicon",
    summary="a Vicon Nexus CSV of trajectories (markers)",
    recognises=_recognises,
    markers=markers,
)
