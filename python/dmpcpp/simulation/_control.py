"""The ways to drive an arm along a reference, by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol, get_args

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.simulation._reference import Reference
from dmpcpp.simulation._sensing import JointState
from dmpcpp.simulation._simulator import Simulator

Mode = Literal["computed_torque", "position", "position_velocity", "velocity"]
MODES: tuple[str, ...] = get_args(Mode)

_VELOCITY_GAIN = 10.0  # 1/s; open loop, a velocity drifts


@dataclass(frozen=True)
class Gains:
    """Of the computed torque: kp [1/s^2], kd [1/s], ki [1/s^3]; critically damped where kd = 2 sqrt(kp)."""

    kp: float
    kd: float
    ki: float


class Controller(Protocol):
    """Decides on a command from what it sees; one per run, ``act`` once a control step in order."""

    def act(self, reference: Reference, k: int, seen: JointState) -> Array:
        """Command for step ``k``: torque (n,) Nm, or velocity (n,) rad/s for the motors."""


class ComputedTorque:
    """Torque = inverse dynamics of (qdd_ref + kd e' + kp e + ki integral of e), with e = q_ref - q.

    Siciliano et al., Robotics, 2009, section 8.5.2; the integral (8.5.3's robustness against a constant load)
    stands still for the joints whose torque is beyond the limit.
    """

    def __init__(self, model: Simulator, gains: Gains, limit: Array, period: float) -> None:
        """Take the model that the controller believes in, and its own period [s]."""
        self._model, self._gains, self._limit, self._period = model, gains, limit, period
        self._integral = np.zeros_like(limit)

    def act(self, reference: Reference, k: int, seen: JointState) -> Array:
        """Torque, not yet clipped."""
        position, velocity = seen
        gains, error = self._gains, reference.position[k] - position
        acceleration = reference.acceleration[k] + gains.kd * (reference.velocity[k] - velocity) + gains.kp * error
        if not gains.ki:
            return self._model.inverse_dynamics(acceleration, position, velocity)
        torque = self._model.inverse_dynamics(acceleration + gains.ki * self._integral, position, velocity)
        self._integral += np.where(np.abs(torque) < self._limit, self._period * error, 0.0)
        return torque


class Servo:
    """Velocities for the engine's own motors.

    ``position``: that which reaches the next reference within the step. ``position_velocity``: the reference's
    velocity, and the error made good within the step. ``velocity``: the same with a gain of 10/s.
    """

    def __init__(self, mode: str, period: float, hold: int) -> None:
        """Take a name of MODES, the control period [s] and the steps that a command is held for."""
        self._from_positions, self._hold = mode == "position", hold
        self._gain = _VELOCITY_GAIN if mode == "velocity" else 1.0 / period

    def act(self, reference: Reference, k: int, seen: JointState) -> Array:
        """Velocity."""
        last = len(reference.time) - 1
        if self._from_positions:
            return np.asarray(self._gain * (reference.position[min(k + self._hold, last)] - seen[0]))
        return np.asarray(reference.velocity[min(k + 1, last)] + self._gain * (reference.position[k] - seen[0]))
