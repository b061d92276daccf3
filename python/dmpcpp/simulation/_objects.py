"""Things to be handled: what an engine needs to know of an object."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import Obstacle
from dmpcpp.simulation._simulator import FLOOR


@dataclass(frozen=True)
class Friction:
    """Coulomb friction of a surface; an engine combines those of two that touch (Bullet by their product).

    Attributes
    ----------
    lateral : float
        Against sliding [1], >= 0.
    spinning, rolling : float
        Against turning about the contact's normal and about an axis in its plane [m], >= 0.
    """

    lateral: float
    spinning: float = 0.0
    rolling: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no friction."""
        for name in ("lateral", "spinning", "rolling"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise InvalidArgument(f"{name}: {getattr(self, name)}, expected a number >= 0.")


@dataclass(frozen=True)
class Cylinder:
    """A solid cylinder of even density, upright while its axis is z.

    Attributes
    ----------
    radius, height : float
        [m], > 0.
    mass : float
        [kg], > 0.
    friction : Friction
    """

    radius: float = 0.03
    height: float = 0.16
    mass: float = 0.3
    friction: Friction = Friction(0.8, spinning=1e-3, rolling=1e-4)

    def __post_init__(self) -> None:
        """Refuse what is no body."""
        for name in ("radius", "height", "mass"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise InvalidArgument(f"{name}: {getattr(self, name)}, expected a positive number.")


@dataclass(frozen=True)
class ParallelGripper:
    """Two fingers that move towards each other along y of the tip, which points along z.

    Attributes
    ----------
    joints, links : (str, str)
        The fingers' sliding joints, 0 where they meet, and their links.
    opening : float
        Joint value of a finger when the gripper is open [m]: half the width between the fingers.
    depth : float
        Where the fingers grip: distance from the tip along its z [m].
    force : float
        With which each finger closes [N].
    friction : Friction
        Of the fingers' surface.
    """

    joints: tuple[str, str]
    links: tuple[str, str]
    opening: float
    depth: float
    force: float
    friction: Friction


PANDA_HAND = ParallelGripper(
    joints=("panda_finger_joint1", "panda_finger_joint2"),
    links=("panda_leftfinger", "panda_rightfinger"),
    opening=0.04,
    depth=0.105,
    force=20.0,
    friction=Friction(1.0),
)
"""Franka's hand on the arm ``arms.find("panda")``; the depth is that of the URDF's panda_grasptarget."""


@dataclass(frozen=True)
class Box:
    """A fixed box with its sides along the axes of the root's frame.

    Attributes
    ----------
    name : str
        As contacts name it; not that of a link, and not "floor".
    size : (float, float, float)
        Along x, y, z [m], > 0.
    centre : (float, float, float)
        [m] in the root's frame.

    Raises
    ------
    InvalidArgument
        A size that is not positive, or a number that is not finite.
    """

    name: str
    size: tuple[float, float, float]
    centre: tuple[float, float, float]

    def __post_init__(self) -> None:
        """Refuse what is no box."""
        for name in ("size", "centre"):
            value = getattr(self, name)
            if np.shape(value) != (3,) or not np.isfinite(value).all():
                raise InvalidArgument(f"{name} of box '{self.name}': {value}, expected three finite numbers [m].")
        if min(self.size) <= 0.0:
            raise InvalidArgument(f"size of box '{self.name}': {self.size}, expected three positive numbers [m].")


def refuse_names(obstacles: Sequence[Box | Obstacle], links: Collection[str]) -> None:
    """Refuse a name that contacts would take for something else: of a link, of the floor, of another obstacle."""
    for k, box in enumerate(obstacles):
        taken = {*links, FLOOR, *(other.name for other in obstacles[:k])}
        if box.name in taken:
            raise InvalidArgument(
                f"obstacles[{k}].name: '{box.name}' is a link, the floor or another obstacle. Give it its own."
            )
