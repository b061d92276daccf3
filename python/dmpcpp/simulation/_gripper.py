"""A parallel gripper at the tip of an arm: what grasping needs to know of it."""

from __future__ import annotations

from dataclasses import dataclass

from dmpcpp.simulation._objects import Friction


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
