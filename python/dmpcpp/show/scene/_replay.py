"""A motion of an arm as a page that plays without a server or a network."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.show.scene._robot import ShownArm
from dmpcpp.show.scene._server import serving

if TYPE_CHECKING:
    from viser import ViserServer

Colour = tuple[int, int, int]

__all__ = ["replay_page"]

_FRAMES_PER_SECOND = 20.0
_MOST_FRAMES = 400
_POINTS = 300  # of a path
_ORANGE, _INK = (230, 159, 0), (26, 26, 26)


def replay_page(
    arm: Arm, time: Array, joints: Array, *, executed: Array, demonstrated_time: Array, demonstrated: Array
) -> str:
    """Return one HTML page that plays the arm's motion beside the demonstrated path of the hand.

    Parameters
    ----------
    arm : Arm
    time : (T,) s
    joints : (T, n) rad
        As executed.
    executed : (T, 4, 4)
        Poses of the tool in the arm's base frame; drawn in black.
    demonstrated_time, demonstrated : (K,) s, (K, 4, 4)
        Those of the hand; drawn in orange. The hand is shown at the tool's phase: both begin and end together.

    Returns
    -------
    str
        The page, about 1 MB, with everything in it: viser's client (MIT licence) and the recorded scene.

    Raises
    ------
    InvalidArgument
        Arrays of different lengths, or a mesh that cannot be found.
    MissingDependency
        viser or yourdfpy is not installed.
    """
    if not len(time) == len(joints) == len(executed) or len(time) < 2:
        raise InvalidArgument(
            f"time, joints, executed: {len(time)}, {len(joints)}, {len(executed)} samples, expected as many, >= 2."
        )
    with serving() as server:
        shown = ShownArm(server, arm)
        look_at(server, executed[:, :3, 3])
        draw_path(server, "/demonstrated", demonstrated[:, :3, 3], _ORANGE, 0.008)
        draw_path(server, "/executed", executed[:, :3, 3], _INK, 0.004)
        hand = server.scene.add_icosphere("/hand", radius=0.018, color=_ORANGE)
        tool = server.scene.add_frame("/tool", axes_length=0.09, axes_radius=0.004)
        frames = _frames(time)
        hands = _at_phase(demonstrated_time, len(frames))
        record = server.get_scene_serializer()
        for k, h in zip(frames, hands, strict=True):
            shown.move(joints[k])
            hand.position = demonstrated[h, :3, 3]
            tool.position, tool.wxyz = executed[k, :3, 3], quaternion(executed[k])
            record.insert_sleep(float(time[-1] - time[0]) / len(frames))
        return record.as_html()


def draw_path(server: ViserServer, name: str, points: Array, colour: Colour, width: float) -> None:
    """Draw a path (K, 3) [m] as a line as thick as `width` [m]."""
    few = points[np.unique(np.linspace(0, len(points) - 1, _POINTS).round().astype(int))]
    server.scene.add_line_segments(name, np.stack([few[:-1], few[1:]], axis=1), colour, thickness=width)


def look_at(server: ViserServer, points: Array) -> None:
    """Begin with arm and path (K, 3) [m] in the picture."""
    corners = np.vstack([points, np.zeros(3)])
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    away = 0.6 + 0.75 * float(np.linalg.norm(np.ptp(corners, axis=0)))
    side = np.cross([0.0, 0.0, 1.0], middle)
    side = side / np.linalg.norm(side) if np.linalg.norm(side) > 1e-6 else np.array([0.0, -1.0, 0.0])
    ahead = np.array([side[1], -side[0], 0.0])
    server.initial_camera.look_at = middle
    server.initial_camera.position = middle + away * (0.85 * ahead - 0.45 * side + 0.3 * np.array([0.0, 0.0, 1.0]))


def quaternion(pose: Array) -> Array:
    """Return the orientation of a pose (4, 4) as viser takes it: w, x, y, z."""
    return np.asarray(Rotation.from_matrix(pose[:3, :3]).as_quat()[[3, 0, 1, 2]])


def _frames(time: Array) -> NDArray[np.intp]:
    """Samples at even times, about twenty a second."""
    count = int(np.clip((time[-1] - time[0]) * _FRAMES_PER_SECOND, 2, _MOST_FRAMES))
    return _at_phase(time, count)


def _at_phase(time: Array, count: int) -> NDArray[np.intp]:
    return np.searchsorted(time, np.linspace(time[0], time[-1], count)).clip(0, len(time) - 1)
