"""Two hands that hold one thing, as one primitive: the pose of what they hold, and of one hand seen from the other.

The thing's origin lies half way between the hands, and it turns with the left one. Its motion takes new starts, goals
and tempi; the pose of the right hand seen from the left one goes with the phase alone, so that the grasp stays as it
was shown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp import motion
from dmpcpp._core import PoseDemonstration, PoseDmp, PoseRun, Via, load, save
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings import Recording

__all__ = ["TwoHands", "TwoHandsMotion", "TwoHandsRun", "hands", "held", "load_two_hands"]

_HELD, _RELATIVE = "held.json", "relative.json"


def held(left: Array, right: Array) -> Array:
    """Return poses (.., 4, 4) of what two hands (.., 4, 4) hold."""
    thing = np.array(left, dtype=np.float64)
    thing[..., :3, 3] = (np.asarray(left)[..., :3, 3] + np.asarray(right)[..., :3, 3]) / 2
    return thing


def hands(thing: Array, relative: Array) -> tuple[Array, Array]:
    """Return the poses (.., 4, 4) of the left and the right hand, from those of what they hold.

    Parameters
    ----------
    thing : (.., 4, 4)
        As of `held`.
    relative : (.., 4, 4)
        The right hand seen from the left one.
    """
    left = np.array(thing, dtype=np.float64)
    half = np.einsum("...ij,...j->...i", left[..., :3, :3], np.asarray(relative)[..., :3, 3]) / 2
    left[..., :3, 3] -= half
    return left, left @ relative


@dataclass(frozen=True, eq=False)
class TwoHandsMotion:
    """Both hands over time.

    Attributes
    ----------
    time : (T,) s
    left, right : (T, 4, 4)
        Body to world, m.
    held : (T, 4, 4)
        What they hold.
    """

    time: Array
    left: Array
    right: Array
    held: Array


@dataclass(frozen=True, eq=False)
class TwoHands:
    """A primitive of two hands.

    Attributes
    ----------
    held : PoseDmp
        The motion of what they hold: its start and goal are those of the motion.
    relative : PoseDmp
        The right hand seen from the left one, over the same phase.
    """

    held: PoseDmp
    relative: PoseDmp

    @classmethod
    def fit(cls, left: PoseDemonstration, right: PoseDemonstration, **options: Any) -> TwoHands:
        """Learn both hands of one performance.

        Parameters
        ----------
        left, right : PoseDemonstration
            In one frame, at the same times.
        **options
            As `PoseDmp.fit` takes them.

        Raises
        ------
        InvalidArgument
            Recorded at other times, or as of `PoseDmp.fit`.
        """
        if not np.array_equal(left.time, right.time):
            raise InvalidArgument("right: recorded at other times than left, expected the same for both.")
        seen = np.linalg.inv(left.pose) @ right.pose
        return cls(
            PoseDmp.fit(PoseDemonstration(left.time, held(left.pose, right.pose)), **options),
            PoseDmp.fit(PoseDemonstration(left.time, seen), **options),
        )

    @classmethod
    def from_recordings(cls, left: Recording, right: Recording, **options: Any) -> TwoHands:
        """Learn both hands of one recording, as long as both were seen; parameters as of `fit`.

        The samples of the right hand are taken at the times of the left one: both count from 0, one clock.
        """
        when = left.time[left.time <= right.time[-1]]
        if len(when) < 3:
            raise InvalidArgument(
                f"right: recorded for {right.time[-1]:g} s, of which the left hand has {len(when)} samples, expected 3 "
                "or more."
            )
        poses = (_sampled(motion.demonstration(one), when) for one in (left, right))
        return cls.fit(*(PoseDemonstration(when, each) for each in poses), **options)

    @property
    def duration(self) -> float:
        """Of the demonstration, s."""
        return self.held.duration

    def rollout(
        self,
        goal: Array | None = None,
        duration: float | None = None,
        dt: float = 1e-3,
        via: Sequence[Via] = (),
    ) -> TwoHandsMotion:
        """Return the motion to a goal of what is held, shaped as of `PoseDmp.rollout`; `via` are poses of it, too."""
        moved = self.held.rollout(goal, duration, dt, via=list(via))
        return self._of(moved.time, moved.pose, self.relative.rollout_at(moved.time, duration=duration).pose)

    def _of(self, time: Array, thing: Array, relative: Array) -> TwoHandsMotion:
        return TwoHandsMotion(time, *hands(thing, relative), thing)

    def save(self, folder: str | Path) -> None:
        """Write both models into a folder, as held.json and relative.json."""
        Path(folder).mkdir(parents=True, exist_ok=True)
        save(self.held, Path(folder) / _HELD)
        save(self.relative, Path(folder) / _RELATIVE)


def load_two_hands(folder: str | Path) -> TwoHands:
    """Return what `TwoHands.save` wrote.

    Raises
    ------
    InvalidArgument
        A file that holds another kind of model, or two that do not last equally long.
    """
    models = [load(Path(folder) / name) for name in (_HELD, _RELATIVE)]
    for name, model in zip((_HELD, _RELATIVE), models, strict=True):
        if not isinstance(model, PoseDmp):
            raise InvalidArgument(f"{Path(folder) / name}: a {type(model).__name__}, expected a PoseDmp.")
    if models[0].duration != models[1].duration:
        raise InvalidArgument(f"{folder}: held and relative are of different durations, expected those of one fit.")
    return TwoHands(*models)


class TwoHandsRun:
    """One run of two hands, for one control loop: goals, via-points and joins are those of `held`.

    Parameters
    ----------
    model : TwoHands

    Attributes
    ----------
    held : PoseRun
        Of what the hands hold; set its goal, duration, via-points and tracking error.
    """

    def __init__(self, model: TwoHands) -> None:
        """Begin at the start."""
        self.held = PoseRun(model.held)
        self._relative = PoseRun(model.relative)

    def step(self, dt: float) -> bool:
        """Move on by dt s; True while the motion runs. The grasp keeps the phase of what is held."""
        before = self.held.phase
        runs = self.held.step(dt)
        ahead = self.held.phase - before
        if ahead > 0:
            self._relative.step(ahead * self._relative.duration)
        return bool(runs)

    @property
    def left(self) -> Array:
        """(4, 4)"""
        return hands(self.held.pose, self._relative.pose)[0]

    @property
    def right(self) -> Array:
        """(4, 4)"""
        return hands(self.held.pose, self._relative.pose)[1]


def _sampled(demonstration: PoseDemonstration, when: Array) -> Array:
    poses = np.tile(np.eye(4), (len(when), 1, 1))
    poses[:, :3, 3] = demonstration.position.at(when).position
    poses[:, :3, :3] = demonstration.orientation.at(when).rotation
    return poses
