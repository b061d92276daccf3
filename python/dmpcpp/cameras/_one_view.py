"""A hand's poses from one camera: the net's own landmarks say how it is turned, its size how far away it is.

A sketch, not a measurement: depth hangs on the size of a palm in pixels. `Quality` says whether the view carries it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.cameras._accuracy import accuracy_of_one
from dmpcpp.cameras._fit import Fit, Motion, Sight, fit_motion
from dmpcpp.cameras._landmarks import PALM, Landmarks
from dmpcpp.cameras._palm import palm_frame, palm_shape
from dmpcpp.cameras._two_views import frames_between

__all__ = ["Quality", "fit_one_view"]

_FRAME = (PALM.index(0), PALM.index(5), PALM.index(9), PALM.index(17))
_HOW = Fit(acceleration=4.0, turning=25.0, rotation=0.15, palm=1.0)
_BONES = ((0, 5), (0, 9), (0, 13), (0, 17), (5, 17))


@dataclass(frozen=True)
class Quality:
    """Whether one view carries a motion; the limits were chosen on 40 drawn views.

    Attributes
    ----------
    bones : float
        How much the net's palm bones change in length over the video: median over them of the robust deviation over
        the median. A rigid hand that is seen well keeps them.
    reprojection : float
        Error of a constant palm under the fit, over the palm's length in the picture.
    facing : float
        How much the palm or the back of the hand faces the camera: cosine, median over the frames.
    straight : float
        How straight the middle finger is: its span over its length, median; a fist has 0.6.
    error : float
        Estimated error of the position [m rms].
    """

    bones: float
    reprojection: float
    facing: float
    straight: float
    error: float

    MOST_BONES = 0.13
    MOST_REPROJECTION = 0.09
    LEAST_FACING = 0.35
    LEAST_STRAIGHT = 0.8
    MOST_ERROR = 0.05

    @property
    def ok(self) -> bool:
        """Whether the view carries it."""
        return not self.why

    @property
    def why(self) -> str:
        """What speaks against it; "" where nothing does."""
        if self.straight < self.LEAST_STRAIGHT:
            return "the hand is a fist, whose landmarks are guessed"
        if self.facing < self.LEAST_FACING:
            return "the hand is seen edge on"
        if self.bones > self.MOST_BONES:
            return f"its bones change by {100 * self.bones:.2g} %, limit {100 * self.MOST_BONES:g} %"
        if self.reprojection > self.MOST_REPROJECTION:
            limit = f"limit {100 * self.MOST_REPROJECTION:g} %"
            return f"a rigid palm misses by {100 * self.reprojection:.2g} % of its size, {limit}"
        if self.error > self.MOST_ERROR:
            return f"its position is known to {1e3 * self.error:.2g} mm, limit {1e3 * self.MOST_ERROR:g} mm"
        return ""


def fit_one_view(view: Landmarks, scale: float) -> tuple[Motion, Quality]:
    """Return the poses at the camera's times, and how far to trust them.

    Parameters
    ----------
    view : Landmarks
    scale : float
        Of the net's world landmarks: the hand's length over what they say it is.
    """
    found = view.found
    world = scale * view.world
    palm, spread = palm_shape(world[found], PALM)
    rays = view.rays[:, list(PALM)]
    turns = np.full((len(world), 3, 3), np.nan)
    turns[found] = _towards(view.rays[found].mean(axis=1)) @ palm_frame(world[found])
    places = np.full((len(world), 3), np.nan)
    places[found] = _placed(rays[found], turns[found] @ palm.T)
    rotation, position = frames_between(view.time, turns, places)
    sights = [Sight(rays, np.full(len(PALM), view.deviation), np.eye(3), np.zeros(3))]
    motion = fit_motion(view.time, sights, rotation, position, palm, spread + 0.003, _HOW, _FRAME)
    return motion, _quality(view, motion, palm)


def _towards(ray: Array) -> Array:
    """Return the least rotations (T, 3, 3) that turn the view axis to rays (T, 2)."""
    axis = np.concatenate([ray, np.ones((len(ray), 1))], axis=1)
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    turn = np.stack([-axis[:, 1], axis[:, 0], np.zeros(len(axis))], axis=1)
    sine = np.linalg.norm(turn, axis=1, keepdims=True)
    angle = np.arctan2(sine, axis[:, 2:])
    least = turn * np.divide(angle, sine, out=np.ones_like(angle), where=sine > 1e-9)
    return np.asarray(Rotation.from_rotvec(least).as_matrix())


def _placed(rays: Array, turned: Array) -> Array:
    """Return translations (T, 3) that lay turned palms (T, 3, K) over rays (T, K, 2): t_x - n t_z = n Y_z - Y_x."""
    count, number = rays.shape[:2]
    a, b = np.zeros((count, number, 2, 3)), np.zeros((count, number, 2))
    for k in (0, 1):
        a[:, :, k, k] = 1.0
        a[:, :, k, 2] = -rays[..., k]
        b[:, :, k] = rays[..., k] * turned[:, 2] - turned[:, k]
    rows, right = a.reshape(count, -1, 3), b.reshape(count, -1, 1)
    across = np.swapaxes(rows, 1, 2)
    return np.asarray(np.linalg.solve(across @ rows, across @ right)[..., 0])


def _quality(view: Landmarks, motion: Motion, palm: Array) -> Quality:
    world = view.world[view.found]
    spreads = []
    for a, b in _BONES:
        length = np.linalg.norm(world[:, a] - world[:, b], axis=1)
        middle = np.median(length)
        spreads.append(1.4826 * np.median(np.abs(length - middle)) / middle)
    points = np.einsum("tij,kj->tki", motion.rotation, palm) + motion.position[:, None]
    seen = view.camera.rays(view.pixels[:, list(PALM)])
    depth = np.maximum(points[..., 2:], 0.02)
    error = view.camera.focal * np.linalg.norm(points[..., :2] / depth - seen, axis=2)
    axis = motion.position / np.linalg.norm(motion.position, axis=1, keepdims=True)
    facing = abs(float(np.median(np.einsum("ti,ti->t", motion.rotation[:, :, 2], axis))))
    return Quality(
        float(np.median(spreads)),
        float(np.sqrt(np.nanmean(error**2)) / view.palm_pixels),
        facing,
        _straightness(world),
        accuracy_of_one(motion).position,
    )


def _straightness(world: Array) -> float:
    finger = world[:, (9, 10, 11, 12)]
    span = np.linalg.norm(finger[:, 3] - finger[:, 0], axis=1)
    return float(np.median(span / np.linalg.norm(np.diff(finger, axis=1), axis=2).sum(axis=1)))
