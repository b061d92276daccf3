"""Masses for links that state none: from the volume of their collision shapes, or placeholders where none count."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator

import numpy as np
from scipy.spatial import ConvexHull

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._convex_pieces import convex_pieces
from dmpcpp.robot._description import links_beyond
from dmpcpp.robot._engine_urdf import write_inertia
from dmpcpp.robot._packages import find_mesh
from dmpcpp.robot._payload import with_description
from dmpcpp.robot._shapes import points_of, pose_of
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
    solid = [(link, pieces) for link in lacking if (pieces := list(_pieces(link, arm.folder)))]
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


def _pieces(link: ET.Element, folder: str) -> Iterator[tuple[float, Array, Array]]:
    """Yield volume, centre (3,) and second moment of volume (3, 3) about the link's origin of each convex piece."""
    for collision in link.findall("collision"):
        geometry = collision.find("geometry")
        if geometry is None:
            continue
        pose = pose_of(collision)
        for points, radius in _convex(geometry, folder, link.get("name", "")):
            placed = points @ pose[:3, :3].T + pose[:3, 3]
            yield _ball(placed[0], radius) if len(placed) == 1 else _solid(placed)


def _convex(geometry: ET.Element, folder: str, link: str) -> Iterator[tuple[Array, float]]:
    mesh = geometry.find("mesh")
    if mesh is None:
        points, radius = points_of(geometry)
        yield from [(points, radius)] if len(points) else []
        return
    scale = np.array([float(x) for x in mesh.get("scale", "1 1 1").split()])
    for piece in convex_pieces(find_mesh(mesh.get("filename", ""), folder, link)) or ():
        lines = [line.split()[1:] for line in piece.splitlines() if line.startswith("v ")]
        yield scale * np.array(lines, dtype=np.float64), 0.0


def _ball(centre: Array, radius: float) -> tuple[float, Array, Array]:
    volume = 4.0 / 3.0 * math.pi * radius**3
    return volume, centre, volume * (radius**2 / 5.0 * np.eye(3) + np.outer(centre, centre))


def _solid(points: Array) -> tuple[float, Array, Array]:
    """Of the convex hull, as tetrahedra from one of its points: the second moment of each is a sum over its corners."""
    hull = ConvexHull(points)
    apex = points[hull.vertices].mean(axis=0)
    corners = points[hull.simplices] - apex  # (F, 3, 3)
    volumes = np.abs(np.linalg.det(corners)) / 6.0
    sums = corners.sum(axis=1)
    moments = np.einsum("fki,fkj->fij", corners, corners) + np.einsum("fi,fj->fij", sums, sums)
    volume = float(volumes.sum())
    centre = np.einsum("f,fi->i", volumes, sums / 4.0) / volume
    about_apex = np.einsum("f,fij->ij", volumes, moments) / 20.0
    shift = np.outer(apex, centre) + np.outer(centre, apex) + np.outer(apex, apex)
    return volume, apex + centre, about_apex + volume * shift


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
