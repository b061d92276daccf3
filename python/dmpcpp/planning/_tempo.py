"""At what tempo a motion is carried out: the person's, slower only where limits bind; slower evenly; or the fastest."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

import numpy as np

from dmpcpp._core import (
    Arm,
    Demand,
    JointTrajectory,
    Pace,
    largest_demand,
    paced,
    stretched,
    time_optimal,
)
from dmpcpp._typing import Array
from dmpcpp.checks import Check
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._bound import Bound

__all__ = [
    "POLICIES",
    "RESERVE",
    "Tempo",
    "TempoPolicy",
    "demand_of",
    "held_effort",
    "on_pace",
    "paced_slowdown",
    "taken_policy",
    "tempo_check",
]

TempoPolicy = Literal["person", "uniform", "fastest"]
"""person: the recorded timing, slower only where limits bind; uniform: slower by one factor; fastest: as fast as the
limits allow, from rest to rest, the person's rhythm lost."""

POLICIES: tuple[TempoPolicy, ...] = get_args(TempoPolicy)
RESERVE = 1.02  # on the duration that the joint limits ask for: the feedback needs some of them
_EFFORT_RESERVE = 0.995  # of the share of the effort limits: an engine's inverse dynamics differ a little
_MOST = 10.0  # times slower than the person; beyond that a check fails unless another limit is stated
_KEPT = 1.05  # slowdown up to which the person's tempo is kept


@dataclass(frozen=True, eq=False)
class Tempo:
    """How a motion's time compares with the time that was wanted for it.

    Attributes
    ----------
    policy : "person", "uniform" or "fastest"
    wanted : (T,)
        s, of each sample: the person's time, or the one asked for.
    pace : Pace
        When each sample is carried out [s], how much slower than wanted, and how quickly that changes.
    demand : Demand or None
        The joint, limit and time [s, wanted] that ask most; None where nothing was looked at.
    bound : Bound or None
        What no method could be faster than with this arm; None where the motion needs no slowing down.
    """

    policy: TempoPolicy
    wanted: Array
    pace: Pace
    demand: Demand | None = None
    bound: Bound | None = None

    @staticmethod
    def unchanged(wanted: Array, policy: TempoPolicy = "person", demand: Demand | None = None) -> Tempo:
        """Return the tempo that was wanted."""
        return Tempo.even(wanted, 1.0, policy, demand)

    @staticmethod
    def even(wanted: Array, factor: float, policy: TempoPolicy, demand: Demand | None) -> Tempo:
        """Return one factor for the whole motion."""
        time = wanted[0] + factor * (wanted - wanted[0])
        return Tempo(policy, wanted, Pace(time, np.full(len(time), factor), np.zeros(len(time))), demand)

    @property
    def slowdown(self) -> float:
        """Duration over the one that was wanted."""
        span = float(self.wanted[-1] - self.wanted[0])
        return float(self.pace.time[-1] - self.pace.time[0]) / span if span > 0.0 else 1.0

    @property
    def peak(self) -> float:
        """The largest slowdown of any moment."""
        return float(self.pace.slowdown.max())

    @property
    def peak_time(self) -> float:
        """s, wanted: when the slowdown is largest."""
        return float(self.wanted[int(np.argmax(self.pace.slowdown))])

    @property
    def kept(self) -> float:
        """Share of the wanted time that is carried out at that tempo, within 5 %."""
        steps = np.diff(self.wanted)
        slow = np.maximum(self.pace.slowdown[1:], self.pace.slowdown[:-1]) > _KEPT
        return float(1.0 - steps[slow].sum() / steps.sum()) if len(steps) else 1.0

    def when(self, time: Array) -> Array:
        """Return when moments [s] of the wanted time are carried out [s]."""
        return np.interp(time, self.wanted, self.pace.time)

    def stretched(self, factor: float) -> Tempo:
        """Return this tempo, slower by one factor."""
        time = self.pace.time[0] + factor * (self.pace.time - self.pace.time[0])
        return replace(self, pace=Pace(time, factor * self.pace.slowdown, self.pace.rate))

    def decided_by(self, names: tuple[str, ...] | list[str]) -> str:
        """Return "velocity of 'joint4' at 0.25 s", the limit that asks most; "" where none was looked at."""
        found = self.demand
        if found is None or found.factor == 0.0:
            return ""
        what = found.limit.name.replace("_", " ")
        who = f" of '{names[found.joint]}'" if found.joint >= 0 else ""
        return f"{what}{who} at {found.time:.2f} s"

    def describe(self, names: tuple[str, ...] | list[str], whose: str = "the person's") -> str:
        """Return one sentence for the verdict."""
        if max(self.slowdown, self.peak) <= 1.0 + 1e-9:
            return f"Carried out at {whose} tempo."
        decided = self.decided_by(names)
        because = f"; {decided} decides" if decided else ""
        slowest = ""
        if self.policy == "person" and self.peak > 1.01 * self.slowdown:
            slowest = f", at its slowest at {1.0 / self.peak:.2f} of it ({self.peak_time:.2f} s)"
        bound = f"; the arm's own bound is {1.0 / self.bound.local:.2f}" if self.bound else ""
        return f"Carried out at {1.0 / self.slowdown:.2f} of {whose} tempo{slowest}{because}{bound}."

    def to_dict(self, names: tuple[str, ...] | list[str]) -> dict[str, Any]:
        """For JSON; s."""
        found = self.demand
        return {
            "policy": self.policy,
            "slowdown": self.slowdown,
            "peak": self.peak,
            "peak_time": self.peak_time,
            "kept": self.kept,
            "bound": self.bound.to_dict() if self.bound else None,
            "decided_by": None
            if found is None or found.factor == 0.0
            else {
                "limit": found.limit.name,
                "joint": names[found.joint] if found.joint >= 0 else None,
                "time": found.time,
                "uniform_factor": found.factor,
            },
        }


def taken_policy(tempo: str) -> TempoPolicy:
    """Return one of the policies.

    Raises
    ------
    InvalidArgument
        Another word.
    """
    for policy in POLICIES:
        if policy == tempo:
            return policy
    raise InvalidArgument(f"tempo: {tempo!r}, expected one of {', '.join(POLICIES)}.")


def tempo_check(tempo: Tempo, slowest: float | None) -> tuple[Check, ...]:
    """Return the check "slowdown": against `slowest` where that is stated, else only of a motion ten times as slow.

    Raises
    ------
    InvalidArgument
        `slowest` is not a number of at least 1.
    """
    if slowest is not None and not 1.0 <= slowest < np.inf:
        raise InvalidArgument(f"slowest: {slowest}, expected a factor on the duration of at least 1.")
    limit = _MOST if slowest is None else slowest
    if slowest is None and tempo.slowdown <= limit:
        return ()
    ok = tempo.slowdown <= limit * (1.0 + 1e-9)
    return (Check("slowdown", ok, tempo.slowdown, limit, "1", float(tempo.when(np.array(tempo.peak_time)))),)


def on_pace(
    arm: Arm, joints: JointTrajectory, policy: TempoPolicy, torque_share: float | None
) -> tuple[JointTrajectory, Tempo]:
    """Return joints within an arm's limits, with 2 % to spare, and their tempo: the person's or the fastest.

    Parameters
    ----------
    arm : Arm
    joints : JointTrajectory
        At the wanted times.
    policy : "person" or "fastest"
    torque_share : float, optional
        Of the effort limits, by KDL's inverse dynamics; without it they are not looked at.
    """
    limits = _limits(arm, joints, torque_share)
    demand = largest_demand(joints, **limits)
    if policy == "fastest" and len(joints.time) > 2:
        return _fastest(arm, joints, limits, demand)
    found = paced(joints, **limits)
    return found.joints, Tempo(policy, joints.time, found.pace, demand)


def paced_slowdown(arm: Arm, joints: JointTrajectory) -> float:
    """Return the duration over the wanted one, slower only where limits of velocity and acceleration bind."""
    time = paced(joints, arm.velocity_limit / RESERVE, arm.acceleration_limit / RESERVE**2).pace.time
    return float((time[-1] - time[0]) / (joints.time[-1] - joints.time[0]))


def demand_of(arm: Arm, joints: JointTrajectory, torque_share: float | None) -> Demand:
    """Return the joint, limit and time that ask for the longest duration, the reserve of 2 % in it."""
    return largest_demand(joints, **_limits(arm, joints, torque_share))


def _fastest(
    arm: Arm, joints: JointTrajectory, limits: dict[str, Any], demand: Demand
) -> tuple[JointTrajectory, Tempo]:
    wanted = np.asarray(joints.time)
    told = {name: limits[name] for name in ("velocity_limit", "acceleration_limit", "effort_limit")}
    fast = time_optimal(joints, **told, arm=arm, gravity=arm.gravity)
    left = largest_demand(fast, **limits)
    if left.factor > 1.0:  # of jerk and the tool's speed, which time_optimal does not know
        fast = stretched(fast, left.factor)
    slowdown = np.gradient(fast.time, wanted)
    rate = np.gradient(np.log(slowdown), wanted)
    return fast, Tempo("fastest", wanted, Pace(fast.time, slowdown, rate), demand)


def _limits(arm: Arm, joints: JointTrajectory, torque_share: float | None) -> dict[str, Any]:
    """Return the limits that `paced` takes, with the reserve on the duration."""
    return {
        "velocity_limit": arm.velocity_limit / RESERVE,
        "acceleration_limit": arm.acceleration_limit / RESERVE**2,
        "jerk_limit": arm.jerk_limit / RESERVE**3,
        "tool_speed_limit": arm.tool_speed_limit / RESERVE,
        "effort_limit": held_effort(arm, joints.position, torque_share),
        "arm": arm,
    }


def held_effort(arm: Arm, position: Array, share: float | None) -> Array | None:
    """Return the effort limits to plan by; None where they are not looked at or cannot even hold the arm."""
    if share is None:
        return None
    limit = _EFFORT_RESERVE * share * arm.effort_limit
    return limit if bool((np.abs(arm.gravity_effort(position)) < limit).all()) else None
