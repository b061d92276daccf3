"""How much of an arm's joint limits a motion uses, and the checks of it: for plans, executions, logs and the page."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Series
from dmpcpp.robot._plausible_limits import LimitDoubt, limit_doubts, why

__all__ = ["LimitUse", "judged_by_limits"]


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
    doubts : tuple of LimitDoubt
        Limits that are missing or that no arm has: by them nothing is judged.
    """

    names: tuple[str, ...]
    time: Array
    margin: Array
    velocity: Array
    acceleration: Array
    doubts: tuple[LimitDoubt, ...] = ()

    @staticmethod
    def of(arm: Arm, time: Array, position: Array, velocity: Array, acceleration: Array) -> LimitUse:
        """Hold joints (T, n) and their derivatives against the limits of an arm."""
        return LimitUse(
            tuple(arm.joint_names),
            time,
            np.minimum(position - arm.lower, arm.upper - position),
            np.abs(velocity) / arm.velocity_limit,
            np.abs(acceleration) / arm.acceleration_limit,
            limit_doubts(arm),
        )

    @property
    def within(self) -> bool:
        """Whether every sample holds every limit."""
        return bool(self.margin.min() >= 0.0 and max(self.velocity.max(), self.acceleration.max()) <= 1.0)

    def checks(self, margin: float = 0.0, velocity: float = 1.0, acceleration: float = 1.0) -> Iterator[Check]:
        """Yield joint_margin, velocity_ratio and acceleration_ratio, held against the least and the most allowed."""
        used = Series(self.time, self.margin, self.names)
        yield judged_by_limits(used, self.doubts_of("position"), lambda s: s.at_least("joint_margin", margin, "rad"))
        since = len(self.time) - len(self.acceleration)
        for kind, time, values, limit in (
            ("velocity", self.time, self.velocity, velocity),
            ("acceleration", self.time[since:], self.acceleration, acceleration),
        ):
            used = Series(time, values, self.names)
            yield judged_by_limits(used, self.doubts_of(kind), _at_most(f"{kind}_ratio", limit))

    def doubts_of(self, kind: str) -> tuple[LimitDoubt, ...]:
        """Return the doubts of one kind of limit."""
        return tuple(doubt for doubt in self.doubts if doubt.kind == kind)


def judged_by_limits(used: Series, doubts: tuple[LimitDoubt, ...], hold: Callable[[Series], Check]) -> Check:
    """Hold the joints whose limits are known against them; where all of these hold, the others are not judged."""
    check = hold(used)
    if not doubts:
        return check
    unknown = {doubt.joint for doubt in doubts}
    known = [k for k, name in enumerate(used.where) if name not in unknown]
    if known:
        of_known = hold(Series(used.time, used.values[:, known], tuple(used.where[k] for k in known)))
        if not of_known.ok:
            return of_known
    return Check.not_judged(check.name, check.unit, why(doubts))


def _at_most(name: str, limit: float) -> Callable[[Series], Check]:
    return lambda series: series.at_most(name, limit, "1")
