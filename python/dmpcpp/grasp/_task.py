"""What is to be grasped and from where: the bottle, its place, and poses of the hand around it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from dmpcpp._core import Box
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import Obstacle
from dmpcpp.simulation import Cylinder

__all__ = ["Bottle", "clutter", "hand_pose", "random_bottle"]

_X, _Y, _YAW = (0.40, 0.60), (-0.25, 0.25), (-0.25, 0.25)  # m, m, rad
_MISJUDGED = 0.004  # m


@dataclass(frozen=True)
class Bottle:
    """A cylinder that stands upright, and what the robot takes its place to be.

    Attributes
    ----------
    x, y : float
        m, of its axis in the robot's base frame.
    yaw : float
        rad about z, from x: the direction, seen from above, in which the hand shall come.
    height : float
        m above the robot's base, of what it stands on: a column, or at 0 the floor.
    grasp_height : float
        m above its lower face, where the fingers shall grip.
    misjudged : (float, float, float)
        m, by which the robot takes the bottle to be elsewhere; it plans with that error.
    cylinder : Cylinder
    """

    x: float = 0.5
    y: float = 0.0
    yaw: float = 0.0
    height: float = 0.25
    grasp_height: float = 0.12
    misjudged: tuple[float, float, float] = (0.0, 0.0, 0.0)
    cylinder: Cylinder = field(default_factory=Cylinder)

    def __post_init__(self) -> None:
        """Refuse what is no place."""
        for name in ("x", "y", "yaw"):
            if not np.isfinite(getattr(self, name)):
                raise InvalidArgument(f"{name}: {getattr(self, name)}, expected a finite number.")
        if not 0.0 <= self.height < np.inf:
            raise InvalidArgument(f"height: {self.height} m, expected 0 (the floor) or more.")
        if not 0.0 < self.grasp_height < self.cylinder.height:
            raise InvalidArgument(
                f"grasp_height: {self.grasp_height} m, expected more than 0 and less than the bottle's height of "
                f"{self.cylinder.height} m."
            )
        if np.shape(self.misjudged) != (3,) or not np.isfinite(self.misjudged).all():
            raise InvalidArgument(f"misjudged: {self.misjudged}, expected three finite numbers (m).")

    @property
    def place(self) -> Array:
        """Where the middle of its lower face really is (3,) [m]."""
        return np.array([self.x, self.y, self.height])

    @property
    def believed_place(self) -> Array:
        """Where the robot takes that to be (3,) [m], on a stand of the height it knows."""
        return self.place + np.array([*self.misjudged[:2], 0.0])

    @property
    def grasp_point(self) -> Array:
        """Where the robot closes its fingers (3,) [m]."""
        return self.place + np.array([0.0, 0.0, self.grasp_height]) + np.array(self.misjudged)


def random_bottle(random: np.random.Generator, cylinder: Cylinder | None = None) -> Bottle:
    """Draw a bottle: x 0.40 to 0.60 m, y and yaw within 0.25 m and rad, misjudged by up to 4 mm on each axis."""
    x, y, yaw = (float(random.uniform(*span)) for span in (_X, _Y, _YAW))
    dx, dy, dz = random.uniform(-_MISJUDGED, _MISJUDGED, 3).tolist()
    return Bottle(x, y, yaw, misjudged=(dx, dy, dz), cylinder=cylinder or Cylinder())


def clutter(count: int, bottle: Bottle, random: np.random.Generator) -> tuple[Obstacle, ...]:
    """Draw posts on the floor, 14 to 30 cm from a bottle and 30 cm or more from the robot, lower and higher than it."""
    drawn: list[Obstacle] = []
    while len(drawn) < count:
        angle, far = float(random.uniform(-np.pi, np.pi)), float(random.uniform(0.14, 0.30))
        x, y = bottle.x + far * np.cos(angle), bottle.y + far * np.sin(angle)
        height = bottle.height + float(random.uniform(0.05, 0.25))
        half = (*random.uniform(0.01, 0.03, 2), 0.5 * height)
        pose = np.eye(4)
        pose[:3, 3] = x, y, 0.5 * height
        if np.hypot(x, y) >= 0.3:
            drawn.append(Obstacle(f"clutter_{len(drawn) + 1}", Box(pose, half)))
    return tuple(drawn)


def hand_pose(point: Array, yaw: float, pitch: float, depth: float, turned: bool = False) -> Array:
    """Pose (4, 4) of a tip that grips at `point`, its z pointing along `yaw` and `pitch` below the horizontal.

    The fingers open along y, which is level. `turned` is the same grip with the hand turned by half a turn
    about z; `depth` is the distance from the tip to the point along z [m].
    """
    c, s = np.cos(yaw), np.sin(yaw)
    approach = np.array([c * np.cos(pitch), s * np.cos(pitch), -np.sin(pitch)])
    across = np.array([-s, c, 0.0]) * (-1.0 if turned else 1.0)
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([np.cross(across, approach), across, approach])
    pose[:3, 3] = point - depth * approach
    return pose
