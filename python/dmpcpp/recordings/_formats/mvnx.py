"""Xsens MVNX: poses of body segments, segment to world, z up, quaternions w x y z.

Source: Xsens MVN user manual, "MVNX file format". Only frames of type "normal" count; the frames of calibration poses
come first. Times are the frame's index over the frame rate, since the attribute `time` is rounded to ms. Read as a
stream; a document type, and with it any entity, is refused. Names of persons and files are not looked at.
"""

from __future__ import annotations

from pathlib import Path
from xml.parsers import expat

import numpy as np
from dmpcpp._text import read_bytes
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._orientation import from_quaternions
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER"]

_MOST_SEGMENTS = 200
_KEPT = {"orientation": 4, "position": 3}  # elements and how many numbers a segment has there


class _Parser:
    """Collects segments and normal frames while expat reads."""

    def __init__(self) -> None:
        """Begin without anything."""
        self.rate = 0.0
        self.segments: list[str] = []
        self.index: list[int] = []
        self.numbers: dict[str, list[list[float]]] = {name: [] for name in _KEPT}
        self._normal, self._text, self._open = False, [""], ""
        self._parser = expat.ParserCreate(namespace_separator=" ")
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._characters
        self._parser.StartDoctypeDeclHandler = self._doctype

    def feed(self, content: bytes) -> None:
        try:
            self._parser.Parse(content, True)
        except expat.ExpatError as error:
            raise InvalidArgument(f"line {error.lineno}: not XML ({expat.ErrorString(error.code)}).") from None

    def _doctype(self, *_: object) -> None:
        raise InvalidArgument("the XML declares a document type, which no MVNX file has; its entities are not opened.")

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        name = name.rsplit(" ", 1)[-1]
        if name == "subject":
            self.rate = _number(attributes.get("frameRate", ""), "frameRate")
        elif name == "segment" and len(self.segments) < _MOST_SEGMENTS:
            self.segments.append(attributes.get("label", f"segment {len(self.segments) + 1}"))
        elif name == "frame":
            self._normal = attributes.get("type") == "normal"
            if self._normal:
                self.index.append(int(_number(attributes.get("index", ""), "index")))
        elif self._normal and name in _KEPT:
            self._open, self._text = name, []

    def _characters(self, text: str) -> None:
        if self._open:
            self._text.append(text)

    def _end(self, name: str) -> None:
        name = name.rsplit(" ", 1)[-1]
        if name == "frame":
            self._normal = False
        elif self._open and name == self._open:
            words = "".join(self._text).split()
            self.numbers[name].append([_number(word, name) for word in words])
            self._open = ""


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the segments."""
    return tuple(_read(path).segments)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the pose of one segment."""
    found = _read(path)
    body = pick_body(body, found.segments)
    k = found.segments.index(body)
    quaternion, position = (_of_segment(found, name, k) for name in _KEPT)
    rotation, notes = from_quaternions(quaternion, "wxyz")
    sampled = sampling(
        len(position), stated, times=lambda: (np.array(found.index) - found.index[0]) / found.rate, unit="s"
    )
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*sampled.notes, *notes],
        world=World(unit="m", time_unit="s", up_axis="z"),
    )


def _read(path: Path) -> _Parser:
    found = _Parser()
    found.feed(read_bytes(path))
    if not found.segments or len(set(found.segments)) < len(found.segments):
        raise InvalidArgument(f"{len(found.segments)} segments, expected at least one, each with a name of its own.")
    if not found.index:
        raise InvalidArgument("no frames of type 'normal': the file holds no motion.")
    if not 0.0 < found.rate < 1e6:
        raise InvalidArgument(f"frameRate is {found.rate:g}, expected a rate in Hz above 0.")
    return found


def _of_segment(found: _Parser, name: str, k: int) -> Array:
    """Return the numbers (T, 3 or 4) of one segment."""
    width, rows = _KEPT[name], found.numbers[name]
    if len(rows) != len(found.index):
        raise InvalidArgument(f"{name}: in {len(rows)} of {len(found.index)} normal frames. Export it for all of them.")
    for frame, row in enumerate(rows):
        if len(row) != width * len(found.segments):
            raise InvalidArgument(
                f"{name} of frame {frame}: {len(row)} numbers, expected {width * len(found.segments)}."
            )
    return np.array(rows)[:, width * k : width * (k + 1)]


def _number(text: str, what: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value) or abs(value) > 1e15:
        raise InvalidArgument(f"{what}: {text[:20]!r}, expected a number.")
    return value


READER = Reader(
    name="mvnx",
    summary="an Xsens MVNX of body segments",
    takes=COMMON,
    recognises=lambda path, head: path.suffix.lower() == ".mvnx" or b"<mvnx" in head[:4096],
    bodies=bodies,
    read=read,
)
