"""A motion hung up at one point: its start, its goal, or the shoulder of the person who made it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp import motion
from dmpcpp._core import Arm, InverseKinematics
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings.recording import Array, Recording
from dmpcpp.retarget.placement import Placement

__all__ = ["Reach", "anchor", "anchor_within_reach", "reach"]

Anchor = Literal["start", "goal"]

_COARSE = 40  # poses that stand for the motion while candidates are compared
_YAWS = 24
_TOOLS = 24  # random tool rotations, where none is given


@dataclass(frozen=True)
class Reach:
    """How much of a motion an arm can take up, pose by pose, within its joint limits.

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
    scale: Sequence[float] = (1.0, 0.75, 0.5, 0.35, 0.25),
    seed: int = 0,
) -> Placement:
    """Search the yaw, scale and, for a point, tool rotation with which the arm reaches most of an anchored motion.

    24 yaws, the given scales and 24 random tool rotations are tried; among equals the largest scale wins. The share
    of the poses that are reached within the joint limits stands in the placement's note. `place` searches the
    position too, and joints for the whole path.

    Parameters
    ----------
    recording, at, on
        As in `anchor`.
    arm : Arm
    scale : sequence of float
        Those to try.
    seed : int
        Of the random tool rotations.

    Raises
    ------
    InvalidArgument
        What `anchor` refuses, or no scale to try.
    """
    if len(scale) == 0:
        raise InvalidArgument("scale: none, expected at least one to try.")
    few = np.unique(np.linspace(0, len(recording) - 1, _COARSE).round().astype(int))
    poses = motion.poses(recording)
    solver = InverseKinematics(arm, iteration_limit=150, diagnose=False)
    best: tuple[int, float] | None = None
    for placement in _candidates(recording, at, on, sorted(scale, reverse=True), np.random.default_rng(seed)):
        solved = solver.solve_many(placement.apply(poses[few])).solved
        if best is None or (solved, placement.scale) > best:
            best, found = (solved, placement.scale), placement
        if best == (len(few), max(scale)):
            break
    return replace(found, note=reach(found, recording, arm).describe())


def reach(placement: Placement, recording: Recording, arm: Arm) -> Reach:
    """Return how many of a placed motion's poses an arm can take up within its joint limits, each by itself."""
    batch = InverseKinematics(arm).solve_many(placement.apply(motion.poses(recording)))
    missed = [k for k, status in enumerate(batch.status) if status.name != "ok"]
    return Reach(batch.solved, len(recording), missed[0] if missed else None)


def _sample(on: Anchor | ArrayLike) -> int | None:
    if not isinstance(on, str):
        return None
    if on not in ("start", "goal"):
        raise InvalidArgument(f"on: {on!r}, expected 'start', 'goal' or a point (3,).")
    return 0 if on == "start" else -1


def _candidates(
    recording: Recording, at: ArrayLike, on: Anchor | ArrayLike, scales: list[float], random: np.random.Generator
) -> Iterator[Placement]:
    tools: list[Array | None] = [None]
    if np.ndim(at) == 1:
        tools = list(Rotation.from_quat(random.normal(size=(_TOOLS, 4))).as_matrix())
    yaws = np.linspace(-np.pi, np.pi, _YAWS, endpoint=False)
    for scale, tool, yaw in product(scales, tools, yaws):
        yield anchor(recording, at, on=on, scale=scale, yaw=float(yaw), tool_rotation=tool)
