"""OpenSim motion files (.mot, .sto): columns of a model's coordinates against time, s, m, degrees or radians.

Source: OpenSim documentation, "Motion (.mot) files" and "Storage (.sto) files". Coordinates are joint angles of a model
that is not in the file; a body's pose can be read where six of them are its translation and its rotation (a pelvis, an
object): the caller states which, and the order of the rotations.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from dmpcpp._notes import Note
from dmpcpp._text import Cells, Row, read_text, split_all
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._pose_columns import pose, stated_columns
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER"]

_BODY = "pose"
_END = "endheader"


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return "pose" once the columns are stated; until then the file holds no bodies, and the error says why."""
    _columns(_read(path)[1], stated)
    return (_BODY,)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the body whose coordinates the caller names."""
    facts, (line, header), rows = _read(path)
    where = _columns((line, header), stated)
    body = pick_body(body, (_BODY,))
    time = header.index("time") if "time" in header else None
    time = where.get("time", time)
    if time is None:
        raise InvalidArgument(f"line {line}: no column 'time'.")
    if stated.angle_unit is None and facts.get("indegrees") in ("yes", "no"):
        stated = replace(stated, angle_unit="deg" if facts["indegrees"] == "yes" else "rad")
    cells = Cells(rows)
    position, rotation, notes = pose(cells, where, lambda column: f"column {header[column]!r}", stated)
    return stated.recording(
        time=cells.numbers([time], ["time"])[:, 0],
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*_notes(facts, len(rows)), *notes],
        world=World(unit="m", time_unit="s"),
    )


def _read(path: Path) -> tuple[dict[str, str], tuple[int, list[str]], list[Row]]:
    """Return the facts of the header in lower case, the line of column names and the lines of data."""
    lines = [(k, line.strip("\r")) for k, line in enumerate(read_text(path).split("\n"), start=1)]
    end = next((k for k, (_, text) in enumerate(lines) if _ends_header(text)), None)
    if end is None:
        raise InvalidArgument(f"no line {_END!r}: the header of a MOT or STO file ends with it.")
    filled = [line for line in lines[end + 1 :] if line[1].strip(", \t")]
    if len(filled) < 2:
        raise InvalidArgument(f"no column names and data behind {_END!r}.")
    delimiter = next((candidate for candidate in "\t," if candidate in filled[0][1]), " ")
    (line, header), *rows = split_all(filled, delimiter)
    return _facts(lines[:end]), (line, [cell.strip() for cell in header]), rows


def _ends_header(text: str) -> bool:
    return text.strip(", \t").lower() == _END


def _facts(lines: list[tuple[int, str]]) -> dict[str, str]:
    pairs = [text.strip(", \t").partition("=") for _, text in lines]
    return {name.strip().lower(): value.strip().lower() for name, equals, value in pairs if equals}


def _columns(row: tuple[int, list[str]], stated: Stated) -> dict[str, int]:
    _, header = row
    held = ", ".join(name for name in header if name)
    if stated.columns is None:
        raise NotStated(
            "columns",
            "columns: coordinates of a model's joints, not poses of bodies. Where six of them place a body, state "
            f"columns={{'x': ..., 'y': ..., 'z': ..., 'rx': ..., 'ry': ..., 'rz': ...}}. The file holds: {held}.",
        )

    def place(column: object) -> int:
        if column in header:
            return header.index(str(column))
        raise InvalidArgument(f"columns: no column {column!r}. The file holds: {held}.")

    return stated_columns(stated.columns, place, bool(stated.fixed_orientation))


def _notes(facts: dict[str, str], count: int) -> list[str]:
    announced = facts.get("nrows", "")
    if announced.isdigit() and int(announced) != count:
        return [Note("warning", f"the header announces {announced} rows, the file holds {count}")]
    return []


def _recognises(path: Path, head: bytes) -> bool:
    return path.suffix.lower() in (".mot", ".sto") or b"\n" + _END.encode() in head[:4096]


READER = Reader(
    name="opensim",
    summary="an OpenSim .mot or .sto of coordinates",
    takes=("columns", "euler_order", "angle_unit", "missing", "fixed_orientation", *COMMON),
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
