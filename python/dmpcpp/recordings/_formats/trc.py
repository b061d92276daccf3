"""Track Row Column (.trc): markers with their unit and times, as OpenSim, Motive and Cortex write them.

Source: OpenSim documentation, "Marker (.trc) files". Three lines of facts, a line of marker names and one of columns,
then the data behind frame number and time, between tabs or commas; empty cells are markers that were not seen.
"""

from __future__ import annotations

from pathlib import Path

from dmpcpp._notes import Note
from dmpcpp._text import Cells, Row, data_lines, read_text, split_all
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._reader import marker_reader
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import LENGTH_UNITS, World

__all__ = ["READER"]


def markers(path: Path, stated: Stated) -> Markers:
    """Return the markers."""
    rows = _rows(path)
    facts = dict(zip(_stripped(rows[1]), _stripped(rows[2]), strict=False))
    names = _names(_stripped(rows[3]), _stripped(rows[4]), rows[3][0])
    cells = Cells(rows[5:], blank=True, nan=True)
    starts = [2 + 3 * k for k in range(len(names))]
    return stated.marker_set(
        time=cells.numbers([1], ["Time"])[:, 0],
        position=cells.points(starts, names),
        names=names,
        source=path.name,
        notes=_notes(facts, len(cells.rows)),
        world=World(unit=None if stated.unit is not None else _unit(facts), time_unit="s"),
    )


def _rows(path: Path) -> list[Row]:
    """Return the lines that hold more than separators."""
    lines = list(data_lines(read_text(path), comment="//"))
    delimiter = "\t" if any("\t" in text for _, text in lines[:5]) else ","  # the first line may have blanks
    rows = [row for row in split_all(lines, delimiter) if any(cell.strip() for cell in row[1])]
    if len(rows) < 6:
        raise InvalidArgument(f"{len(rows)} lines, expected five of a TRC header and then data.")
    return rows


def _stripped(row: Row) -> list[str]:
    return [cell.strip() for cell in row[1]]


def _names(heads: list[str], columns: list[str], line: int) -> tuple[str, ...]:
    count = sum(1 for cell in columns if cell) // 3
    if heads[0] != "Frame#" or count == 0:
        raise InvalidArgument(f"line {line}: {heads[0]!r}, expected Frame#, Time and the markers, and X1 Y1 Z1 below.")
    names = heads[2 : 2 + 3 * count : 3]
    if len(names) != count or not all(names):
        raise InvalidArgument(f"line {line}: {count} markers by the columns below, but not as many names above them.")
    return distinct(names)


def _notes(facts: dict[str, str], count: int) -> list[str]:
    announced = facts.get("NumFrames", "")
    if announced.isdigit() and int(announced) != count:
        return [Note("warning", f"the header announces {announced} frames, the file holds {count}")]
    return []


def _unit(facts: dict[str, str]) -> str:
    unit = facts.get("Units", "")
    if unit not in LENGTH_UNITS:
        raise NotStated("unit", f"Units is {unit!r}, expected one of {', '.join(LENGTH_UNITS)}. State unit=...")
    return unit


READER = marker_reader(
    name="trc",
    summary="a TRC file of markers",
    recognises=lambda path, head: head.lstrip(b"\xef\xbb\xbf").startswith(b"PathFileType"),
    markers=markers,
)
