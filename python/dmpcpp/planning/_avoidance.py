"""A motion led around what stands in its way: one bump of the tool's path, and joints that keep the whole arm clear.

The bump is a via-pose (`Via`): at the phase where the path is deepest it leads across the path, and within its reach it
fades, so that start, goal and the rest of the shape stay. The first size counts with which the tool's path and then,
judged in the engine's own shapes, the whole arm keep their distance.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp._core import Arm, Box, Capsule, Dmp, Plane, PoseDmp, PoseTrajectory, Sphere, Trajectory, Via
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._clearance import ClearOfItself, clear_of_itself
from dmpcpp.planning._joints import Engine, Led, Solution
from dmpcpp.planning._placement import Placement
from dmpcpp.recordings import Recording
from dmpcpp.robot import OBSTACLE_MARGIN, Obstacle, Surroundings, base_in_root

__all__ = ["Detour", "clear_path", "place_among", "solve_around"]

_SAMPLES = 400  # of the tool's path
_SIZES = np.geomspace(0.02, 0.5, 14)  # m
_REACHES = (1.0, 0.45, 0.3)
_DIRECTIONS = 24
_APART = np.cos(np.deg2rad(50.0))  # between two directions that are tried with one size
_OF_A_SIZE = 4  # offsets of one size that the whole arm is asked for
_MOST_TRIED = 36
_THOROUGHLY = 5  # of them with all branches of the joints
_SPARE = 1e-3  # m, beyond the margin


@dataclass(frozen=True)
class Detour:
    """Why and how a motion was changed so that it clears the obstacles.

    Attributes
    ----------
    via : Via
        The via-pose that leads around.
    offset : float
        How far it is from where the motion was, m.
    clearance : float
        What the path of the tool's point keeps from the obstacles, proven along the whole path, m.
    names : tuple of str
        The obstacles that were in the way.
    """

    via: Via
    offset: float
    clearance: float
    names: tuple[str, ...]

    def describe(self) -> str:
        """Return one line for reports."""
        named = ", ".join(f"'{name}'" for name in self.names)
        return (
            f"led around {named}: {100 * self.offset:.1f} cm aside at phase {self.via.phase:.2f}, start and goal as "
            f"they were; the tool's path keeps {1e3 * self.clearance:.0f} mm"
        )

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        return {
            "phase": self.via.phase,
            "pose": np.asarray(self.via.point).tolist(),
            "reach": list(self.via.reach) if isinstance(self.via.reach, tuple) else self.via.reach,
            "offset": self.offset,
            "tool_clearance": self.clearance,
            "obstacles": list(self.names),
        }


def solve_around(
    ways: Callable[..., Solution],
    model: Led,
    arm: Arm,
    around: Surroundings,
    clear: ClearOfItself | None,
    *,
    goal: ArrayLike | None = None,
    via: Sequence[Via] = (),
) -> tuple[Solution, Detour | None]:
    """Find joints for a model that keep the whole arm off all obstacles, by a detour where that is needed.

    Parameters
    ----------
    ways : callable
        `solve` with all but `via` and `slow_down` bound.
    model : PoseDmp, PoseDmpSequence or Cycles
        Sequences and cycles are not led around.
    arm : Arm
    around : Surroundings
    clear : ClearOfItself, optional
        Judges the whole arm; without it the tool's path alone is kept clear.
    goal, via
        As of `solve`.

    Raises
    ------
    InvalidArgument
        Start or goal lie in an obstacle, or no way around was found; with the obstacle and how near it came.
    """
    solution = ways(via=via)
    if not around.obstacles:
        return solution, None
    scene = _Scene(around, base_in_root(arm))
    scene.require_ends(solution.motion.pose[:, :3, 3])
    blamed = _in_the_way(scene, clear, solution)
    if not blamed:
        return solution, None
    if not isinstance(model, PoseDmp):
        raise InvalidArgument(
            f"obstacle: '{blamed[0]}' is in the way of cycles or a sequence, which are not led around it. Move it, or "
            "the motion."
        )
    detours = list(islice(_detours(model, scene, goal, via, _worst_phase(scene, clear, solution)), _MOST_TRIED))
    for candidate, offset, accept in _attempts(detours, clear):
        vias = _in_order([*via, candidate])
        if not _is_clear(scene, clear, ways(via=vias, slow_down=False, accept=accept)):
            continue
        found = ways(via=vias)
        if _is_clear(scene, clear, found):
            kept = scene.proven(found.motion.pose[:, :3, 3])
            return found, Detour(candidate, offset, kept, blamed)
    raise InvalidArgument(_no_way(blamed, len(detours), around.margin))


def _attempts(
    detours: Sequence[tuple[Via, float]], clear: ClearOfItself | None
) -> Iterator[tuple[Via, float, ClearOfItself | None]]:
    """Yield all detours with the joints found first, then some with whatever joints keep clear, which takes longer."""
    for candidate, offset in detours:
        yield candidate, offset, None
    if clear is not None:
        few = detours[:: max(1, len(detours) // _THOROUGHLY)]
        for candidate, offset in few:
            yield candidate, offset, clear


def clear_path(
    model: Dmp | PoseDmp,
    obstacles: Sequence[Sphere | Box | Capsule | Plane],
    *,
    margin: float = OBSTACLE_MARGIN,
    goal: ArrayLike | None = None,
    via: Sequence[Via] = (),
) -> Detour | None:
    """Return a via-point with which the path of a motion keeps a margin from obstacles that stand still.

    For the point that moves alone, without an arm. Plan again where the goal moves. Pass it on as
    `model.rollout(goal, via=[detour.via])` or `run.via(detour.via.phase, detour.via.point, reach=detour.via.reach)`.

    Parameters
    ----------
    model : Dmp (3 axes) or PoseDmp
    obstacles : sequence of Sphere, Box, Capsule or Plane
        m, in the frame of the motion.
    margin : float
        m, above 0.
    goal, via
        As of `rollout`.

    Returns
    -------
    Detour or None
        None where the path is clear as it is. `clearance` is proven between the samples, too: of a segment no more than
        half its length is lost.

    Raises
    ------
    InvalidArgument
        Start or goal lie in an obstacle, or no bump of up to 50 cm will do.
    """
    named = tuple(Obstacle(f"obstacle {k}", shape) for k, shape in enumerate(obstacles))
    if not named:
        return None
    scene = _Scene(Surroundings(obstacles=named, margin=margin), np.eye(4))
    times = np.linspace(0.0, model.duration, _SAMPLES + 1)
    places = _places(model.rollout_at(times, goal, via=list(via)))
    scene.require_ends(places)
    blamed = scene.names_within(places, margin)
    if not blamed:
        return None
    phase = float(np.clip(np.argmin(scene.distances(places)) / _SAMPLES, 0.15, 0.85))
    for candidate, offset in _detours(model, scene, goal, via, phase):
        kept = scene.proven(_places(model.rollout_at(times, goal, via=_in_order([*via, candidate]))))
        if kept >= margin:
            return Detour(candidate, offset, kept, blamed)
    raise InvalidArgument(_no_way(blamed, 0, margin))


def _places(motion: Trajectory | PoseTrajectory) -> Array:
    """Return the places (T, 3) of a motion."""
    places: Array = motion.pose[:, :3, 3] if isinstance(motion, PoseTrajectory) else motion.position
    return places


def place_among(
    policy: Callable[..., Placement],
    recording: Recording,
    arm: Arm,
    clear: ClearOfItself,
    around: Surroundings,
    engine: Engine,
) -> Placement:
    """Place a motion so that the arm keeps clear of the obstacles, or, where that fails, as if there were none.

    The motion is then led around them. Raises what the policy raises.
    """
    try:
        return policy(recording, arm, accept=clear)
    except InvalidArgument:
        if not around.obstacles:
            raise
    return policy(recording, arm, accept=clear_of_itself(arm, partial(engine, obstacles=())))


def _no_way(blamed: tuple[str, ...], tried: int, margin: float) -> str:
    named = ", ".join(f"'{name}'" for name in blamed)
    how = f"none of {tried} ways around keeps the whole arm" if tried else "no bump of up to 50 cm keeps the tool"
    return (
        f"obstacle: {named} in the way, and {how} {1e3 * margin:g} mm away. Move the obstacle or the motion, or take a "
        "smaller obstacle_margin."
    )


def _in_order(vias: Sequence[Via]) -> list[Via]:
    return sorted(vias, key=lambda one: one.phase)


class _Scene:
    """The obstacles in the frame of the arm's base, and what the tool's point keeps from them."""

    def __init__(self, around: Surroundings, base: Array) -> None:
        self.margin = around.margin
        turned = np.asarray(np.linalg.inv(base), dtype=np.float64)
        self._all = [(one.name, _moved(one, turned)) for one in around.obstacles]

    def distances(self, places: Array) -> Array:
        """Return the distance of each place (N, 3) to the nearest obstacle, m."""
        found: Array = np.min([shape.distance(places) for _, shape in self._all], axis=0)
        return found

    def proven(self, places: Array) -> float:
        """Return what the whole path (T, 3) keeps at least: between two samples no more than half a step is lost."""
        distance, steps = self.distances(places), np.linalg.norm(np.diff(places, axis=0), axis=1)
        return float((0.5 * (distance[1:] + distance[:-1] - steps)).min())

    def names_within(self, places: Array, limit: float) -> tuple[str, ...]:
        return tuple(name for name, shape in self._all if shape.distance(places).min() < limit)

    def require_ends(self, places: Array) -> None:
        for end, place in (("start", places[0]), ("goal", places[-1])):
            for name, shape in self._all:
                distance = float(shape.distance(place))
                if distance < 0.0:
                    raise InvalidArgument(
                        f"obstacle: the {end} of the motion lies {-1e3 * distance:.0f} mm inside '{name}'. Move one of "
                        "them."
                    )


def _moved(obstacle: Obstacle, by: Array) -> Sphere | Box | Capsule | Plane:
    """Return a shape in the frame whose pose inverse is `by`."""
    shape = obstacle.shape

    def place(point: Array) -> Array:
        moved: Array = by[:3, :3] @ point + by[:3, 3]
        return moved

    if isinstance(shape, Sphere):
        return Sphere(place(shape.center), shape.radius)
    if isinstance(shape, Capsule):
        return Capsule(place(shape.start), place(shape.end), shape.radius)
    if isinstance(shape, Plane):
        return Plane(place(shape.point), by[:3, :3] @ shape.normal)
    return Box(by @ shape.pose, shape.half_sizes)


def _in_the_way(scene: _Scene, clear: ClearOfItself | None, solution: Solution) -> tuple[str, ...]:
    """Return the obstacles that a solution does not keep clear of; none of one that is not followed anyway.

    Joints may touch each other because those that would not come too close to an obstacle.
    """
    near = scene.names_within(solution.motion.pose[:, :3, 3], scene.margin)
    if near or clear is None or not solution.joints.report.complete:
        return near
    touched = clear.nearest_object(solution.joints.position)
    if touched:
        return (touched.clearance.other,)
    return () if clear.keeps_clear(solution.joints.position) else clear.refusing_objects()


def _is_clear(scene: _Scene, clear: ClearOfItself | None, solution: Solution) -> bool:
    if not solution.joints.report.complete or scene.names_within(solution.motion.pose[:, :3, 3], scene.margin):
        return False
    return clear is None or clear.keeps_clear(solution.joints.position)


def _worst_phase(scene: _Scene, clear: ClearOfItself | None, solution: Solution) -> float:
    """Where along the motion an obstacle is deepest in the way of the tool, or else of the arm."""
    distance = scene.distances(solution.motion.pose[:, :3, 3])
    k = float(np.argmin(distance))
    if distance.min() > scene.margin and clear is not None and solution.joints.report.complete:
        touched = clear.nearest_object(solution.joints.position)
        k = touched.sample if touched else k
    return float(np.clip(k / (len(distance) - 1), 0.15, 0.85))  # samples are even in phase, whatever the tempo


def _detours(
    model: Dmp | PoseDmp, scene: _Scene, goal: ArrayLike | None, via: Sequence[Via], phase: float
) -> Iterator[tuple[Via, float]]:
    """Yield bumps with which the tool's path is clear, the smallest first."""
    while any(abs(one.phase - phase) < 0.02 for one in via):
        phase += 0.03
    times = np.linspace(0.0, model.duration, _SAMPLES + 1)
    path = model.rollout_at(times, goal, via=list(via))
    places = _places(path)
    pose = np.array((path.pose if isinstance(path, PoseTrajectory) else path.position)[round(phase * _SAMPLES)])
    across = _across(places, round(phase * _SAMPLES))
    bumps = [(reach, *_bump(model, times, goal, via, phase, pose, reach)) for reach in _REACHES]
    for size in _SIZES:
        yielded: list[Array] = []
        for _, reach, bump in bumps:
            kept = np.array([scene.proven(places + size * bump[:, None] * way) for way in across])
            for k in np.argsort(-kept):
                is_new = all(float(across[k] @ other) < _APART for other in yielded)
                if kept[k] > scene.margin + _SPARE and is_new and len(yielded) < _OF_A_SIZE:
                    yielded.append(across[k])
                    yield Via(phase, _aside(pose, size * across[k]), reach=reach), float(size)


def _bump(
    model: Dmp | PoseDmp,
    times: Array,
    goal: ArrayLike | None,
    via: Sequence[Via],
    phase: float,
    pose: Array,
    reach: float,
) -> tuple[tuple[float, float], Array]:
    """Return a reach as it fits in, and the share (T,) of a displacement that the path takes from it."""
    fitting = (min(reach, phase), min(reach, 1.0 - phase))
    small, aside = 1e-3, np.array([1.0, 0.0, 0.0])
    plain, moved = (
        model.rollout_at(times, goal, via=_in_order([*via, Via(phase, _aside(pose, by * aside), reach=fitting)]))
        for by in (0.0, small)
    )
    share: Array = (_places(moved)[:, 0] - _places(plain)[:, 0]) / small
    return fitting, share


def _aside(pose: Array, by: Array) -> Array:
    """Return a place (3,) or pose (4, 4) that is moved."""
    moved = pose.copy()
    place = moved if pose.ndim == 1 else moved[:3, 3]
    place += by
    return moved


def _across(places: Array, k: int) -> Array:
    """Return unit directions (24, 3) across a path at its k-th place."""
    along = places[min(k + 1, len(places) - 1)] - places[max(k - 1, 0)]
    length = float(np.linalg.norm(along))
    along = along / length if length > 1e-9 else np.array([1.0, 0.0, 0.0])
    up = np.array([0.0, 0.0, 1.0])
    first = up - float(along @ up) * along
    if np.linalg.norm(first) < 0.1:
        first = np.array([1.0, 0.0, 0.0]) - float(along[0]) * along
    first /= np.linalg.norm(first)
    second = np.cross(along, first)
    angles = np.linspace(0.0, 2.0 * np.pi, _DIRECTIONS, endpoint=False)
    directions: Array = np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second
    return directions
