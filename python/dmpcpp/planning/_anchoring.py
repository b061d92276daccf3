"""Placement anchored at the start, the goal or the shoulder."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp import motion
from dmpcpp._core import Arm, InverseKinematics
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._placement import EFFORT, Accept, Placement, to_follow
from dmpcpp.recordings import Recording
from dmpcpp.robot import POSE, Follow, following, require_within_reach

__all__ = ["Reach", "anchor", "anchor_within_reach", "reach"]

Anchor = Literal["start", "goal"]

_COARSE = 40  # poses that stand for the motion while candidates are compared
_SCALES = 5
_YAWS = 24
_TOOLS = 24  # random tool rotations, where none is given
_FOLLOWED = 8  # candidates of one scale that are followed from end to end at most
_FEW = 5  # every fifth of the coarse poses is looked at first: most candidates miss one of them


@dataclass(frozen=True)
class Reach:
    """Poses of a motion the arm reaches within joint limits, each solved on its own.

    Attributes
    ----------
    solved, total : int
        Poses.
    first_missed : int or None
        The first that is not reached.
    """

    solved: int
    total: int
    first_missed: int | None

    @property
    def share(self) -> float:
        """0 to 1."""
        return self.solved / self.total

    def describe(self) -> str:
        """For reports."""
        missed = "" if self.first_missed is None else f", the first that is not: {self.first_missed}"
        return f"{self.solved} of {self.total} poses ({100 * self.share:.1f} %) within reach and joint limits{missed}"


def anchor(
    recording: Recording,
    at: ArrayLike,
    *,
    on: Anchor | ArrayLike = "start",
    scale: float = 1.0,
    yaw: float = 0.0,
    tool_rotation: ArrayLike | None = None,
) -> Placement:
    """Place a motion so that one of its points comes to lie at a given place of the robot.

    Parameters
    ----------
    recording : Recording
        Its up axis stays up; z where it has none.
    at : array_like (3,) or (4, 4)
        Where the anchor comes to lie in the robot's base frame, m. With a pose the tool's orientation at the start
        (or goal) is met too: it sets the tool rotation.
    on : "start", "goal", or array_like (3,)
        The anchor: where the motion begins or ends, or a point of the recording's world, m: the shoulder, say, for
        which `at` is that of the robot and `scale` the ratio of the arms' lengths.
    scale : float
        Of positions about the anchor, above 0.
    yaw : float
        rad, about the robot's z axis.
    tool_rotation : array_like (3, 3), optional
        Rotation of the robot's tool in the frame of the recorded body; none unless given.

    Raises
    ------
    InvalidArgument
        A pose with an anchor that has no orientation, a pose together with a tool rotation, or what `Placement`
        refuses.
    """
    motion.complete(recording)
    at = np.asarray(at, dtype=np.float64)
    if at.shape not in ((3,), (4, 4)):
        raise InvalidArgument(f"at: shape {at.shape}, expected (3,) or (4, 4).")
    sample = _sample(on)
    centre = np.asarray(on, dtype=np.float64) if sample is None else recording.position[sample]
    placement = Placement(
        at if at.ndim == 1 else at[:3, 3], yaw=yaw, scale=scale, up_axis=recording.up_axis or "z", centre=centre
    )
    if at.ndim == 1:
        return placement if tool_rotation is None else replace(placement, tool_rotation=np.asarray(tool_rotation))
    if sample is None or tool_rotation is not None:
        raise InvalidArgument("at: a pose, expected a point (3,): the orientation is not that of a start or goal.")
    return replace(placement, tool_rotation=(placement.rotation @ recording.rotation[sample]).T @ at[:3, :3])


def anchor_within_reach(
    recording: Recording,
    arm: Arm,
    at: ArrayLike,
    *,
    on: Anchor | ArrayLike = "start",
    scale: tuple[float, float] = (0.25, 1.0),
    yaw: float | None = None,
    tool_rotation: ArrayLike | None = None,
    seed: int = 0,
    accept: Accept | None = None,
    follow: str | Follow | None = None,
) -> Placement:
    """Search the scale, yaw and, for a point, tool rotation with which an arm carries out an anchored motion.

    Five scales, 24 yaws and 24 random tool rotations are tried, less what is given. The largest whose path the arm can
    follow from end to end is taken; else the one of whose poses it reaches most. The share of the poses that are
    reached within the joint limits, each by itself, stands in the placement's note. If none can be followed, `start`
    is None; nothing is raised.

    Parameters
    ----------
    recording, at, on
        As in `anchor`.
    arm : Arm
    scale : (float, float)
        Smallest and largest scale of positions about the anchor.
    yaw : float, optional
        rad; searched unless given.
    tool_rotation : array_like (3, 3), optional
        Searched unless given, or set by a pose.
    seed : int
        Of the random tool rotations and of the order.
    accept : JointTrajectory -> bool, optional
        As in `place`.
    follow : str, optional
        As in `place`.

    Raises
    ------
    InvalidArgument
        What `anchor` refuses, a range of scale that is empty, or a start or goal farther away than the arm is long.
    """
    if not 0.0 < scale[0] <= scale[1] < np.inf:
        raise InvalidArgument(f"scale: {scale}, expected (smallest, largest) with 0 < smallest <= largest.")
    _within_length(arm, at, on)
    scales = np.geomspace(scale[1], scale[0], _SCALES).tolist() if scale[0] < scale[1] else [scale[0]]
    turns = _turns(at, yaw, tool_rotation, np.random.default_rng(seed))
    candidates = _candidates(recording, at, on, scales, turns)
    followed = following(arm, follow)
    found = _carried(candidates, recording, arm, accept, followed)
    note = reach(found, recording, arm, followed).describe()
    if found.start is None:
        note += "; no candidate could be followed from end to end"
    return replace(found, note=note)


def reach(placement: Placement, recording: Recording, arm: Arm, follow: Follow = POSE) -> Reach:
    """Return how many of a placed motion's poses an arm can take up within its joint limits, each by itself."""
    batch = InverseKinematics(arm, weight=follow.weight).solve_many(placement.apply(motion.poses(recording)))
    missed = [k for k, status in enumerate(batch.status) if status.name != "ok"]
    return Reach(batch.solved, len(recording), missed[0] if missed else None)


def _sample(on: Anchor | ArrayLike) -> int | None:
    if not isinstance(on, str):
        return None
    if on not in ("start", "goal"):
        raise InvalidArgument(f"on: {on!r}, expected 'start', 'goal' or a point (3,).")
    return 0 if on == "start" else -1


def _within_length(arm: Arm, at: ArrayLike, on: Anchor | ArrayLike) -> None:
    """Refuse a start or goal that no joints bring the tip to: searching it would take minutes."""
    if not isinstance(on, str):
        return  # a shoulder is not a place of the tip
    at = np.asarray(at, dtype=np.float64)
    point = at[:3, 3] if at.shape == (4, 4) else at
    if point.shape != (3,):
        return  # which `anchor` names
    require_within_reach(point, arm, f"at: the {on} of the motion")


def _candidates(
    recording: Recording,
    at: ArrayLike,
    on: Anchor | ArrayLike,
    scales: list[float],
    turns: list[tuple[ArrayLike | None, float]],
) -> Iterator[Placement]:
    """Yield what is to be tried, the largest first."""
    for size, (tool, yaw) in product(scales, turns):
        yield anchor(recording, at, on=on, scale=size, yaw=yaw, tool_rotation=tool)


def _turns(
    at: ArrayLike, yaw: float | None, tool: ArrayLike | None, random: np.random.Generator
) -> list[tuple[ArrayLike | None, float]]:
    """Return the tool rotations and yaws to try, in an order in which neighbours differ."""
    yaws = np.linspace(-np.pi, np.pi, _YAWS, endpoint=False).tolist() if yaw is None else [yaw]
    tools: list[ArrayLike | None] = [tool]
    if tool is None and np.ndim(at) == 1:  # a pose sets it
        tools = list(Rotation.from_quat(random.normal(size=(_TOOLS, 4))).as_matrix())
    turns = list(product(tools, yaws))
    return [turns[k] for k in random.permutation(len(turns))]


def _carried(
    candidates: Iterator[Placement], recording: Recording, arm: Arm, accept: Accept | None, follow: Follow
) -> Placement:
    """Return the first that the arm follows from end to end, with its first joints; else the first of those with most
    poses within reach.
    """
    coarse = np.unique(np.linspace(0, len(recording) - 1, _COARSE).round().astype(int))
    poses = motion.poses(recording)[coarse]
    path = to_follow(recording)
    quick = InverseKinematics(arm, weight=follow.weight, iteration_limit=150, diagnose=False)
    most, followed = -1, Counter[float]()
    for placement in candidates:
        if followed[placement.scale] == _FOLLOWED:
            continue
        solved = _solved(placement.apply(poses), quick)
        if solved > most:
            most, best = solved, placement
        if solved == len(poses):
            start = _start(placement, path, arm, accept, follow)
            if start is not None:
                return replace(placement, start=start)
            followed[placement.scale] += 1
    return best


def _solved(poses: Array, quick: InverseKinematics) -> int:
    """Return how many of the poses are solved: of a few, and of the others if these all are."""
    few = np.arange(len(poses)) % _FEW == 0
    solved = quick.solve_many(poses[few]).solved
    return solved if solved < few.sum() else solved + quick.solve_many(poses[~few]).solved


def _start(placement: Placement, path: Recording, arm: Arm, accept: Accept | None, follow: Follow) -> Array | None:
    """Search joints at the first pose from which the whole path can be followed, to what `accept` accepts."""
    solver = InverseKinematics(arm, weight=follow.weight)
    joints = solver.follow(placement.apply(motion.poses(path)), times=path.time, **EFFORT)
    carried = joints.report.complete and (accept is None or accept(joints))
    return joints.position[0] if carried else None
