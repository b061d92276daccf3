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
from dmpcpp.errors import InvalidArgument

Points = Array
MESH_KINDS = (".obj", ".stl", ".dae", ".ply", ".glb", ".gltf", ".off")
"""What collision meshes may be, by suffix."""
Triangles = NDArray[np.intp]

_CUTS = (0.25, 0.5, 0.75)  # where along each axis a cut is tried
_WORTH = 0.93  # a cut must shrink the volume of the hull to this
_THIN = 1e-3  # half the thickness of a plate, of its extent
_DEPTH = 4  # at most 2^4 pieces


def convex_pieces(path: Path) -> tuple[str, ...] | None:
    """The pieces of a mesh in its file's unit of length, each the text of an OBJ file of its hull.

    A flat mesh becomes a thin plate. None for a mesh without triangles.

    Raises
    ------
    InvalidArgument
        The file cannot be read as a mesh, or what its kind needs is not installed.
    """
    return _pieces(str(path), path.stat().st_mtime_ns)


@lru_cache(maxsize=128)
def _pieces(path: str, _changed: int) -> tuple[str, ...] | None:
    corners = read_mesh(Path(path))
    if corners.size == 0:
        return None
    points, triangles = _indexed(corners)
    whole = _volume(points, triangles)
    if not np.isfinite(whole):
        points, triangles = _thickened(points)
        return (_obj(points, triangles),)
    return tuple(_obj(points, piece) for piece in _cut(points, triangles, whole, _DEPTH))


def mesh_points(path: Path) -> Points:
    """The corners (V, 3) of a mesh in the unit of its file; none where it cannot be read."""
    try:
        return _points(str(path), path.stat().st_mtime_ns)
    except OSError:
        return np.empty((0, 3))


@lru_cache(maxsize=256)
def _points(path: str, _changed: int) -> Points:
    try:
        return _indexed(read_mesh(Path(path)))[0]
    except InvalidArgument:
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


def _thickened(points: Points) -> tuple[Points, Triangles]:
    """Return the corners of a plate around flat points: engines collide with volumes alone."""
    centre = points.mean(axis=0)
    axes = np.linalg.svd(points - centre, full_matrices=True)[2]
    along = (points - centre) @ axes.T
    low, high = along.min(axis=0), along.max(axis=0)
    thin = max(_THIN * float((high - low).max()), 1e-9)
    low, high = np.minimum(low, -thin), np.maximum(high, thin)
    corners = np.array(list(product(*zip(low, high, strict=True)))) @ axes + centre
    return corners, np.asarray(ConvexHull(corners).simplices, dtype=np.intp)


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


def read_mesh(path: Path) -> Array:
    """Return the triangles (F, 3, 3) of a mesh in the file's unit; a COLLADA file's own unit is m.

    Raises
    ------
    InvalidArgument
        Names the file and what to do.
    """
    kind = path.suffix.lower()
    try:
        if kind == ".obj":
            return _read_obj(path.read_text(encoding="utf-8", errors="replace"))
        return _read_stl(path.read_bytes()) if kind == ".stl" else _read_other(path)
    except (ValueError, IndexError) as error:
        why = f" ({error})" if str(error) and "NoneType" not in str(error) else ""
        raise InvalidArgument(f"'{path.name}' cannot be read as a mesh{why}. Convert it to .obj or .stl.") from None


def _read_other(path: Path) -> Array:
    """COLLADA, PLY, glTF and whatever else trimesh reads; axes as in the file, as RViz takes them."""
    if path.suffix.lower() not in MESH_KINDS:
        raise ValueError(f"of the readable kinds {', '.join(MESH_KINDS)} it is none")
    try:
        import trimesh
    except ImportError:
        raise ValueError('what reads it, trimesh, is not installed: pip install "dmpcpp[view]"') from None
    try:
        scene = trimesh.load_scene(str(path))
        meshes = [mesh for mesh in scene.dump() if hasattr(mesh, "triangles")]
    except Exception as error:  # whatever the libraries behind it raise of a damaged file
        raise ValueError(str(error) or type(error).__name__) from None
    named = str(scene.units).split(" * ")  # of COLLADA "0.01 * meters"
    unit = float(named[0]) if len(named) == 2 else 1.0
    return unit * np.concatenate([np.empty((0, 3, 3)), *(np.asarray(mesh.triangles) for mesh in meshes)])


def _read_obj(text: str) -> Array:
    words = [line.split() for line in text.splitlines()]
    points = np.array([word[1:4] for word in words if word[:1] == ["v"]], dtype=np.float64)
    faces = [[int(corner.split("/")[0]) for corner in word[1:]] for word in words if word[:1] == ["f"]]
    fans = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
    if not fans:
        return np.empty((0, 3, 3))
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
