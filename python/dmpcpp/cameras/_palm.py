"""The frame of a palm: where a hand is and how it is turned, from its landmarks.

Origin at the wrist, x to the knuckle of the middle finger, z off the back of a right hand, y = z x x.
"""

from __future__ import annotations

import numpy as np

from dmpcpp._typing import Array

__all__ = ["kabsch", "palm_frame", "palm_shape"]


def palm_frame(points: Array, which: tuple[int, int, int, int] = (0, 5, 9, 17)) -> Array:
    """Return the palm's axes (.., 3, 3), body -> world, from landmarks (.., M, 3).

    `which` are the wrist and the knuckles of index, middle and little finger.
    """
    wrist, index, middle, little = which
    x = _unit(points[..., middle, :] - points[..., wrist, :])
    z = _unit(np.cross(x, points[..., index, :] - points[..., little, :]))
    return np.stack([x, np.cross(z, x), z], axis=-1)


def palm_shape(points: Array, landmarks: tuple[int, ...]) -> tuple[Array, Array]:
    """Return the median landmarks (K, 3) in the palm's frame and their spread (K, 3), over frames (T, 21, 3).

    The spread is 1.4826 times the median absolute deviation, a robust standard deviation.
    """
    turned = np.einsum("tji,tkj->tki", palm_frame(points), points[:, landmarks] - points[:, :1])
    middle = np.nanmedian(turned, axis=0)
    return middle, 1.4826 * np.nanmedian(np.abs(turned - middle), axis=0)


def kabsch(shape: Array, points: Array, weight: Array | None = None) -> tuple[Array, Array]:
    """Return rotations (T, 3, 3) and translations (T, 3) that lay a shape (K, 3) over points (T, K, 3), least squares
    with a weight (K,) of each point.

    Source: W. Kabsch, Acta Cryst. A32 (1976); S. Umeyama, IEEE PAMI 13 (1991). NaN where a point is NaN.
    """
    known = np.asarray(np.isfinite(points).all(axis=(1, 2)))
    filled = np.where(known[:, None, None], points, shape)
    weight = np.ones(len(shape)) if weight is None else weight
    weight = weight / weight.sum()
    centre, middle = weight @ filled, weight @ shape
    spread = np.einsum("k,tki,kj->tij", weight, filled - centre[:, None], shape - middle)
    u, _, vt = np.linalg.svd(spread)
    u[:, :, 2] *= np.sign(np.linalg.det(u) * np.linalg.det(vt))[:, None]
    rotation = u @ vt
    translation = centre - rotation @ middle
    rotation[~known], translation[~known] = np.nan, np.nan
    return rotation, translation


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))
