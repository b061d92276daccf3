"""How much of an arm's joint limits a motion uses, and the checks of it: for plans, executions, logs and the page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Series

__all__ = ["LimitUse"]


@dataclass(frozen=True, eq=False)
class LimitUse:
    """What a motion uses of the limits, sample by sample and joint by joint.

    Attributes
    ----------
    names : tuple of str
        Of the joints.
    time : (T,)
        s
    margin : (T, n)
        rad (m of a sliding joint), to the nearer position limit; negative outside.
    velocity, acceleration : (T, n)
        Shares of the limits, 1 on them. Of accelerations there may be fewer samples: the last ones of `time`.
    """

    names: tuple[str, ...]
    time: Array
    margin: Array
    velocity: Array
    acceleration: Array

    @staticmethod
    def of(arm: Arm, time: Array, position: Array, velocity: Array, acceleration: Array) -> LimitUse:
        """Hold joints (T, n) and their derivatives against the limits of an arm."""
        return LimitUse(
            tuple(arm.joint_names),
            time,
            np.minimum(position - arm.lower, arm.upper - position),
            np.abs(velocity) / arm.velocity_limit,
            np.abs(acceleration) / arm.acceleration_limit,
        )

    @property
    def within(self) -> bool:
        """Whether every sample holds every limit."""
        return bool(self.margin.min() >= 0.0 and max(self.velocity.max(), self.acceleration.max()) <= 1.0)

    def checks(self, margin: float = 0.0, velocity: float = 1.0, acceleration: float = 1.0) -> Iterator[Check]:
        """Yield joint_margin, velocity_ratio and acceleration_ratio, held against the least and the most allowed."""
        yield Series(self.time, self.margin, self.names).at_least("joint_margin", margin, "rad")
        yield Series(self.time, self.velocity, self.names).at_most("velocity_ratio", velocity, "1")
        since = len(self.time) - len(self.acceleration)
        yield Series(self.time[since:], self.acceleration, self.names).at_most("acceleration_ratio", acceleration, "1")
