"""The step from a model to joints: the path rolled out, followed by the arm, and slowed down where limits bind."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp import simulation
from dmpcpp._core import (
    Arm,
    InverseKinematics,
    JointTrajectory,
    PacedLimit,
    PoseDmp,
    PoseDmpSequence,
    PoseTrajectory,
    Via,
    duration_factor,
    retimed,
    stretched,
)
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._bound import arm_bound
from dmpcpp.planning._cycles import Cycles
from dmpcpp.planning._fit import DEFAULT_TOLERANCE, Fitted, Tolerance, fitted, taken_tolerance
from dmpcpp.planning._placement import Accept
from dmpcpp.planning._tempo import RESERVE, Tempo, TempoPolicy, demand_of, on_pace, taken_policy
from dmpcpp.robot import POSE, Follow, stated_duration_factor
from dmpcpp.simulation import Simulator

__all__ = ["Engine", "Slowed", "Solution", "limit_factor", "slowed", "solve"]

Engine = Callable[..., Simulator]
Led = PoseDmp | PoseDmpSequence | Cycles
"""What leads an arm's tip: a model, several one after another, or cycles of a rhythmic one."""

_SAMPLES = 1000  # of a path, at least
_SAMPLES_PER_KERNEL = 10
_INSET = 2e-3  # rad or m, kept off the position limits where the path allows: a spline overshoots its samples
_TORQUE_SHARE = 0.95  # of the effort limits; the rest is left to the feedback
_BRANCHES = 12  # other starts that are tried where the best one is not accepted


@dataclass(frozen=True, eq=False)
class Solution:
    """A motion and the joints that carry it out.

    Attributes
    ----------
    motion : PoseTrajectory
        Of the arm's tip in its base frame, at the samples of the joints.
    joints : JointTrajectory
        Its report says which poses are met.
    tempo : Tempo
        Where the motion is slower than it was asked for, and by how much.
    learned : PoseTrajectory
        The model's rollout, at the same samples; the motion itself unless that was fitted.
    fit : Fitted or None
        How far the motion is from the learned one, within the tolerance; None where it is the learned one.
    """

    motion: PoseTrajectory
    joints: JointTrajectory
    tempo: Tempo
    learned: PoseTrajectory
    fit: Fitted | None = None

    @property
    def slowdown(self) -> float:
        """The duration over the one that was asked for."""
        return self.tempo.slowdown


@dataclass(frozen=True, eq=False)
class Slowed:
    """Trajectory slowed down to the limits.

    Attributes
    ----------
    joints : JointTrajectory
    factor : float
        Duration over original duration.
    possible : bool
        False if no finite duration meets the limits (`torque_share` of the effort limits); `joints` then violates one.
    tempo : Tempo
        Where they are slower, and by how much.
    """

    joints: JointTrajectory
    factor: float
    possible: bool
    tempo: Tempo


def solve(
    model: Led,
    arm: Arm,
    *,
    goal: ArrayLike | None = None,
    duration: float | None = None,
    start: ArrayLike | None = None,
    stand: ArrayLike | None = None,
    accept: Accept | None = None,
    slow_down: bool = True,
    tempo: str = "person",
    tolerance: str | Tolerance | tuple[float, float] | None = DEFAULT_TOLERANCE,
    engine: Engine | None = None,
    follow: str | Follow = POSE,
    via: Sequence[Via] = (),
) -> Solution:
    """Roll a model out and find the joints for it, as slow as the limits of the arm ask for.

    Parameters
    ----------
    model : PoseDmp, PoseDmpSequence or Cycles
        Of poses of the arm's tip in its base frame.
    arm : Arm
    goal : array_like (4, 4), optional
        By default as demonstrated.
    duration : float, optional
        s; by default as demonstrated.
    start : array_like (n,), optional
        Initial guess at the first pose; other branches are searched if it fails.
    stand : array_like (n,), optional
        Current joints; the path is followed only from here.
    accept : JointTrajectory -> bool, optional
        Called with complete joint trajectories; where it rejects one, other branches are tried, and if it rejects all
        of them the first is returned. Not called with `stand`.
    slow_down : bool
        Take longer where velocity or acceleration limits ask for it.
    tempo : "person", "uniform" or "fastest"
        How: only where they bind, evenly, or as fast as they allow at every point of the path, from rest to rest.
    tolerance : Tolerance, (float, float) or str, optional
        How far the tip may be from the learned path [m, rad], "1mm,0.5deg" for instance, where the limits then ask for
        less time. None or "0": the learned path itself, which is also followed from joints in which the arm stands,
        through via-poses and in cycles.
    engine : callable, optional
        Whose inverse dynamics the effort limits must hold, too. If no duration meets them, only the other limits are
        applied; `slowed` reports that as `possible`.
    follow : str or Follow
        The part of each pose that the arm follows: "pose", "position", "axis" (z) or "axis:x", ..
    via : sequence of Via
        Poses that the motion passes; their velocities are those of `duration`, and slow down with the motion.

    Raises
    ------
    InvalidArgument
        What `PoseDmp.rollout` and `InverseKinematics.follow` refuse. An incomplete path does not raise: see
        `joints.report.complete`.
    """
    policy, allowed, follow = taken_policy(tempo), taken_tolerance(tolerance), Follow.of(follow)
    wanted = model.duration if duration is None else duration
    dt = wanted / max(_SAMPLES, _SAMPLES_PER_KERNEL * _kernels(model))
    learned = _rolled_out(model, goal, wanted, dt, via)
    joints = _followed(learned, arm, start, stand, accept, follow)
    if not slow_down:
        return Solution(learned, joints, Tempo.unchanged(joints.time), learned)
    fit = None
    led_elsewhere = stand is not None or via or isinstance(model, Cycles)  # joints, poses or a rest that must be met
    if allowed is not None and not led_elsewhere and joints.report.complete:
        fit = fitted(arm, learned, joints, allowed, follow, accept, _TORQUE_SHARE)
    slow = slowed(arm, joints, engine, tempo=policy)
    if fit:  # the largest demand is less, and most often the whole
        faster = slowed(arm, fit.joints, engine, tempo=policy)
        fit, slow = (fit, faster) if faster.factor < slow.factor else (None, slow)
    if policy != "uniform" or fit:
        again = retimed(learned, slow.tempo.pace)
    elif slow.factor > 1.0:
        again = _rolled_out(model, goal, slow.factor * wanted, slow.factor * dt, _slower(via, slow.factor))
    else:
        again = learned
    motion = retimed(fit.motion, slow.tempo.pace) if fit else again
    return Solution(motion, slow.joints, _bounded(slow.tempo, arm, learned, follow), again, fit)


def _bounded(tempo: Tempo, arm: Arm, learned: PoseTrajectory, follow: Follow) -> Tempo:
    """Add what the arm can do at all, where the motion is slower than it was asked for."""
    return replace(tempo, bound=arm_bound(arm, learned, follow)) if tempo.slowdown > 1.0 else tempo


def _kernels(model: Led) -> int:
    if isinstance(model, Cycles):
        return model.count * model.options.basis_count
    parts = model.models if isinstance(model, PoseDmpSequence) else [model]
    return sum(part.options.basis_count for part in parts)


def _rolled_out(model: Led, goal: ArrayLike | None, duration: float, dt: float, via: Sequence[Via]) -> PoseTrajectory:
    if not isinstance(model, PoseDmpSequence):
        return model.rollout(goal, duration, dt, via=via)
    if via:
        raise InvalidArgument(
            "via: of a sequence, expected none. Give each motion its own when PoseDmpSequence is made."
        )
    return model.rollout(goal, duration, dt)


def _slower(vias: Sequence[Via], factor: float) -> list[Via]:
    return [
        Via(via.phase, via.point, None if via.velocity is None else via.velocity / factor, via.reach) for via in vias
    ]


def limit_factor(arm: Arm, joints: JointTrajectory) -> float:
    """Return the smallest factor on the duration with which the limits hold that are stated; may be below 1.

    Velocity and acceleration, jerk and the tool's speed.
    """
    by_joints = duration_factor(joints, arm.velocity_limit, arm.acceleration_limit)
    return max(by_joints, stated_duration_factor(arm, joints.time, joints.position, joints.acceleration))


def slowed(
    arm: Arm,
    joints: JointTrajectory,
    engine: Engine | None = None,
    torque_share: float = _TORQUE_SHARE,
    *,
    tempo: TempoPolicy = "uniform",
) -> Slowed:
    """Slow joints down until the limits hold, with a reserve of 2 %: evenly unless `tempo` says otherwise.

    Limits of velocity, acceleration and `torque_share` of the effort: by KDL's inverse dynamics, and with an engine by
    that engine's, which knows friction.
    """
    if tempo == "uniform":
        demand = demand_of(arm, joints, torque_share)
        by_effort = demand.factor if engine is None and demand.limit == PacedLimit.effort else 1.0
        factor = max(1.0, RESERVE * limit_factor(arm, joints), by_effort)
        if not math.isfinite(factor):
            return Slowed(joints, 1.0, False, Tempo.unchanged(joints.time, tempo, demand))
        slow, found = stretched(joints, factor), Tempo.even(joints.time, factor, tempo, demand)
    else:
        slow, found = on_pace(arm, joints, tempo, torque_share)
    return _within_effort(arm, slow, found, engine, torque_share)


def _within_effort(arm: Arm, joints: JointTrajectory, tempo: Tempo, engine: Engine | None, share: float) -> Slowed:
    """Stretch what an engine's inverse dynamics still finds too fast, friction and repaired inertias in it."""
    torque = 1.0 if engine is None else simulation.torque_duration_factor(arm, joints, share=share, simulator=engine)
    if not math.isfinite(torque):
        return Slowed(joints, tempo.slowdown, False, tempo)
    if torque <= 1.0:
        return Slowed(joints, tempo.slowdown, True, tempo)
    return Slowed(stretched(joints, torque), torque * tempo.slowdown, True, tempo.stretched(torque))


def _followed(
    path: PoseTrajectory,
    arm: Arm,
    start: ArrayLike | None,
    stand: ArrayLike | None,
    accept: Accept | None,
    follow: str | Follow,
) -> JointTrajectory:
    """Return joints along the path that are accepted; else the first complete ones, else those that meet most poses."""
    follow = Follow.of(follow)
    best = _complete(path, arm, start, stand, follow)
    if not best.report.complete or accept is None or stand is not None or accept(best):
        return best
    solver = InverseKinematics(arm, weight=follow.weight)
    others = (solver.follow(path, start=branch.joints) for branch in islice(solver.branches(path.pose[0]), _BRANCHES))
    return next((joints for joints in others if joints.report.complete and accept(joints)), best)


def _complete(
    path: PoseTrajectory, arm: Arm, start: ArrayLike | None, stand: ArrayLike | None, follow: Follow
) -> JointTrajectory:
    found: list[JointTrajectory] = []
    for joints in _attempts(path, arm, start, stand, follow):
        if joints.report.complete:
            return joints
        found.append(joints)
    return max(found, key=lambda joints: joints.report.solved)


def _attempts(
    path: PoseTrajectory, arm: Arm, start: ArrayLike | None, stand: ArrayLike | None, follow: Follow
) -> Iterator[JointTrajectory]:
    """Yield joints along the path: off the position limits, then on them; from the joints given, then from any."""
    inset = _inset(arm)
    if stand is not None:
        if _is_within(inset, stand):
            yield InverseKinematics(inset, weight=follow.weight).follow(path, start=stand)
        yield InverseKinematics(arm, weight=follow.weight).follow(path, start=stand)
        return
    for limited in (inset, arm):
        solver = InverseKinematics(limited, weight=follow.weight)
        if start is not None:
            yield solver.follow(path, start=np.clip(start, limited.lower, limited.upper))
        yield solver.follow(path)


def _is_within(arm: Arm, joints: ArrayLike) -> bool:
    joints = np.asarray(joints)
    return bool((joints >= arm.lower).all() and (joints <= arm.upper).all())


def _inset(arm: Arm) -> Arm:
    span: Array = arm.upper - arm.lower
    room = np.where(np.isfinite(span), np.minimum(_INSET, 0.01 * span), 0.0)
    return arm.with_limits(lower=arm.lower + room, upper=arm.upper - room)
