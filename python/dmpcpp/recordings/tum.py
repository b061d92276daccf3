"""TUM trajectories: lines of `t tx ty tz qx qy qz qw` in s and m, `#` before a comment.

Source: J. Sturm et al., A benchmark for the evaluation of RGB-D SLAM systems, IROS 2012.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings.orientation import from_quaternions
from dmpcpp.recordings.reader import AXES, Reader, pick_body
from dmpcpp.recordings.recording import Array, Recording
from dmpcpp.recordings.stated import Stated
from dmpcpp.recordings.text import data_lines, number, read_text
from dmpcpp.recordings.world import World

__all__ = ["READER", "bodies", "read"]

_COLUMNS = ("t", "tx", "ty", "tz", "qx", "qy", "qz", "qw")
_BODY = "pose"


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the one body of a TUM file, "pose"."""
    _rows(path)
    return (_BODY,)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the trajectory; the format says s and m, but not which axis is up."""
    body = pick_body(body, (_BODY,))
    rows = _rows(path)
    rotation, notes = from_quaternions(rows[:, 4:8], "xyzw")
    return stated.recording(
        time=rows[:, 0],
        position=rows[:, 1:4],
        rotation=rotation,
        body=body,
        source=path.name,
        notes=notes,
        world=World(unit="m", time_unit="s"),
    )


def _rows(path: Path) -> Array:
    rows = []
    for line, text in data_lines(read_text(path)):
        cells = text.split()
        if len(cells) != len(_COLUMNS):
            raise InvalidArgument(f"line {line}: {len(cells)} columns, expected 8: {' '.join(_COLUMNS)}.")
        rows.append([number(cell, line, name) for cell, name in zip(cells, _COLUMNS, strict=True)])
    if not rows:
        raise InvalidArgument(f"no lines of data, expected {' '.join(_COLUMNS)}.")
    return np.array(rows)


def _recognises(path: Path, head: bytes) -> bool:
    """Return whether the first line of data is eight numbers between blanks, outside a .csv or .tsv."""
    if path.suffix.lower() in (".csv", ".tsv"):
        return False
    lines = [line for line in head.split(b"\n") if line.strip() and not line.lstrip().startswith(b"#")]
    cells = lines[0].split() if lines else []
    return len(cells) == len(_COLUMNS) and all(_is_number(cell) for cell in cells)


def _is_number(cell: bytes) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


READER = Reader(
    name="tum",
    summary="a TUM trajectory: lines of t tx ty tz qx qy qz qw, s and m",
    takes=AXES,
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
