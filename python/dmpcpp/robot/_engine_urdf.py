"""A URDF written anew for the physics engines, with only what they read.

Engines stumble over what others put into a description: elements of other programs, ``<dynamics>`` with friction
alone, lines longer than a buffer, inertias whose frame is turned. Written anew, one element a line, none is left.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from xml.sax.saxutils import quoteattr

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array

__all__ = ["inertia_of", "write_inertia", "written"]

_COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_LINK = {
    "inertial": {"origin": {}, "mass": {}, "inertia": {}},
    "collision": {"origin": {}, "geometry": {"mesh": {}, "box": {}, "cylinder": {}, "sphere": {}, "capsule": {}}},
}
_MATERIAL = {"color": {}, "texture": {}}
_READ = {
    "link": {**_LINK, "visual": {**_LINK["collision"], "material": _MATERIAL}},
    "joint": {"parent": {}, "child": {}, "origin": {}, "axis": {}, "limit": {}, "dynamics": {}},
    "material": _MATERIAL,
}


def written(robot: ET.Element) -> str:
    """Return the robot as text: what engines read and nothing else, an element a line.

    Inertias are turned into the frame of their link. That of the root, which stands, is replaced by one that is the
    same about every axis: it changes no torque, and Bullet turns gravity with its frame.
    """
    root = _root(robot)
    for link in robot.findall("link"):
        _turn_inertia(link, link.get("name") == root)
    name = quoteattr(robot.get("name") or "robot")
    lines = [f"<robot name={name}>", *_lines_of_parts(robot), "</robot>"]
    return "\n".join(lines) + "\n"


def inertia_of(element: ET.Element) -> Array:
    """Return the matrix (3, 3) of an ``<inertia>``; ValueError for what is not made of numbers."""
    xx, xy, xz, yy, yz, zz = (float(element.get(name, 0.0)) for name in _COMPONENTS)
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def write_inertia(element: ET.Element, inertia: Array) -> None:
    """Write the matrix (3, 3) into an ``<inertia>``."""
    for name, (row, column) in zip(_COMPONENTS, zip(*np.triu_indices(3), strict=True), strict=True):
        element.set(name, repr(float(inertia[row, column])))


def _root(robot: ET.Element) -> str:
    children = {child.get("link") for child in robot.iterfind("joint/child")}
    return next((name for link in robot.findall("link") if (name := link.get("name", "")) not in children), "")


def _turn_inertia(link: ET.Element, stands: bool) -> None:
    inertial = link.find("inertial")
    element = None if inertial is None else inertial.find("inertia")
    if inertial is None or element is None:
        return
    inertia, origin = inertia_of(element), inertial.find("origin")
    turn = [float(word) for word in (origin.get("rpy", "0 0 0") if origin is not None else "0 0 0").split()]
    if stands:
        inertia = np.eye(3) * np.trace(inertia) / 3.0
    elif any(turn):
        rotation = Rotation.from_euler("xyz", turn).as_matrix()
        inertia = rotation @ inertia @ rotation.T
        inertia = 0.5 * (inertia + inertia.T)
    elif origin is None:
        return
    if origin is not None:
        origin.set("rpy", "0 0 0")
    write_inertia(element, inertia)


def _lines_of_parts(robot: ET.Element) -> Iterator[str]:
    for part in robot:
        if part.tag in _READ:
            yield from _lines(part, _READ[part.tag])


def _lines(element: ET.Element, known: dict[str, dict]) -> Iterator[str]:  # type: ignore[type-arg]
    attributes = _damping(element) if element.tag == "dynamics" else dict(element.items())
    if element.tag == "dynamics" and not attributes:
        return
    if element.tag in ("collision", "visual"):
        attributes.pop("name", None)  # engines want no two alike
    attributes = {name: value for name, value in attributes.items() if "{" not in name}  # of other programs
    opened = " ".join([f"<{element.tag}", *(f"{name}={quoteattr(value)}" for name, value in attributes.items())])
    inside = [line for part in element if part.tag in known for line in _lines(part, known[part.tag])]
    if not inside:
        yield f"{opened}/>"
        return
    yield from (f"{opened}>", *inside, f"</{element.tag}>")


def _damping(element: ET.Element) -> dict[str, str]:
    """The damping alone, where there is some; the Coulomb friction of a joint is left out."""
    damping = float(element.get("damping", 0.0) or 0.0)
    return {"damping": repr(damping), "friction": "0"} if damping > 0.0 else {}
