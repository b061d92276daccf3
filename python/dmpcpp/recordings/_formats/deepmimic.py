"""DeepMimic humanoid clips: JSON with joint rotations, turned into body poses by forward kinematics.

Format: {"Loop": "wrap" | "none", "Frames": [[44 numbers], ...]}; y up, x forward, the figure's right side
is +z; s, m, rad, quaternions with the scalar first. Source: X. B. Peng et al., DeepMimic, ACM Trans. Graphics
37 (2018), and the figure humanoid/humanoid.urdf of pybullet_data at a quarter of its scale.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from dmpcpp._text import read_text
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._orientation import from_quaternions
from dmpcpp.recordings._reader import Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "bodies", "read"]

_WIDTH = 44
_ROOT_POSITION = slice(1, 4)


@dataclass(frozen=True)
class _Joint:
    """A joint of the figure: where it sits in its parent's frame [m] and which columns turn it."""

    parent: str | None
    offset: tuple[float, float, float]
    turn: slice | int | None  # quaternion columns, the column of an angle about z [rad], or fixed


def _leg(z: float, first: int, side: str) -> dict[str, _Joint]:
    return {
        f"{side}_hip": _Joint("root", (0.0, 0.0, z), slice(first, first + 4)),
        f"{side}_knee": _Joint(f"{side}_hip", (0.0, -0.421546, 0.0), first + 4),
        f"{side}_ankle": _Joint(f"{side}_knee", (0.0, -0.409870, 0.0), slice(first + 5, first + 9)),
    }


def _arm(z: float, first: int, side: str) -> dict[str, _Joint]:
    return {
        f"{side}_shoulder": _Joint("chest", (-0.02405, 0.243500, z), slice(first, first + 4)),
        f"{side}_elbow": _Joint(f"{side}_shoulder", (0.0, -0.274788, 0.0), first + 4),
        # The figure has no wrist joint: the hand turns with the forearm.
        f"{side}_hand": _Joint(f"{side}_elbow", (0.0, -0.258947, 0.0), None),
    }


_FIGURE: dict[str, _Joint] = {
    "root": _Joint(None, (0.0, 0.0, 0.0), slice(4, 8)),
    "chest": _Joint("root", (0.0, 0.236151, 0.0), slice(8, 12)),
    "neck": _Joint("chest", (0.0, 0.223894, 0.0), slice(12, 16)),
    **_arm(0.183110, 25, "right"),
    **_arm(-0.183110, 39, "left"),
    **_leg(0.084887, 16, "right"),
    **_leg(-0.084887, 30, "left"),
}


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the figure's joints; "right_hand" and "left_hand" are the wrists."""
    _frames(path)
    return tuple(_FIGURE)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the world pose of one joint of the figure.

    Only the joints between the root and `body` need sound quaternions. A frame lasts for its duration, so its
    pose holds at the sum of the durations before it; the duration of the last frame, 0 in most clips, is not
    used.
    """
    body = pick_body(body, tuple(_FIGURE))
    frames = _frames(path)
    notes = ["pose of the wrist; its orientation is the forearm's, the figure's wrist is fixed"]
    rotation, position, corrections = _forward_kinematics(frames, body)
    return stated.recording(
        time=_times(frames[:, 0]),
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=(notes if body.endswith("_hand") else []) + corrections,
        world=World(unit="m", time_unit="s", up_axis="y"),
    )


def _frames(path: Path) -> Array:
    """Return the frames (T, 44), all finite."""
    try:
        content = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise InvalidArgument(f"line {error.lineno}, column {error.colno}: not JSON ({error.msg}).") from None
    except (RecursionError, ValueError) as error:  # brackets without end, integers of thousands of digits
        raise InvalidArgument(f"not a DeepMimic clip: {type(error).__name__} in the JSON.") from None
    frames = content.get("Frames") if isinstance(content, dict) else None
    if not isinstance(frames, list) or not frames:
        raise InvalidArgument('not a DeepMimic clip: expected {"Loop": ..., "Frames": [[44 numbers], ...]}.')
    return np.array([_frame(k, frame) for k, frame in enumerate(frames)])


def _frame(k: int, frame: object) -> list[float]:
    if not isinstance(frame, list) or len(frame) != _WIDTH:
        found = f"{len(frame)} numbers" if isinstance(frame, list) else type(frame).__name__
        raise InvalidArgument(f"Frames[{k}]: {found}, expected {_WIDTH} numbers.")
    for column, value in enumerate(frame):
        if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e6:
            shown = repr(value) if isinstance(value, float) else type(value).__name__
            raise InvalidArgument(f"Frames[{k}][{column}]: {shown}, expected a finite number.")
    return [float(value) for value in frame]


def _times(durations: Array) -> Array:
    return np.concatenate(([0.0], np.cumsum(durations[:-1])))


def _forward_kinematics(frames: Array, body: str) -> tuple[Array, Array, list[str]]:
    """Return rotation (T, 3, 3) and position (T, 3) in the world, and the corrections made."""
    joint = _FIGURE[body]
    if joint.parent is None:
        rotation, notes = _turn(frames, body)
        return rotation, frames[:, _ROOT_POSITION], notes
    parent_rotation, parent_position, parent_notes = _forward_kinematics(frames, joint.parent)
    turn, notes = _turn(frames, body)
    position = parent_position + parent_rotation @ np.array(joint.offset)
    return parent_rotation @ turn, position, parent_notes + notes


def _turn(frames: Array, name: str) -> tuple[Array, list[str]]:
    turn = _FIGURE[name].turn
    if turn is None:
        return np.broadcast_to(np.eye(3), (len(frames), 3, 3)), []
    if isinstance(turn, slice):
        return from_quaternions(frames[:, turn], "wxyz", f"{name} quaternion")
    return _about_z(frames[:, turn]), []


def _about_z(angle: Array) -> Array:
    rotation = np.tile(np.eye(3), (len(angle), 1, 1))
    rotation[:, 0, 0] = rotation[:, 1, 1] = np.cos(angle)
    rotation[:, 1, 0] = np.sin(angle)
    rotation[:, 0, 1] = -rotation[:, 1, 0]
    return rotation


READER = Reader(
    name="deepmimic",
    summary='a DeepMimic humanoid clip: JSON with "Frames" of 44 numbers',
    takes=("rate", "time_unit", "missing"),
    recognises=lambda path, head: head.lstrip().startswith(b"{") and b'"Frames"' in head,
    bodies=bodies,
    read=read,
)
