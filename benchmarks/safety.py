"""`python -m benchmarks.safety [--json] [--seed N]`: limits and obstacles behind a run, in scenes drawn from a seed.

movement_primitives' coupling term for obstacles runs through the same scenes where it is installed (extra `bench`). In
the scenes at most 40 % of the motions are free without avoidance, and every start and goal is. Exit status: 0 every
goal reached, 3 one missed.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import click
import numpy as np
from dmpcpp import (
    Box,
    Demonstration,
    Dmp,
    DmpOptions,
    DmpParameters,
    InvalidArgument,
    Run,
    SafetyFilter,
    Sphere,
    Status,
    planning,
    so3,
)
from numpy.typing import NDArray

from benchmarks import accuracy, peers
from benchmarks.figures import Figure

Array = NDArray[np.float64]
Shape = Sphere | Box

_STEPS = 500  # a duration
_MARGIN = 0.02  # m
_SCENES = 200
_HARD = 50  # of each kind
_IN_THE_WAY = ("sphere", "wall", "tilted wall", "closed gap")
_US = 1e6


@dataclass(frozen=True)
class Scene:
    """A reach of 0.6 m in one second with what is in its way."""

    path: Array
    obstacles: tuple[Shape, ...]

    def model(self, duration: float = 1.0) -> Dmp:
        """Return the motion as learned."""
        return Dmp.fit(Demonstration(np.linspace(0.0, duration, len(self.path)), self.path))

    def free(self, path: Array, times: Array | None = None) -> float:
        """Return the least distance of a path (T, 3) at times (T,) to what is in the way then, m."""
        places = [path - np.outer(times, shape.velocity) if times is not None else path for shape in self.obstacles]
        return min(float(shape.distance(place).min()) for shape, place in zip(self.obstacles, places, strict=True))


@dataclass(frozen=True)
class Passage:
    """How a scene was passed: the least distance (m), how far from the goal it ended (m), and its length over the
    plain one."""

    clearance: float
    missed: float
    longer: float
    blocked: int


def reach(rng: np.random.Generator) -> Array:
    """Return a bent reach (101, 3) of 0.6 m in any direction."""
    s = np.linspace(0.0, 1.0, 101)
    along = rng.normal(size=3)
    along /= np.linalg.norm(along)
    across = np.cross(along, rng.normal(size=3))
    across /= np.linalg.norm(across)
    bend = rng.uniform(-0.08, 0.08)
    return np.outer(0.6 * s**3 * (10 - 15 * s + 6 * s**2), along) + np.outer(bend * np.sin(np.pi * s) ** 3, across)


def _drawn(rng: np.random.Generator, place: Array, velocity: Array) -> Shape:
    if rng.random() < 0.5:
        return Sphere(place, rng.uniform(0.03, 0.09), velocity)
    pose = np.eye(4)
    pose[:3, :3] = so3.exp(rng.normal(size=3))
    pose[:3, 3] = place
    return Box(pose, rng.uniform(0.02, 0.08, 3), velocity)


def scenes(seed: int, moving: bool) -> list[Scene]:
    """Return 200 scenes of one to three obstacles near the path; start and goal are free with 3 cm to spare."""
    rng = np.random.default_rng([seed, moving])
    found: list[Scene] = []
    while len(found) < _SCENES:
        path = reach(rng)
        shapes = []
        for _ in range(rng.integers(1, 4)):
            when = rng.uniform(0.25, 0.75)
            velocity = rng.normal(size=3) if moving else np.zeros(3)
            velocity *= 0.3 / max(np.linalg.norm(velocity), 1e-9) if moving else 1.0
            aside = rng.normal(size=3) * 0.03
            shapes.append(_drawn(rng, path[int(100 * when)] + aside - when * velocity, velocity))
        scene = Scene(path, tuple(shapes))
        ends = [Scene(path, (shape,)) for shape in shapes]
        at = (0.0, 1.0, 2.0) if moving else (0.0,)
        clear = all(one.free(path[[0, -1]], np.full(2, moment)) > _MARGIN + 0.03 for one in ends for moment in at)
        if clear:
            found.append(scene)
    return found


def hard_scenes(seed: int, kind: str) -> list[Scene]:
    """Return 50 scenes with an obstacle exactly in the way: sphere, wall, tilted wall, or two that close a gap."""
    rng = np.random.default_rng([seed, 7, sum(map(ord, kind))])
    found = []
    for _ in range(_HARD):
        path = np.outer(np.linalg.norm(reach(rng), axis=1), [1.0, 0.0, 0.0])
        path *= 0.6 / path[-1, 0]
        place = np.array([rng.uniform(0.2, 0.4), 0.0, 0.0])
        if kind == "sphere":
            found.append(Scene(path, (Sphere(place, rng.uniform(0.03, 0.1)),)))
            continue
        pose = np.eye(4)
        pose[:3, 3] = place
        if kind == "tilted wall":
            pose[:3, :3] = so3.exp([0.0, rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)])
        half = np.array([0.015, *rng.uniform(0.06, 0.15, 2)])
        if kind != "closed gap":
            found.append(Scene(path, (Box(pose, half),)))
            continue
        other = pose.copy()
        pose[1, 3], other[1, 3] = half[1] + 0.005, -half[1] - 0.005
        found.append(Scene(path, (Box(pose, half), Box(other, half))))
    return found


def passage(scene: Scene, duration: float = 1.0, until: float = 2.0, **limits: Array) -> Passage:
    """Return how the filter passes a scene until a multiple of its duration."""
    moved = [_at_duration(shape, duration) for shape in scene.obstacles]
    run, safe = Run(scene.model(duration)), SafetyFilter(moved, margin=_MARGIN, **limits)
    dt = duration / _STEPS
    clearance, blocked, length, last = np.inf, 0, 0.0, run.position
    for _ in range(round(until * _STEPS)):
        run.step(dt, filter=safe)
        clearance = min(clearance, safe.clearance)
        blocked += run.status == Status.blocked
        length += float(np.linalg.norm(run.position - last))
        last = run.position
    plain = float(np.linalg.norm(np.diff(scene.path, axis=0), axis=1).sum())
    return Passage(clearance, float(np.linalg.norm(run.position - scene.path[-1])), length / plain, blocked)


def _at_duration(shape: Shape, duration: float) -> Shape:
    velocity = np.asarray(shape.velocity) / duration
    if isinstance(shape, Sphere):
        return Sphere(shape.center, shape.radius, velocity)
    return Box(shape.pose, shape.half_sizes, velocity)


def measure_scenes(seed: int) -> Iterator[Figure]:
    """Drawn scenes, still and moving."""
    still, moving = scenes(seed, False), scenes(seed, True)
    plain = 100 * float(np.mean([scene.free(scene.path) > 0.0 for scene in still]))
    yield Figure("still: free without avoidance", plain, 40.0, "%")
    theirs = _peer_hits(still)
    passed = [passage(scene) for scene in still]
    yield Figure("still: touched", _share(passed, lambda one: one.clearance <= 0.0), 0.0, "%", theirs)
    yield Figure("still: 2 cm not kept", _share(passed, lambda one: one.clearance < _MARGIN - 1e-3), 0.0, "%")
    yield Figure("still: not at the goal by 2 T", _share(passed, lambda one: one.missed > 5e-3), 0.0, "%")
    yield Figure("still: path length, median", float(np.median([one.longer for one in passed])), 1.05, "x")
    start = [scene.free(scene.path[:1]) > 0.0 for scene in moving]
    times = np.linspace(0.0, 1.0, 101)
    plain = 100 * float(np.mean([scene.free(scene.path, times) > 0.0 for scene in moving]))
    yield Figure("moving: free without avoidance", plain, 40.0, "%")
    passed = [passage(scene) for scene, clear in zip(moving, start, strict=True) if clear]
    yield Figure("moving: touched", _share(passed, lambda one: one.clearance <= 0.0), 0.5, "%")
    yield Figure("moving: not at the goal by 2 T", _share(passed, lambda one: one.missed > 5e-3), 1.0, "%")


def measure_hard(seed: int) -> Iterator[Figure]:
    """Scenes with something exactly in the way."""
    for kind in _IN_THE_WAY:
        passed = [passage(scene, until=3.0) for scene in hard_scenes(seed, kind)]
        yield Figure(f"{kind} in the way: touched", _share(passed, lambda one: one.clearance <= 0.0), 0.0, "%")
        yield Figure(
            f"{kind} in the way: not at the goal by 3 T", _share(passed, lambda one: one.missed > 5e-3), 0.0, "%"
        )


def measure_plans(seed: int) -> Iterator[Figure]:
    """One verified bump, planned before the motion begins."""
    still = scenes(seed, False)
    found = [_planned(scene) for scene in still]
    none = 100.0 * float(np.mean([one is None for one in found]))
    bumps = [one for one in found if one is not None]
    yield Figure("planned: no way found", none, 2.0, "%")
    yield Figure("planned: nearer than 2 cm", 1e3 * max(0.0, _MARGIN - min(one[0] for one in bumps)), 0.0, "mm")
    yield Figure("planned: path length, median", float(np.median([one[1] for one in bumps])), 1.05, "x")
    yield Figure("planned: peak acceleration, median", float(np.median([one[2] for one in bumps])), 1.1, "x")


def _planned(scene: Scene) -> tuple[float, float, float] | None:
    """Return the least distance (m) at 10001 samples, and length and peak acceleration over the plain motion's."""
    model = scene.model()
    try:
        detour = planning.clear_path(model, scene.obstacles, margin=_MARGIN)
    except InvalidArgument:
        return None
    plain = model.rollout(dt=1e-4)
    moved = model.rollout(dt=1e-4, via=[detour.via]) if detour else plain
    lengths = [float(np.linalg.norm(np.diff(one.position, axis=0), axis=1).sum()) for one in (moved, plain)]
    peaks = [float(np.linalg.norm(one.acceleration, axis=1).max()) for one in (moved, plain)]
    return scene.free(moved.position), lengths[0] / lengths[1], peaks[0] / peaks[1]


def measure_durations(seed: int) -> Iterator[Figure]:
    """The same scenes in 1, 2 and 4 s."""
    few = scenes(seed, False)[:20]
    found = np.array([[passage(scene, duration).clearance for duration in (1.0, 2.0, 4.0)] for scene in few])
    yield Figure("clearance over durations 1, 2, 4 s: apart", float(np.ptp(found, axis=1).max()), 1e-9, "m")


def measure_limits(seed: int) -> Iterator[Figure]:
    """Wild goals and tempi: 8 axes, 150000 steps; and scenes with limits and obstacles at once."""
    axes, dt = 8, 1e-3
    lower, upper, fastest, hardest = -0.4, 0.5, 0.8, 3.0
    safe = SafetyFilter(
        lower=[lower] * axes, upper=[upper] * axes, velocity=[fastest] * axes, acceleration=[hardest] * axes
    )
    rng, run = np.random.default_rng(seed), Run(springs(axes))
    place, speed, push = 0.0, 0.0, 0.0
    for step in range(150_000):
        if step % 50 == 0:
            run.goal = rng.uniform(-2.0, 2.0, axes)
        if step % 333 == 0:
            run.duration = rng.uniform(0.05, 2.0)
        run.step(dt, filter=safe)
        at = run.position
        place = max(place, float(at.max()) - upper, lower - float(at.min()))
        speed = max(speed, float(np.abs(run.velocity).max()) - fastest)
        push = max(push, float(np.abs(run.acceleration).max()) / hardest - 1.0)
    yield Figure("limits, 1.2 million axis-steps: position beyond", place, 0.0, "m")
    yield Figure("limits, 1.2 million axis-steps: velocity beyond", speed, 0.0, "m/s")
    yield Figure("limits, 1.2 million axis-steps: acceleration beyond, share", push, 1e-9, "")
    limits = {"velocity": np.full(3, 1.2), "acceleration": np.full(3, 8.0)}
    passed = [passage(scene, until=3.0, **limits) for scene in scenes(seed, False)]
    yield Figure("still, with limits: touched", _share(passed, lambda one: one.clearance <= 0.0), 0.0, "%")
    yield Figure("still, with limits: not at the goal by 3 T", _share(passed, lambda one: one.missed > 5e-3), 1.0, "%")
    tight = {"velocity": np.full(3, 1.5), "acceleration": np.full(3, 5.0)}
    hard = [scene for kind in _IN_THE_WAY for scene in hard_scenes(seed, kind)]
    passed = [passage(scene, until=3.0, **tight) for scene in hard]
    yield Figure("in the way, with tight limits: touched", _share(passed, lambda one: one.clearance <= 0.0), 0.0, "%")
    yield Figure(
        "in the way, with tight limits: not at the goal", _share(passed, lambda one: one.missed > 5e-3), 0.0, "%"
    )


def springs(axes: int) -> Dmp:
    """Return a model that goes wherever its goal is, without a filter of goal and tempo."""
    parameters = DmpParameters()
    parameters.options = DmpOptions(basis_count=5, goal_filter=0.0, tempo_filter=0.0, scaling="none")
    parameters.duration = 0.5
    for name in ("start", "goal", "start_velocity"):
        setattr(parameters, name, np.zeros(axes))
    parameters.amplitude = np.ones(axes)
    parameters.weights = np.zeros((5, axes))
    return Dmp(parameters)


def measure_cost(seed: int) -> Iterator[Figure]:
    """What a step of the filter costs, with three obstacles beside the path and limits."""
    model = Scene(reach(np.random.default_rng(seed)), ()).model()
    pose = np.eye(4)
    pose[:3, 3] = 0.1, 0.2, 0.6
    obstacles = [Sphere([0.2, 0.5, 0.1], 0.1), Sphere([-0.4, 0.5, 0.1], 0.1), Box(pose, [0.1, 0.1, 0.1])]
    safe = SafetyFilter(obstacles, velocity=[5.0] * 3, acceleration=[90.0] * 3)

    def seconds(filter_: SafetyFilter | None) -> float:
        best = np.inf
        for _ in range(9):
            run, start = Run(model), time.process_time()
            for _ in range(400):
                run.reset()
                run.step(0.5, filter=filter_)  # 100 pieces
            best = min(best, (time.process_time() - start) / 400 / 100)
        return best

    plain = seconds(None)
    yield Figure("a step of the filter, three obstacles and limits", _US * (seconds(safe) - plain), 0.2, "us")


def _share(passed: list[Passage], fails: Callable[[Passage], bool]) -> float:
    return 100.0 * float(np.mean([fails(one) for one in passed]))


def _peer_hits(still: list[Scene]) -> dict[str, float]:
    """Return the share of scenes in which the other package's coupling term touches something, %."""
    if not peers.installed()["movement_primitives"]:
        return {}
    from movement_primitives.dmp import DMP, CouplingTermObstacleAvoidance3D

    hits = 0
    for scene in still:
        other = DMP(n_dims=3, execution_time=1.0, dt=1.0 / _STEPS, n_weights_per_dim=50)
        other.imitate(np.linspace(0.0, 1.0, len(scene.path)), scene.path)
        nearest = scene.obstacles[int(np.argmin([shape.distance(scene.path).min() for shape in scene.obstacles]))]
        centre = nearest.center if isinstance(nearest, Sphere) else nearest.pose[:3, 3]
        _, path = other.open_loop(coupling_term=CouplingTermObstacleAvoidance3D(np.array(centre)))
        hits += scene.free(path) <= 0.0
    return {"movement_primitives": 100.0 * hits / len(still)}


def measure(seed: int = 0) -> Iterator[Figure]:
    """Yield every figure."""
    for part in (measure_scenes, measure_hard, measure_plans, measure_durations, measure_limits, measure_cost):
        yield from part(seed)


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON instead of the table.")
@click.option("--seed", default=0, show_default=True, help="Of the scenes.")
def main(as_json: bool, seed: int) -> None:
    """Measure the safety filter, with the goal of every figure."""
    measured = list(measure(seed))
    if as_json:
        click.echo(json.dumps({"figures": [figure.to_dict() for figure in measured]}, indent=2))
    else:
        accuracy.show(measured)
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


if __name__ == "__main__":
    main()
