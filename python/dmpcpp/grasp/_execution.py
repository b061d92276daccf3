"""A planned grasp carried out under physics, and everything that was measured."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.grasp._planning import GraspPlan
from dmpcpp.grasp._timing import PHASES
from dmpcpp.simulation import ContactEvent, GraspWorld, ParallelGripper, Reference, sample

__all__ = ["GraspLog", "carry_out"]

_KP, _KD = 400.0, 40.0  # 1/s^2, 1/s; computed torque, critically damped
_RECORD_EVERY = 10  # steps


@dataclass(frozen=True, eq=False)
class GraspLog:
    """A grasp as it went: M records of n joints, every 10 ms at 1 kHz.

    Attributes
    ----------
    simulator : str
        Engine and version.
    rate : float
        Control steps a second [Hz].
    steps, planned_steps : int
        Control steps done and wanted; fewer were done if the state left the finite numbers.
    phases : dict of str to float
        When each of PHASES begins [s].
    time : (M,) s
        0 where the reach begins.
    position : (M, n) rad
    opening : (M,) m
        Of a finger, from the middle.
    desired_tool_pose, tool_pose, object_pose : (M, 4, 4)
        In the robot's base frame.
    torque_ratio : (n,)
        Largest torque that the controller asked for, over the effort limit, of each joint in any step.
    clipped_steps : int
        In which the torque of a joint was cut at its limit.
    contacts : tuple of ContactEvent
        Of anything but the fingers with the bottle, in every step.
    """

    simulator: str
    rate: float
    steps: int
    planned_steps: int
    phases: dict[str, float]
    time: Array
    position: Array
    opening: Array
    desired_tool_pose: Array
    tool_pose: Array
    object_pose: Array
    torque_ratio: Array
    clipped_steps: int
    contacts: tuple[ContactEvent, ...]

    def during(self, first: str, last: str = "hold") -> slice:
        """Records from the beginning of the phase `first` to the end of the phase `last`."""
        after = PHASES.index(last) + 1
        end = self.phases[PHASES[after]] if after < len(PHASES) else np.inf
        start, stop = np.searchsorted(self.time, (self.phases[first] - 1e-9, end - 1e-9))
        return slice(int(start), int(stop))


def carry_out(
    plan: GraspPlan,
    arm: Arm,
    gripper: ParallelGripper,
    *,
    rate: float = 1000.0,
    progress: Callable[[float], None] | None = None,
) -> GraspLog:
    """Reach, approach, close for 0.6 s, lift and hold for 2 s; the same plan gives the same log bit for bit.

    The arm is driven by computed torque, clipped at the effort limits; the controller does not know the bottle.
    The fingers close with the gripper's force, and friction alone holds what is between them.

    Parameters
    ----------
    plan : GraspPlan
    arm : Arm
    gripper : ParallelGripper
    rate : float
        Control and physics steps a second, 100 to 10000 Hz.
    progress : callable, optional
        Called as progress(share done).
    """
    if not 100.0 <= rate <= 1e4:
        raise InvalidArgument(f"rate: {rate}, expected 100 to 10000 Hz.")
    reference = sample(arm, plan.joints, rate, settle=0.0, from_rest=True, consistent=True)
    stands = (arm, 1.0 / rate, gripper, plan.bottle.cylinder, plan.bottle.place)
    with GraspWorld(*stands, obstacles=plan.around.obstacles) as world:
        run = _Run(world, gripper, arm, len(reference.time))
        run.go(reference, int(np.searchsorted(reference.time, plan.phases["close"])), progress)
    records = slice(0, run.records * _RECORD_EVERY, _RECORD_EVERY)
    return GraspLog(
        simulator=world.name,
        rate=rate,
        steps=run.done,
        planned_steps=len(reference.time),
        phases=plan.phases,
        time=reference.time[records],
        desired_tool_pose=arm.forward_kinematics(reference.position[records]),
        **run.arrays(),
    )


class _Run:
    """The control loop and the memory of what it met."""

    def __init__(self, world: GraspWorld, gripper: ParallelGripper, arm: Arm, steps: int) -> None:
        self._world, self._fingers, self._limit = world, frozenset(gripper.links), arm.effort_limit
        count = -(-steps // _RECORD_EVERY)
        self._position, self._opening = np.empty((count, arm.joint_count)), np.empty(count)
        self._tool_pose, self._object_pose = np.empty((count, 4, 4)), np.empty((count, 4, 4))
        self._largest = np.zeros(arm.joint_count)
        self._contacts: list[ContactEvent] = []
        self._clipped = 0
        self.done = self.records = 0

    def go(self, reference: Reference, close: int, progress: Callable[[float], None] | None) -> None:
        world, total = self._world, len(reference.time)
        world.reset(reference.position[0], reference.velocity[0])
        for k in range(total):
            if k == close:
                world.grip(0.0)
            if k % _RECORD_EVERY == 0 and not self._record(k):
                return
            self._drive(reference.position[k], reference.velocity[k], reference.acceleration[k])
            self._touch(k, float(reference.time[k]))
            self.done = k + 1
            if progress and (k % 100 == 0 or k + 1 == total):
                progress((k + 1) / total)

    def _drive(self, position: Array, velocity: Array, acceleration: Array) -> None:
        q, qd = self._world.state()
        demand = self._world.inverse_dynamics(acceleration + _KD * (velocity - qd) + _KP * (position - q))
        size = np.abs(demand)
        np.maximum(self._largest, size, out=self._largest)
        if (size > self._limit).any():
            self._clipped += 1
            demand = np.clip(demand, -self._limit, self._limit)
        self._world.apply_torque(demand)
        self._world.step()

    def _record(self, k: int) -> bool:
        """Keep where everything was at step k; False if the state is no longer finite."""
        world, m = self._world, k // _RECORD_EVERY
        self._position[m], self._opening[m] = world.state()[0], world.opening()
        self._tool_pose[m], self._object_pose[m] = world.tool_pose(), world.object_pose()
        finite = bool(np.isfinite(self._position[m]).all() and np.isfinite(self._object_pose[m]).all())
        self.records = m + finite
        return finite

    def _touch(self, k: int, time: float) -> None:
        """Keep what touched in step k."""
        for contact in self._world.contacts():
            event = ContactEvent(k, time, contact)
            if not self._is_grip(event):
                self._contacts.append(event)

    def _is_grip(self, event: ContactEvent) -> bool:
        return event.contact.other == GraspWorld.object_name and event.contact.link in self._fingers

    def arrays(self) -> dict[str, Any]:
        kept = slice(0, self.records)
        return {
            "position": self._position[kept],
            "opening": self._opening[kept],
            "tool_pose": self._tool_pose[kept],
            "object_pose": self._object_pose[kept],
            "torque_ratio": self._largest / self._limit,
            "clipped_steps": self._clipped,
            "contacts": tuple(self._contacts),
        }
