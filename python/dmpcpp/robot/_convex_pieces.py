"""Collision meshes as a few convex pieces.

Engines take the convex hull of a mesh. Where a link is hollow that closes the hollow: the wrist of a KUKA
iiwa then touches its forearm over a sixth of its range. Cutting a mesh where that removes the most empty
space keeps the shapes convex, and the pieces together still hold every triangle: contacts come too early,
never too late.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from dmpcpp._typing import Array

Points = Array
Triangles = NDArray[np.intp]

_CUTS = (0.25, 0.5, 0.75)  # where along each axis a cut is tried
_WORTH = 0.93  # a cut must shrink the volume of the hull to this
_DEPTH = 4  # at most 2^4 pieces


def convex_pieces(path: Path) -> tuple[str, ...] | None:
    """The pieces of an OBJ or STL mesh, each the text of an OBJ file of its hull.

    None for a file of another kind or without a volume: what to make of that is the engine's business.
    """
    return _pieces(str(path), path.stat().st_mtime_ns)


@lru_cache(maxsize=128)
def _pieces(path: str, _changed: int) -> tuple[str, ...] | None:
    try:
        points, triangles = _indexed(_read(Path(path)))
        whole = _volume(points, triangles)
        return tuple(_obj(points, piece) for piece in _cut(points, triangles, whole, _DEPTH))
    except (ValueError, IndexError, QhullError):
        return None


def mesh_points(path: Path) -> Points:
    """The corners (V, 3) of a mesh in the unit of its file; none where it cannot be read."""
    try:
        return _points(str(path), path.stat().st_mtime_ns)
    except OSError:
        return np.empty((0, 3))


@lru_cache(maxsize=256)
def _points(path: str, _changed: int) -> Points:
    try:
        return _indexed(_read(Path(path)))[0]
    except (ValueError, IndexError):
        return np.empty((0, 3))


def _cut(points: Points, triangles: Triangles, volume: float, depth: int) -> list[Triangles]:
    """Cut in two where the hulls of the parts hold the least, if that is worth it, and so on."""
    if depth == 0:
        return [triangles]
    centres = points[triangles].mean(axis=1)
    lowest, highest = centres.min(axis=0), centres.max(axis=0)
    best, parts = _WORTH * volume, [(triangles, volume)]
    for axis, share in product(range(3), _CUTS):
        below = centres[:, axis] < lowest[axis] + share * (highest[axis] - lowest[axis])
        sides = [(side, _volume(points, side)) for side in (triangles[below], triangles[~below])]
        total = sum(size for _, size in sides)
        if total < best:
            best, parts = total, sides
    if len(parts) == 1:
        return [triangles]
    return [piece for side, size in parts for piece in _cut(points, side, size, depth - 1)]


def _volume(points: Points, triangles: Triangles) -> float:
    """Of the hull; infinity where there is none, so that no cut leaves a flat piece."""
    try:
        return float(ConvexHull(points[np.unique(triangles)]).volume)
    except (QhullError, ValueError):
        return np.inf


def _obj(points: Points, triangles: Triangles) -> str:
    corners = points[np.unique(triangles)]
    hull = ConvexHull(corners)
    number = {vertex: k + 1 for k, vertex in enumerate(hull.vertices)}
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners[hull.vertices].tolist()]
    lines += ["f " + " ".join(str(number[vertex]) for vertex in face) for face in hull.simplices]
    return "\n".join(lines) + "\n"


def _indexed(corners: Array) -> tuple[Points, Triangles]:
    """Triangles (F, 3, 3) as points (V, 3), each once, and their numbers (F, 3)."""
    points, numbers = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    return points, numbers.reshape(-1, 3)


def _read(path: Path) -> Array:
    """Triangles (F, 3, 3) in the unit of the file; ValueError for a file that is neither OBJ nor STL."""
    kind = path.suffix.lower()
    if kind == ".obj":
        return _read_obj(path.read_text(encoding="utf-8", errors="replace"))
    if kind == ".stl":
        return _read_stl(path.read_bytes())
    raise ValueError(kind)


def _read_obj(text: str) -> Array:
    words = [line.split() for line in text.splitlines()]
    points = np.array([word[1:4] for word in words if word[:1] == ["v"]], dtype=np.float64)
    faces = [[int(corner.split("/")[0]) for corner in word[1:]] for word in words if word[:1] == ["f"]]
    fans = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
    index = np.array(fans)
    return np.asarray(points[np.where(index > 0, index - 1, index)])


def _read_stl(data: bytes) -> Array:
    count = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * count:
        table = np.frombuffer(data[84:], dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
        return table["corners"].astype(np.float64)
    words = (line.split() for line in data.decode(errors="replace").splitlines())
    points = [word[1:4] for word in words if word[:1] == ["vertex"]]
    return np.array(points, dtype=np.float64).reshape(-1, 3, 3)
