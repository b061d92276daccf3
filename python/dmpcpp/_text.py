"""Text files as numbered lines and numbers, with errors that name the line."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import overload

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument

__all__ = ["Cells", "Lines", "Row", "data_lines", "number", "read_bytes", "read_text", "split", "split_all"]


def read_bytes(path: Path, size: int = -1) -> bytes:
    """Return the file's bytes, or its first `size`.

    Raises
    ------
    FileError
        The file is missing, a folder, or not readable.
    """
    try:
        with path.open("rb") as file:
            return file.read(size)
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None


def read_text(path: Path) -> str:
    """Return the file as text.

    Raises
    ------
    FileError
        See `read_bytes`.
    InvalidArgument
        It is not UTF-8 text; the message names the line and says what to do.
    """
    content = read_bytes(path)
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise InvalidArgument("line 1: UTF-16 text, expected UTF-8. Save the file as UTF-8.")
    nul = content.find(b"\0")
    if nul >= 0:
        line = content.count(b"\n", 0, nul) + 1
        raise InvalidArgument(f"line {line}: binary content, expected text.")
    if b"\n" not in content:
        content = content.replace(b"\r", b"\n")  # line ends of old Macs
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise InvalidArgument(
            f"line {line}: byte 0x{content[error.start]:02x} is not UTF-8 text. Save the file as UTF-8."
        ) from None


def data_lines(text: str, comment: str | tuple[str, ...] = "#", skip: int = 0) -> Iterator[tuple[int, str]]:
    """Yield (line number from 1, stripped line) of the lines behind `skip` that are neither blank nor comments."""
    for count, line in enumerate(text.split("\n"), start=1):
        stripped = line.strip("\r ")
        if count > skip and stripped.strip() and not stripped.lstrip().startswith(comment):
            yield count, stripped


def number(cell: str, line: int, column: str) -> float:
    """Return a cell as a finite number.

    Raises
    ------
    InvalidArgument
        Naming the line and the column.
    """
    try:
        value = float(cell)
    except ValueError:
        shown = cell if len(cell) <= 20 else cell[:20] + "..."
        what = "an empty cell" if not cell.strip() else repr(shown)
        raise InvalidArgument(f"line {line}, {column}: {what}, expected a number.") from None
    if not math.isfinite(value):
        raise InvalidArgument(f"line {line}, {column}: {value}, expected a finite number.")
    return value


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

    rows: Sequence[Row]
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
        values = _plain_numbers(self.rows, columns)
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


class Lines(Sequence[Row]):
    """Lines of a table, (line number, text), that are split when they are asked for: long tables stay small."""

    def __init__(self, lines: Sequence[tuple[int, str]], delimiter: str) -> None:
        """Take the lines; a list, or a part of one."""
        self.lines, self.delimiter = lines, delimiter

    def __len__(self) -> int:
        """Return the number of lines."""
        return len(self.lines)

    @overload
    def __getitem__(self, index: int) -> Row: ...
    @overload
    def __getitem__(self, index: slice) -> Lines: ...
    def __getitem__(self, index: int | slice) -> Row | Lines:
        """Return one line's number and cells, or a part of the lines."""
        if isinstance(index, slice):
            return Lines(self.lines[index], self.delimiter)
        line, text = self.lines[index]
        return line, split(text, self.delimiter, line)

    def __iter__(self) -> Iterator[Row]:
        """Yield number and cells of each line."""
        return ((line, split(text, self.delimiter, line)) for line, text in self.lines)


def _plain_numbers(rows: Sequence[Row], columns: Sequence[int]) -> Array:
    """Return columns as numbers (T, len(columns)) where all their cells are; else none."""
    try:
        if isinstance(rows, Lines) and rows and len(columns):
            delimiter = None if rows.delimiter == " " else rows.delimiter
            texts = (text for _, text in rows.lines)
            read = np.loadtxt(texts, comments=None, delimiter=delimiter, usecols=list(columns), ndmin=2)
            return read if len(read) == len(rows) else np.full((0, 0), np.nan)
        return np.array([[float(cells[c]) for c in columns] for _, cells in rows])
    except (ValueError, IndexError):
        return np.full((0, 0), np.nan)


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
