"""Where and how large a recorded motion stands in a robot's workspace: a similarity transform."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp import motion
from dmpcpp._core import JointTrajectory
from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings import Axis, Recording

__all__ = ["EFFORT", "Accept", "Placement", "to_follow"]

_Z_UP = {
    "x": np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),  # -90 deg about y
    "y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),  # +90 deg about x
    "z": np.eye(3),
}


@dataclass(frozen=True, eq=False)
class Placement:
    """A placement of a recorded motion in a robot's workspace.

    With U the rotation that turns the recording's up axis to z, and A = Rz(yaw) U:

        p' = position + scale A (p - centre)
        R' = A R tool_rotation

    Positions scale, rotations do not.

    Parameters
    ----------
    position : array_like (3,)
        m, where `centre` comes to lie, in the robot's base frame (z up).
    yaw : float
        rad, about the robot's z axis.
    scale : float
        > 0.
    tool_rotation : array_like (3, 3)
        The constant rotation of the robot's tool in the frame of the recorded body.
    up_axis : "x", "y" or "z"
        The axis of the recording that points up.
    centre : array_like (3,)
        m, the point of the recording's world that scaling leaves in place; `place` takes the middle of the
        box around the path.
    start : array_like (n,), optional
        Joints at the first pose from which the whole motion can be followed: pass them to
        `InverseKinematics.follow(..., start=...)`. `place` sets them.
    note : str
        How the placement was found, for reports.

    Raises
    ------
    InvalidArgument
        A number that is not finite, scale <= 0, a tool rotation that is not a proper rotation.
    """

    position: Array
    yaw: float = 0.0
    scale: float = 1.0
    tool_rotation: Array = field(default_factory=lambda: np.eye(3))
    up_axis: Axis = "z"
    centre: Array = field(default_factory=lambda: np.zeros(3))
    start: Array | None = None
    note: str = ""

    def __post_init__(self) -> None:
        """Take the arrays over as read-only float64 and check everything."""
        for name, shape in (("position", (3,)), ("centre", (3,)), ("tool_rotation", (3, 3))):
            object.__setattr__(self, name, _owned(name, getattr(self, name), shape))
        if self.start is not None:
            object.__setattr__(self, "start", _owned("start", self.start, np.shape(self.start)))
        if not np.isfinite(self.yaw):
            raise InvalidArgument(f"yaw: {self.yaw}, expected an angle in rad.")
        if not 0.0 < self.scale < np.inf:
            raise InvalidArgument(f"scale: {self.scale}, expected a number above 0.")
        if self.up_axis not in _Z_UP:
            raise InvalidArgument(f"up_axis: {self.up_axis!r}, expected 'x', 'y' or 'z'.")
        tool = self.tool_rotation
        if np.abs(tool.T @ tool - np.eye(3)).max() > 1e-6 or np.linalg.det(tool) < 0.0:
            raise InvalidArgument("tool_rotation: not a proper rotation, expected R^T R = I and det(R) = +1.")

    @property
    def rotation(self) -> Array:
        """Return A (3, 3): recording's world -> robot's base."""
        c, s = np.cos(self.yaw), np.sin(self.yaw)
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]) @ _Z_UP[self.up_axis]

    def apply(self, poses: ArrayLike) -> Array:
        """Carry poses (T, 4, 4) or one pose (4, 4) of the recording's world over to the robot's base frame.

        Raises
        ------
        InvalidArgument
            Another shape.
        """
        poses = np.asarray(poses, dtype=np.float64)
        if poses.ndim not in (2, 3) or poses.shape[-2:] != (4, 4):
            raise InvalidArgument(f"poses: shape {poses.shape}, expected (T, 4, 4) or (4, 4).")
        placed = np.array(poses)
        rotation = self.rotation
        placed[..., :3, :3] = rotation @ poses[..., :3, :3] @ self.tool_rotation
        placed[..., :3, 3] = self.position + self.scale * (poses[..., :3, 3] - self.centre) @ rotation.T
        return placed

    def apply_to(self, recording: Recording) -> Recording:
        """Carry a recording over; its history says how."""
        placed = self.apply(motion.poses(recording))
        if recording.up_axis is None:
            recording = recording.with_(Note("assumed", f"no up axis given: {self.up_axis} taken", about="up_axis"))
        return recording.with_(
            Note("changed", self.describe()),
            position=placed[:, :3, 3],
            rotation=Rotation.from_matrix(placed[:, :3, :3]).as_matrix(),  # rounding of the product taken out
            up_axis="z",
        )

    def describe(self) -> str:
        """Return one line for reports: mm and degrees."""
        x, y, z = np.round(1e3 * self.position).astype(int)
        tool = Rotation.from_matrix(self.tool_rotation).as_rotvec(degrees=True)
        turned = ", ".join(f"{angle:.1f}" for angle in tool)
        found = f"; {self.note}" if self.note else ""
        return (
            f"placed at ({x}, {y}, {z}) mm, yaw {np.degrees(self.yaw):.1f} deg, scale {self.scale:.3f}, "
            f"tool rotation vector ({turned}) deg, up axis {self.up_axis}{found}"
        )


def _owned(name: str, values: ArrayLike, shape: tuple[int, ...]) -> Array:
    try:
        array = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InvalidArgument(f"{name}: not an array of numbers.") from None
    if array.shape != shape or not np.isfinite(array).all():
        raise InvalidArgument(f"{name}: {array.tolist()}, expected {shape} finite numbers.")
    array.setflags(write=False)
    return array


Accept = Callable[[JointTrajectory], bool]
"""Called with each complete joint trajectory; False rejects it (e.g. self-collision)."""

EFFORT: dict[str, Any] = {"starts": 8, "anchors": 3, "thorough": False}
"""Of the search for joints along one candidate's path."""

_STEP_DISTANCE = 0.03  # m, recorded, between the poses that are followed
_STEP_ANGLE = 0.1  # rad, likewise
_LONG = 5000  # samples; a search follows a path hundreds of times
_RATE = 50.0  # Hz; a hand does nothing in between that an arm could follow


def to_follow(recording: Recording) -> Recording:
    """Return the motion with more samples where a fast hand moves further between two of them than joints can be
    followed with certainty; and with fewer, but 50 a second, where a long one was sampled faster than that.
    """
    every = max(1, int(recording.rate / _RATE)) if len(recording) > _LONG else 1
    if every > 1:
        kept = np.append(np.arange(0, len(recording) - 1, every), len(recording) - 1)
        recording = recording.part(kept, f"every {every}th sample taken")
    return motion.refine(recording, _STEP_DISTANCE, _STEP_ANGLE)
