"""How far the joints of a described robot move points of its links, for proofs about what lies between two postures."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.robot._shapes import balls, end_of, number, pose_of

__all__ = ["Levers"]


class Levers:
    """Levers of joints: m a rad, or 1 for a joint that slides.

    Between two postures no point of a link moves farther than the steps of joints times their levers: the sum of
    distances from joint to joint and on to the farthest point of the link, as if stretched all the way.

    Attributes
    ----------
    all : (n,)
        To any point of any link.
    """

    def __init__(self, robot: ET.Element, joints: Sequence[str], aliases: Mapping[str, str] | None = None) -> None:
        """Of the joints named, in their order; `aliases` are names in the description of links with another name."""
        self._number = {name: k for k, name in enumerate(joints)}
        self._aliases = aliases or {}
        above = {end_of(joint, "child"): joint for joint in robot.findall("joint")}
        self._reach = {
            link.get("name", ""): self._reach_of(link.get("name", ""), _extent(link), above)
            for link in robot.findall("link")
        }
        self._found: dict[tuple[str, str], Array] = {}
        self.all = np.max([self._array(reach) for reach in self._reach.values()], axis=0)

    def between(self, link: str, other: str) -> Array:
        """Return the levers (n,) with which joints move two links against each other, or a link and what is none."""
        if (link, other) not in self._found:
            one, two = (self._reach.get(self._aliases.get(name, name), {}) for name in (link, other))
            apart = {
                k: lever for reach, beyond in ((one, two), (two, one)) for k, lever in reach.items() if k not in beyond
            }
            self._found[link, other] = self._array(apart)
        return self._found[link, other]

    def _reach_of(self, link: str, extent: float, above: Mapping[str, ET.Element]) -> dict[int, float]:
        """Return the lever of each joint between the root and a link, to the points of that link."""
        found, far = {}, extent
        while link in above:
            joint = above[link]
            if joint.get("name") in self._number:
                found[self._number[joint.get("name", "")]] = 1.0 if joint.get("type") == "prismatic" else far
            far += _step(joint)
            link = end_of(joint, "parent")
        return found

    def _array(self, levers: Mapping[int, float]) -> Array:
        found = np.zeros(len(self._number))
        for k, lever in levers.items():
            found[k] = lever
        return found


def _extent(link: ET.Element) -> float:
    """How far the shapes of a link reach from the origin of its frame, m."""
    return max((float(np.linalg.norm(p, axis=1).max()) + r for p, r in balls(link)), default=0.0)


def _step(joint: ET.Element) -> float:
    """How far a joint's child is from its parent at most, m."""
    stroke = 0.0
    limit = joint.find("limit")
    if joint.get("type") == "prismatic" and limit is not None:
        stroke = max(abs(number(limit.get("lower"))), abs(number(limit.get("upper"))))
    return float(np.linalg.norm(pose_of(joint)[:3, 3])) + stroke
