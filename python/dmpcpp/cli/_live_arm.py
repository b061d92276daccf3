"""The arm in the viewfinder: a sketch that follows the hand as one camera sees it, frame by frame."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np

if TYPE_CHECKING:
    from dmpcpp._core import Arm
    from dmpcpp._typing import Array

__all__ = ["LiveArm"]

_SPAN = 0.8  # m that the arm's tip goes while the hand crosses the picture
_CAMERA_TO_BASE = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])  # away from the camera is forwards


class LiveArm:
    """Poses an arm for a hand; `__call__` returns its joints from the side, points (N, 2) of a square from 0 to 1."""

    def __init__(self, arm: Arm) -> None:
        """Begin with every joint in the middle of its range."""
        from dmpcpp._core import InverseKinematics

        self._solver = InverseKinematics(arm)
        self._joints = np.array(self._solver.middle)
        self._start = arm.forward_kinematics(self._joints)
        self._parts = _parts(arm)
        self._first: tuple[Array, Array] | None = None
        points = np.array(self._points())
        self._reach = 1.3 * max(float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()), 0.1)

    def __call__(self, pixels: Array, world: Array) -> list[list[float]]:
        """Follow landmarks (21, 2), 0 to 1 of the picture, and (21, 3) [m]."""
        from dmpcpp.cameras import palm_frame

        size = float(np.linalg.norm(pixels[9] - pixels[0]))
        now = palm_frame(world), np.array([*pixels[9], 1.0 / max(size, 0.02)])
        first = self._first = self._first or now
        moved = _SPAN * (now[1] - first[1]) * [1.0, 1.0, 0.1]
        wanted = self._start.copy()
        wanted[:3, 3] += _CAMERA_TO_BASE @ moved
        wanted[:3, :3] = _CAMERA_TO_BASE @ now[0] @ first[0].T @ _CAMERA_TO_BASE.T @ wanted[:3, :3]
        self._joints = np.array(self._solver.solve(wanted, self._joints).joints)
        side = np.array(self._points())[:, [0, 2]] / self._reach
        return np.round(np.stack([0.5 + 0.5 * side[:, 0], 0.75 - 0.5 * side[:, 1]], axis=1), 4).tolist()

    def _points(self) -> list[Array]:
        ends = [part.forward_kinematics(self._joints[: part.joint_count])[:3, 3] for part in self._parts]
        return [np.zeros(3), *ends]


def _parts(arm: Arm) -> list[Arm]:
    """Return the chains from the base to the link behind each joint, the whole arm last."""
    from dmpcpp._core import Arm

    above = {
        joint.find("child").get("link"): (joint.find("parent").get("link"), joint.get("type"))  # type: ignore[union-attr]
        for joint in ElementTree.fromstring(arm.urdf).iter("joint")
        if joint.find("child") is not None and joint.find("parent") is not None
    }
    links, link = [], arm.tip
    while link != arm.base and link in above:
        parent, kind = above[link]
        if kind != "fixed":
            links.append(link)
        link = parent
    return [*(Arm.from_urdf(arm.urdf, arm.base, str(each), arm.folder) for each in reversed(links)), arm]
