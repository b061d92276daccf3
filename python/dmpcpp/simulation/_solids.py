"""Obstacles as every engine takes them: a kind, its sizes and a pose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp import _core
from dmpcpp._typing import Array
from dmpcpp.robot import Obstacle
from dmpcpp.simulation._objects import Box

__all__ = ["Solid", "quaternion_of", "solid_of"]


@dataclass(frozen=True, eq=False)
class Solid:
    """A sphere, a box, a capsule along z or the half-space below z = 0, at a pose (4, 4) in the root's frame; m."""

    kind: str
    pose: Array
    radius: float = 0.0
    half: tuple[float, float, float] = (0.0, 0.0, 0.0)
    length: float = 0.0  # of a capsule, without its ends


def solid_of(thing: Box | Obstacle) -> Solid:
    """Return what an engine adds."""
    if isinstance(thing, Box):
        x, y, z = (0.5 * side for side in thing.size)
        return Solid("box", _at(thing.centre), half=(x, y, z))
    shape = thing.shape
    if isinstance(shape, _core.Sphere):
        return Solid("sphere", _at(shape.center), radius=shape.radius)
    if isinstance(shape, _core.Box):
        x, y, z = map(float, shape.half_sizes)
        return Solid("box", np.array(shape.pose), half=(x, y, z))
    if isinstance(shape, _core.Plane):
        return Solid("plane", _along(shape.point, shape.normal))
    axis = shape.end - shape.start
    return Solid(
        "capsule", _along(0.5 * (shape.start + shape.end), axis), shape.radius, length=float(np.linalg.norm(axis))
    )


def quaternion_of(pose: Array) -> list[float]:
    """Return x, y, z, w of a pose's rotation."""
    x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat()
    return [float(x), float(y), float(z), float(w)]


def _at(place: ArrayLike) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = place
    return pose


def _along(place: Array, axis: Array) -> Array:
    """Return a pose whose z is along an axis; any where the axis has no length."""
    pose = _at(place)
    length = float(np.linalg.norm(axis))
    if length > 0.0:
        z = axis / length
        across = np.eye(3)[int(np.argmin(np.abs(z)))]
        x = np.cross(across, z)
        x /= np.linalg.norm(x)
        pose[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    return pose
