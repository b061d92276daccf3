"""A payload that planner, controller and engines know of; and the same arm with another description."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence

from dmpcpp._core import Arm
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._urdf_changes import KNOWN_PAYLOAD, add_payload
from dmpcpp.robot._xml import parsed

__all__ = ["payload_of", "with_description", "with_payload"]


def with_payload(arm: Arm, mass: float, at: Sequence[float] = (0.0, 0.0, 0.0)) -> Arm:
    """Return the arm with a payload fixed to its tip link, which planner, controller and engines know of.

    Parameters
    ----------
    arm : Arm
    mass : float
        kg, >= 0.
    at : (3,)
        Its centre in the frame of the tip link [m].
    """
    place = tuple(float(x) for x in at)
    if not 0.0 <= mass < math.inf or len(place) != 3 or not all(map(math.isfinite, place)):
        raise InvalidArgument(f"payload: {mass}, {list(at)}, expected a mass in kg >= 0 and a place x, y, z in m.")
    robot = parsed(arm.urdf)
    for tag in ("link", "joint"):
        for element in robot.findall(tag):
            if element.get("name", "").startswith(KNOWN_PAYLOAD):
                robot.remove(element)
    if mass > 0.0:
        add_payload(robot, arm.tip, mass, place, KNOWN_PAYLOAD)
    return with_description(arm, robot)


def payload_of(arm: Arm) -> float:
    """Return the mass of the payload that was stated [kg]."""
    mass = parsed(arm.urdf).find(f"link[@name='{KNOWN_PAYLOAD}']/inertial/mass")
    return 0.0 if mass is None else float(mass.get("value", 0.0))


def with_description(arm: Arm, robot: ET.Element) -> Arm:
    """Return the arm with another description of the same joints; its limits, sources and frames stay."""
    _, *rest = arm.__getstate__()  # type: ignore[misc]
    changed = Arm.__new__(Arm)
    changed.__setstate__((ET.tostring(robot, encoding="unicode").encode(), *rest))  # type: ignore[attr-defined]
    return changed
