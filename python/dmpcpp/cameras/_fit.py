"""The whole-video fit: all poses of a hand and one constant palm at once, by Gauss-Newton with robust weights.

Errors are reprojections in every camera, accelerations of the position and of the turning, and, with one camera, how
far the net's own rotation is left. Alone, a frame of one camera leaves depth to its noise; accelerations tie it to its
neighbours.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.cameras._bordered import Normal
from dmpcpp.cameras._palm import palm_frame

__all__ = ["Fit", "Motion", "Sight", "fit_motion"]

_ROUNDS = 25
_SETTLED = 1e-4  # relative fall of the cost
_BEHIND = 0.02  # m; no point is taken to lie nearer to a camera
_ANCHOR = 1e-3  # weight of the palm's start: holds the frame, which nothing else does


@dataclass(frozen=True, eq=False)
class Sight:
    """What one camera measured: rays (T, K, 2), NaN where lost, the standard deviations (K,) along an axis, and
    x_camera = R x + t.
    """

    rays: Array
    deviation: Array
    rotation: Array
    translation: Array


@dataclass(frozen=True)
class Fit:
    """How errors are weighted: standard deviations.

    Attributes
    ----------
    acceleration : float
        m/s^2, of the position.
    turning : float
        rad/s^2, of the orientation.
    rotation : float
        rad, of the starting orientation as a measurement; 0: it is none.
    palm : float
        Weight of the starting palm as a measurement, on top of the anchor.
    """

    acceleration: float = 6.0
    turning: float = 40.0
    rotation: float = 0.0
    palm: float = 0.0


@dataclass(frozen=True, eq=False)
class Motion:
    """Fitted poses in the first camera's axes.

    `rotation` (T, 3, 3), `position` (T, 3) [m] of the palm's frame; `palm` (K, 3) [m] in it; `error` (V, T, K, 2) the
    reprojection in standard deviations, NaN where not seen; `variance` (T, 6) of a frame alone, for such errors of one
    deviation: of the turn [rad^2] about, and of the position [m^2] along, each axis.
    """

    rotation: Array
    position: Array
    palm: Array
    error: Array
    variance: Array


def fit_motion(
    time: Array,
    sights: list[Sight],
    rotation: Array,
    position: Array,
    palm: Array,
    spread: Array,
    how: Fit,
    palm_landmarks: tuple[int, int, int, int],
) -> Motion:
    """Fit poses to what cameras saw.

    Parameters
    ----------
    time : array (T,)
        s.
    sights : list of Sight
    rotation, position : arrays (T, 3, 3), (T, 3)
        Where the fit starts.
    palm, spread : arrays (K, 3)
        The palm's landmarks in its frame [m], and how well they are known.
    how : Fit
    palm_landmarks : (int, int, int, int)
        Which of the K are the wrist and the knuckles of index, middle and little finger: they define the frame.
    """
    problem = _Problem(time, sights, rotation, spread, palm, how)
    state = (rotation, position, palm)
    cost, damping = problem.cost(*state), 1e-4
    for _ in range(_ROUNDS):
        normal = problem.normal(*state)
        tried = _moved(state, *normal.step(damping))
        new = problem.cost(*tried)
        while not new < cost and damping < 1e6:
            damping *= 10.0
            tried = _moved(state, *normal.step(damping))
            new = problem.cost(*tried)
        if not new < cost:
            break
        fallen, state, cost, damping = (cost - new) / cost, tried, new, max(damping / 10.0, 1e-7)
        if fallen < _SETTLED:
            break
    return problem.result(*state, palm_landmarks)


def _moved(state: tuple[Array, Array, Array], own: Array, common: Array) -> tuple[Array, Array, Array]:
    rotation, position, palm = state
    turn = Rotation.from_rotvec(own[:, :3]).as_matrix()
    return rotation @ turn, position + own[:, 3:], palm + common.reshape(palm.shape)


class _Problem:
    """The errors and their derivatives at a state: rotation (T, 3, 3), position (T, 3), palm (K, 3)."""

    def __init__(self, time: Array, sights: list[Sight], start: Array, spread: Array, palm: Array, how: Fit) -> None:
        self.sights, self.start, self.palm, self.how = sights, start, palm, how
        self.step = np.diff(time)[:, None]
        scale = 0.3 * how.palm * np.sqrt(len(time)) + _ANCHOR
        self.stiffness = (scale / spread).ravel()

    def cost(self, rotation: Array, position: Array, palm: Array) -> float:
        total = 0.0
        for sight in self.sights:
            error, _ = self._reprojection(sight, rotation, position, palm)
            total += float(np.nansum(2.0 * (np.sqrt(1.0 + error**2) - 1.0)))
        for error in (self._acceleration(position)[0], self._turning(rotation)[0], self._left(rotation)):
            total += float(np.sum(error**2))
        return total + float(np.sum((self.stiffness * (palm - self.palm).ravel()) ** 2))

    def normal(self, rotation: Array, position: Array, palm: Array) -> Normal:
        normal = Normal(len(rotation), palm.size)
        for sight in self.sights:
            error, jacobian = self._reprojection(sight, rotation, position, palm)
            weight = (1.0 + error**2) ** -0.25  # root of the weight of the pseudo-Huber loss
            seen = np.isfinite(error)
            weight, error = np.where(seen, weight, 0.0), np.where(seen, error, 0.0)
            own, shared = self._parts(jacobian, rotation, palm, sight)
            flat = (len(rotation), -1)
            normal.add(
                (weight[..., None] * own).reshape(*flat, 6),
                (weight[..., None] * shared).reshape(*flat, palm.size),
                (weight * error).reshape(flat),
            )
        if self.how.rotation:
            eye = np.zeros((len(rotation), 3, 6))
            eye[:, range(3), range(3)] = 1.0 / self.how.rotation
            normal.add(eye, None, self._left(rotation))
        error, weights = self._acceleration(position)
        normal.add_coupled(tuple(_at(weight, 3) for weight in weights), error)
        error, turns = self._turning(rotation)
        normal.add_coupled(turns, error)
        normal.add_shared(self.stiffness, (palm - self.palm).ravel())
        normal.blocks[0] += 1e-9 * np.eye(6)
        return normal

    def _reprojection(self, sight: Sight, rotation: Array, position: Array, palm: Array) -> tuple[Array, Array]:
        """Return errors (T, K, 2) over their deviation, and their derivatives (T, K, 2, 3) by the point seen."""
        points = np.einsum("tij,kj->tki", rotation, palm) + position[:, None]
        seen = points @ sight.rotation.T + sight.translation
        depth = np.maximum(seen[..., 2], _BEHIND)
        scale = (1.0 / sight.deviation)[:, None]
        ray = seen[..., :2] / depth[..., None]
        error = scale * (ray - sight.rays)
        jacobian = np.zeros((*error.shape, 3))
        jacobian[..., 0, 0] = jacobian[..., 1, 1] = scale[:, 0] / depth
        jacobian[..., 2] = -scale * ray / depth[..., None]
        return error, jacobian

    def _parts(self, jacobian: Array, rotation: Array, palm: Array, sight: Sight) -> tuple[Array, Array]:
        """Return the derivatives (T, K, 2, 6) by a frame's pose and (T, K, 2, 3 K) by the palm."""
        world = jacobian @ sight.rotation
        body = world @ rotation[:, None]
        turned = -body @ _cross(palm)[None]
        shared = np.zeros((*jacobian.shape[:3], len(palm), 3))
        k = np.arange(len(palm))
        shared[:, k, :, k] = np.moveaxis(body, 1, 0)
        return np.concatenate([turned, world], axis=-1), shared.reshape(*jacobian.shape[:3], -1)

    def _acceleration(self, position: Array) -> tuple[Array, tuple[Array, Array, Array]]:
        before, behind = self.step[:-1], self.step[1:]
        scale = 2.0 / (before + behind) / self.how.acceleration
        weights = (scale / before, -scale * (1.0 / before + 1.0 / behind), scale / behind)
        first, middle, last = weights
        return first * position[:-2] + middle * position[1:-1] + last * position[2:], weights

    def _turning(self, rotation: Array) -> tuple[Array, tuple[Array, Array, Array]]:
        between = np.swapaxes(rotation[:-1], 1, 2) @ rotation[1:]
        speed = Rotation.from_matrix(between).as_rotvec() / self.step
        before, behind = self.step[:-1], self.step[1:]
        scale = 2.0 / (before + behind) / self.how.turning
        back = -np.swapaxes(between, 1, 2) / self.step[:, :, None]
        ahead = np.eye(3) / self.step[:, :, None]
        parts = (-back[:-1], back[1:] - ahead[:-1], ahead[1:])
        return scale * np.diff(speed, axis=0), tuple(_at(scale[:, :, None] * part, 0) for part in parts)  # type: ignore[return-value]

    def _left(self, rotation: Array) -> Array:
        if not self.how.rotation:
            return np.zeros((len(rotation), 3))
        away = np.swapaxes(self.start, 1, 2) @ rotation
        return np.asarray(Rotation.from_matrix(away).as_rotvec() / self.how.rotation)

    def result(self, rotation: Array, position: Array, palm: Array, landmarks: tuple[int, int, int, int]) -> Motion:
        """Return the poses of the frame that the palm's landmarks define."""
        error, information = [], np.zeros((len(rotation), 6, 6))
        axes, origin = palm_frame(palm, landmarks), palm[landmarks[0]]
        position = position + rotation @ origin
        rotation, palm = rotation @ axes, (palm - origin) @ axes
        for sight in self.sights:
            scaled, jacobian = self._reprojection(sight, rotation, position, palm)
            own = self._parts(jacobian, rotation, palm, sight)[0]
            own = np.where(np.isfinite(scaled)[..., None], own, 0.0)
            information += np.einsum("tkei,tkej->tij", own, own)
            error.append(scaled)
        covariance = np.linalg.pinv(information, hermitian=True)
        return Motion(rotation, position, palm, np.array(error), np.einsum("tii->ti", covariance))


def _at(weights: Array, first: int) -> Array:
    """Return Jacobians (K, 3, 6) whose columns from `first` are weights (K, 1) on the diagonal, or (K, 3, 3)."""
    jacobian = np.zeros((len(weights), 3, 6))
    jacobian[:, :, first : first + 3] = weights if weights.ndim == 3 else weights[:, :, None] * np.eye(3)
    return jacobian


def _cross(vectors: Array) -> Array:
    """Return the matrices (K, 3, 3) of v x."""
    matrix = np.zeros((len(vectors), 3, 3))
    x, y, z = vectors.T
    matrix[:, 0, 1], matrix[:, 0, 2], matrix[:, 1, 2] = -z, y, -x
    return matrix - np.swapaxes(matrix, 1, 2)
