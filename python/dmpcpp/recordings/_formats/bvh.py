"""Biovision hierarchy (.bvh): a skeleton and its joint angles, turned into body poses by forward kinematics.

Source: M. Meredith and S. Maddock, Motion Capture File Formats Explained, University of Sheffield CS-01-11. Rotation
channels turn about the moving axes in the order in which they stand, in degrees; a position channel replaces that
component of the joint's OFFSET. The format says neither the unit of length nor which axis is up (often y).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from dmpcpp._text import number, read_text
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._cells import Cells, split_all
from dmpcpp.recordings._formats.bvh_skeleton import Joint, skeleton
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Array, Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER"]


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
    count = len(motion.cells.rows)
    notes = [] if count == motion.announced else [f"warning: {motion.announced} frames announced, {count} there"]
    return stated.recording(
        time=motion.step * np.arange(count),
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=notes,
        world=World(time_unit="s"),
    )


def _read(path: Path) -> tuple[dict[str, Joint], _Motion]:
    lines = [(k, line.strip()) for k, line in enumerate(read_text(path).split("\n"), start=1)]
    begin = next((k for k, (_, text) in enumerate(lines) if text == "MOTION"), None)
    if begin is None:
        raise InvalidArgument("no line MOTION: the skeleton is not followed by frames.")
    joints = skeleton(lines[:begin])
    motion = _motion([line for line in lines[begin + 1 :] if line[1]])
    width = sum(len(joint.channels) for joint in joints.values())
    for line, cells in motion.cells.rows:
        if len(cells) != width:
            raise InvalidArgument(
                f"line {line}: {len(cells)} numbers, expected {width} as there are that many channels."
            )
    return joints, motion


def _motion(lines: list[tuple[int, str]]) -> _Motion:
    if len(lines) < 3:
        raise InvalidArgument("expected 'Frames: N', 'Frame Time: seconds' and the frames behind MOTION.")
    announced = _fact(lines[0], "Frames:")
    step = _fact(lines[1], "Frame Time:")
    if announced != int(announced):
        raise InvalidArgument(f"line {lines[0][0]}: {announced} frames, expected a whole number.")
    if not 0.0 < step < 1e6:
        raise InvalidArgument(f"line {lines[1][0]}: a frame time of {step:g} s, expected more than 0.")
    return _Motion(Cells(split_all(lines[2:], " ")), int(announced), step)


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
    recognises=lambda path, head: head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"HIERARCHY"),
    bodies=bodies,
    read=read,
)
