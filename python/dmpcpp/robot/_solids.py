"""Volume, centre and second moment of the collision shapes of a link."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from dmpcpp._typing import Array
from dmpcpp.robot._convex_pieces import convex_pieces
from dmpcpp.robot._packages import find_mesh
from dmpcpp.robot._shapes import points_of, pose_of

__all__ = ["solid", "solids_of"]


def solids_of(link: ET.Element, folder: str) -> Iterator[tuple[float, Array, Array]]:
    """Yield volume, centre (3,) and second moment of volume (3, 3) about the link's origin of each convex piece."""
    for collision in link.findall("collision"):
        geometry = collision.find("geometry")
        if geometry is None:
            continue
        pose = pose_of(collision)
        for points, radius in _convex(geometry, folder, link.get("name", "")):
            placed = points @ pose[:3, :3].T + pose[:3, 3]
            yield _ball(placed[0], radius) if len(placed) == 1 else solid(placed)


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


def solid(points: Array) -> tuple[float, Array, Array]:
    """Return volume, centre and second moment of volume of the convex hull of points (N, 3).

    It is cut into tetrahedra about one point: the second moment of each is a sum over its corners.
    """
    try:
        hull = ConvexHull(points)
    except QhullError:  # flat
        return 0.0, points.mean(axis=0), np.zeros((3, 3))
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
