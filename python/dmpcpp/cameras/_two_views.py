"""A hand's poses from two cameras: triangulated, then fitted as a whole."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from dmpcpp._typing import Array
from dmpcpp.cameras._fit import Fit, Motion, Sight, fit_motion
from dmpcpp.cameras._landmarks import Landmarks
from dmpcpp.cameras._palm import kabsch, palm_shape
from dmpcpp.cameras._relation import Relation

__all__ = ["TWO_PALM", "fit_two_views", "frames_between", "triangulate"]

TWO_PALM = (0, 1, 2, 5, 6, 9, 10, 13, 14, 17, 18)
"""Landmarks of the fit with two cameras: the palm, and joints that count as far as they keep their places."""

_FRAME = (TWO_PALM.index(0), TWO_PALM.index(5), TWO_PALM.index(9), TWO_PALM.index(17))
_HOW = Fit(acceleration=6.0, turning=40.0)
_LEAST_SPREAD = 0.003  # m
_ROUNDS = 4  # of weights, shape and poses
_STRAYS = 2.5  # times as far as the usual landmark: from there on one counts less
_MOST_UNSURE = 10.0


def triangulate(first: Array, second: Array, relation: Relation) -> Array:
    """Return points (.., 3) in the first camera's axes, from rays (.., 2) of both: linear least squares.

    NaN where a ray is NaN.
    """
    r, t = relation.rotation, relation.translation
    eye = np.eye(3)
    rows = [first[..., k, None] * eye[2] - eye[k] for k in (0, 1)]
    rows += [second[..., k, None] * r[2] - r[k] for k in (0, 1)]
    right = [np.zeros(first.shape[:-1])] * 2 + [t[k] - second[..., k] * t[2] for k in (0, 1)]
    a, b = np.stack(rows, axis=-2), np.stack(right, axis=-1)
    known = np.isfinite(a).all(axis=(-2, -1))
    gram = np.where(known[..., None, None], np.swapaxes(a, -1, -2) @ a, eye)
    point = np.linalg.solve(gram, np.einsum("...ki,...k->...i", a, b)[..., None])[..., 0]
    return np.where(known[..., None], point, np.nan)


def fit_two_views(first: Landmarks, second: Landmarks, relation: Relation) -> Motion:
    """Return the poses at the first camera's times.

    Parameters
    ----------
    first : Landmarks
    second : Landmarks
        At the first one's times (`Landmarks.at`).
    relation : Relation
        With the translation in m.
    """
    points = triangulate(first.rays, second.rays, relation)
    palm, spread = palm_shape(points, TWO_PALM)
    palm, unsure, poses = _rigid_part(points[:, TWO_PALM], palm)
    rotation, position = frames_between(first.time, *poses)
    chosen = list(TWO_PALM)
    sights = [
        Sight(first.rays[:, chosen], first.deviation * unsure, np.eye(3), np.zeros(3)),
        Sight(second.rays[:, chosen], second.deviation * unsure, relation.rotation, relation.translation),
    ]
    spread = np.maximum(spread, _LEAST_SPREAD)
    return fit_motion(first.time, sights, rotation, position, palm, spread, _HOW, _FRAME)


def _rigid_part(points: Array, palm: Array) -> tuple[Array, Array, tuple[Array, Array]]:
    """Return the shape (K, 3), how unsure each landmark is against the others (K,), and poses.

    A joint that a finger moves strays from the rigid shape, and counts less.
    """
    unsure = np.ones(len(palm))
    for _ in range(_ROUNDS):
        rotation, position = kabsch(palm, points, unsure**-2.0)
        own = np.einsum("tji,tkj->tki", rotation, points - position[:, None])
        palm = np.nanmedian(own, axis=0)
        strays = 1.4826 * np.sqrt(np.mean(np.nanmedian(np.abs(own - palm), axis=0) ** 2, axis=1))
        unsure = np.clip(strays / max(_STRAYS * float(np.median(strays)), 1e-9), 1.0, _MOST_UNSURE)
    return palm, unsure, (rotation, position)


def frames_between(time: Array, rotation: Array, position: Array) -> tuple[Array, Array]:
    """Return poses (T, ..) with those that are NaN taken from their neighbours: somewhere for a fit to start."""
    known = np.isfinite(position).all(axis=1)
    inside = np.clip(time, time[known][0], time[known][-1])
    turns = Slerp(time[known], Rotation.from_matrix(rotation[known]))(inside).as_matrix()
    places = np.stack([np.interp(inside, time[known], position[known, k]) for k in range(3)], axis=1)
    turns[known], places[known] = rotation[known], position[known]
    return turns, places
