"""A body's pose out of the columns of a table: a position, and a quaternion or three angles about the axes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings.cells import Cells
from dmpcpp.recordings.orientation import from_euler, from_quaternions
from dmpcpp.recordings.recording import Array
from dmpcpp.recordings.stated import Stated

__all__ = ["ANGLES", "POSITION", "QUATERNION", "pose", "stated_columns"]

POSITION = ("x", "y", "z")
QUATERNION = ("qx", "qy", "qz", "qw")
ANGLES = ("rx", "ry", "rz")


def pose(
    cells: Cells, where: Mapping[str, int], called: Callable[[int], str], stated: Stated
) -> tuple[Array, Array, list[str]]:
    """Return position (T, 3), rotation (T, 3, 3) and what was mended; NaN where the sample was lost.

    Parameters
    ----------
    cells : Cells
    where : mapping
        From the names of `POSITION` and of `QUATERNION` or `ANGLES` to columns.
    called : (column) -> str
        How messages call a column.
    stated : Stated
        `missing`, `euler_order` and `angle_unit` count here.

    Raises
    ------
    InvalidArgument
        Naming line and column, or what must be stated (`NotStated`).
    """
    cells = replace(cells, blank=cells.blank or stated.missing == "empty", nan=cells.nan or stated.missing == "nan")
    names = (*POSITION, *(QUATERNION if "qx" in where else ANGLES))
    columns = [where[name] for name in names]
    values = cells.numbers(columns, [called(column) for column in columns])
    lost = np.isnan(values).any(axis=1) | _marked(values[:, :3], stated.missing)
    values[lost] = np.nan
    if "qx" in where:
        rotation, notes = from_quaternions(values[:, 3:], "xyzw", missing=lost)
    else:
        rotation, notes = from_euler(values[:, 3:], stated.euler_order, stated.angle_unit, lost), []
    return values[:, :3], rotation, notes


def stated_columns(columns: object, place: Callable[[object], int]) -> dict[str, int]:
    """Return the columns that the caller stated, "time" among them if it was, by what they hold.

    Raises
    ------
    InvalidArgument
        Names that are missing or unknown, or whatever `place` refuses.
    """
    if not isinstance(columns, Mapping):
        raise InvalidArgument(f"columns: {columns!r}, expected a mapping from time, x, y, z, qx, .. to columns.")
    turn = ANGLES if any(name in columns for name in ANGLES) else QUATERNION
    unknown = set(map(str, columns)) - {"time", *POSITION, *turn}
    missing = [name for name in (*POSITION, *turn) if name not in columns]
    if unknown or missing:
        wrong = f"unknown {', '.join(map(repr, sorted(unknown)))}" if unknown else f"missing {', '.join(missing)}"
        raise InvalidArgument(f"columns: {wrong}; expected time, {', '.join((*POSITION, *turn))}.")
    return {str(name): place(column) for name, column in columns.items()}


def _marked(position: Array, missing: object) -> NDArray[np.bool_]:
    """Return which rows (T,) hold the number that stands for a lost sample, in all three coordinates."""
    if missing in (None, "empty", "nan"):
        return np.zeros(len(position), dtype=bool)
    if isinstance(missing, bool) or not isinstance(missing, int | float) or not np.isfinite(missing):
        raise InvalidArgument(f"missing: {missing!r}, expected 'empty', 'nan' or a number such as 0.")
    return np.asarray((position == missing).all(axis=1))
