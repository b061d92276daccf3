"""Long tables: rows of several bodies or takes below each other, told apart by a column, the key."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from dmpcpp._text import Row
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._flag_columns import is_flag

__all__ = ["Key", "keys_in", "rows_where", "wanted"]

BODY_KEYS = frozenset(("hand", "handedness", "side", "object_uid", "object_id", "body", "landmark", "joint", "marker"))
TAKE_KEYS = frozenset(("take", "trial", "episode", "episode_index", "demo", "demonstration", "repetition"))
"""Names of columns that tell rows apart whatever their values do."""

_COMPARISONS: dict[str, Callable[[float, float], bool]] = {
    ">=": operator.ge,
    "<=": operator.le,
    ">": operator.gt,
    "<": operator.lt,
}
_COMPARED = re.compile(r">=|<=|!=|>|<")
_CONDITION = re.compile(r"(?P<name>[^=<>!]*[^=<>!\s][^=<>!]*)(?P<how>>=|<=|!=|=|>|<)\s*(?P<value>.*?)\s*")
_MOST_VALUES = 0.25  # share of the rows; a column with more values is a measurement or a counter
_PERIODIC = 0.9  # share of rows whose value comes again after one round of all values
_LOOKED_AT = 200  # rows that show whether a column can be a key
_SHOWN = 30  # values that a message lists


@dataclass(frozen=True)
class Key:
    """A column that tells the rows of several bodies or takes apart; `values` in the order of the file."""

    name: str
    column: int
    values: tuple[str, ...]

    @property
    def of_takes(self) -> bool:
        """Return whether its values are takes or episodes rather than bodies."""
        return _plain(self.name) in TAKE_KEYS

    def not_chosen(self) -> NotStated:
        """Return the error for a table of which no value was chosen."""
        what = "takes or episodes" if self.of_takes else "bodies"
        held = ", ".join(self.values[:_SHOWN]) + (", ..." if len(self.values) > _SHOWN else "")
        count = f"{len(self.values)} {'episodes' if 'episode' in self.name else what}"
        together = f" (or learn them together: where='{self.name}=all')"
        also = together if self.of_takes else f" (or body='{self.values[-1]}')"
        return NotStated(
            ("where",) if self.of_takes else ("where", "body"),
            f"where: the column {self.name!r} tells the rows of {count} apart: {held}. Specify one: "
            f"where='{self.name}={self.values[-1]}'{also}.",
            [{"where": {self.name: value}} for value in self.values],
        )


def keys_in(header: Sequence[str], rows: Sequence[Row], used: Sequence[int], time: int | None) -> list[Key]:
    """Return the keys with more than one value.

    A column is one by its name; or if it has at most a quarter as many values as there are rows, and within each value
    the times increase although in the whole table they do not, or the values come round and round.

    Parameters
    ----------
    header : sequence of str
    rows : sequence of (line, cells)
    used : sequence of int
        Columns of poses and times, which are no keys.
    time : int, optional
        The column of times.
    """
    found = []
    candidates = [
        (column, name, _plain(name) in BODY_KEYS | TAKE_KEYS)
        for column, name in enumerate(header)
        if column not in used and not is_flag(name)
    ]
    first = rows[:_LOOKED_AT]
    candidates = [
        (column, name, known)
        for column, name, known in candidates
        if known or not any(map(_is_measurement, _column(first, column)))
    ]
    clock = _numbers(rows, time) if candidates else None
    disordered = clock is not None and not (np.diff(clock) > 0.0).all()
    for column, name, known in candidates:
        values = _column(rows, column)
        unique = tuple(dict.fromkeys(values))
        if len(unique) < 2 or (not known and not _may_be_key(unique, len(rows))):
            continue
        if known or _comes_round(values, len(unique)) or (clock is not None and disordered and _orders(values, clock)):
            found.append(Key(name, column, unique))
    return found


def rows_where(header: Sequence[str], rows: Sequence[Row], where: object) -> tuple[list[Row], list[str]]:
    """Return the rows with the values that were specified, and a note.

    Parameters
    ----------
    where : str or mapping
        "COLUMN=VALUE", several joined by ","; or column -> value. In place of = stand >=, <=, >, < and !=, too; in a
        mapping they begin the value.

    Raises
    ------
    InvalidArgument
        No such column, or no row with this value; the message lists those that exist.
    """
    kept = list(rows)
    chosen_values = wanted(where)
    for name, value in chosen_values.items():
        if name not in header:
            held = ", ".join(cell for cell in header if cell)
            raise InvalidArgument(f"where: no column {name!r}. The file holds: {held[:300]}.")
        column = list(header).index(name)
        chosen = [row for row in kept if _meets(_cell(row, column), value)]
        if not chosen:
            unique = list(dict.fromkeys(_cell(row, column) for row in kept))
            raise InvalidArgument(
                f"where: no row with {_condition(name, value)}. The column holds: {', '.join(unique[:_SHOWN])}."
            )
        kept = chosen
    said = ", ".join(_condition(name, value) for name, value in chosen_values.items())
    return kept, [f"{len(kept)} of {len(rows)} rows, with {said}"]


def wanted(where: object) -> dict[str, str]:
    """Return the values that were specified by column."""
    if isinstance(where, Mapping):
        return {str(name): str(value) for name, value in where.items()}
    found = {}
    for part in str(where).split(","):
        match = _CONDITION.fullmatch(part)
        if match is None:
            raise InvalidArgument(f"where: {part!r}, expected COLUMN=VALUE such as hand=right, or confidence>=0.5.")
        found[match["name"].strip()] = match["how"].removesuffix("=" if match["how"] == "=" else "") + match["value"]
    return found


def _may_be_key(unique: Sequence[str], rows: int) -> bool:
    if len(unique) > _MOST_VALUES * rows:
        return False
    return all(not _is_measurement(value) for value in unique)


def _is_measurement(text: str) -> bool:
    """Return whether a cell holds a number with a fraction, or nothing."""
    if not text:
        return True
    try:
        value = float(text)
    except ValueError:
        return False
    return value != value or value != int(value) if abs(value) < 1e300 else True


def _comes_round(values: Sequence[str], count: int) -> bool:
    array = np.array(values)
    return (
        len(array) >= 3 * count
        and float((array[count:] == array[:-count]).mean()) >= _PERIODIC
        and bool((array[1 : 2 * count] != array[: 2 * count - 1]).all())
    )


def _orders(values: Sequence[str], clock: np.ndarray) -> bool:
    """Return whether the times increase within each value."""
    array = np.array(values)
    return all((np.diff(clock[array == value]) > 0.0).all() for value in dict.fromkeys(values))


def _numbers(rows: Sequence[Row], column: int | None) -> np.ndarray | None:
    if column is None:
        return None
    try:
        return np.array([float(cells[column]) for _, cells in rows])
    except (ValueError, IndexError):
        return None


def _column(rows: Sequence[Row], column: int) -> list[str]:
    return [_cell(row, column) for row in rows]


def _cell(row: Row, column: int) -> str:
    return row[1][column].strip() if column < len(row[1]) else ""


def _condition(name: str, value: str) -> str:
    return f"{name}{'' if _COMPARED.match(value) else '='}{value}"


def _meets(cell: str, value: str) -> bool:
    """Return whether a cell equals a value, or compares with the number behind >=, <=, >, < or !=."""
    match = _COMPARED.match(value)
    if match is None:
        return _equal(cell, value)
    limit = value[match.end() :].strip()
    if match[0] == "!=":
        return not _equal(cell, limit)
    try:
        return _COMPARISONS[match[0]](float(cell), float(limit))
    except ValueError:
        return False


def _equal(cell: str, value: str) -> bool:
    if cell.lower() == value.lower():
        return True
    try:
        return float(cell) == float(value)
    except ValueError:
        return False


def _plain(name: str) -> str:
    return name.strip().lower().replace(" ", "_")
