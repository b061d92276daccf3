"""EuRoC CSV: lines of `timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z, ..` in ns and m, under a `#` line of names.

Source: M. Burri et al., The EuRoC micro aerial vehicle datasets, Int. J. Robotics Research 35 (2016).
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from dmpcpp._text import Cells, Row, data_lines, read_text, split, split_all
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._orientation import from_quaternions
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER"]

_BODY = "pose"
_COLUMN = re.compile(r"(?P<what>[pq])_(?:\w+_)?(?P<axis>[wxyz])\b.*")
_WANTED = ("px", "py", "pz", "qw", "qx", "qy", "qz")
_HEAD = re.compile(rb"(?:\xef\xbb\xbf)?#\s*timestamp[^\n]*,\s*p_", re.IGNORECASE)


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the one body of the file, "pose"."""
    _read(path)
    return (_BODY,)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the trajectory."""
    body = pick_body(body, (_BODY,))
    where, cells = _read(path)
    values = cells.numbers([where[name] for name in _WANTED], list(_WANTED))
    rotation, notes = from_quaternions(values[:, 3:], stated.quat_order or "wxyz")
    time, start = _times(cells.rows)
    return stated.recording(
        time=time,
        position=values[:, :3],
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*notes, f"time counted from the first sample at {start} ns"],
        world=World(unit="m", time_unit="ns"),
    )


def _read(path: Path) -> tuple[dict[str, int], Cells]:
    text = read_text(path)
    header = split(text.split("\n", 1)[0].lstrip("#"), ",", 1)
    where: dict[str, int] = {}
    for column, cell in enumerate(header):
        match = _COLUMN.fullmatch(cell.strip())
        if match:
            where.setdefault(match["what"] + match["axis"], column)
    missing = [name for name in _WANTED if name not in where]
    if missing:
        raise InvalidArgument(f"line 1: no column for {', '.join(missing)} among {', '.join(header)[:200]}.")
    rows = split_all(data_lines(text), ",")
    if not rows:
        raise InvalidArgument("no lines of data.")
    return where, Cells(rows)


def _times(rows: list[Row]) -> tuple[Array, int]:
    """Return the times [ns] from the first, and the first; whole numbers, as a double is short of an epoch in ns."""
    stamps = []
    for line, cells in rows:
        try:
            stamps.append(int(cells[0]))
        except ValueError:
            raise InvalidArgument(
                f"line {line}, timestamp: {cells[0][:20]!r}, expected a whole number of ns."
            ) from None
    try:
        return np.array([float(stamp - stamps[0]) for stamp in stamps]), stamps[0]
    except OverflowError:
        raise InvalidArgument("timestamp: numbers too large for times in ns.") from None


READER = Reader(
    name="euroc",
    summary="a EuRoC CSV: timestamp, p_x .. q_z, ns and m",
    takes=("quat_order", "rotation", *COMMON),
    recognises=lambda path, head: bool(_HEAD.match(head)),
    bodies=bodies,
    read=read,
)
