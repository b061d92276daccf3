"""Tables of text: numbered lines of cells, and columns of them as numbers, with errors that name line and column."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from dmpcpp._text import number
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._recording import Array

__all__ = ["Cells", "Row", "split", "split_all"]

Row = tuple[int, list[str]]  # line number from 1, cells


@dataclass(frozen=True)
class Cells:
    """The lines of data of a table.

    Parameters
    ----------
    rows : list of (line number, cells)
    blank : bool
        Whether an empty cell, or one that a line ends before, is a number that was lost.
    nan : bool
        Whether `nan` is; both become NaN where they are, and are errors where they are not.
    mark : str
        Another text that stands for a lost number, case ignored.
    advice : str
        What an error about a cell ends with, where the caller could have stated that it marks a lost number.
    """

    rows: list[Row]
    blank: bool = False
    nan: bool = False
    mark: str = ""
    advice: str = ""

    def numbers(self, columns: Sequence[int], names: Sequence[str]) -> Array:
        """Return columns, counted from 0, as numbers (T, len(columns)).

        Raises
        ------
        InvalidArgument
            Naming the line and the column of what is not a finite number.
        """
        try:
            values = np.array([[float(cells[c]) for c in columns] for _, cells in self.rows])
        except (ValueError, IndexError):
            values = np.full((0, 0), np.nan)
        if values.size and np.isfinite(values).all():  # the common case at a tenth of the time
            return values
        pairs = list(zip(columns, names, strict=True))
        return np.array([[self._number(row, column, name) for column, name in pairs] for row in self.rows])

    def points(self, first_columns: Sequence[int], names: Sequence[str]) -> Array:
        """Return points (T, M, 3) whose x, y and z stand in three columns from each of `first_columns` on.

        A point of which any coordinate was lost is NaN in all three.
        """
        columns = [first + k for first in first_columns for k in range(3)]
        called = [f"{axis} of {name!r}" for name in names for axis in "xyz"]
        points = self.numbers(columns, called).reshape(len(self.rows), len(first_columns), 3)
        points[np.isnan(points).any(axis=2)] = np.nan
        return points

    def _number(self, row: Row, column: int, name: str) -> float:
        line, cells = row
        if column >= len(cells):
            if self.blank:
                return np.nan
            raise InvalidArgument(f"line {line}, {name}: the line ends after {len(cells)} cells.")
        text = cells[column].strip().lower()
        if self._is_lost(text):
            return np.nan
        try:
            return number(cells[column], line, name)
        except InvalidArgument as error:
            raise InvalidArgument(f"{error}{self.advice.format(text[:20] or 'empty')}") from None

    def _is_lost(self, text: str) -> bool:
        return (self.blank and not text) or (self.nan and text == "nan") or (text != "" and text == self.mark)


def split_all(lines: Iterable[tuple[int, str]], delimiter: str) -> list[Row]:
    """Return (line number, cells) of (line number, text)."""
    return [(line, split(text, delimiter, line)) for line, text in lines]


def split(text: str, delimiter: str, line: int) -> list[str]:
    """Return the cells of one line; " " stands for any blanks, quotes protect any other delimiter.

    Raises
    ------
    InvalidArgument
        Naming the line.
    """
    if delimiter == " ":
        return text.split()
    if '"' not in text:
        return text.split(delimiter)
    try:
        return next(csv.reader([text], delimiter=delimiter))
    except (csv.Error, ValueError, TypeError, StopIteration) as error:
        raise InvalidArgument(f"line {line}: not a line of cells ({error}).") from None
