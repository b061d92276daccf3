"""Goals that were not demonstrated: how far a motion goes back for them, how it starts, how far out it swings."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from dmpcpp import Demonstration, Dmp, motion
from numpy.typing import NDArray

from benchmarks import demonstrations, human_motion
from benchmarks.demonstrations import minimum_jerk
from benchmarks.figures import Figure

Array = NDArray[np.float64]

_SHARES = (0.25, 0.5, 0.75, 1.5, 2.0)  # of the demonstrated way
_ASIDE = 0.3  # of the extent, to six sides
_LIMITS = {  # mm back, of the peak at the start, mm outside the box
    "reaches": (0.1, 0.15, 1.0),
    "reaches with rests": (0.1, 0.15, 1.0),
    "recorded reaches": (1.5, 0.15, 1.0),
    "motions that wander": (56.0, 0.15, np.inf),
}


def goals(scaling: str) -> Iterator[Figure]:
    """Measure the worst of ten motions of each kind, and of 20 recorded reaches where they are there, each led to 5
    goals on its way and 6 beside it. What the demonstration does itself does not count."""
    for kind, motions in _motions().items():
        back = start = outside = 0.0
        for demonstration in motions:
            model = Dmp.fit(demonstration, scaling=scaling)
            for goal in _goals(demonstration.position):
                now = _led(model, demonstration, goal)
                back, start, outside = (max(pair) for pair in zip((back, start, outside), now, strict=True))
        limits = _LIMITS[kind]
        yield Figure(f"{kind} to new goals: back beyond the demonstration", 1e3 * back, limits[0], "mm")
        yield Figure(
            "the same: acceleration at the start beyond the demonstrated, over the peak", start, limits[1], "1"
        )
        if np.isfinite(limits[2]):
            yield Figure("the same: outside the box of old and new goal", 1e3 * outside, limits[2], "mm")


def _motions() -> dict[str, list[Demonstration]]:
    time = np.linspace(0.0, 2.0, 401)
    seeds = [np.random.default_rng(seed) for seed in range(10)]
    found = {
        "reaches": [_shown(time, _reach(rng), lambda t: t / 2.0) for rng in seeds],
        "reaches with rests": [
            _shown(time, _reach(rng), lambda t: np.clip((t - 0.4) / 1.2, 0.0, 1.0)) for rng in seeds
        ],
        "motions that wander": [_shown(time, _loops(rng), lambda t: t / 2.0) for rng in seeds],
    }
    if folder := demonstrations.recordings():
        hand, _ = human_motion.grasping(folder.parent)
        parts = human_motion.reaches(motion.cycles(hand))
        found["recorded reaches"] = [Demonstration(part.time, part.position) for part in parts]
    return found


def _shown(time: Array, path: Callable[[Array], Array], share: Callable[[Array], Array]) -> Demonstration:
    return Demonstration(time, path(minimum_jerk(share(time))))


def _reach(rng: np.random.Generator) -> Callable[[Array], Array]:
    """Half of them straight, half of them arched to the side."""
    way = _vector(rng, rng.uniform(0.2, 0.6))
    arch = np.cross(way, rng.normal(size=3))
    arch *= rng.integers(0, 2) * rng.uniform(0.05, 0.15) / np.linalg.norm(arch)
    return lambda s: np.asarray(s[:, None] * way + np.sin(np.pi * s)[:, None] * arch)


def _loops(rng: np.random.Generator) -> Callable[[Array], Array]:
    way, radius, turns = _vector(rng, 0.3), rng.uniform(0.03, 0.1), int(rng.integers(1, 4))

    def path(s: Array) -> Array:
        around = 2.0 * np.pi * turns * s
        return np.asarray(s[:, None] * way + radius * np.c_[np.sin(around), np.cos(around) - 1.0, 0.0 * s])

    return path


def _vector(rng: np.random.Generator, length: float) -> Array:
    vector = rng.normal(size=3)
    return np.asarray(length * vector / np.linalg.norm(vector))


def _goals(path: Array) -> Iterator[Array]:
    way = path[-1] - path[0]
    extent = float(np.linalg.norm(np.ptp(path, axis=0)))
    yield from (path[0] + share * way for share in _SHARES)
    yield from (path[-1] + sign * _ASIDE * extent * np.eye(3)[axis] for axis in range(3) for sign in (1.0, -1.0))


def _led(model: Dmp, demonstration: Demonstration, goal: Array) -> tuple[float, float, float]:
    """Return how far the motion goes back [m], its acceleration at the start, and how far it leaves the box [m], each
    beyond what the demonstration does."""
    own, moved = model.rollout(dt=2e-3), model.rollout(goal=goal, dt=2e-3)
    back = _back(moved.position, goal) - _back(own.position, model.goal)
    peak = np.linalg.norm(own.acceleration, axis=1).max()
    start = np.linalg.norm(moved.acceleration[0]) - np.linalg.norm(own.acceleration[0])
    low = np.minimum(demonstration.position.min(axis=0), goal)
    high = np.maximum(demonstration.position.max(axis=0), goal)
    # A detour is kept in its size: the box is that of the demonstration's own, carried to the new goal.
    carried = demonstration.position + goal - model.goal
    low, high = np.minimum(low, carried.min(axis=0)), np.maximum(high, carried.max(axis=0))
    outside = np.maximum(low - moved.position, moved.position - high).max()
    return float(back), float(start / peak), float(outside)


def _back(path: Array, goal: Array) -> float:
    way = (goal - path[0]) / np.linalg.norm(goal - path[0])
    along = (path - path[0]) @ way
    return float((np.maximum.accumulate(along) - along).max())
