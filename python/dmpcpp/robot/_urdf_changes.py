"""Changes to a URDF that every engine then sees alike: other masses, a payload, joints that do not move."""

from __future__ import annotations

import warnings
import xml.etree.ElementTree as ET
from collections.abc import Collection, Mapping

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array

PAYLOAD_LINK = "dmpcpp_payload"
"""Of a disturbance: the controller does not know of it."""
KNOWN_PAYLOAD = "dmpcpp_known_payload"
_LONG_NAME = 200
_MANY_LINKS = 100
_PAYLOAD_RADIUS = 0.03  # m


def scale_masses(robot: ET.Element, factors: Mapping[str, float]) -> None:
    """Multiply mass and inertia of the named links."""
    for link in robot.findall("link"):
        factor = factors.get(link.get("name", ""), 1.0)
        for element in (*link.findall("inertial/mass"), *link.findall("inertial/inertia")):
            for name, value in element.items():
                element.set(name, repr(float(value) * factor))


def add_payload(robot: ET.Element, tip: str, mass: float, offset: tuple[float, ...], name: str = PAYLOAD_LINK) -> None:
    """Fix a solid sphere of ``mass`` [kg] to the tip, without a collision shape."""
    inertia = repr(0.4 * mass * _PAYLOAD_RADIUS**2)
    link = ET.SubElement(robot, "link", name=name)
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "mass", value=repr(mass))
    moments = {"ixx": inertia, "iyy": inertia, "izz": inertia, "ixy": "0", "ixz": "0", "iyz": "0"}
    ET.SubElement(inertial, "inertia", moments)
    joint = ET.SubElement(robot, "joint", name=f"{name}_joint", type="fixed")
    ET.SubElement(joint, "parent", link=tip)
    ET.SubElement(joint, "child", link=name)
    ET.SubElement(joint, "origin", xyz=_text(offset))


def normalize_axes(robot: ET.Element) -> None:
    """Give every joint's axis the length 1, as ``Arm`` does: Bullet takes a longer one for a faster joint."""
    for axis in robot.iterfind("joint/axis"):
        axis.set("xyz", axis.get("xyz", "1 0 0"))  # MuJoCo asks for it
        vector = _vector(axis.get("xyz", ""))
        length = float(np.linalg.norm(vector))
        if length > 0.0 and length != 1.0:
            axis.set("xyz", _text(vector / length))


def rename_links(robot: ET.Element) -> dict[str, str]:
    """Rename links that an engine cannot bear; return the new names by the old ones.

    To MuJoCo "world" is what stands still, and Bullet reads lines of 8191 bytes.
    """
    names = [link.get("name", "") for link in robot.findall("link")]
    aliases = {name: f"dmpcpp_link_{k}" for k, name in enumerate(names) if name == "world" or len(name) > _LONG_NAME}
    for element in (*robot.findall("link"), *robot.iterfind("joint/parent"), *robot.iterfind("joint/child")):
        key = "name" if element.tag == "link" else "link"
        element.set(key, aliases.get(element.get(key, ""), element.get(key, "")))
    return aliases


def remove_bare_frames(robot: ET.Element, keep: Collection[str]) -> None:
    """Take out fixed links at the ends that have neither mass nor shape, where there are many links.

    Bullet takes robots of 128 links, and descriptions are full of frames.
    """
    if len(robot.findall("link")) <= _MANY_LINKS:
        return
    links = {link.get("name", ""): link for link in robot.findall("link")}
    while ends := [joint for joint in robot.findall("joint") if _ends_in_bare_frame(robot, joint, links, keep)]:
        for joint in ends:
            robot.remove(joint)
            robot.remove(links.pop(_link_of(joint, "child")))


def _ends_in_bare_frame(
    robot: ET.Element, joint: ET.Element, links: Mapping[str, ET.Element], keep: Collection[str]
) -> bool:
    name = _link_of(joint, "child")
    link = links[name]
    mass = link.find("inertial/mass")
    weighs = mass is not None and float(mass.get("value", 0.0)) > 0.0
    has_shape = link.find("collision") is not None or link.find("visual") is not None
    goes_on = any(_link_of(other, "parent") == name for other in robot.findall("joint"))
    return joint.get("type") == "fixed" and not (weighs or has_shape or goes_on or name in keep)


def _link_of(joint: ET.Element, role: str) -> str:
    element = joint.find(role)
    return "" if element is None else element.get("link", "")


def freeze(robot: ET.Element, moving: Collection[str], types: Collection[str] = ()) -> None:
    """Fix every joint neither called as in ``moving`` nor of one of ``types``.

    In the middle of its range, as ``Bullet`` holds a finger by a motor.
    """
    for joint in robot.findall("joint"):
        if joint.get("type") not in ("fixed", *types) and joint.get("name") not in moving:
            _displace(joint, _middle(joint))
            joint.set("type", "fixed")
            for name in ("axis", "limit", "dynamics", "mimic", "safety_controller", "calibration"):
                for element in joint.findall(name):
                    joint.remove(element)


def _middle(joint: ET.Element) -> float:
    limit = joint.find("limit")
    lower, upper = (float(limit.get(end, 0.0)) if limit is not None else 0.0 for end in ("lower", "upper"))
    return 0.5 * (lower + upper) if lower < upper else 0.0


def _displace(joint: ET.Element, value: float) -> None:
    """Move the joint's origin to where the child stands at ``value`` [rad or m]."""
    origin = joint.find("origin")
    origin = ET.SubElement(joint, "origin") if origin is None else origin
    place, turn = (_vector(origin.get(name, "0 0 0")) for name in ("xyz", "rpy"))
    element = joint.find("axis")
    axis = _vector("1 0 0" if element is None else element.get("xyz", "1 0 0"))
    axis = axis / np.linalg.norm(axis)
    rotation = Rotation.from_euler("xyz", turn)
    if joint.get("type") == "prismatic":
        origin.set("xyz", _text(place + rotation.apply(value * axis)))
    else:
        with warnings.catch_warnings():  # in gimbal lock scipy warns and gives angles of the same rotation
            warnings.simplefilter("ignore", UserWarning)
            origin.set("rpy", _text((rotation * Rotation.from_rotvec(value * axis)).as_euler("xyz")))


def _vector(text: str) -> Array:
    return np.array([float(word) for word in text.split()])


def _text(vector: Collection[float] | Array) -> str:
    return " ".join(repr(float(value)) for value in vector)
