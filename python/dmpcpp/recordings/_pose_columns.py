"""A body's pose out of the columns of a table: a position, and a quaternion or three angles about the axes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dmpcpp._text import Cells
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._orientation import REFUSE_ABOVE, no_turn
from dmpcpp.recordings._representation import NUMBERED, QUATERNION, TURNS, oriented, turn_in
from dmpcpp.recordings._soundness import lost_zeros, zero_note
from dmpcpp.recordings._statement import Stated

__all__ = ["POSITION", "check_last_row", "pose", "stated_columns"]

POSITION = ("x", "y", "z")
_LAST_ROW = ("m30", "m31", "m32", "m33")

_LEAST_MARK = 999.0  # of numbers that are written in place of a sample: -999, 9999, -9999, ..
_ADVICE = " If this marks a lost sample, state missing='{}'."


def pose(
    cells: Cells, where: Mapping[str, int], called: Callable[[int], str], stated: Stated
) -> tuple[Array, Array, list[str]]:
    """Return position (T, 3), rotation (T, 3, 3) and the corrections made; NaN where the sample was lost.

    Parameters
    ----------
    cells : Cells
    where : mapping
        From the names of `POSITION` and of `QUATERNION`, `ANGLES` or neither to columns.
    called : (column) -> str
        How messages call a column.
    stated : Stated
        `missing`, `euler_order`, `angle_unit` and `fixed_orientation` count here.

    Raises
    ------
    InvalidArgument
        Naming line and column, or what must be stated (`NotStated`).
    """
    kind = turn_in(where)
    bottom = tuple(name for name in _LAST_ROW if name in where)
    names = (*POSITION, *kind, *bottom)
    columns = [where[name] for name in names]
    values = _marking(cells, stated.missing).numbers(columns, [called(column) for column in columns])
    lost = np.isnan(values).any(axis=1) | _marked(values[:, :3], stated.missing)
    notes: list[str] = []
    if stated.missing is None:
        _check_marks(cells, values, lost, kind)
        zeros = lost_zeros(values[:, :3], ~lost)
        lost, notes = lost | zeros, zero_note(zeros)
    values[lost] = np.nan
    if bottom:
        check_last_row(values[:, -len(bottom) :], lost)
    end = len(POSITION) + len(kind)
    rotation, told = oriented(values[:, 3:end], kind, stated, lost)
    return values[:, :3], rotation, [*notes, *told]


def check_last_row(rows: Array, lost: NDArray[np.bool_]) -> None:
    """Refuse 4 x 4 matrices whose last row (T, 4) is not 0 0 0 1.

    Raises
    ------
    InvalidArgument
        With the index.
    """
    expected = np.array([0.0, 0.0, 0.0, 1.0])[-rows.shape[1] :]
    wrong = ~lost & ~(np.abs(rows - expected).max(axis=1) <= 1e-6)
    if wrong.any():
        k = int(np.argmax(wrong))
        raise InvalidArgument(f"poses[{k}]: last row {rows[k]}, expected [0 0 0 1]. Are the matrices transposed?")


def _marking(cells: Cells, missing: object) -> Cells:
    """Return the cells with what was stated to stand for a lost sample."""
    if missing is None:
        return replace(cells, advice=_ADVICE)
    word = missing.strip().lower() if isinstance(missing, str) else ""
    return replace(
        cells,
        blank=cells.blank or word == "empty",
        nan=cells.nan or word == "nan",
        mark=word if word not in ("", "empty", "nan") else "",
    )


def stated_columns(columns: object, place: Callable[[object], int], position_only: bool = False) -> dict[str, int]:
    """Return the columns that the caller stated, "time" among them if it was, by what they hold.

    Raises
    ------
    InvalidArgument
        Names that are missing or unknown, or whatever `place` refuses; `NotStated` of a position without an
        orientation, unless it is enough.
    """
    if not isinstance(columns, Mapping):
        raise InvalidArgument(f"columns: {columns!r}, expected a mapping from time, x, y, z, qx, .. to columns.")
    names = (*POSITION, *_turn_names(columns, position_only))
    unknown = set(map(str, columns)) - {"time", *names}
    missing = [name for name in names if name not in columns]
    if unknown or missing:
        wrong = f"unknown {', '.join(map(repr, sorted(unknown)))}" if unknown else f"missing {', '.join(missing)}"
        raise InvalidArgument(f"columns: {wrong}; expected time, {', '.join(names)}.")
    return {str(name): place(column) for name, column in columns.items()}


def _turn_names(columns: Mapping[object, object], position_only: bool) -> tuple[str, ...]:
    """Return the names of the orientation's columns that are to be there beside a position's."""
    if set(columns) - {"time"} == set(POSITION):
        if not position_only:
            raise no_turn("the columns stated")
        return ()
    return next((kind for kind in TURNS if any(name in columns for name in kind)), QUATERNION)


def _marked(position: Array, missing: object) -> NDArray[np.bool_]:
    """Return which rows (T,) hold the number that stands for a lost sample, in all three coordinates."""
    if missing is None or (isinstance(missing, str) and missing.strip()):
        return np.zeros(len(position), dtype=bool)
    if isinstance(missing, bool) or not isinstance(missing, int | float) or not np.isfinite(missing):
        raise InvalidArgument(f"missing: {missing!r}, expected 'empty', 'nan', another word, or a number such as 0.")
    return np.asarray((position == missing).all(axis=1))


def _check_marks(cells: Cells, values: Array, lost: NDArray[np.bool_], kind: tuple[str, ...]) -> None:
    """Refuse a number that stands in all of a pose and cannot: the mark of a lost sample that was not stated."""
    mark = values[:, 0]
    with_quaternion = kind in (QUATERNION, NUMBERED)
    impossible = np.abs(2.0 * np.abs(mark) - 1.0) > REFUSE_ABOVE if with_quaternion else np.abs(mark) >= _LEAST_MARK
    found = ~lost & impossible & (values == mark[:, None]).all(axis=1)
    if found.any():
        k = int(np.argmax(found))
        raise InvalidArgument(
            f"line {cells.rows[k][0]}: {mark[k]:.12g} in every column of the pose. If this marks a lost sample, state "
            f"missing={mark[k]:.12g}."
        )
