"""One run on a robot: what would happen, whether it may, the motion itself, and what was recorded of it."""

from __future__ import annotations

import gc
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check
from dmpcpp.export import JointSamples
from dmpcpp.robot import payload_of
from dmpcpp.running._follower import Follower
from dmpcpp.running._robot import CycleLog, End, Robot, RobotError, RobotInfo, RobotState, Sample
from dmpcpp.sending import Joints, approach, check, joined, nearest_turns, ready, slowed_by, turned

__all__ = ["Briefing", "Run", "Stoppable", "brief", "execute"]

_LOG_SHARE = 2.0  # of the cycles that are expected, taken as memory
_LOG_MORE = 5.0  # s beyond that
_STOOD = 1e-3  # rad (m) that the robot may have moved between the look at it and the start

Clear = Callable[[Array], bool]


@dataclass(frozen=True, eq=False)
class Briefing:
    """What a run would do, and what speaks against it.

    Attributes
    ----------
    info : RobotInfo
    state : RobotState
    arm : Arm
        With the robot's own limits.
    plan : JointSamples
        The motion with its leads as it will be sent: its speed, and the whole turns nearest to the robot.
    approach : Joints or None
        The way to its start; None where the robot stands there.
    whole : Joints
        Approach and motion; time 0 is that of the plan.
    checks : tuple of Check
        Of the whole, as the robot will see it.
    advice : tuple of str
        What the robot's maker recommends and the motion does not keep.
    problems : tuple of str
        Why the robot must not be moved; none where it may.
    """

    info: RobotInfo
    state: RobotState
    arm: Arm
    plan: JointSamples
    approach: Joints | None
    whole: Joints
    checks: tuple[Check, ...]
    advice: tuple[str, ...]
    problems: tuple[str, ...]

    @property
    def distance(self) -> tuple[float, str]:
        """How far the start is [rad], and which joint has the longest way."""
        off = np.abs(self.plan.position[0] - self.state.commanded)
        return float(off.max()), self.plan.joint_names[int(np.argmax(off))]

    @property
    def duration(self) -> tuple[float, float]:
        """Of the approach and of the motion with its leads [s]."""
        way = 0.0 if self.approach is None else float(self.approach.time[-1])
        return way, float(self.plan.time[-1] - self.plan.time[0])


@dataclass(frozen=True, eq=False)
class Run:
    """What became of a run.

    Attributes
    ----------
    log : CycleLog
        Every cycle, also of a run that was stopped.
    time : (N,) s
        Of the cycles on the clock of the plan: an approach is before the plan's first sample.
    end : End
    stopped : bool
        Whether a person, or an error of ours, stopped it.
    """

    log: CycleLog
    time: Array
    end: End
    stopped: bool


def brief(
    robot: Robot, arm: Arm, joints: JointSamples, *, speed: float = 1.0, clear: Callable[[Arm], Clear] | None = None
) -> Briefing:
    """Reach a robot, look at how it stands and check everything that it would be sent; nothing is moved.

    Parameters
    ----------
    robot : Robot
    arm : Arm
        Of the plan.
    joints : JointSamples
        joints.csv of a plan.
    speed : float
        Share of the plan's speed, above 0 and at most 1.
    clear : callable, optional
        Gives for an arm whether joints (N, n) touch nothing, for the approach.

    Raises
    ------
    RobotError
        The robot is not reached, or is another one than the plan's.
    """
    info = robot.connect()
    if info.joint_names and list(info.joint_names) != list(arm.joint_names):
        raise RobotError(
            f"{info.name} has the joints {', '.join(info.joint_names)}, the plan {', '.join(arm.joint_names)}. "
            "Plan for the robot that is there."
        )
    limited, state = robot.limits(arm), robot.state()
    turns = nearest_turns(limited, joints.position, state.commanded)
    moved = turned(slowed_by(joints, speed), turns)
    plan = JointSamples(
        moved.time, moved.position, moved.velocity, moved.acceleration, moved.joint_names, joints.motion
    )
    way = approach(limited, state.commanded, plan.position[0])
    whole = joined(way, plan)
    checks = (*check(plan, limited, rate=info.rate), *robot.checks(plan, limited))
    if way is not None:
        checks += check(way, limited, rate=info.rate, stands=state.commanded)
    advice = tuple(robot.advice(plan, limited))
    problems = tuple(_problems(info, state, arm, way, checks, clear))
    return Briefing(info, state, limited, plan, way, whole, checks, advice, problems)


def _problems(
    info: RobotInfo,
    state: RobotState,
    arm: Arm,
    way: Joints | None,
    checks: tuple[Check, ...],
    clear: Callable[[Arm], Clear] | None,
) -> Iterator[str]:
    if not state.ready:
        yield f"the robot is not ready: {state.mode}. Clear that at the robot; nothing is recovered from here."
    failed = tuple(one for one in checks if not one.ok)
    if failed:
        yield f"the robot may not get this motion: {ready(failed).detail}."
    if way is not None and clear is not None and not clear(arm)(way.position):
        yield (
            "the way to the start comes nearer than 2 mm to the arm itself or the floor. Move the robot by hand nearer "
            "to the start of the motion."
        )
    planned = payload_of(arm)
    if info.payload is not None and abs(info.payload - planned) > 1e-3:
        yield (
            f"the robot carries {info.payload:g} kg and the plan {planned:g} kg. Set the robot's load, or plan with "
            f"a payload of {info.payload:g} kg."
        )


class Stoppable(Protocol):
    """Targets of a stream that can be asked to come to rest."""

    duration: float
    """s, unless it is stopped."""

    @property
    def stopping(self) -> bool:
        """Whether a stop was asked for."""

    def stop(self) -> None:
        """Come to rest from the next call on; from a signal handler or any thread."""

    def __call__(self, time: float) -> Sample | None:
        """See `Targets`."""


def execute(
    robot: Robot,
    briefing: Briefing,
    *,
    watch: Callable[[], bool] | None = None,
    targets: Stoppable | None = None,
) -> Run:
    """Move the robot: the approach and the motion in one stream, stopped along the path on Ctrl-C.

    A second Ctrl-C ends the stream and leaves the stop to the robot. The log is whole in all cases.

    Parameters
    ----------
    robot : Robot
    briefing : Briefing
        Of this robot, just now.
    watch : callable, optional
        Asked in every cycle whether to stop along the path.
    targets : optional
        What is streamed instead of the briefing's motion, for instance an `OnlineMotion`.

    Raises
    ------
    RobotError
        The briefing names problems, or the robot has moved since; nothing was moved.
    """
    if briefing.problems:
        raise RobotError(briefing.problems[0])
    stands = robot.state()
    if not stands.ready or np.abs(stands.commanded - briefing.state.commanded).max() > _STOOD:
        raise RobotError("the robot has moved or changed its mode since it was looked at. Start again.")
    follower = targets or Follower(briefing.whole, briefing.arm, watch=watch)
    expected = (_LOG_SHARE * follower.duration + _LOG_MORE) * briefing.info.rate
    log = CycleLog(int(expected), briefing.arm.joint_count)
    with _stopping(follower, robot), _without_collection():
        end = robot.stream(follower, log)
    return Run(log, log["time"] + briefing.whole.time[0], end, follower.stopping)


@contextmanager
def _stopping(follower: Stoppable, robot: Robot) -> Iterator[None]:
    """Let Ctrl-C and SIGTERM stop along the path, and a second one at once."""
    if threading.current_thread() is not threading.main_thread():
        yield  # only the main thread is sent signals
        return

    def stop(*_: object) -> None:
        if follower.stopping:
            robot.stop()
        follower.stop()

    before = {each: signal.signal(each, stop) for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


@contextmanager
def _without_collection() -> Iterator[None]:
    """Keep the collector of garbage out of the cycles."""
    enabled = gc.isenabled()
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
