"""The library's own physics in real time, behind the protocol of a robot."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check
from dmpcpp.robot import Disturbance, payload_of
from dmpcpp.running._robot import CycleLog, End, RobotInfo, RobotState, Targets
from dmpcpp.sending import JointMotion
from dmpcpp.simulation import Simulator, default_simulator

__all__ = ["SimulatedRobot"]

_KP, _KD = 1600.0, 80.0  # 1/s^2, 1/s; computed torque, critically damped
_RATE = 1000.0  # Hz


class SimulatedRobot:
    """An arm under physics, driven by computed torque at 1 kHz.

    Its clock is that of its steps: where the machine is too slow for real time the arm moves slower and nothing else
    changes, so that the same run gives the same log.

    Parameters
    ----------
    arm : Arm
    stands : (n,)
        Joints in which it stands first [rad].
    engine : callable
        As of ``simulation.execute``.
    disturbance : Disturbance, optional
        Of the arm; the controller does not know of it.
    real_time : bool
        Whether to wait for the wall's clock.
    """

    def __init__(
        self,
        arm: Arm,
        stands: Array,
        *,
        engine: Callable[..., Simulator] = default_simulator,
        disturbance: Disturbance | None = None,
        real_time: bool = True,
    ) -> None:
        """Nothing is loaded yet."""
        self._arm, self._stands, self._engine = arm, np.array(stands, dtype=np.float64), engine
        self._disturbance, self._real_time = disturbance, real_time
        self._plant: Simulator | None = None
        self._model: Simulator | None = None
        self._torque = np.zeros_like(self._stands)
        self._commanded = self._stands.copy()
        self._halted = False

    def connect(self) -> RobotInfo:
        """Load the arm where it stands first."""
        self.close()
        self._model = self._engine(self._arm, 1.0 / _RATE).__enter__()
        self._plant = self._model
        if self._disturbance and self._disturbance.changes_arm:
            self._plant = self._engine(self._arm, 1.0 / _RATE, disturbance=self._disturbance).__enter__()
        self._plant.reset(self._stands, np.zeros_like(self._stands))
        name = f"simulated {self._arm.name}, {self._plant.name}"
        return RobotInfo(name, tuple(self._arm.joint_names), _RATE, payload_of(self._arm))

    def state(self) -> RobotState:
        """How it stands."""
        position, velocity = self._open().state()
        return RobotState(position, velocity, self._torque, self._commanded.copy(), True, "idle")

    def limits(self, arm: Arm) -> Arm:
        """Those of the arm."""
        return arm

    def checks(self, joints: JointMotion, arm: Arm) -> Iterable[Check]:
        """Nothing beyond what every robot is checked for."""
        return ()

    def advice(self, joints: JointMotion, arm: Arm) -> Iterable[str]:
        """None."""
        return ()

    def stream(self, targets: Targets, log: CycleLog) -> End:
        """Step the physics, one command a step."""
        plant, model, step = self._open(), self._model or self._open(), 1.0 / _RATE
        self._halted, began = False, time.perf_counter()
        for k in range(10**9):
            if self._halted:
                return End(False, "stopped at once")
            before = time.thread_time()
            target = targets(k * step)
            work = time.thread_time() - before
            if target is None:
                return End(True)
            position, velocity = plant.state()
            if not np.isfinite(position).all():
                return End(False, "the simulated arm left the finite numbers")
            wished = target.acceleration + _KD * (target.velocity - velocity) + _KP * (target.position - position)
            torque = model.inverse_dynamics(wished, position, velocity)
            self._torque = np.clip(torque, -self._arm.effort_limit, self._arm.effort_limit)
            self._commanded[:] = target.position
            log.add(k * step, step, position, velocity, self._torque, self._commanded, work)
            plant.apply_torque(self._torque)
            plant.step()
            if self._real_time:
                time.sleep(max(0.0, began + (k + 1) * step - time.perf_counter()))
        return End(False, "the motion does not end")

    def stop(self) -> None:
        """Leave the arm where it is."""
        self._halted = True

    def close(self) -> None:
        """Free the worlds."""
        for world in {id(w): w for w in (self._plant, self._model) if w is not None}.values():
            world.__exit__(None, None, None)
        self._plant = self._model = None

    def _open(self) -> Simulator:
        if self._plant is None:
            self.connect()
        assert self._plant is not None
        return self._plant
