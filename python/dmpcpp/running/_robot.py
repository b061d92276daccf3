"""What a robot has to offer so that a motion can be run on it: one file a robot, none imports another."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check
from dmpcpp.sending import JointMotion

__all__ = ["CycleLog", "End", "Robot", "RobotError", "RobotInfo", "RobotState", "Sample", "Targets"]


class RobotError(RuntimeError):
    """A robot cannot be reached or may not be moved; the message says why and what to do."""


@dataclass(frozen=True, eq=False)
class Sample:
    """Where the joints are to be at a time: position, velocity, acceleration (n,) in rad and s.

    The arrays are those of the caller, written anew at the next call: copy what is kept.
    """

    position: Array
    velocity: Array
    acceleration: Array


Targets = Callable[[float], Sample | None]
"""Called with the time since the stream began [s]; None when the robot is to end there, at rest."""


@dataclass(frozen=True)
class RobotInfo:
    """What a robot says of itself.

    Attributes
    ----------
    name : str
        For people.
    joint_names : tuple of str
        As its URDF names them; empty where the robot does not name them and the plan's are taken.
    rate : float
        Commands a second [Hz].
    payload : float or None
        kg as the robot has it; None where it does not say.
    notes : tuple of str
        What a person should know before it moves.
    """

    name: str
    joint_names: tuple[str, ...]
    rate: float
    payload: float | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class RobotState:
    """How a robot stands now.

    Attributes
    ----------
    position, velocity, torque : (n,)
        Measured, rad, rad/s, Nm.
    commanded : (n,)
        The last position that its controller was given; where a motion has to begin.
    ready : bool
        Whether it takes commands.
    mode : str
        Its own word for what it does, with its errors.
    """

    position: Array
    velocity: Array
    torque: Array
    commanded: Array
    ready: bool
    mode: str


@dataclass(frozen=True)
class End:
    """How a stream ended.

    Attributes
    ----------
    complete : bool
        Whether the targets came to their end and the robot took the last one.
    reason : str
        Why it did not; "" otherwise.
    """

    complete: bool
    reason: str = ""


class Robot(Protocol):
    """A robot that follows joints over time.

    ``stream`` asks for the joints at a time, not for the next sample: lost packets, late cycles and slowing down for a
    stop are all the same thing, another time.
    """

    def connect(self) -> RobotInfo:
        """Reach the robot; RobotError with what to do where it cannot be."""

    def state(self) -> RobotState:
        """How it stands now; only while nothing streams."""

    def limits(self, arm: Arm) -> Arm:
        """The arm with the robot's own limits where these are narrower."""

    def checks(self, joints: JointMotion, arm: Arm) -> Iterable[Check]:
        """What this robot refuses beyond `sending.check`: limits that depend on where it is, for one."""

    def advice(self, joints: JointMotion, arm: Arm) -> Iterable[str]:
        """What its maker recommends and the joints do not keep; it does not keep them from being sent."""

    def stream(self, targets: Targets, log: CycleLog) -> End:
        """Follow the targets at the robot's own rate until they are None, and log every cycle."""

    def stop(self) -> None:
        """End a stream at once, by the robot's own means; from any thread, as often as one likes."""

    def close(self) -> None:
        """Let go of the robot."""


class CycleLog:
    """Every cycle of a stream; its memory is taken before it begins.

    Attributes
    ----------
    count : int
        Cycles in it.
    lost : int
        Periods that no command was sent for.
    """

    _OF_JOINTS = ("position", "velocity", "torque", "commanded")
    _PLAIN = ("time", "period", "work")

    def __init__(self, cycles: int, joints: int) -> None:
        """Take the memory; what comes after it is full is left out."""
        self._arrays = {name: np.full((cycles, joints), np.nan) for name in self._OF_JOINTS}
        self._arrays |= {name: np.full(cycles, np.nan) for name in self._PLAIN}
        self.count = self.lost = 0
        self._capacity = cycles

    def add(
        self,
        time: float,
        period: float,
        position: Array,
        velocity: Array,
        torque: Array,
        commanded: Array,
        work: float,
    ) -> None:
        """Take one cycle: time since the stream began, the period that it stands for, our own work in it [s]."""
        k = self.count
        if k == self._capacity:
            return
        arrays = self._arrays
        arrays["time"][k], arrays["period"][k], arrays["work"][k] = time, period, work
        arrays["position"][k], arrays["velocity"][k] = position, velocity
        arrays["torque"][k], arrays["commanded"][k] = torque, commanded
        self.count = k + 1

    def __getitem__(self, name: str) -> Array:
        """The values of all cycles: time, period, work (N,), position, velocity, torque, commanded (N, n)."""
        return self._arrays[name][: self.count]
