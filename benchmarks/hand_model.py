"""A right hand of our own: 21 joints posed by finger angles, motions of it, and cameras that see it.

Plain dimensions of an adult's hand; no one's mesh. Axes of the palm as in `dmpcpp.cameras`: origin at the wrist, x to
the knuckle of the middle finger, z off the back of the hand, y to the thumb's side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from dmpcpp.cameras import Camera, Landmarks, Relation, chain_length
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

KNUCKLES = np.array([[0.092, 0.025, 0.0], [0.095, 0.0, 0.0], [0.087, -0.021, -0.002], [0.077, -0.040, -0.006]])
BONES = np.array([[0.042, 0.025, 0.021], [0.046, 0.029, 0.022], [0.043, 0.027, 0.022], [0.034, 0.020, 0.019]])
SPREAD = np.radians([8.0, 0.0, -7.0, -16.0])  # of the fingers in the palm's plane
THUMB = np.array([[0.022, 0.030, -0.012], [0.056, 0.054, -0.022], [0.083, 0.071, -0.024], [0.108, 0.083, -0.024]])


def hand_points(bend: np.ndarray) -> np.ndarray:
    """Return the landmarks (T, 21, 3) [m] in the palm's frame, for finger bends (T, 4) [rad] at each joint."""
    points = np.zeros((len(bend), 21, 3))
    points[:, 1:5] = THUMB
    points[:, 4] = THUMB[3] + 0.02 * np.stack([-bend[:, 0], -bend[:, 0], -bend[:, 0]], axis=1)
    for finger in range(4):
        first = 5 + 4 * finger
        points[:, first] = KNUCKLES[finger]
        along = np.array([np.cos(SPREAD[finger]), np.sin(SPREAD[finger]), 0.0])
        for k in range(3):
            angle = bend[:, finger] * (k + 0.8)
            step = np.cos(angle)[:, None] * along - np.sin(angle)[:, None] * np.array([0.0, 0.0, 1.0])
            points[:, first + k + 1] = points[:, first + k] + BONES[finger, k] * step
    return points


HAND_LENGTH = chain_length(hand_points(np.zeros((1, 4))))


@dataclass(frozen=True, eq=False)
class HandMotion:
    """A hand over time in the first camera's axes: `rotation`, `position` of the palm; `bend` of the fingers."""

    time: np.ndarray
    rotation: np.ndarray
    position: np.ndarray
    bend: np.ndarray

    @property
    def points(self) -> np.ndarray:
        """All landmarks (T, 21, 3) [m]."""
        return np.einsum("tij,tkj->tki", self.rotation, hand_points(self.bend)) + self.position[:, None]

    def at(self, time: np.ndarray) -> HandMotion:
        """Return the motion at other times inside its span."""
        turn = Rotation.from_matrix(self.rotation).as_rotvec()
        inside = np.clip(time, self.time[0], self.time[-1])
        parts = [CubicSpline(self.time, each)(inside) for each in (turn, self.position, self.bend)]
        return HandMotion(time, Rotation.from_rotvec(parts[0]).as_matrix(), *parts[1:])


def seeded_motion(
    seed: int,
    duration: float = 4.0,
    rate: float = 30.0,
    distance: float = 0.6,
    turn: float = 25.0,
    reach: float = 0.12,
    facing: float = 0.0,
    base: np.ndarray | None = None,
) -> HandMotion:
    """Return a smooth motion: sums of three slow waves about a palm that faces the cameras, fingers up.

    `turn` [deg] and `reach` [m] are the largest angle about, and the range along, an axis; `facing` [deg] is where the
    palm looks, from the first camera to the right.
    """
    rng = np.random.default_rng([seed, 26])
    time = np.arange(0.0, duration + 1e-9, 1.0 / rate)
    waves = _waves(rng, time, 10, duration)
    # Palm to the camera: z off the back is away from it (+z), fingers up is -y.
    base = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]) if base is None else base
    base = Rotation.from_euler("y", -facing, degrees=True).as_matrix() @ base
    rotation = Rotation.from_rotvec(np.radians(turn) * waves[:, :3] * [0.8, 1.0, 0.8]).as_matrix() @ base
    position = np.array([0.0, 0.07, distance]) + reach * waves[:, 3:6] * [1.0, 0.6, 0.6]
    bend = 0.18 + 0.12 * waves[:, 6:]
    return HandMotion(time, rotation, position, bend)


def _waves(rng: np.random.Generator, time: np.ndarray, count: int, duration: float) -> np.ndarray:
    frequency = rng.uniform(0.15, 0.7, (3, count)) + 0.3 / duration
    phase, size = rng.uniform(0.0, 2.0 * np.pi, (3, count)), rng.uniform(0.4, 1.0, (3, count))
    waves = np.einsum("wc,twc->tc", size, np.sin(2.0 * np.pi * frequency * time[:, None, None] + phase))
    return waves / np.abs(waves).max(axis=0)


def second_camera(angle: float, at: float = 0.6, height: float = 0.08) -> Relation:
    """Return the camera that looks at the same place from `angle` [deg] to the right, a little from above."""
    centre = np.array([0.0, 0.0, at])
    eye = centre + at * np.array([np.sin(np.radians(angle)), 0.0, -np.cos(np.radians(angle))]) - [0.0, height, 0.0]
    z = centre - eye
    z = z / np.linalg.norm(z)
    x = np.cross([0.0, 1.0, 0.0], z)
    x = x / np.linalg.norm(x)
    rotation = np.stack([x, np.cross(z, x), z])
    return Relation(rotation, -rotation @ eye)


def coloured(rng: np.random.Generator, time: np.ndarray, shape: tuple[int, ...], deviation: float) -> np.ndarray:
    """Return noise (T, ..) as landmark nets show it: a slow part, what moves with the view, and a part of 2 to 6 Hz."""
    slow, fast, rate = np.zeros((len(time), *shape)), np.zeros((len(time), *shape)), 1.0 / np.diff(time).mean()
    keep_slow, keep_fast = np.exp(-2.0 * np.pi * 0.4 / rate), np.exp(-2.0 * np.pi * 4.0 / rate)
    draws = rng.standard_normal((2, len(time), *shape))
    slow[0], fast[0] = draws[:, 0]
    for k in range(1, len(time)):
        slow[k] = keep_slow * slow[k - 1] + np.sqrt(1.0 - keep_slow**2) * draws[0, k]
        fast[k] = keep_fast * fast[k - 1] + np.sqrt(1.0 - keep_fast**2) * draws[1, k]
    return deviation * (np.sqrt(0.8) * slow + np.sqrt(0.2) * fast)


def seen(
    motion: HandMotion,
    camera: Camera,
    relation: Relation | None = None,
    *,
    seed: int = 0,
    pixels: float = 0.0,
    world: float = 0.0,
    clock: float = 0.0,
) -> Landmarks:
    """Return exact projections of a motion with coloured noise: of `pixels` [px] and `world` [m] an axis.

    `clock` [s] is what the camera's clock shows at the motion's time 0.
    """
    rng = np.random.default_rng([seed, 9])
    points = motion.points
    rotation = np.eye(3) if relation is None else relation.rotation
    inside = points @ rotation.T + (0.0 if relation is None else relation.translation)
    rays = inside.mean(axis=1)
    axis = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    away = np.cross(np.array([0.0, 0.0, 1.0]), axis)
    angle = np.arcsin(np.clip(np.linalg.norm(away, axis=1), 0.0, 1.0))
    turn = Rotation.from_rotvec(away / np.maximum(np.sin(angle), 1e-12)[:, None] * angle[:, None]).inv()
    centred = np.einsum("tij,tkj->tki", turn.as_matrix(), inside - inside.mean(axis=1, keepdims=True))
    return Landmarks(
        motion.time + clock,
        camera.project(inside) + coloured(rng, motion.time, (21, 2), pixels),
        centred + coloured(rng, motion.time, (21, 3), world),
        np.full(len(motion.time), 0.95),
        camera,
    )


def body_errors(
    true_rotation: np.ndarray,
    true_position: np.ndarray,
    rotation: np.ndarray,
    position: np.ndarray,
    shape: bool = False,
) -> tuple[float, float]:
    """Return RMS errors [m], [rad] of poses (T, ..) after the best constant body offset.

    With `shape` after the best rigid alignment of the path, too.
    """
    world = _turn_of(position, true_position) if shape else np.eye(3)
    for _ in range(8 if shape else 1):
        offset = Rotation.from_matrix(np.swapaxes(rotation, 1, 2) @ world.T @ true_rotation).mean().as_matrix()
        turned = world @ rotation @ offset
        if shape:
            rest = Rotation.from_matrix(true_rotation @ np.swapaxes(turned, 1, 2)).mean().as_matrix()
            world = rest @ world
    angle = Rotation.from_matrix(np.swapaxes(world @ rotation @ offset, 1, 2) @ true_rotation).magnitude()
    # p_true = W p + c + R_true o is linear in the offset o and, without shape, in nothing else
    moved = position @ world.T
    if shape:
        for _ in range(8):
            moved, left = _aligned(moved, true_position, true_rotation)
    else:
        left = true_position - moved
        offset_body = np.einsum("tji,tj->ti", true_rotation, left).mean(axis=0)
        left = left - true_rotation @ offset_body
    return float(np.sqrt(np.mean(np.sum(left**2, axis=1)))), float(np.sqrt(np.mean(angle**2)))


def _aligned(path: np.ndarray, truth: np.ndarray, rotation: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the path after a constant body offset and a rigid motion, and what is left."""
    rows = np.concatenate([rotation, np.broadcast_to(np.eye(3), rotation.shape)], axis=2).reshape(-1, 6)
    found = np.linalg.lstsq(rows, (truth - path).ravel(), rcond=None)[0]
    path = path + (rows @ found).reshape(-1, 3)
    path = (path - path.mean(axis=0)) @ _turn_of(path, truth).T + truth.mean(axis=0)
    return path, truth - path


def _turn_of(path: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Return the rotation (3, 3) that lays a path (T, 3) over another, about their means."""
    u, _, vt = np.linalg.svd((truth - truth.mean(axis=0)).T @ (path - path.mean(axis=0)))
    return u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ vt
