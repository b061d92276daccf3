"""Franka Research 3 through Franka's own pylibfranka: joint positions at 1 kHz, the robot's impedance controller."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Series
from dmpcpp.errors import MissingDependency
from dmpcpp.robot import MAKERS
from dmpcpp.running._robot import CycleLog, End, RobotError, RobotInfo, RobotState, Targets
from dmpcpp.sending import JointMotion, effort

__all__ = ["FrankaRobot", "velocity_range"]

_JOINTS = 7
_RATE = 1000.0  # Hz
_EPSILON = 1e-3  # that libfranka keeps off the limits of velocity, acceleration and jerk
_TORQUE_RATE = 1000.0  # Nm/s; Franka Control Interface documentation, recommended
_WAIT = 0.2  # s between attempts to connect
_TRIES = 5

# Franka Control Interface documentation, "Limits for Franka Research 3": the velocity of each joint is at most
# min(v, max(0, sqrt(2 a (q_end - q)) - b)) towards either end of its range; here v, b, 2 a, lower end, upper end.
_RANGE = np.array(
    [
        [2.62, 0.30, 12.00, -2.75010, 2.75010],
        [2.62, 0.20, 5.17, -1.79180, 1.79180],
        [2.62, 0.20, 7.00, -2.90650, 2.90650],
        [2.62, 0.30, 8.00, -3.04810, -0.14580],
        [5.26, 0.35, 34.00, -2.81010, 2.81010],
        [4.18, 0.35, 11.00, 0.54092, 4.52050],
        [5.26, 0.35, 34.00, -3.01960, 3.01960],
    ]
).T


def velocity_range(position: Array) -> tuple[Array, Array]:
    """Lowest and highest velocity (.., 7) [rad/s] of an FR3 at joints (.., 7) [rad]."""
    most, offset, twice, lower, upper = _RANGE
    up = np.sqrt(np.maximum(0.0, twice * (upper - position))) - offset
    down = np.sqrt(np.maximum(0.0, twice * (position - lower))) - offset
    return -np.clip(down, 0.0, most) + _EPSILON, np.clip(up, 0.0, most) - _EPSILON


class FrankaRobot:
    """An FR3 at a host; nothing is moved but by ``stream``, and no error is recovered from.

    Parameters
    ----------
    host : str
        Name or address of the robot's controller.
    """

    def __init__(self, host: str) -> None:
        """Nothing is connected yet."""
        self._host, self._robot, self._api = host, None, None

    def connect(self) -> RobotInfo:
        """Reach the robot; a connection of before is closed, as it serves one client alone."""
        self.close()
        api = self._api = _pylibfranka()
        real_time = Path("/sys/kernel/realtime").exists()
        config = api.RealtimeConfig.kEnforce if real_time else api.RealtimeConfig.kIgnore
        self._robot = self._reached(api, config)
        notes = () if real_time else ("this kernel is not a real-time one: late cycles may stop the robot",)
        state = self._read()
        return RobotInfo(f"franka://{self._host}: FR3", (), _RATE, float(state.m_load), notes)

    def state(self) -> RobotState:
        """How it stands."""
        state, api = self._read(), self._api
        errors = str(state.current_errors) if bool(state.current_errors) else ""
        ready = state.robot_mode == api.RobotMode.Idle and not errors  # type: ignore[attr-defined]
        mode = " ".join(filter(None, (state.robot_mode.name, errors)))
        return RobotState(*map(np.array, (state.q, state.dq, state.tau_J, state.q_d)), ready, mode)

    def limits(self, arm: Arm) -> Arm:
        """The arm within the maker's limits of the FR3; RobotError for joints of another robot."""
        _require_fr3(arm)
        maker = MAKERS["fr3"]
        assert maker.velocity and maker.acceleration and maker.jerk and maker.effort
        return arm.with_limits(
            lower=np.maximum(arm.lower, _RANGE[3]),
            upper=np.minimum(arm.upper, _RANGE[4]),
            velocity=np.minimum(arm.velocity_limit, np.subtract(maker.velocity, _EPSILON)),
            acceleration=np.minimum(arm.acceleration_limit, np.subtract(maker.acceleration, _EPSILON)),
            jerk=np.minimum(arm.jerk_limit, np.subtract(maker.jerk, _EPSILON)),
            effort=np.minimum(arm.effort_limit, maker.effort),
        )

    def checks(self, joints: JointMotion, arm: Arm) -> Iterator[Check]:
        """Yield robot_velocity_at_position: what depends on where the FR3 is."""
        low, high = velocity_range(np.asarray(joints.position))
        share = np.where(joints.velocity > 0.0, joints.velocity / np.maximum(high, 1e-9), 0.0)
        share = np.where(joints.velocity < 0.0, joints.velocity / np.minimum(low, -1e-9), share)
        names = tuple(arm.joint_names)
        yield Series(joints.time, share, names).at_most("robot_velocity_at_position", 1.0, "1")

    def advice(self, joints: JointMotion, arm: Arm) -> Iterator[str]:
        """Yield where torque changes faster than Franka recommends, by the inverse dynamics of the arm."""
        torque = effort(arm, joints.position, joints.velocity, joints.acceleration)
        rate = np.abs(np.diff(torque, axis=0)) / np.diff(joints.time)[:, None]
        k, joint = np.unravel_index(np.argmax(rate), rate.shape)
        if rate[k, joint] > _TORQUE_RATE:
            yield (
                f"torque of '{arm.joint_names[int(joint)]}' changes by {rate[k, joint]:.0f} Nm/s at "
                f"{joints.time[int(k) + 1]:.3f} s; Franka recommends at most {_TORQUE_RATE:.0f}"
            )

    def stream(self, targets: Targets, log: CycleLog) -> End:
        """Follow the targets by joint positions; the time is the robot's own, lost packets counted by it."""
        api = self._api
        try:
            control = self._robot.start_joint_position_control(api.ControllerMode.JointImpedance)  # type: ignore
            return _follow(api, control, targets, log)
        except Exception as error:  # of the client: ControlException, NetworkException and others without a common base
            return End(False, f"the robot ended the motion: {_one_line(error)}")

    def stop(self) -> None:
        """Leave the stop to the robot."""
        if self._robot is not None:
            try:
                self._robot.stop()
            except Exception:  # the connection may be what is gone
                return

    def close(self) -> None:
        """Close the connection."""
        self._robot = None

    def _read(self) -> Any:
        if self._robot is None:
            raise RobotError(f"franka://{self._host}: not connected.")
        try:
            return self._robot.read_once()
        except Exception as error:
            raise RobotError(f"franka://{self._host}: it does not answer ({_one_line(error)}).") from None

    def _reached(self, api: Any, config: Any) -> Any:
        """The connection; a controller that still closes the last one is asked again."""
        for left in reversed(range(_TRIES)):
            try:
                return api.Robot(self._host, config)
            except Exception as error:
                if not left:
                    raise RobotError(
                        f"franka://{self._host}: no robot is reached ({_one_line(error)}). Is the host right, is FCI "
                        "activated in Desk, and does no other program hold the robot?"
                    ) from None
                time.sleep(_WAIT)
        raise AssertionError


def _follow(api: Any, control: Any, targets: Targets, log: CycleLog) -> End:
    """The loop at 1 kHz. The last position is held where the targets end, and the motion is said to be finished."""
    now = 0.0
    commanded: list[float] = []
    while True:
        state, elapsed = control.readOnce()
        before = time.thread_time()
        period = elapsed.to_sec()
        now += period
        target = targets(now)
        if target is not None:
            commanded = target.position.tolist()
        command = api.JointPositions(commanded)
        command.motion_finished = target is None
        work = time.thread_time() - before
        control.writeOnce(command)
        log.add(now, period, state.q, state.dq, state.tau_J, commanded, work)
        log.lost += max(0, round(period * _RATE) - 1)
        if target is None:
            return End(True)


def _require_fr3(arm: Arm) -> None:
    names = list(arm.joint_names)
    numbered = len(names) == _JOINTS and all(name.endswith(f"joint{k + 1}") for k, name in enumerate(names))
    if not numbered or not ("fr3" in arm.name.lower() or all("fr3" in name for name in names)):
        raise RobotError(
            f"the plan is of arm {arm.name!r} with joints {', '.join(names)}, and the robot is an FR3 (fr3_joint1 to "
            "fr3_joint7). Plan for the arm fr3, or for its URDF."
        )


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())


def _pylibfranka() -> Any:
    try:
        import pylibfranka
    except ImportError:
        raise MissingDependency(
            "Robots of Franka are reached by pylibfranka, which is there for Python 3.10 to 3.12. Install it: "
            'pip install "dmpcpp[franka]".'
        ) from None
    return pylibfranka
