"""A scene's URDF as obstacles: its collision shapes, with every joint at 0."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from dmpcpp._core import Box, Plane, Sphere
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.robot._packages import find_mesh
from dmpcpp.robot._shapes import number, points_of, pose_of, poses_at_rest
from dmpcpp.robot._xml import parsed

__all__ = ["shapes_of_urdf"]


def shapes_of_urdf(text: str, folder: Path) -> Iterator[tuple[str, Sphere | Box | Plane, str]]:
    """Yield the name of its link, the shape in the root's frame, and what was taken for what it is.

    Raises
    ------
    FileError
        A mesh that cannot be found or read, or a shape of no size.
    """
    robot = parsed(text)
    poses = poses_at_rest(robot)
    for link in robot.findall("link"):
        name = link.get("name", "")
        for collision in link.findall("collision"):
            geometry = collision.find("geometry")
            kinds = list(geometry) if geometry is not None else []
            if kinds and name in poses:
                yield (name, *_shape(name, kinds[0], poses[name] @ pose_of(collision), folder))


def _shape(link: str, kind: ET.Element, pose: Array, folder: Path) -> tuple[Sphere | Box, str]:
    if kind.tag == "sphere":
        radius = number(kind.get("radius"))
        _require_size(link, kind.tag, radius)
        return Sphere(pose[:3, 3], radius), ""
    if kind.tag == "mesh":
        kind.set("filename", str(_mesh(link, kind.get("filename", ""), folder)))
    whole = ET.Element("geometry")
    whole.append(kind)
    try:
        points, _ = points_of(whole)
    except (OSError, ValueError, InvalidArgument) as error:
        raise FileError(f"obstacle: the shape of link '{link}' cannot be read: {error}") from None
    _require_size(link, kind.tag, len(points))
    low, high = points.min(axis=0), points.max(axis=0)
    _require_size(link, kind.tag, float((high - low).max()))
    centre = np.eye(4)
    centre[:3, 3] = 0.5 * (low + high)
    note = "" if kind.tag == "box" else f"'{link}' is a {kind.tag}: the box around it is kept clear of."
    return Box(pose @ centre, 0.5 * (high - low)), note


def _mesh(link: str, filename: str, folder: Path) -> Path:
    try:
        return find_mesh(filename, str(folder), link)
    except (InvalidArgument, OSError) as error:
        raise FileError(f"obstacle: {error}") from None


def _require_size(link: str, kind: str, size: float) -> None:
    if not size > 0.0:
        raise FileError(f"obstacle: the {kind} of link '{link}' has no size.")
