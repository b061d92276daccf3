"""A motion whose goal moves while the robot does: the model runs in the loop, the joints follow within limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm, IkStatus, JointTracker, Motion, PoseDmp, PoseRun
from dmpcpp._typing import Array
from dmpcpp.checks import Check
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import POSE, Follow
from dmpcpp.running._follower import Follower
from dmpcpp.running._goals import GoalSource
from dmpcpp.running._joint_limiter import JointLimiter
from dmpcpp.running._robot import Sample
from dmpcpp.sending import Joints
from dmpcpp.simulation import Tolerances

__all__ = ["OnlineMotion", "Reached", "online_checks"]

_BEHIND = 200.0  # 1/rad: 5 mrad behind, the clock of the motion goes at half its speed
_STOPPING = 0.2  # s in which the clock of the motion comes to a stop
_STILL = 0.5  # s without a new goal after which a motion that has come to its end is over
_REST = (1e-6, 1e-6, 1e-4)  # rad, rad/s and rad/s^2 below which the joints rest
_ENDLESS = 120.0  # s beyond the motion after which a goal that keeps moving is left, and the arm stopped


@dataclass(frozen=True)
class Reached:
    """What became of the goal.

    Attributes
    ----------
    position, angle : float
        m and rad between the tip and the last goal at the end.
    missed : int
        Cycles in which inverse kinematics did not meet the pose: out of reach, or beyond a limit of the joints.
    """

    position: float
    angle: float
    missed: int


class OnlineMotion:
    """Targets of a stream: an approach, then the model itself, its goal moved by a source.

    Each cycle the run goes on by as much as the joints are not behind (phase stopping: Ijspeert et al., Neural
    Computation 25, 2013), the joints of its pose are tracked, and a cascade takes them through the limits of velocity,
    acceleration and jerk. Contacts and torques are not looked at.

    Parameters
    ----------
    model : PoseDmp
        Of the tip in the base frame; a discrete one.
    arm : Arm
    joints : (n,)
        At the model's first pose [rad].
    stands : (n,)
        Where the arm rests when the motion begins [rad]; near those.
    goals : GoalSource
    duration : float
        Of the motion [s].
    period : float
        Of the robot's cycle [s].
    approach : Joints or None
        What comes first, from rest to rest.
    follow : Follow
        The part of each pose that is followed.
    watch : callable, optional
        Asked in every cycle whether to stop.
    """

    def __init__(
        self,
        model: PoseDmp,
        arm: Arm,
        joints: Array,
        stands: Array,
        goals: GoalSource,
        *,
        duration: float,
        period: float,
        approach: Joints | None = None,
        follow: Follow = POSE,
        watch: Callable[[], bool] | None = None,
    ) -> None:
        """Take all memory."""
        if model.options.motion == Motion.rhythmic:
            raise InvalidArgument("model: a rhythmic one has a centre and no goal that could move.")
        self._arm, self._goals, self._follow, self._watch = arm, goals, follow, watch
        self._run = PoseRun(model)
        self._run.duration = duration
        self._tracker = JointTracker(arm, joints, weight=follow.weight)
        self._limiter = JointLimiter(arm, stands)
        self._approach = Follower(approach, arm) if approach is not None else None
        self._period, self._begin = period, 0.0 if approach is None else float(approach.time[-1] - approach.time[0])
        self._sample = Sample(*np.zeros((3, arm.joint_count)))
        self._time, self._rate, self._newest = 0.0, 1.0, 0.0
        self._asked = self._over = False
        self._missed, self.duration = 0, self._begin + duration + _ENDLESS

    @property
    def stopping(self) -> bool:
        """Whether a stop was asked for."""
        return self._asked

    def stop(self) -> None:
        """Come to rest from the next call on; from a signal handler or any thread."""
        self._asked = True
        if self._approach is not None:
            self._approach.stop()

    def last(self) -> Sample:
        """Return the joints of the last call."""
        return self._sample

    def __call__(self, time: float) -> Sample | None:
        """Return the joints ``time`` s after the begin; None once the motion is over or stopped, and they rest."""
        if self._watch is not None and not self._asked and self._watch():
            self.stop()
        if self._approach is not None and time < self._begin:
            found = self._approach(time)
            if found is not None:
                self._keep(found.position, found.velocity, found.acceleration)
            return None if found is None else self._sample
        if self._over:
            return None
        self._asked = self._asked or time > self.duration  # a goal that never rests ends in a stop, not at speed
        while self._time < time - self._begin + 0.5 * self._period:
            self._cycle()
        return self._sample

    def reached(self, joints: Array) -> Reached:
        """Return how far the tip of these joints is from the last goal."""
        tip, goal = self._arm.forward_kinematics(joints), self._run.goal
        turned = np.clip((np.trace(tip[:3, :3].T @ goal[:3, :3]) - 1.0) / 2.0, -1.0, 1.0)
        return Reached(float(np.linalg.norm(tip[:3, 3] - goal[:3, 3])), float(np.arccos(turned)), self._missed)

    def _cycle(self) -> None:
        dt, tracker, limiter = self._period, self._tracker, self._limiter
        goal = self._goals.newest(self._time, self._run.goal)
        if goal is not None and not self._asked:
            self._run.goal, self._newest = goal, self._time
        behind = float(np.abs(tracker.joints - limiter.position).max())
        wanted = 0.0 if self._asked else 1.0
        self._rate += float(np.clip(wanted - self._rate, -dt / _STOPPING, dt / _STOPPING))
        going = self._run.step(dt * self._rate / (1.0 + _BEHIND * behind)) if self._rate > 0.0 else False
        if self._rate > 0.0:
            self._missed += tracker.track(self._run.pose, dt) != IkStatus.ok
        limiter.step(tracker.joints, tracker.velocity if self._rate > 0.0 else 0.0 * tracker.velocity, dt)
        self._time += dt
        waited = self._asked or self._time - self._newest > _STILL
        self._over = not going and waited and self._rests()
        rest = 0.0 if self._over else 1.0
        self._keep(limiter.position, rest * limiter.velocity, rest * limiter.acceleration)

    def _rests(self) -> bool:
        limiter, tracker = self._limiter, self._tracker
        moving = (tracker.joints - limiter.position, limiter.velocity, limiter.acceleration)
        return all(np.abs(values).max() < rest for values, rest in zip(moving, _REST, strict=True))

    def _keep(self, position: Array, velocity: Array, acceleration: Array) -> None:
        self._sample.position[:] = position
        self._sample.velocity[:] = velocity
        self._sample.acceleration[:] = acceleration


def online_checks(found: Reached, commanded: Array, arm: Arm, period: float, tolerances: Tolerances) -> list[Check]:
    """Return how near the tip came to the last goal, and shares of the limits by differences of the commands (N, n)."""
    share = (
        ("velocity", np.diff(commanded, axis=0) / period / arm.velocity_limit),
        ("acceleration", np.diff(commanded, 2, axis=0) / period**2 / arm.acceleration_limit),
        ("jerk", np.diff(commanded, 3, axis=0) / period**3 / arm.jerk_limit),
    )
    largest = {name: float(np.abs(values).max(initial=0.0)) for name, values in share}
    near = Check(
        "goal_position", found.position <= tolerances.position_max, found.position, tolerances.position_max, "m"
    )
    turned = Check("goal_angle", found.angle <= tolerances.angle_max, found.angle, tolerances.angle_max, "rad")
    limits = [Check(f"robot_{name}", most <= 1.0, most, 1.0, "1") for name, most in largest.items()]
    return [near, turned, *limits]
