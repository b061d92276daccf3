"""Improve a motion by trial: a search for via-points, a goal or weights that a cost of the user's prefers.

PI^BB (Stulp and Sigaud 2012, "Policy improvement methods: between black-box optimization and episodic reinforcement
learning"): samples about the best guess, averaged by exp(-10 (c - min) / (max - min)), in steps that shrink.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dmpcpp._core import Via
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["Improvement", "improve"]

_SAMPLES = 10  # of each update
_SHARPNESS = 10.0
_SEARCHES = ("via", "goal", "weights")


@dataclass(frozen=True, eq=False)
class Improvement:
    """What a search found.

    Attributes
    ----------
    model
        The model: with other weights where these were searched, otherwise as it was.
    goal
        Shaped as the model's: to roll out to.
    via : tuple of Via
        To roll out past.
    cost : float
        Of the best trial, which is this one.
    costs : (trials,)
        Of all trials in their order, that of the model as it was first; infinite where the cost refused one.
    """

    model: Any
    goal: Any
    via: tuple[Via, ...]
    cost: float
    costs: Array

    def rollout(self, duration: float | None = None, dt: float = 1e-3) -> Any:
        """Return the motion that was found, as the model's rollout gives it."""
        return self.model.rollout(self.goal, duration, dt, via=list(self.via))


def improve(
    model: Any,
    cost: Callable[[Any], float],
    *,
    search: str = "via",
    phases: Sequence[float] = (0.5,),
    reach: float = 0.3,
    step: float | None = None,
    decay: float = 0.97,
    rollouts: int = 100,
    dt: float = 1e-2,
    seed: int = 0,
) -> Improvement:
    """Search for the motion of least cost about a model's.

    Parameters
    ----------
    model : Dmp or PoseDmp
        Discrete. Of poses via-points and goals are moved; their rotations stay.
    cost : callable
        Takes a rollout (Trajectory, PoseTrajectory) and returns a number, less is better: distances, or what became of
        it in a simulator. It may return infinity or NaN for a trial that failed.
    search : {"via", "goal", "weights"}
        "via": places at `phases`, within `reach`; two or three numbers each, so that few trials go far. "goal": the
        end. "weights": those of the forcing term, perturbed so that paths change smoothly and both ends stay.
    step : float, optional
        First standard deviation of a trial's positions, m (default: a tenth of the demonstrated extent).
    decay : float
        Factor of the step at each update, 0.5 to 1.
    rollouts : int
        Trials, the first one that of the model as it is; 11 or more.
    dt : float
        Of the rollouts that `cost` gets, s.
    seed : int
        The same seed gives the same trials.

    Raises
    ------
    InvalidArgument
        Another model or search, numbers out of range, or a model whose own trial has no finite cost.
    """
    if search not in _SEARCHES:
        raise InvalidArgument(f"search: '{search}', expected one of {', '.join(_SEARCHES)}.")
    trial = _trial(model, search, phases, reach, dt)
    extent = float(np.linalg.norm(np.ptp(_positions(model.rollout(dt=dt)), axis=0)))
    width = 0.1 * extent if step is None else step
    _require(width, decay, rollouts)
    random = np.random.default_rng(seed)
    costs: list[float] = []
    best: tuple[float, Any] = (np.inf, None)

    def tried(values: Array) -> float:
        nonlocal best
        found = trial.at(values)
        told = float(cost(found.rollout(dt=dt)))
        costs.append(told if np.isfinite(told) else np.inf)
        if costs[-1] < best[0]:
            best = (costs[-1], found)
        return costs[-1]

    middle = np.zeros(trial.size)
    if not np.isfinite(tried(middle)):
        raise InvalidArgument("cost: not finite for the model as it is, expected a number to start from.")
    while len(costs) < rollouts:
        count = min(_SAMPLES, rollouts - len(costs))
        samples = middle + width * random.normal(size=(count, trial.size)) @ trial.shape.T
        middle = _averaged(samples, np.array([tried(sample) for sample in samples]), middle)
        width *= decay
    found = best[1]
    return Improvement(found.model, found.goal, found.via, best[0], np.array(costs))


def _averaged(samples: Array, costs: Array, otherwise: Array) -> Array:
    fine = np.isfinite(costs)
    if not fine.any():
        return otherwise
    costs, samples = costs[fine], samples[fine]
    spread = float(np.ptp(costs))
    share = np.exp(-_SHARPNESS * (costs - costs.min()) / spread) if spread > 0 else np.ones(len(costs))
    return np.asarray(share @ samples / share.sum())


@dataclass(frozen=True, eq=False)
class _Trial:
    """The motions of a search: `size` numbers about 0, in m; samples are shape @ normal numbers."""

    at: Callable[[Array], Improvement]
    size: int
    shape: Array


def _trial(model: Any, search: str, phases: Sequence[float], reach: float, dt: float) -> _Trial:
    axes = _positions_of(model.start).size
    if search == "goal":
        goal = lambda moved: Improvement(model, _moved(model.goal, moved), (), np.inf, np.empty(0))  # noqa: E731
        return _Trial(goal, axes, np.eye(axes))
    if search == "weights":
        shape = _smooth(model, dt)
        count = len(shape)

        def weighed(values: Array) -> Improvement:
            weights = np.array(model.weights)
            weights[:, :axes] += values.reshape(axes, count).T
            return Improvement(model.with_weights(weights), model.goal, (), np.inf, np.empty(0))

        return _Trial(weighed, axes * count, np.kron(np.eye(axes), shape))
    plain = [_point(model, phase) for phase in phases]

    def past(values: Array) -> Improvement:
        moved = [
            Via(phase, _moved(point, by), reach=reach)
            for phase, point, by in zip(phases, plain, values.reshape(len(plain), axes), strict=True)
        ]
        return Improvement(model, model.goal, tuple(moved), np.inf, np.empty(0))

    return _Trial(past, axes * len(plain), np.eye(axes * len(plain)))


def _smooth(model: Any, dt: float) -> Array:
    """Return L (N, k): weights L xi change the path smoothly, by 1 m RMS, and neither its end nor the rate there."""
    count = model.options.basis_count
    samples = max(50, round(model.duration / dt) + 1)
    times = np.linspace(0, model.duration, samples)
    base = _positions(model.rollout_at(times))[:, 0]
    effect = np.empty((samples, count))
    for k in range(count):
        weights = np.array(model.weights)
        weights[k, 0] += 1.0
        effect[:, k] = _positions(model.with_weights(weights).rollout_at(times))[:, 0] - base
    bend = np.diff(effect, 2, axis=0) * (samples - 1) ** 2
    gram = bend.T @ bend
    covariance = np.linalg.inv(gram + 1e-8 * np.trace(gram) / count * np.eye(count))
    ends = np.array([effect[-1], effect[-1] - effect[-2]])
    across = covariance @ ends.T
    covariance -= across @ np.linalg.pinv(ends @ across) @ across.T
    values, vectors = np.linalg.eigh((covariance + covariance.T) / 2)
    shape = vectors * np.sqrt(np.maximum(values, 0.0))
    return np.asarray(shape / np.sqrt(np.mean(np.sum((effect @ shape) ** 2, axis=1))))


def _require(width: float, decay: float, rollouts: int) -> None:
    if not (np.isfinite(width) and width > 0):
        raise InvalidArgument(f"step: {width}, expected a positive number of metres.")
    if not 0.5 <= decay <= 1.0:
        raise InvalidArgument(f"decay: {decay}, expected 0.5 to 1.")
    if rollouts < _SAMPLES + 1:
        raise InvalidArgument(f"rollouts: {rollouts}, expected {_SAMPLES + 1} or more.")


def _point(model: Any, phase: float) -> Any:
    found = model.rollout_at(np.array([phase * model.duration]))
    return found.pose[0] if hasattr(found, "pose") else found.position[0]


def _positions(motion: Any) -> Array:
    return np.asarray(motion.pose[:, :3, 3] if hasattr(motion, "pose") else motion.position)


def _positions_of(point: Any) -> Array:
    if not isinstance(point, np.ndarray) or (point.shape != (4, 4) and point.ndim != 1):
        raise InvalidArgument("model: expected a Dmp or a PoseDmp.")
    return np.asarray(point[:3, 3] if point.ndim == 2 else point)


def _moved(point: Array, by: Array) -> Array:
    moved = np.array(point)
    if moved.ndim == 2:
        moved[:3, 3] += by
        return moved
    return np.asarray(moved + by)
