"""Qualisys Track Manager TSV: markers ("3D") or rigid bodies ("6D"), mm.

Source: QTM User Manual, "TSV export", and its exports. A header of `KEY<tab>values` lines, then perhaps a line of
column names, then the data. A marker or body that was not seen stands as zeros or as empty cells. The nine elements
of a rotation are the columns of the matrix one after another.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

import numpy as np
from dmpcpp._text import Cells, Row, data_lines, number, read_text, split_all
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._orientation import from_matrices
from dmpcpp.recordings._reader import COMMON, Reader, no_orientation, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import Sampling, sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER"]

_KEY = re.compile(r"[A-Z][A-Z0-9_]+")
_WORLD = World(unit="mm", time_unit="s")
_BODY_WIDTH = 16  # X Y Z Roll Pitch Yaw Residual Rot[0] .. Rot[8]


@dataclass(frozen=True)
class _File:
    """A file with its header; `first` is the column behind frame number and time."""

    header: dict[str, list[str]]
    cells: Cells
    names: tuple[str, ...]
    width: int  # columns of one marker or body
    first: int

    @property
    def holds_bodies(self) -> bool:
        return self.width == _BODY_WIDTH

    def sampling(self, stated: Stated) -> Sampling:
        count = len(self.cells.rows)
        if self.first == 2:
            return sampling(count, stated, times=lambda: self.cells.numbers([1], ["Time"])[:, 0], unit="s")
        frequency = self.header.get("FREQUENCY", [""])[0]
        known = frequency.replace(".", "", 1).isdigit()
        return sampling(count, stated, rate=float(frequency) if known else None)


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the rigid bodies of a 6D file; none of a 3D file."""
    file = _read(path)
    return file.names if file.holds_bodies else ()


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return one rigid body of a 6D file."""
    file = _read(path)
    if not file.holds_bodies:
        raise no_orientation(file.names)
    body = pick_body(body, file.names)
    first = file.first + _BODY_WIDTH * file.names.index(body)
    columns = [first, first + 1, first + 2, *range(first + 7, first + 16)]
    called = [f"{what} of {body!r}" for what in ("X", "Y", "Z", *(f"Rot[{k}]" for k in range(9)))]
    values = file.cells.numbers(columns, called)
    matrices = values[:, 3:].reshape(-1, 3, 3).swapaxes(1, 2)
    lost = np.isnan(values).any(axis=1) | (matrices == 0.0).all(axis=(1, 2))
    rotation, notes = from_matrices(matrices, missing=lost)
    sampled = file.sampling(stated)
    return sampled.stated.recording(
        time=sampled.time,
        position=np.where(lost[:, None], np.nan, values[:, :3]),
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*sampled.notes, *notes],
        world=_WORLD,
    )


def markers(path: Path, stated: Stated) -> Markers:
    """Return the markers of a 3D file."""
    file = _read(path)
    if file.holds_bodies:
        raise InvalidArgument(f"markers: a 6D file holds none, but the bodies {', '.join(file.names)}.")
    starts = [file.first + 3 * k for k in range(len(file.names))]
    points = file.cells.points(starts, file.names)
    points[(points == 0.0).all(axis=2)] = np.nan
    sampled = file.sampling(stated)
    return sampled.stated.marker_set(
        time=sampled.time, position=points, names=file.names, source=path.name, notes=sampled.notes, world=_WORLD
    )


def _read(path: Path) -> _File:
    rows = split_all(data_lines(read_text(path), comment="//"), "\t")
    header = _header(rows)
    rest = rows[sum(1 for _ in _header_rows(rows)) :]
    columns = rest[0][1] if rest and rest[0][1][0].strip() == "Frame" else []
    data = rest[1:] if columns else rest
    if not data:
        raise InvalidArgument("a Qualisys header without lines of data.")
    key, width = _content(header)
    names = [name for name in header.get(key, []) if name]
    if not names:
        raise InvalidArgument(f"the header has no {key}, whose names are needed. Export again with the TSV header.")
    first = columns.index("Time") + 1 if "Time" in columns[:2] else _first(data[0], width * len(names), key)
    return _File(header, Cells(data, blank=True, nan=True), distinct(names), width, first)


def _header_rows(rows: list[Row]) -> Iterator[list[str]]:
    return takewhile(lambda cells: _KEY.fullmatch(cells[0].strip()), (cells for _, cells in rows))


def _header(rows: list[Row]) -> dict[str, list[str]]:
    """Return the values behind each key; at least one, which may be empty."""
    return {cells[0].strip(): [cell.strip() for cell in cells[1:]] or [""] for cells in _header_rows(rows)}


def _content(header: dict[str, list[str]]) -> tuple[str, int]:
    included = header.get("DATA_INCLUDED", [""])[0]
    if included == "3D":
        return "MARKER_NAMES", 3
    if included == "6D":
        return "BODY_NAMES", _BODY_WIDTH
    raise InvalidArgument(f"DATA_INCLUDED is {included!r}, expected 3D (markers) or 6D (rigid bodies).")


def _first(row: tuple[int, list[str]], width: int, key: str) -> int:
    """Return how many columns stand before the data, where no line of column names says it."""
    line, cells = row
    count = len(cells) - (cells[-1].strip() == "")
    first = count - width
    if first not in (0, 2):
        raise InvalidArgument(
            f"line {line}: {count} columns, expected {width} for {key}, or 2 more for frame and time."
        )
    for cell in cells[:first]:
        number(cell, line, "frame or time")
    return first


READER = Reader(
    name="qualisys",
    summary="a Qualisys TSV of markers (3D) or rigid bodies (6D)",
    takes=("fixed_orientation", *COMMON),
    recognises=lambda path, head: head.lstrip(b"\xef\xbb\xbf").startswith((b"NO_OF_FRAMES\t", b"FILE_VERSION\t")),
    bodies=bodies,
    read=read,
    markers=markers,
)
