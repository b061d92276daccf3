"""Masses for links that state none: from the volume of their collision shapes, or placeholders where none count."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._description import links_beyond
from dmpcpp.robot._engine_urdf import write_inertia
from dmpcpp.robot._payload import with_description
from dmpcpp.robot._solids import solids_of
from dmpcpp.robot._xml import parsed

__all__ = ["DENSITY_NOTE", "links_by_density", "with_density", "without_dynamics"]

DENSITY_NOTE = "dmpcpp_density"
"""Attribute of an <inertial> that was computed from shapes."""


def with_density(arm: Arm, density: float) -> Arm:
    """Return the arm with masses and inertias for the moved links that state none, as solids of one density.

    Parameters
    ----------
    arm : Arm
    density : float
        kg/m^3, > 0, of the convex pieces of the collision shapes; 2700 is solid aluminium, and a casting with motors
        and gears has about a third of that.

    Raises
    ------
    InvalidArgument
        A density that is not positive, or no link that lacks a mass has a shape.
    """
    if not 0.0 < density < math.inf:
        raise InvalidArgument(f"density: {density}, expected a positive number of kg/m^3.")
    robot = parsed(arm.urdf)
    lacking = [link for link in _moved(robot, arm) if not _weighs(link)]
    solid = [(link, pieces) for link in lacking if (pieces := list(solids_of(link, arm.folder)))]
    if not solid:
        raise InvalidArgument("density: no moved link lacks a mass and has a collision shape; leave it out.")
    for link, pieces in solid:
        _write(link, density, pieces)
    return with_description(arm, robot)


def without_dynamics(arm: Arm) -> Arm:
    """Return the arm for a run by kinematics alone: no effort limits, and placeholders where masses are missing."""
    robot = parsed(arm.urdf)
    for link in _moved(robot, arm):
        if not _weighs(link):
            _replace_inertial(link, 1.0, np.zeros(3), 0.01 * np.eye(3))
    return with_description(arm, robot).with_limits(effort=np.full(arm.joint_count, np.inf))


def links_by_density(arm: Arm) -> tuple[str, ...]:
    """Return the links whose mass was computed from their shapes."""
    found = parsed(arm.urdf).findall("link")
    return tuple(link.get("name", "") for link in found if link.find(f"inertial[@{DENSITY_NOTE}]") is not None)


def _moved(robot: ET.Element, arm: Arm) -> list[ET.Element]:
    names = links_beyond(robot, arm.joint_names[0])
    return [link for link in robot.findall("link") if link.get("name") in names]


def _weighs(link: ET.Element) -> bool:
    mass = link.find("inertial/mass")
    return mass is not None and float(mass.get("value", 0.0)) > 0.0


def _write(link: ET.Element, density: float, pieces: list[tuple[float, Array, Array]]) -> None:
    volume = sum(piece[0] for piece in pieces)
    centre = sum((v * c for v, c, _ in pieces), np.zeros(3)) / volume
    moment = sum((m for _, _, m in pieces), np.zeros((3, 3))) - volume * np.outer(centre, centre)
    _replace_inertial(link, density * volume, centre, density * (np.trace(moment) * np.eye(3) - moment))
    link.find("inertial").set(DENSITY_NOTE, repr(density))  # type: ignore[union-attr]


def _replace_inertial(link: ET.Element, mass: float, centre: Array, inertia: Array) -> None:
    for old in link.findall("inertial"):
        link.remove(old)
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=" ".join(repr(float(x)) for x in centre))
    ET.SubElement(inertial, "mass", value=repr(float(mass)))
    write_inertia(ET.SubElement(inertial, "inertia"), inertia)
