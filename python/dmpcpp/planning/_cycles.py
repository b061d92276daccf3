"""A rhythmic motion for a number of cycles, from rest to rest on its own path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp._core import DmpOptions, Motion, PoseDmp, PoseTrajectory, Via
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["Cycles"]

_MOST = 1000
_RAMP = 1.0  # periods in which the tempo rises, and falls


@dataclass(frozen=True, eq=False)
class Cycles:
    """What a plan leads like a model: a rhythmic one, round and round, its tempo rising from rest and falling to it.

    The path is that of the cycle from the first sample to the last; only the tempo differs, by a smooth ramp of one
    period at each end (velocity and acceleration are 0 at both).

    Attributes
    ----------
    model : PoseDmp
        With `Motion.rhythmic`.
    count : int
        Cycles, 2 to 1000.
    """

    model: PoseDmp
    count: int

    def __post_init__(self) -> None:
        """Refuse what does not go round."""
        if self.model.options.motion != Motion.rhythmic:
            raise InvalidArgument('model: a discrete one, expected one learned with motion="rhythmic".')
        if not 2 <= self.count <= _MOST:
            raise InvalidArgument(f"count: {self.count}, expected 2 to {_MOST} cycles.")

    @property
    def duration(self) -> float:
        """Seconds of the whole at the demonstrated tempo: a period more than the cycles take, for both ramps."""
        return (self.count + _RAMP) * self.model.duration

    @property
    def options(self) -> DmpOptions:
        """Those of the model."""
        return self.model.options

    @property
    def start(self) -> Array:
        """Pose (4, 4) where it begins and ends."""
        return self.model.start

    @property
    def goal(self) -> Array:
        """The centre, (4, 4)."""
        return self.model.goal

    def rollout(
        self, goal: ArrayLike | None = None, duration: float | None = None, dt: float = 1e-3, via: Sequence[Via] = ()
    ) -> PoseTrajectory:
        """Return the motion at 0, dt, ... up to the duration; `goal` is where the centre comes to lie.

        Raises
        ------
        InvalidArgument
            Via-points, which belong to runs of a rhythmic model, or what `PoseDmp.rollout_at` refuses.
        """
        if via:
            raise InvalidArgument("via: a rhythmic motion passes via-points in a run (PoseRun.via), not in a plan.")
        whole = self.duration if duration is None else duration
        if not 0.0 < dt <= whole < np.inf:
            raise InvalidArgument(f"duration: {whole}, dt: {dt}, expected positive times, dt the smaller one.")
        time = dt * np.arange(int(np.floor(whole / dt + 1e-6)) + 1)
        phase, rate, change = self._tempo(time / whole)
        rate, change = rate / whole, change / whole**2
        period = self.model.duration
        moved = self.model.rollout_at(phase * period, goal)
        twist = moved.twist * period
        faster = moved.acceleration * (period * rate[:, None]) ** 2 + twist * change[:, None]
        made = PoseTrajectory.__new__(PoseTrajectory)
        made.__setstate__((time, moved.pose, twist * rate[:, None], faster))
        return made

    def _tempo(self, u: Array) -> tuple[Array, Array, Array]:
        """Return phase, rate and second derivative over the share of the whole, 0 to 1."""
        ramp = _RAMP / (self.count + _RAMP)
        fast = float(self.count + _RAMP)
        # v = w^3 (10 - 15 w + 6 w^2) rises from 0 to 1; its integral is w^4 (2.5 - 3 w + w^2), 0.5 at the end.
        early, late = np.minimum(u / ramp, 1.0), np.minimum((1.0 - u) / ramp, 1.0)
        gone = ramp * early**4 * (2.5 - 3.0 * early + early**2) + np.maximum(u - ramp, 0.0)
        gone = np.where(u > 1.0 - ramp, 1.0 - ramp - ramp * late**4 * (2.5 - 3.0 * late + late**2), gone)
        near = np.where(u > 0.5, late, early)
        rate = near**3 * (10.0 - 15.0 * near + 6.0 * near**2)
        change = 30.0 * near**2 * (1.0 - near) ** 2 / ramp * np.where(u > 0.5, -1.0, 1.0)
        return fast * np.maximum.accumulate(gone), fast * rate, fast * change
