"""TUM trajectories: lines of `t tx ty tz qx qy qz qw` in s and m, `#` before a comment.

Source: J. Sturm et al., A benchmark for the evaluation of RGB-D SLAM systems, IROS 2012.
"""

from __future__ import annotations

from pathlib import Path

from dmpcpp._text import Cells, data_lines, read_text, split_all
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._orientation import QuatOrder
from dmpcpp.recordings._pose_columns import pose
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "bodies", "read"]

_COLUMNS = ("t", "tx", "ty", "tz", "qx", "qy", "qz", "qw")
_BODY = "pose"


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the one body of a TUM file, "pose"."""
    _cells(path)
    return (_BODY,)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the trajectory; the format says s and m, but not which axis is up."""
    body = pick_body(body, (_BODY,))
    cells = _cells(path)
    order, told = stated.order("xyzw")
    position, rotation, notes = pose(cells, _where(order), _COLUMNS.__getitem__, stated)
    return stated.recording(
        time=cells.numbers([0], ["t"])[:, 0],
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*told, *notes],
        world=World(unit="m", time_unit="s"),
    )


def _where(order: QuatOrder) -> dict[str, int]:
    """Return the columns by what they hold, the quaternion in an order."""
    return {"x": 1, "y": 2, "z": 3, **{f"q{part}": 4 + k for k, part in enumerate(order)}}


def _cells(path: Path) -> Cells:
    rows = split_all(data_lines(read_text(path)), " ")
    for line, cells in rows:
        if len(cells) != len(_COLUMNS):
            raise InvalidArgument(f"line {line}: {len(cells)} columns, expected 8: {' '.join(_COLUMNS)}.")
    if not rows:
        raise InvalidArgument(f"no lines of data, expected {' '.join(_COLUMNS)}.")
    return Cells(rows)


def _recognises(path: Path, head: bytes) -> bool:
    """Return whether the first line of data is eight numbers between blanks, outside a .csv or .tsv."""
    if path.suffix.lower() in (".csv", ".tsv"):
        return False
    text = head.removeprefix(b"\xef\xbb\xbf")
    lines = [line for line in text.split(b"\n") if line.strip() and not line.lstrip().startswith(b"#")]
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
    takes=("quat_order", "rotation", *COMMON),
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
