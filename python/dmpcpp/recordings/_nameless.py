"""Tables of which no line names the columns, or none that is known: what their shape says, and what to specify."""

from __future__ import annotations

import numpy as np

from dmpcpp._notes import Note
from dmpcpp._text import Cells
from dmpcpp._typing import Array
from dmpcpp.errors import NotStated
from dmpcpp.recordings._columns import bodies_in
from dmpcpp.recordings._layout import layout_of
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._table_lines import TableLines, shown

__all__ = ["bodyless", "from_shape", "nameless"]

_LOOKED_AT = 200  # rows
_UNIT = 1e-3  # of the norm of four printed numbers, and of a matrix's rows


def from_shape(lines: TableLines) -> tuple[dict[str, int], str] | None:
    """Return the columns of a table without names whose numbers can be one thing only, and a note; else None.

    Twelve numbers a line that are rotation matrices with a last column are a KITTI trajectory; eight numbers with
    increasing first ones and unit quaternions behind are a TUM trajectory, whose order x y z w is told.
    """
    width = len(lines.rows[0][1])
    if width == 12 and _are_rotations(_numbers(lines, width), (0, 1, 2, 4, 5, 6, 8, 9, 10)):
        return layout_of(Stated(layout="mat12"))[0].where, "KITTI: twelve numbers a line taken as 3 x 4 matrices"
    if width == 8 and _is_tum(_numbers(lines, width)):
        where = layout_of(Stated(layout="time,x,y,z,quat_xyzw"))[0].where
        said = "taken: quat_order: xyzw, the order of a TUM trajectory (no line names the columns)"
        return where, Note("assumed", said, about="quat_order")
    return None


def nameless(lines: TableLines) -> NotStated:
    """Return the error for a table of which no line names the columns, with what its shape suggests."""
    line, cells = lines.rows[0]
    width = len(cells)
    return NotStated(
        ("layout", "columns"),
        f"line {line}: {width} numbers and no line above that names them.{_suggestion(lines, width)} Specify what each "
        "column holds: layout='time,x,y,z,quat_xyzw' for instance, or the columns by number from 0: "
        "columns={'time': 0, "
        "'x': 1, ..., 'qw': 7}.",
    )


def bodyless(lines: TableLines) -> NotStated:
    """Return the error for a header without a whole pose, and the way out."""
    header = lines.names
    held = tuple(bodies_in(header, position_only=True))
    if held:
        several = f" or three markers on one rigid body: markers=['{held[0]}', ...]," if len(held) > 2 else ""
        return NotStated(
            ("fixed_orientation", "columns"),
            f"{''.join(f'{note}. ' for note in lines.notes)}the columns of {', '.join(held[:5])} hold a position "
            f"and no orientation in the header {shown(header)}. "
            f"State fixed_orientation=True to hold the tool's fixed,{several} or the columns: columns={{'time': ..., "
            f"'x': ..., 'y': ..., 'z': ..., 'qx': ..., ...}}.",
        )
    return NotStated(
        "columns",
        f"no body with columns x y z qx qy qz qw in the header {shown(header)}. State the columns by name, "
        "columns={'time': ..., 'x': ..., ..., 'qw': ...}, or skip_lines=N where the header stands N lines below.",
    )


def _suggestion(lines: TableLines, width: int) -> str:
    """Return what a table of that many numbers looks like, with the option that says it."""
    values = _numbers(lines, width)
    for ahead in range(max(0, width - 18), width - 15):
        rows = values[:, ahead:]
        last = rows.shape[1] == 16 and np.abs(rows[:, 12:] - [0.0, 0.0, 0.0, 1.0]).max(initial=0.0) < 1e-6
        if last and len(values) and _are_rotations(rows, (0, 1, 2, 4, 5, 6, 8, 9, 10)):
            words = ["time", "skip"][:ahead] if _increases(values[:, 0]) else ["skip"] * ahead
            return f" The last 16 are a 4 x 4 matrix, row by row: layout='{','.join([*words, 'mat16'])}'."
    return ""


def _numbers(lines: TableLines, width: int) -> Array:
    """Return the first rows as numbers; none where they are not."""
    rows = [row for row in lines.rows[:_LOOKED_AT] if len(row[1]) == width]
    try:
        return Cells(rows).numbers(range(width), ["a cell"] * width)
    except ValueError:
        return np.empty((0, width))


def _are_rotations(values: Array, cells: tuple[int, ...]) -> bool:
    matrices = values[:, cells].reshape(-1, 3, 3)
    gram = matrices @ np.swapaxes(matrices, 1, 2)
    return len(values) > 0 and bool(np.abs(gram - np.eye(3)).max() < _UNIT)


def _is_tum(values: Array) -> bool:
    if len(values) < 3 or not _increases(values[:, 0]):
        return False
    norm = np.linalg.norm(values[:, 4:], axis=1)
    return bool(np.abs(norm - 1.0).max() < _UNIT)


def _increases(first: Array) -> bool:
    """Return whether numbers can be times: they increase, in steps that vary by less than half of their median."""
    steps = np.diff(first)
    return len(steps) > 1 and bool((steps > 0.0).all() and np.ptp(steps) < 0.5 * float(np.median(steps)))
