"""Biovision hierarchy (.bvh): a skeleton and its joint angles, turned into body poses by forward kinematics.

Source: M. Meredith and S. Maddock, Motion Capture File Formats Explained, University of Sheffield CS-01-11. Rotation
channels turn about the moving axes in the order in which they stand, in degrees; a position channel replaces that
component of the joint's OFFSET. The format says neither the unit of length nor which axis is up (often y).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from dmpcpp._notes import Note
from dmpcpp._text import Cells, Row, number, read_text, split_all
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Axis, Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._upward import above_or_below, upward
from dmpcpp.recordings._world import World

__all__ = ["CHANNELS", "READER", "Joint", "skeleton"]

_LOOKED_AT = 20  # frames in which head and feet are compared


@dataclass(frozen=True)
class _Motion:
    """The lines behind MOTION."""

    cells: Cells
    announced: int
    step: float  # s


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the joints."""
    return tuple(_read(path)[0])


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the world pose of one joint."""
    joints, motion = _read(path)
    body = pick_body(body, tuple(joints))
    if stated.unit is None:
        raise NotStated(
            "unit", "unit: a BVH file does not say its unit of length. State unit='cm', 'm' or metres per unit."
        )
    rotation, position = _world_pose(joints, body, motion.cells)
    up_axis, told = _up_axis(joints, motion.cells, stated)
    count = len(motion.cells.rows)
    notes = (
        [] if count == motion.announced else [Note("warning", f"{motion.announced} frames announced, {count} there")]
    )
    return stated.recording(
        time=motion.step * np.arange(count),
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*notes, *told],
        world=World(time_unit="s", up_axis=up_axis),
    )


def _read(path: Path) -> tuple[dict[str, Joint], _Motion]:
    lines = [(k, line.strip()) for k, line in enumerate(read_text(path).split("\n"), start=1)]
    begin = next((k for k, (_, text) in enumerate(lines) if text.upper() == "MOTION"), None)
    if begin is None:
        raise InvalidArgument("no line MOTION: the skeleton is not followed by frames.")
    joints = skeleton(lines[:begin])
    width = sum(len(joint.channels) for joint in joints.values())
    motion = _motion([line for line in lines[begin + 1 :] if line[1]], width)
    for line, cells in motion.cells.rows:
        if len(cells) != width:
            raise InvalidArgument(
                f"line {line}: {len(cells)} numbers, expected {width} as there are that many channels."
            )
    return joints, motion


def _motion(lines: list[tuple[int, str]], width: int) -> _Motion:
    if len(lines) < 3:
        raise InvalidArgument("expected 'Frames: N', 'Frame Time: seconds' and the frames behind MOTION.")
    announced = _fact(lines[0], "Frames:")
    step = _fact(lines[1], "Frame Time:")
    if announced != int(announced):
        raise InvalidArgument(f"line {lines[0][0]}: {announced} frames, expected a whole number.")
    if not 0.0 < step < 1e6:
        raise InvalidArgument(f"line {lines[1][0]}: a frame time of {step:g} s, expected more than 0.")
    return _Motion(Cells(_unwrapped(split_all(lines[2:], " "), width, int(announced))), int(announced), step)


def _unwrapped(rows: list[Row], width: int, announced: int) -> list[Row]:
    """Return frames that were wrapped over several lines as one row each, where all numbers announced are there."""
    count = sum(len(cells) for _, cells in rows)
    if all(len(cells) == width for _, cells in rows) or count != width * announced or width == 0:
        return rows
    cells = [(line, cell) for line, row in rows for cell in row]
    return [(cells[k][0], [cell for _, cell in cells[k : k + width]]) for k in range(0, count, width)]


def _fact(row: tuple[int, str], name: str) -> float:
    line, text = row
    words = " ".join(text.split())
    if not words.startswith(name):
        raise InvalidArgument(f"line {line}: {text[:40]!r}, expected {name!r}.")
    return number(words.removeprefix(name), line, name.rstrip(":"))


def _world_pose(joints: dict[str, Joint], body: str, cells: Cells) -> tuple[Array, Array]:
    """Return rotation (T, 3, 3) and position (T, 3) of a joint: the product of the transforms from the root to it."""
    chain = [joints[body]]
    while chain[-1].parent is not None:
        chain.append(joints[chain[-1].parent])
    rotation = np.tile(np.eye(3), (len(cells.rows), 1, 1))
    position = np.zeros((len(cells.rows), 3))
    for joint in reversed(chain):
        turn, shift = _local_pose(joint, cells)
        position = position + np.einsum("tij,tj->ti", rotation, shift)
        rotation = rotation @ turn
    return rotation, position


def _up_axis(joints: dict[str, Joint], cells: Cells, stated: Stated) -> tuple[Axis, list[str]]:
    """Return the axis that points up: the one along which the head is above the feet, else y, which most files have."""
    if stated.up_axis is not None:
        return stated.up_axis, []
    some = replace(cells, rows=cells.rows[:: max(1, len(cells.rows) // _LOOKED_AT)])
    wanted = [name for name in joints if above_or_below(name)]
    places = np.array([_world_pose(joints, name, some)[1] for name in wanted])
    found = upward(wanted, np.swapaxes(places, 0, 1)) if wanted else None
    if found is not None:
        return found, [f"up axis {found}: the head is above the feet along it"]
    return "y", [
        Note(
            "assumed",
            "taken: up_axis: y, as in most BVH files; no joints of head and feet show it",
            about="up_axis",
        )
    ]


def _local_pose(joint: Joint, cells: Cells) -> tuple[Array, Array]:
    columns = range(joint.first_column, joint.first_column + len(joint.channels))
    values = cells.numbers(columns, [f"{channel} of {joint.name!r}" for channel in joint.channels])
    turn = np.tile(np.eye(3), (len(cells.rows), 1, 1))
    shift = np.tile(np.array(joint.offset), (len(cells.rows), 1))
    for channel, value in zip(joint.channels, values.T, strict=True):
        axis = "XYZ".index(channel[0])
        if channel.endswith("position"):
            shift[:, axis] = value
        else:
            turn = turn @ _about(axis, np.radians(value))
    return turn, shift


def _about(axis: int, angle: Array) -> Array:
    """Return the rotations (T, 3, 3) by angles [rad] about x, y or z."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    rotation = np.tile(np.eye(3), (len(angle), 1, 1))
    rotation[:, j, j] = rotation[:, k, k] = np.cos(angle)
    rotation[:, k, j] = np.sin(angle)
    rotation[:, j, k] = -rotation[:, k, j]
    return rotation


READER = Reader(
    name="bvh",
    summary="a BVH skeleton with its motion; unit to be stated",
    takes=COMMON,
    recognises=lambda path, head: head.lstrip(b"\xef\xbb\xbf \t\r\n")[:9].upper() == b"HIERARCHY",
    bodies=bodies,
    read=read,
)


CHANNELS = tuple(f"{axis}{what}" for what in ("position", "rotation") for axis in "XYZ")
_MOST_JOINTS = 10000  # of a file that means it


@dataclass
class Joint:
    """A joint: where it sits in its parent's frame, and which columns of a frame move it."""

    name: str
    parent: str | None
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    channels: tuple[str, ...] = ()
    first_column: int = 0


def skeleton(lines: list[tuple[int, str]]) -> dict[str, Joint]:
    """Return the joints by name in the order of the file, a parent before its children.

    Parameters
    ----------
    lines : list of (line number, text)
        From HIERARCHY to above MOTION.

    Raises
    ------
    InvalidArgument
        Naming the line.
    """
    return _Skeleton(lines).joints


class _Skeleton:
    """The words of a skeleton, read from the first to the last; `open` holds the joints whose braces are open."""

    def __init__(self, lines: list[tuple[int, str]]) -> None:
        self.joints: dict[str, Joint] = {}
        self.open: list[Joint | None] = []  # None for an End Site, which only has an offset
        self.columns = 0
        self.words = _words(lines)
        self.line = 0
        take: dict[str, Callable[[], None]] = {
            "ROOT": self._root,
            "JOINT": self._joint,
            "End": self._end_site,
            "OFFSET": self._offset,
            "CHANNELS": self._channels,
            "}": self._close,
            "HIERARCHY": lambda: None,  # the title, nothing to take
        }
        for line, word in self.words:
            self.line = line
            known = next((name for name in take if name.lower() == word.lower()), None)
            if known is None:
                raise self._error(f"{word[:20]!r}, expected JOINT, End Site, OFFSET, CHANNELS or }}")
            take[known]()
        if self.open or not self.joints:
            raise self._error("the skeleton ends in the middle, or holds no joint")

    def _root(self) -> None:
        if self.open:
            raise self._error("a ROOT inside of a joint")
        self._enter(None)

    def _joint(self) -> None:
        parent = self._innermost()
        if parent is None:
            raise self._error("a JOINT inside of an End Site")
        self._enter(parent.name)

    def _end_site(self) -> None:
        self._innermost()
        self._name()
        self.open.append(None)

    def _offset(self) -> None:
        joint = self._innermost()
        x, y, z = (number(self._next("a number"), self.line, "OFFSET") for _ in range(3))
        if joint is not None:
            joint.offset = (x, y, z)

    def _channels(self) -> None:
        joint = self._innermost()
        count = self._next("the number of channels")
        if joint is None or joint.channels or count not in tuple("0123456"):
            raise self._error(f"{count[:20]!r} channels, expected 0 to 6, once in a joint")
        joint.channels = tuple(self._next("a channel").capitalize() for _ in range(int(count)))
        joint.first_column = self.columns
        self.columns += len(joint.channels)
        if not set(joint.channels) <= set(CHANNELS) or len(set(joint.channels)) < len(joint.channels):
            shown = ", ".join(joint.channels)[:80]
            raise self._error(f"channels {shown}, expected different ones of {', '.join(CHANNELS)}")

    def _close(self) -> None:
        self._innermost()
        self.open.pop()

    def _enter(self, parent: str | None) -> None:
        name = self._name()
        if not name or name in self.joints or len(self.joints) >= _MOST_JOINTS:
            raise self._error(f"a joint called {name[:40]!r}, expected a name that no other joint has")
        self.joints[name] = Joint(name, parent)
        self.open.append(self.joints[name])

    def _name(self) -> str:
        """Return the words up to the brace that opens a joint."""
        words = []
        while (word := self._next("{")) != "{":
            words.append(word)
        return " ".join(words)

    def _next(self, expected: str) -> str:
        line, word = next(self.words, (self.line, ""))
        if not word:
            raise self._error(f"the skeleton ends, expected {expected}")
        self.line = line
        return word

    def _innermost(self) -> Joint | None:
        if not self.open:
            raise self._error("outside of any joint")
        return self.open[-1]

    def _error(self, what: str) -> InvalidArgument:
        return InvalidArgument(f"line {self.line}: {what}.")


def _words(lines: list[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    for line, text in lines:
        for word in text.replace("{", " { ").replace("}", " } ").split():
            yield line, word
