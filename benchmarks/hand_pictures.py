"""Pictures of our own hand, drawn with an exact camera: skin of implicit shapes, skinned to the joints, lit, blurred.

The surface is the zero set of a distance function: rounded cones along the bones, smoothly joined, with the pads of
the palm. Vertices follow the bones by linear blending. What is drawn is a painter's picture of small quads, twice as
fine as the picture, averaged down.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import cv2
import numpy as np
from dmpcpp.cameras import Camera, Relation

from benchmarks.hand_model import KNUCKLES, SPREAD, THUMB, HandMotion, hand_points

_CELLS = 0.0028, 0.0042  # m, of the skin: fine, and coarse for small pictures
_SMALL = 600.0  # px of focal length
_FINE = 2  # times as fine as the picture
_RADII = np.array([[11.0, 9.8, 8.6, 7.2], [11.0, 10.0, 8.8, 7.4], [10.6, 9.5, 8.4, 7.1], [9.6, 8.5, 7.5, 6.4]]) * 1e-3
_PALM_PARTS = [  # two ends [m] and two radii [m]
    ([-0.21, 0.010, -0.002], [-0.03, 0.011, -0.001], 0.027, 0.019),
    ([-0.21, -0.012, -0.002], [-0.03, -0.010, -0.001], 0.026, 0.018),
    ([-0.03, 0.011, -0.001], [0.015, 0.014, -0.003], 0.019, 0.016),
    ([-0.03, -0.010, -0.001], [0.015, -0.014, -0.003], 0.018, 0.016),
    ([0.015, 0.014, -0.003], KNUCKLES[0], 0.015, 0.0115),
    ([0.015, 0.004, -0.002], KNUCKLES[1], 0.015, 0.0115),
    ([0.015, -0.006, -0.002], KNUCKLES[2], 0.015, 0.0110),
    ([0.015, -0.014, -0.003], KNUCKLES[3], 0.015, 0.0100),
    ([0.012, 0.016, -0.010], THUMB[1], 0.015, 0.0125),
    ([0.018, -0.020, -0.010], [0.060, -0.037, -0.010], 0.014, 0.0105),
    (THUMB[1], [0.080, 0.024, -0.006], 0.0105, 0.0090),
    ([0.045, 0.036, -0.016], [0.070, 0.026, -0.010], 0.0125, 0.0100),
    ([0.030, 0.006, -0.006], [0.070, 0.004, -0.004], 0.0145, 0.0125),
    ([0.030, 0.016, -0.010], [0.072, 0.014, -0.006], 0.0140, 0.0120),
    ([0.030, -0.010, -0.006], [0.066, -0.016, -0.005], 0.0140, 0.0120),
    (KNUCKLES[0] + [-0.006, 0.0, -0.006], KNUCKLES[3] + [-0.006, 0.0, -0.004], 0.0095, 0.0085),
]


def _cone(points: np.ndarray, a: np.ndarray, b: np.ndarray, r: float, s: float) -> np.ndarray:
    """Distance (N,) to a cone with round ends."""
    a, b = np.asarray(a), np.asarray(b)
    share = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
    return np.linalg.norm(points - a - share[:, None] * (b - a), axis=1) - (r + share * (s - r))


def _joined(a: np.ndarray, b: np.ndarray, k: float) -> np.ndarray:
    """The smooth minimum of I. Quilez: over a width k the two flow into one another."""
    h = np.clip(0.5 + 0.5 * (b - a) / k, 0.0, 1.0)
    return b + h * (a - b) - k * h * (1.0 - h)


def _distance(points: np.ndarray) -> np.ndarray:
    """Signed distance [m] of points (N, 3) to the skin of the open hand."""
    palm = np.full(len(points), 1.0)
    for a, b, r, s in _PALM_PARTS:
        palm = _joined(palm, _cone(points, a, b, r, s), 0.008)
    joints = hand_points(np.zeros((1, 4)))[0]
    whole = palm
    for finger in range(4):
        own = np.full(len(points), 1.0)
        for k in range(3):
            own = _joined(
                own,
                _cone(points, joints[5 + 4 * finger + k], joints[6 + 4 * finger + k], *_RADII[finger, k : k + 2]),
                0.003,
            )
        own = _joined(own, palm, 0.005)
        whole = np.minimum(whole, own)
    thumb = _joined(
        _cone(points, THUMB[1], THUMB[2], 0.0125, 0.0105), _cone(points, THUMB[2], THUMB[3], 0.0105, 0.0080), 0.003
    )
    return np.minimum(whole, _joined(thumb, palm, 0.006))


@dataclass(frozen=True, eq=False)
class _Skin:
    """Vertices (V, 3) of the open hand, normals, faces (F, 4), weights (V, 13) of the palm and 12 phalanges, shade."""

    vertices: np.ndarray
    normals: np.ndarray
    faces: np.ndarray
    weights: np.ndarray
    colour: np.ndarray


@cache
def _skin(cell: float = _CELLS[0]) -> _Skin:
    low, high = np.array([-0.20, -0.085, -0.06]), np.array([0.215, 0.11, 0.045])
    axes = [np.arange(a, b, cell) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    values = _distance(grid.reshape(-1, 3)).reshape(grid.shape[:3])
    vertices, faces = _surface(grid, values)
    step = 1e-4 * np.eye(3)
    normals = np.stack([_distance(vertices + e) - _distance(vertices - e) for e in step], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    normal_of_face = normals[faces].mean(axis=1)
    corner = vertices[faces]
    across = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
    faces[np.einsum("fi,fi->f", across, normal_of_face) < 0.0] = faces[
        np.einsum("fi,fi->f", across, normal_of_face) < 0.0
    ][:, ::-1]
    return _Skin(vertices, normals, faces, _weights(vertices), _shade(vertices, normals))


def _surface(grid: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Surface nets: one vertex in each cell that the surface crosses, one quad for each edge that it crosses."""
    inside = values < 0.0
    shape = np.array(values.shape) - 1
    corners = [np.array([i, j, k]) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    parts = np.stack([inside[tuple(slice(c, c + n) for c, n in zip(o, shape, strict=True))] for o in corners])
    crossed = parts.any(axis=0) & ~parts.all(axis=0)
    cells = np.argwhere(crossed)
    index = np.full(shape, -1)
    index[crossed] = np.arange(len(cells))
    total, count = np.zeros((len(cells), 3)), np.zeros(len(cells))
    for a in range(8):
        for b in range(a + 1, 8):
            if np.abs(corners[a] - corners[b]).sum() != 1:
                continue
            p, q = (tuple((cells + corners[c]).T) for c in (a, b))
            va, vb = values[p], values[q]
            cut = (va < 0.0) != (vb < 0.0)
            share = np.where(cut, va / np.where(cut, va - vb, 1.0), 0.0)
            total += np.where(cut[:, None], grid[p] + share[:, None] * (grid[q] - grid[p]), 0.0)
            count += cut
    faces = []
    for axis in range(3):
        one = np.eye(3, dtype=int)[axis]
        other = [np.eye(3, dtype=int)[k] for k in range(3) if k != axis]
        core = tuple(slice(1, n) if k != axis else slice(0, n) for k, n in enumerate(shape))
        ahead = tuple(slice(1, n) if k != axis else slice(1, n + 1) for k, n in enumerate(shape))
        edges = np.argwhere(inside[core] != inside[ahead]) + (1 - one)
        quads = [edges - other[0] - other[1], edges - other[1], edges, edges - other[0]]
        faces.append(np.stack([index[tuple(each.T)] for each in quads], axis=1))
    return total / count[:, None], np.concatenate(faces)


def _weights(vertices: np.ndarray) -> np.ndarray:
    joints = hand_points(np.zeros((1, 4)))[0]
    far = np.full((len(vertices), 13), 1.0)
    far[:, 0] = np.min([_cone(vertices, *part) for part in _PALM_PARTS], axis=0)
    far[:, 0] = np.minimum(far[:, 0], _cone(vertices, THUMB[1], THUMB[3], 0.012, 0.009))
    for finger in range(4):
        for k in range(3):
            a, b = joints[5 + 4 * finger + k], joints[6 + 4 * finger + k]
            far[:, 1 + 3 * finger + k] = _cone(vertices, a, b, *_RADII[finger, k : k + 2])
    weights = np.exp(-np.maximum(far - far.min(axis=1, keepdims=True), 0.0) / 0.0022)
    return weights / weights.sum(axis=1, keepdims=True)


def _shade(vertices: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """How bright (V,) the skin is for its place: hollows, creases of the joints, the lines of the palm, nails."""
    hollow = np.clip(_distance(vertices + 0.010 * normals) / 0.010, 0.35, 1.0)
    joints = hand_points(np.zeros((1, 4)))[0]
    shade = 0.55 + 0.45 * hollow
    palmar = np.clip(-normals[:, 2], 0.0, 1.0)
    for finger in range(4):
        along = np.array([np.cos(SPREAD[finger]), np.sin(SPREAD[finger]), 0.0])
        for k, scale in ((0, -0.6), (1, 1.0), (2, 1.0)):
            joint = joints[5 + 4 * finger + k] + (0.016 * along if k == 0 else 0.0)
            near = np.linalg.norm(vertices - joint, axis=1) < 0.014
            line = np.exp(-(((vertices - joint) @ along / 0.0014) ** 2))
            shade -= 0.16 * abs(scale) * near * line * (0.35 + 0.65 * palmar)
        tip = joints[8 + 4 * finger]
        nail = (np.linalg.norm(vertices - tip, axis=1) < 0.0075) & (normals[:, 2] > 0.55)
        shade += 0.10 * nail
    for a, b in (([0.078, 0.03], [0.06, -0.035]), ([0.075, 0.028], [0.035, -0.03]), ([0.07, 0.03], [0.02, 0.004])):
        a, b = np.array(a), np.array(b)
        share = np.clip((vertices[:, :2] - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
        away = np.linalg.norm(vertices[:, :2] - a - share[:, None] * (b - a), axis=1)
        shade -= 0.14 * palmar * np.exp(-((away / 0.0016) ** 2))
    return shade


def _posed(skin: _Skin, bend: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices and normals of the hand with bent fingers (4,), in the palm's frame."""
    joints, rest = hand_points(bend[None])[0], hand_points(np.zeros((1, 4)))[0]
    points, normals = skin.weights[:, :1] * skin.vertices, skin.weights[:, :1] * skin.normals
    for finger in range(4):
        along = np.array([np.cos(SPREAD[finger]), np.sin(SPREAD[finger]), 0.0])
        side = np.cross(np.array([0.0, 0.0, 1.0]), along)
        for k in range(3):
            angle = bend[finger] * (k + 0.8)
            up = np.array([0.0, 0.0, 1.0])
            from_axes = np.stack([along, side, up])
            c, s = np.cos(angle), np.sin(angle)
            to_axes = np.stack([c * along - s * up, side, s * along + c * up])
            turn = to_axes.T @ from_axes
            near = np.flatnonzero(skin.weights[:, 1 + 3 * finger + k] > 1e-3)
            weight = skin.weights[near, 1 + 3 * finger + k, None]
            start = 5 + 4 * finger + k
            points[near] += weight * ((skin.vertices[near] - rest[start]) @ turn.T + joints[start])
            normals[near] += weight * (skin.normals[near] @ turn.T)
    return points, normals / np.linalg.norm(normals, axis=1, keepdims=True)


@dataclass(frozen=True, eq=False)
class Scene:
    """Light, skin and background of a seed, for one size of picture."""

    background: np.ndarray
    skin: np.ndarray
    light: np.ndarray
    ambient: float
    grain: float

    @staticmethod
    def of_seed(seed: int, size: tuple[int, int], grain: float = 2.0) -> Scene:
        """Return a scene; the background holds soft blotches and boxes, as a room does."""
        rng = np.random.default_rng([seed, 77])
        width, height = size
        coarse = rng.uniform(40.0, 190.0, (5, 8, 3)).mean(axis=2, keepdims=True) + rng.normal(0.0, 12.0, (5, 8, 3))
        picture = cv2.resize(coarse.astype(np.float32), size, interpolation=cv2.INTER_CUBIC)
        for _ in range(9):
            x, y = rng.integers(0, width), rng.integers(0, height)
            w, h = rng.integers(width // 16, width // 4), rng.integers(height // 16, height // 3)
            tone = rng.uniform(30.0, 220.0) * np.array([1.0, 1.0, 1.0]) + rng.normal(0.0, 18.0, 3)
            cv2.rectangle(picture, (int(x), int(y)), (int(x + w), int(y + h)), tuple(map(float, tone)), -1)
        picture = cv2.GaussianBlur(picture, (0, 0), width / 300.0)
        tones = np.array([[150.0, 180.0, 232.0], [120.0, 150.0, 205.0], [95.0, 125.0, 180.0], [160.0, 185.0, 225.0]])
        light = rng.normal(0.0, 0.6, 3) + [0.0, -0.9, -1.0]
        return Scene(
            np.clip(picture, 0.0, 255.0).astype(np.float32),
            tones[rng.integers(len(tones))] * rng.uniform(0.92, 1.05),
            light / np.linalg.norm(light),
            float(rng.uniform(0.45, 0.6)),
            grain,
        )


def draw_hand(
    picture: np.ndarray, scene: Scene, camera: Camera, rotation: np.ndarray, position: np.ndarray, bend: np.ndarray
) -> np.ndarray:
    """Return the picture (H, W, 3) with the hand at a pose in the camera's axes drawn over it."""
    skin = _skin(_CELLS[camera.focal < _SMALL])
    points, normals = _posed(skin, bend)
    seen, normals = points @ rotation.T + position, normals @ rotation.T
    lit = scene.ambient + 0.62 * np.clip(normals @ scene.light, 0.0, 1.0) + 0.08 * np.clip(-normals[:, 2], 0.0, 1.0)
    bright = skin.colour * lit
    warm = 1.0 + 0.05 * np.clip(-skin.normals[:, 2:], 0.0, 1.0) * np.array([-0.6, -0.2, 1.0])
    colour = np.clip(bright[:, None] * scene.skin * warm, 0.0, 255.0)
    sleeve = skin.vertices[:, 0] < -0.085
    colour[sleeve] = bright[sleeve, None] * np.array([110.0, 70.0, 60.0])
    faces = skin.faces
    middle = seen[faces].mean(axis=1)
    facing = np.einsum("fi,fi->f", normals[faces].mean(axis=1), middle) < 0.0
    faces = faces[facing & (middle[:, 2] > 0.05)]
    order = np.argsort(-seen[faces][:, :, 2].mean(axis=1))
    faces = faces[order]
    pixels = camera.project(seen)
    low = np.maximum(np.floor(pixels.min(axis=0)).astype(int) - 2, 0)
    high = np.minimum(np.ceil(pixels.max(axis=0)).astype(int) + 3, [picture.shape[1], picture.shape[0]])
    if (high <= low).any():
        return picture
    part = picture[low[1] : high[1], low[0] : high[0]]
    fine = cv2.resize(part, None, fx=_FINE, fy=_FINE, interpolation=cv2.INTER_NEAREST)
    places = np.round((pixels - low + 0.5) * _FINE * 16 - 8).astype(np.int32)
    for quad, tone in zip(places[faces], colour[faces].mean(axis=1).tolist(), strict=True):
        cv2.fillConvexPoly(fine, quad, tone, lineType=cv2.LINE_8, shift=4)
    picture = picture.copy()
    picture[low[1] : high[1], low[0] : high[0]] = cv2.resize(
        fine, (part.shape[1], part.shape[0]), interpolation=cv2.INTER_AREA
    )
    return picture


def pictures_of(
    motion: HandMotion,
    camera: Camera,
    relation: Relation | None = None,
    *,
    seed: int = 0,
    exposure: float = 0.0,
    shots: int = 3,
    grain: float = 2.0,
):
    """Yield the pictures (H, W, 3) of uint8 of a motion, in another camera where a relation says so.

    `exposure` [s] blurs: `shots` moments of it are averaged.
    """
    rng = np.random.default_rng([seed, 5])
    scene = Scene.of_seed(seed, camera.size, grain)
    moments = np.linspace(-0.5, 0.5, shots) * exposure if exposure else np.zeros(1)
    noise = grain * rng.standard_normal((4, *scene.background.shape), dtype=np.float32)
    moved = [motion.at(motion.time + moment) if exposure else motion for moment in moments]
    turn, shift = (np.eye(3), np.zeros(3)) if relation is None else (relation.rotation, relation.translation)
    for k in range(len(motion.time)):
        drawn = [
            draw_hand(scene.background, scene, camera, turn @ m.rotation[k], turn @ m.position[k] + shift, m.bend[k])
            for m in moved
        ]
        picture = drawn[0] if len(drawn) == 1 else np.mean(drawn, axis=0)
        grained = picture + np.roll(noise[rng.integers(4)], rng.integers(0, 97, 2), axis=(0, 1))
        yield np.clip(grained, 0.0, 255.0).astype(np.uint8)


def write_video(path: Path, pictures, rate: float) -> None:
    """Write pictures as a video that OpenCV's own encoder makes."""
    writer = None
    for picture in pictures:
        if writer is None:
            size = (picture.shape[1], picture.shape[0])
            writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"mp4v"), rate, size)
        writer.write(picture)
    assert writer is not None
    writer.release()
