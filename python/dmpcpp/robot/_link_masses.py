"""Masses and inertias of links as an engine needs them: what is replaced, and how much is missing."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._contact_rules import groups_of
from dmpcpp.robot._engine_urdf import inertia_of, write_inertia
from dmpcpp.robot._inertia import InertiaRepair, is_physical, moment_change, nearest_physical
from dmpcpp.robot._solids import solids_of

__all__ = ["refuse_massless", "repaired", "shares_without_mass"]

_STEEL = 7850.0
"""kg/m^3: no part of an arm weighs more than its shape in solid steel."""
_NOTHING = 1e-6
"""Share of a body's mass up to which a part of it is a mere frame."""


def shares_without_mass(robot: ET.Element, arm: Arm, moved: frozenset[str]) -> dict[str, float]:
    """Return for each moved link without mass, or with a mass but no inertia, what that may come to.

    A share of the mass of all that the arm moves with it as one body: the link's mass, or what its shapes would weigh
    in solid steel. The shares of one body are summed up; infinite where it states no mass at all.
    """
    links = {link.get("name", ""): link for link in robot.findall("link")}
    found: dict[str, float] = {}
    for group in set(groups_of(robot, lambda joint: joint.get("name") not in arm.joint_names).values()):
        stated = sum(_mass(links[name]) for name in group)
        weights = {name: _unstated(links[name], arm.folder) for name in sorted(group & moved)}
        lacking = {name: weight for name, weight in weights.items() if weight is not None}
        share = sum(lacking.values()) / stated if stated > 0.0 else math.inf
        found |= dict.fromkeys(lacking, share)
    return found


def repaired(robot: ET.Element, unstated: Mapping[str, float]) -> Iterator[InertiaRepair]:
    """Give every link an inertia that a body can have; yield what was replaced, and what is missing."""
    for link in robot.findall("link"):
        repair = _repair(link, unstated.get(link.get("name", ""), math.inf))
        if repair is not None and repair.change > _NOTHING:
            yield repair


def refuse_massless(robot: ET.Element, last: str, beyond: frozenset[str]) -> None:
    """A joint that carries no mass has undefined dynamics; the last joint, and the links beyond, carry the least."""
    masses = [mass for link in robot.findall("link") if link.get("name") in beyond for mass in link.iter("mass")]
    if not any(float(mass.get("value", 0.0)) > 0.0 for mass in masses):
        raise InvalidArgument(
            f"arm.urdf: no link beyond joint '{last}' has a mass, expected one that physics can move. Give "
            f"{', '.join(sorted(beyond))} an <inertial>, take the masses from the shapes "
            "(arms.with_stated(arm, density=2700)), or run by kinematics alone (dynamics='none'); `dmpcpp check-urdf` "
            "names every link without one."
        )


def _mass(link: ET.Element) -> float:
    """Return the mass that a link states, kg; 0 for one that is none, which is refused elsewhere."""
    try:
        mass = float(getattr(link.find("inertial/mass"), "attrib", {}).get("value", 0.0))
    except ValueError:
        return 0.0
    return mass if 0.0 < mass < math.inf else 0.0


def _unstated(link: ET.Element, folder: str) -> float | None:
    """Return the mass of a link that states no inertia, kg: its own, or that of its shapes in steel; else None."""
    mass = _mass(link)
    if mass > 0.0:
        return None if _read_inertia(link).any() else mass
    if link.find("collision") is None:
        return None
    try:
        return _STEEL * sum(volume for volume, _, _ in solids_of(link, folder))
    except InvalidArgument:  # a mesh that cannot be read, which is refused elsewhere
        return math.inf


def _repair(link: ET.Element, share: float) -> InertiaRepair | None:
    """Replace an inertia that is not physical; a link without mass and inertia is only a frame and stays.

    A link that has a shape to collide with is a body, and no body is without mass.
    """
    name, is_body = link.get("name", ""), link.find("collision") is not None
    inertial = link.find("inertial")
    if inertial is None:
        _make_massless(link)
        return InertiaRepair(name, share, missing=True) if is_body else None
    element = inertial.find("inertia")
    mass = float(getattr(inertial.find("mass"), "attrib", {}).get("value", 0.0))
    if not 0.0 <= mass < np.inf:
        raise InvalidArgument(f"arm.urdf: link '{name}': <mass>: {mass} kg, expected 0 or more.")
    inertia = _read_inertia(link)
    if mass == 0.0 and not inertia.any():
        return InertiaRepair(name, share, missing=True) if is_body else None
    if is_physical(inertia):
        return None
    if element is None:
        element = ET.SubElement(inertial, "inertia")
    nearest = nearest_physical(inertia)
    write_inertia(element, nearest)
    return InertiaRepair(name, moment_change(inertia, nearest) if inertia.any() else share, missing=not inertia.any())


def _make_massless(link: ET.Element) -> None:
    """Say in the URDF what a missing <inertial> means: no mass. (Bullet would take 1 kg.)"""
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "mass", value="0")
    write_inertia(ET.SubElement(inertial, "inertia"), np.zeros((3, 3)))


def _read_inertia(link: ET.Element) -> Array:
    name, element = link.get("name"), link.find("inertial/inertia")
    if element is None:
        return np.zeros((3, 3))
    try:
        inertia = inertia_of(element)
    except ValueError as error:
        raise InvalidArgument(f"arm.urdf: link '{name}': <inertia>: {error}. Give six numbers.") from None
    if not np.isfinite(inertia).all():
        raise InvalidArgument(f"arm.urdf: link '{name}': <inertia> is not finite. Give six numbers.")
    return inertia
