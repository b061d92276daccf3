"""How two cameras stand to one another, and how their clocks do, from a hand that both saw.

x_2 = R x_1 + t, t up to its length; the second camera's clock shows tau_2 = (1 + drift) tau_1 + shift.
Sources: R. Hartley, In defense of the eight-point algorithm, IEEE PAMI 19 (1997); R. Hartley and A. Zisserman, Multiple
View Geometry, 2nd ed., 9.6 (four poses of an essential matrix) and 11.4 (Sampson's distance).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array

__all__ = ["Relation", "cross_matrix", "essential", "in_front", "relate", "sampson"]

_ROUNDS = 6  # of reweighting


@dataclass(frozen=True, eq=False)
class Relation:
    """The second camera against the first: x_2 = rotation x_1 + translation; `error` of rays, a robust deviation."""

    rotation: Array
    translation: Array
    error: float = 0.0

    @property
    def angle(self) -> float:
        """Return how far apart the cameras look [rad]."""
        return float(np.arccos(np.clip(self.rotation[2, 2], -1.0, 1.0)))


def essential(first: Array, second: Array, weight: Array | None = None) -> Array:
    """Return E (3, 3) with second^T E first = 0 for rays (N, 2): eight points, normalised."""
    a, scale_a = _normalised(first)
    b, scale_b = _normalised(second)
    rows = (b[:, :, None] * a[:, None, :]).reshape(-1, 9)
    if weight is not None:
        rows = rows * weight[:, None]
    matrix = scale_b.T @ np.linalg.eigh(rows.T @ rows)[1][:, 0].reshape(3, 3) @ scale_a
    u, _, vt = np.linalg.svd(matrix)
    return np.asarray(u @ np.diag([1.0, 1.0, 0.0]) @ vt)


def sampson(matrix: Array, first: Array, second: Array) -> Array:
    """Return the signed distances (N,) of rays (N, 2) from what E allows, in units of the rays."""
    a, b = _homogeneous(first), _homogeneous(second)
    left, right = a @ matrix.T, b @ matrix
    scale = np.sqrt(left[:, 0] ** 2 + left[:, 1] ** 2 + right[:, 0] ** 2 + right[:, 1] ** 2)
    return np.asarray(np.einsum("ni,ni->n", b, left) / np.maximum(scale, 1e-12))


def relate(first: Array, second: Array, deviation: float, near: Relation | None = None) -> Relation | None:
    """Return the relation, with a translation of length 1, that rays (N, 2) of the same points show; None if none.

    Parameters
    ----------
    first, second : arrays (N, 2)
        Rays without NaN.
    deviation : float
        Beyond which a distance of a ray counts less.
    near : Relation, optional
        Where to start in place of what eight points say.
    """
    if len(first) < 40:
        return None
    start = _by_eight_points(first, second, deviation) if near is None else (near.rotation, near.translation)
    if start is None:
        return None
    rotation, translation = start
    basis = np.linalg.svd(translation[None])[2][1:]

    def errors(x: Array) -> Array:
        turned, moved = _stepped(rotation, translation, basis, x)
        return sampson(cross_matrix(moved) @ turned, first, second) / deviation

    found = least_squares(errors, np.zeros(5), loss="soft_l1", max_nfev=30)
    rotation, translation = _stepped(rotation, translation, basis, found.x)
    error = deviation * 1.4826 * float(np.median(np.abs(errors(found.x))))
    if in_front(rotation, translation, first, second).mean() < 0.75:
        return None
    return Relation(rotation, translation, error)


def _by_eight_points(first: Array, second: Array, deviation: float) -> tuple[Array, Array] | None:
    weight = np.ones(len(first))
    for _ in range(_ROUNDS):
        matrix = essential(first, second, weight)
        weight = 1.0 / np.sqrt(1.0 + (sampson(matrix, first, second) / deviation) ** 2)
    return _pose_of(matrix, first, second)


def in_front(rotation: Array, translation: Array, first: Array, second: Array) -> NDArray[np.bool_]:
    """Return which rays (N, 2) meet in front of both cameras."""
    a, b = _homogeneous(first) @ rotation.T, _homogeneous(second)
    aa, ab, bb = (np.einsum("ni,ni->n", u, v) for u, v in ((a, a), (a, b), (b, b)))
    at, bt = a @ translation, b @ translation
    crossed = aa * bb - ab * ab
    return np.asarray((ab * bt - bb * at > 0.0) & (aa * bt - ab * at > 0.0) & (crossed > 0.0))


def _pose_of(matrix: Array, first: Array, second: Array) -> tuple[Array, Array] | None:
    """Return the one of the four poses of E that has the most points in front of both cameras."""
    u, _, vt = np.linalg.svd(matrix)
    u, vt = u * np.sign(np.linalg.det(u)), vt * np.sign(np.linalg.det(vt))
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    poses = [(u @ turn @ vt, sign * u[:, 2]) for turn in (quarter, quarter.T) for sign in (1.0, -1.0)]
    votes = [float(in_front(*pose, first, second).mean()) for pose in poses]
    best = int(np.argmax(votes))
    return poses[best] if votes[best] > 0.6 else None


def _stepped(rotation: Array, translation: Array, basis: Array, x: Array) -> tuple[Array, Array]:
    moved = translation + x[3:] @ basis
    return Rotation.from_rotvec(x[:3]).as_matrix() @ rotation, moved / np.linalg.norm(moved)


def _normalised(points: Array) -> tuple[Array, Array]:
    centre = points.mean(axis=0)
    scale = np.sqrt(2.0) / max(float(np.sqrt(np.mean(np.sum((points - centre) ** 2, axis=1)))), 1e-12)
    turn = np.array([[scale, 0.0, -scale * centre[0]], [0.0, scale, -scale * centre[1]], [0.0, 0.0, 1.0]])
    return _homogeneous(points) @ turn.T, turn


def _homogeneous(points: Array) -> Array:
    return np.concatenate([points, np.ones((len(points), 1))], axis=1)


def cross_matrix(v: Array) -> Array:
    """Return the matrix (3, 3) of v x."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
