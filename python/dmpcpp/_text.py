"""Text files as numbered lines and numbers, with errors that name the line."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from dmpcpp.errors import FileError, InvalidArgument

__all__ = ["data_lines", "number", "read_bytes", "read_text"]


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
        raise FileError(f"{path}: can not be read ({error.strerror or error}).") from None


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
