"""The readers, in the order in which they are asked whether a file is theirs."""

from __future__ import annotations

import warnings
from os import PathLike
from pathlib import Path

from dmpcpp._text import read_bytes
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._formats import (
    aria,
    arrays,
    bvh,
    c3d,
    deepmimic,
    euroc,
    hdf5,
    hot3d,
    lerobot,
    motive,
    mvnx,
    opensim,
    qualisys,
    ros,
    table,
    trc,
    tum,
    umi,
    vicon,
    video,
)
from dmpcpp.recordings._reader import Reader
from dmpcpp.recordings._signatures import known_other
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._table_lines import is_data, table_lines

__all__ = ["READERS", "prepared", "reader_of", "summaries"]

# From the format that its own first bytes name to the one that only its shape tells: the first to recognise a file
# reads it.
_ORDERED = (
    video.READER,
    arrays.READER,
    c3d.READER,
    hdf5.READER,
    lerobot.READER,
    umi.READER,
    mvnx.READER,
    hot3d.READER,
    ros.READER,
    deepmimic.READER,
    bvh.READER,
    qualisys.READER,
    motive.READER,
    trc.READER,
    opensim.READER,
    vicon.READER,
    aria.READER,
    euroc.READER,
    table.READER,
    tum.READER,
)
READERS: dict[str, Reader] = {reader.name: reader for reader in _ORDERED}
_FOLDERS = (ros.is_bag_folder, lerobot.is_folder, umi.is_folder)
_HEAD = 65536  # bytes that decide the format


def summaries() -> dict[str, str]:
    """Return the names of the formats with a few words on each."""
    return {name: reader.summary for name, reader in READERS.items()}


def reader_of(path: str | PathLike[str], format: str | None = None) -> Reader:
    """Return the reader of a file: that of the format named, or of the first that recognises the file.

    Raises
    ------
    FileError
        The file is missing or cannot be read.
    InvalidArgument
        The format is unknown, or cannot be recognised; the message lists those that exist.
    """
    path = Path(path)
    if format is not None:
        if format not in READERS:
            raise InvalidArgument(f"format: {format!r}, expected one of:\n{_listed()}")
        return READERS[format]
    head = b"" if any(each(path) for each in _FOLDERS) else read_bytes(path, _HEAD)
    for reader in _ORDERED:
        if reader.recognises(path, head):
            return reader
    if other := known_other(path, head):
        raise InvalidArgument(f"{path.name}: {other}")
    said = f"{path.name}: the format cannot be recognised.{_hint(head)} State format=..., one of:\n{_listed()}"
    raise NotStated("format", said)


def _hint(head: bytes) -> str:
    """Return what to do with a file that looks like a table of numbers, "" of any other."""
    try:
        lines = table_lines(head.decode("utf-8-sig"), None)
    except (InvalidArgument, UnicodeDecodeError):
        return ""
    if not lines.rows or not is_data(lines.rows[0][1]):
        return ""
    return (
        f" It looks like a table of {len(lines.rows[0][1])} columns: state columns={{'time': 0, 'x': 1, 'y': 2, "
        "'z': 3, 'qx': 4, ...} by name or by number from 0."
    )


def prepared(path: str | PathLike[str], format: str | None, stated: dict[str, object]) -> tuple[Reader, Stated]:
    """Return the reader of a file and what was stated about it, checked to be what the format takes."""
    stated = _with_names_of_today(stated)
    reader = reader_of(path, format if format is not None or "columns" not in stated else _with_columns(path))
    for name in stated:
        if name not in Stated.__dataclass_fields__:
            raise reader.not_taken(name)
    statement = Stated(**stated)  # type: ignore[arg-type]
    reader.check(statement)
    return reader, statement


def _with_names_of_today(stated: dict[str, object]) -> dict[str, object]:
    """Return the statements with the names of before 0.2 replaced."""
    if "mend_times" not in stated:
        return stated
    warnings.warn("mend_times is sort_times now.", DeprecationWarning, stacklevel=4)
    return {("sort_times" if name == "mend_times" else name): value for name, value in stated.items()}


def _with_columns(path: str | PathLike[str]) -> str:
    """Return the format of a file whose columns are stated: a table, unless it is known as something else."""
    try:
        return reader_of(path).name
    except NotStated:
        return table.READER.name


def _listed() -> str:
    """Return the formats, a line each."""
    width = max(len(name) for name in READERS)
    return "\n".join(f"  {name:{width}}  {summary}" for name, summary in summaries().items())
