"""How far an arm reaches at most: what lies beyond needs no search."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._xml import parsed

__all__ = ["farthest_reach", "require_within_reach"]

_TOLERANCE = 1e-3  # m; of the figures in a robot's description


def farthest_reach(arm: Arm) -> tuple[Array, float]:
    """Return a ball that holds every place of an arm's tip: centre (3,) in the base frame and radius, m.

    The centre is where the first joint that moves is attached; the radius is the sum of the distances from each joint
    to the next and on to the tip, stretched all the way, and of what sliding joints add. The arm may reach less: joints
    cannot all be stretched. The radius is infinite where the description does not tell.
    """
    try:
        return _ball(_chain(arm), arm)
    except (ET.ParseError, ValueError):  # the arm was read by a parser that bears more
        return np.zeros(3), np.inf


def require_within_reach(point: ArrayLike, arm: Arm, what: str) -> None:
    """Refuse a place (3,) [m, base frame] that is farther away than an arm is long; `what` names it in the message.

    Raises
    ------
    InvalidArgument
        With the distance and the arm's length.
    """
    place = np.asarray(point, dtype=np.float64)
    centre, most = farthest_reach(arm)
    away = float(np.linalg.norm(place - centre))
    if away > most + _TOLERANCE:
        where = ", ".join(f"{x:g}" for x in place)
        raise InvalidArgument(
            f"{what} at ({where}) m lies {away:.3g} m from the first joint of arm {arm.name!r}, which is {most:.3g} m "
            f"long stretched out. State a point nearer to it, in m in the frame of {arm.base!r}."
        )


def _chain(arm: Arm) -> list[ET.Element]:
    """Return the joints from base to tip."""
    robot = parsed(arm.urdf)
    above = {_attribute(joint, "child", "link"): joint for joint in robot.findall("joint")}
    chain: list[ET.Element] = []
    link = arm.tip
    while link != arm.base:
        if link not in above or above[link] in chain:
            raise ValueError("the tip does not hang below the base.")
        chain.insert(0, above[link])
        link = _attribute(chain[0], "parent", "link")
    return chain


def _ball(chain: list[ET.Element], arm: Arm) -> tuple[Array, float]:
    centre, turn, radius = np.zeros(3), Rotation.identity(), 0.0
    moved = False
    for joint in chain:
        step = _vector(_attribute(joint, "origin", "xyz"))
        if moved:
            radius += float(np.linalg.norm(step))
        else:
            centre = centre + turn.apply(step)
            turn = turn * Rotation.from_euler("xyz", _vector(_attribute(joint, "origin", "rpy")))
        moved = moved or joint.get("type") != "fixed"
        radius += _stroke(joint, arm)
    return centre, radius if moved else np.inf


def _stroke(joint: ET.Element, arm: Arm) -> float:
    """Return how far a joint itself may carry what hangs on it, m."""
    if joint.get("type") in ("fixed", "revolute", "continuous"):
        return 0.0
    if joint.get("type") != "prismatic" or joint.get("name") not in arm.joint_names:
        return float("inf")
    k = arm.joint_names.index(joint.get("name", ""))
    return float(max(abs(arm.lower[k]), abs(arm.upper[k])))


def _attribute(joint: ET.Element, child: str, name: str) -> str:
    element = joint.find(child)
    return "" if element is None else element.get(name, "")


def _vector(text: str) -> Array:
    """Return three numbers; zeros where there are none."""
    vector = np.array([float(word) for word in text.split()] or [0.0, 0.0, 0.0])
    if vector.shape != (3,):
        raise ValueError(f"'{text}', expected three numbers.")
    return vector
