"""Project Aria machine perception CSV: hand tracking in the frame of the glasses, or the glasses' own trajectory.

Source: Project Aria documentation, "MPS output: hand tracking" and "trajectory". Columns `tx_left_device_wrist` ..
`qw_left_device_wrist` are a pose (us, m, quaternions whose names tell their order), `tx_left_landmark_0_device` .. a
point; a confidence below 0 marks a hand that was not seen.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from dmpcpp._text import Cells, data_lines, read_text, split_all
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._markers import Markers
from dmpcpp.recordings._orientation import HELD_FIXED, from_quaternions, held_fixed, no_turn
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Axis, Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World
from numpy.typing import NDArray

__all__ = ["READER"]

_TIME = "tracking_timestamp_us"
_WORLD = World(unit="m", time_unit="us")
_UPRIGHT = 0.99  # share of gravity along one axis
_POSE = ("tx", "ty", "tz", "qx", "qy", "qz", "qw")
_POINT = ("tx", "ty", "tz")
_COLUMN = re.compile(r"(?P<what>t[xyz]|q[xyzw])_(?P<of>\w+)")
_WRISTS = {
    "left_wrist_device": "left_wrist",
    "right_wrist_device": "right_wrist",
}  # of the first format, positions only
_NAMES = {**_WRISTS, "left_device_wrist": "left_wrist", "right_device_wrist": "right_wrist", "world_device": "device"}


@dataclass(frozen=True)
class _File:
    """The data and the columns: what (`left_device_wrist`) -> quantity (`tx`) -> column."""

    cells: Cells
    header: list[str]
    things: dict[str, dict[str, int]]

    def holding(self, wanted: tuple[str, ...]) -> dict[str, dict[str, int]]:
        """Return the columns of what has all of some quantities, by the name that users see."""
        whole = {of: where for of, where in self.things.items() if all(what in where for what in wanted)}
        whole.pop("ecef_device", None)  # the glasses on the globe, no motion in a room
        return {_NAMES.get(of, of.removesuffix("_device")): where for of, where in whole.items()}

    def up_axis(self, body: str) -> Axis | None:
        """Return the axis of the world against which gravity points, for the trajectory of the glasses."""
        names = [f"gravity_{axis}_world" for axis in "xyz"]
        if body != "device" or not all(name in self.header for name in names):
            return None
        gravity = self.cells.numbers([self.header.index(name) for name in names], names).mean(axis=0)
        k = int(np.argmin(gravity))
        return ("x", "y", "z")[k] if gravity[k] < -_UPRIGHT * np.linalg.norm(gravity) else None

    def times(self) -> Array:
        return self.cells.numbers([self.header.index(_TIME)], [_TIME])[:, 0]

    def unseen(self, name: str) -> NDArray[np.bool_]:
        """Return in which samples (T,) the hand that a body or point belongs to was not seen."""
        confidence = f"{name.split('_')[0]}_tracking_confidence"
        if confidence not in self.header:
            return np.zeros(len(self.cells.rows), dtype=bool)
        return np.asarray(self.cells.numbers([self.header.index(confidence)], [confidence])[:, 0] < 0.0)


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the wrists, or "device"."""
    return tuple(_held(_read(path), stated))


def _held(file: _File, stated: Stated) -> dict[str, dict[str, int]]:
    """Return the columns of the bodies; those of the first format have no orientation.

    Raises
    ------
    NotStated
        They are the only ones, and a fixed orientation is not said to be enough.
    """
    held = file.holding(_POSE)
    points = {name: where for name, where in file.holding(_POINT).items() if name in _WRISTS.values()}
    if held or not points:
        return held
    if not stated.fixed_orientation:
        raise no_turn(f"the first hand format holds of {' and '.join(points)}")
    return points


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return a wrist in the frame of the glasses, or the glasses in the world."""
    file = _read(path)
    held = _held(file, stated)
    body = pick_body(body, tuple(held))
    wanted = _POSE if "qx" in held[body] else _POINT
    values = file.cells.numbers([held[body][what] for what in wanted], [f"{what} of {body!r}" for what in wanted])
    lost = file.unseen(body)
    if wanted == _POSE:
        rotation, notes = from_quaternions(values[:, 3:], stated.quat_order or "xyzw", missing=lost)
    else:
        rotation, notes = held_fixed(lost), [HELD_FIXED]
    if body != "device":
        notes = ["in the frame of the glasses, which moves with the head", *notes]
    return stated.recording(
        time=file.times(),
        position=np.where(lost[:, None], np.nan, values[:, :3]),
        rotation=rotation,
        body=body,
        source=path.name,
        notes=notes,
        world=replace(_WORLD, up_axis=file.up_axis(body)),
    )


def markers(path: Path, stated: Stated) -> Markers:
    """Return the landmarks of the hands."""
    file = _read(path)
    held = {name: where for name, where in file.holding(_POINT).items() if "landmark" in name}
    if not held:
        wrists = [name for name in file.holding(_POINT) if "wrist" in name]
        what = f"the wrists are bodies: body='{wrists[0]}'" if wrists else "and no wrists: it is no trajectory of hands"
        raise InvalidArgument(f"markers: the file holds no landmarks, {what}.")
    columns = [where[what] for where in held.values() for what in _POINT]
    called = [f"{what} of {name!r}" for name in held for what in _POINT]
    points = file.cells.numbers(columns, called).reshape(len(file.cells.rows), len(held), 3)
    points[np.array([file.unseen(name) for name in held]).T] = np.nan
    return stated.marker_set(
        time=file.times(), position=points, names=tuple(held), source=path.name, notes=[], world=_WORLD
    )


def _read(path: Path) -> _File:
    rows = split_all(data_lines(read_text(path)), ",")
    if len(rows) < 2:
        raise InvalidArgument("a header line without lines of data.")
    header = [cell.strip() for cell in rows[0][1]]
    if _TIME not in header:
        raise InvalidArgument(f"line {rows[0][0]}: no column {_TIME!r}.")
    things: dict[str, dict[str, int]] = {}
    for column, name in enumerate(header):
        match = _COLUMN.fullmatch(name)
        if match:
            things.setdefault(match["of"], {}).setdefault(match["what"], column)
    return _File(Cells(rows[1:]), header, things)


READER = Reader(
    name="aria",
    summary="a Project Aria CSV of hands or of the glasses' trajectory",
    takes=("fixed_orientation", "quat_order", "rotation", *COMMON),
    recognises=lambda path, head: _TIME.encode() in head.split(b"\n", 1)[0],
    bodies=bodies,
    read=read,
    markers=markers,
)
