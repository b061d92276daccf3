"""Where the collision shapes of a described robot are, and how low it stands."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import product
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.robot._convex_pieces import mesh_points

__all__ = ["balls", "end_of", "lowest", "number", "points_of", "pose_of", "poses_at_rest"]


def lowest(robot: ET.Element, links: frozenset[str]) -> float:
    """Return the height of the lowest point of the shapes of links in the root's frame, m; infinity without any.

    Every joint stands at 0; those that are to stand elsewhere are to be frozen there before.
    """
    poses, height = poses_at_rest(robot), np.inf
    for link in robot.findall("link"):
        pose = poses.get(link.get("name", ""))
        if link.get("name") in links and pose is not None:
            for points, radius in balls(link):
                height = min(height, float((points @ pose[2, :3]).min() + pose[2, 3] - radius))
    return height


def poses_at_rest(robot: ET.Element) -> dict[str, Array]:
    """Return the pose (4, 4) of each link in the root's frame with every joint at 0."""
    joints: dict[str, list[tuple[str, Array]]] = {}
    children = set()
    for joint in robot.findall("joint"):
        parent, child = end_of(joint, "parent"), end_of(joint, "child")
        joints.setdefault(parent, []).append((child, pose_of(joint)))
        children.add(child)
    poses = {link.get("name", ""): np.eye(4) for link in robot.findall("link") if link.get("name") not in children}
    open_links = list(poses)
    while open_links:
        parent = open_links.pop()
        for child, frame in joints.get(parent, []):
            poses[child] = poses[parent] @ frame
            open_links.append(child)
    return poses


def balls(link: ET.Element) -> list[tuple[Array, float]]:
    """Return points (N, 3) in the link's frame and a radius: the shape is within these balls, and touches them."""
    found = []
    for collision in link.findall("collision"):
        geometry, frame = collision.find("geometry"), pose_of(collision)
        points, radius = points_of(geometry) if geometry is not None else (np.empty((0, 3)), 0.0)
        if len(points):
            found.append((points @ frame[:3, :3].T + frame[:3, 3], radius))
    return found


def points_of(geometry: ET.Element) -> tuple[Array, float]:
    """Return points (N, 3) [m] whose hull is the shape, or the centre of a ball; and the radius of a ball, else 0."""
    for shape in geometry:
        if shape.tag == "box":
            return 0.5 * np.array([*product((-1.0, 1.0), repeat=3)]) * _vector(shape.get("size"), 3), 0.0
        if shape.tag == "sphere":
            return np.zeros((1, 3)), number(shape.get("radius"))
        if shape.tag in ("cylinder", "capsule"):
            return _rims(number(shape.get("radius")), number(shape.get("length"))), 0.0
        if shape.tag == "mesh":
            return mesh_points(Path(shape.get("filename", ""))) * _vector(shape.get("scale", "1 1 1"), 3), 0.0
    return np.empty((0, 3)), 0.0


def _rims(radius: float, length: float) -> Array:
    angle = np.linspace(0.0, 2.0 * np.pi, 32, endpoint=False)
    ring = np.c_[radius * np.cos(angle), radius * np.sin(angle)]
    return np.concatenate([np.c_[ring, np.full(len(ring), z)] for z in (-0.5 * length, 0.5 * length)])


def pose_of(element: ET.Element) -> Array:
    """Return the pose (4, 4) that an element's <origin> states."""
    origin = element.find("origin")
    frame = np.eye(4)
    if origin is not None:
        frame[:3, 3] = _vector(origin.get("xyz", "0 0 0"), 3)
        frame[:3, :3] = Rotation.from_euler("xyz", _vector(origin.get("rpy", "0 0 0"), 3)).as_matrix()
    return frame


def end_of(joint: ET.Element, role: str) -> str:
    element = joint.find(role)
    return "" if element is None else element.get("link", "")


def _vector(text: str | None, count: int) -> Array:
    values = np.array([float(word) for word in (text or "").split()])
    return values if len(values) == count else np.zeros(count)


def number(text: str | None) -> float:
    return float(text) if text else 0.0
