"""A controller, an arm and the sensors between them, closed to a loop; and the record of its run."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.simulation._control import Controller
from dmpcpp.simulation._reference import Reference
from dmpcpp.simulation._sensing import Sensors
from dmpcpp.simulation._simulator import Contact, Simulator

Progress = Callable[[int, int], None]

_PROGRESS_STEPS = 100  # steps between two calls of the progress function

Drive = Callable[[Simulator, Array], tuple[Array, Array]]
"""Makes a step of the engine under a command; returns the torque wanted and the torque given, (n,) Nm each."""


def by_torque(limit: Array) -> Drive:
    """Commands are torques; they are clipped at ``limit`` (n,) Nm."""

    lowest = -limit

    def drive(plant: Simulator, demand: Array) -> tuple[Array, Array]:
        torque = np.minimum(np.maximum(demand, lowest), limit)
        plant.apply_torque(torque)
        plant.step()
        return demand, torque

    return drive


def by_motors(plant: Simulator, velocity: Array) -> tuple[Array, Array]:
    """Commands are velocities for the engine's own motors."""
    plant.servo(velocity)
    plant.step()
    torque = plant.servo_torque()
    return torque, torque


@dataclass(frozen=True)
class ControlLoop:
    """What closes the loop: an arm, a controller, and the sensors between them."""

    plant: Simulator
    controller: Controller
    drive: Drive
    sensors: Sensors
    hold: int

    def run(self, reference: Reference, recorder: Recorder, progress: Progress | None) -> None:
        """Go along the reference; a state that is not finite ends it."""
        plant, total = self.plant, len(reference.time)
        plant.reset(reference.position[0], reference.velocity[0])
        for k in range(total):
            if not recorder.state(k, plant):
                return
            seen = self.sensors.see(plant.state())
            if k % self.hold == 0:
                command = self.controller.act(reference, k, seen)
            recorder.torques(k, *self.drive(plant, command))
            for contact in plant.contacts():
                recorder.contacts.append((k, contact))
            if progress and ((k + 1) % _PROGRESS_STEPS == 0 or k + 1 == total):
                progress(k + 1, total)


class Recorder:
    """Arrays of the whole run, taken before it starts; ``done`` says how many steps are in them."""

    def __init__(self, steps: int, joints: int) -> None:
        """Take the memory."""
        of_joints = ("position", "velocity", "torque_demand", "torque")
        self._arrays = {name: np.empty((steps, joints)) for name in of_joints}
        self._arrays["tool_pose"] = np.empty((steps, 4, 4))
        self.contacts: list[tuple[int, Contact]] = []
        self.done = 0

    def state(self, k: int, engine: Simulator) -> bool:
        """Record where the arm is; False if that is not finite."""
        position, velocity = engine.state()
        # One bad number spoils the sum, and Python adds up a handful sooner than numpy.
        if not math.isfinite(sum(position.tolist()) + sum(velocity.tolist())):
            return False
        arrays, self.done = self._arrays, k + 1
        arrays["position"][k], arrays["velocity"][k] = position, velocity
        arrays["tool_pose"][k] = engine.tool_pose()
        return True

    def torques(self, k: int, demand: Array, torque: Array) -> None:
        """Record what was asked for and what was given."""
        self._arrays["torque_demand"][k], self._arrays["torque"][k] = demand, torque

    def arrays(self) -> dict[str, Array]:
        """By the names of ``ExecutionLog``, of the steps that were done."""
        return {name: values[: self.done] for name, values in self._arrays.items()}
