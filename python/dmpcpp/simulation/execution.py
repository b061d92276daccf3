"""Carry out a joint trajectory on a simulated arm: torques in, everything measured out."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp.errors import InvalidArgument
from dmpcpp.simulation.bullet import Bullet
from dmpcpp.simulation.execution_log import CAVEATS, ContactEvent, ExecutionLog
from dmpcpp.simulation.reference import Reference, sample
from dmpcpp.simulation.simulator import Contact, Simulator

Mode = Literal["computed_torque", "position"]
Progress = Callable[[int, int], None]

_PROGRESS_STEPS = 100  # steps between two calls of the progress function


def execute(
    arm: Arm,
    joints: JointTrajectory,
    *,
    rate: float = 1000.0,
    mode: Mode = "computed_torque",
    kp: float = 400.0,
    kd: float = 40.0,
    settle: float = 0.5,
    from_rest: bool = True,
    consistent: bool = True,
    simulator: Callable[[Arm, float], Simulator] = Bullet,
    progress: Progress | None = None,
) -> ExecutionLog:
    """Carry out ``joints`` on ``arm`` under physics; two calls give the same log bit for bit.

    Parameters
    ----------
    arm : Arm
    joints : JointTrajectory
        (T, n), T >= 2, in the order of ``arm.joint_names``.
    rate : float
        Control and physics steps a second [Hz].
    mode : {"computed_torque", "position"}
        ``"computed_torque"``: torque = inverse dynamics of (qdd_ref + kd (qd_ref - qd) + kp (q_ref - q)) in
        the measured state, clipped at the effort limits (Siciliano et al., Robotics, 2009, section 8.5.2).
        ``"position"``: a sanity check; the engine's own motors reach the next reference inside the step. It
        tests kinematics and the torque cap only, and can not feel a load.
    kp, kd : float
        Gains of the computed torque [1/s^2, 1/s], >= 0; critically damped where kd = 2 sqrt(kp).
    settle : float
        How long the arm holds the last position [s], >= 0.
    from_rest : bool
        Run up to the first state from rest, before time 0. If False the simulated arm is put into the first
        state in flight: no arm can do that.
    consistent : bool
        Take the reference's velocity and acceleration by differences of its samples: what a semi-implicit
        engine follows without error. If False they are the derivatives of the spline.
    simulator : callable
        ``simulator(arm, time_step)`` gives a ``Simulator``; ``functools.partial(Bullet, floor=None)`` has no
        ground.
    progress : callable, optional
        Called as ``progress(done, total)`` every hundred steps and at the end.

    Returns
    -------
    ExecutionLog
        Its ``verdict`` says what held and what did not. A run whose state is no longer finite stops there.

    Raises
    ------
    InvalidArgument
        The trajectory does not fit the arm, or an option is out of range.
    MissingDependency
        The engine is not installed.
    """
    _refuse(arm, joints, rate, mode, kp, kd, settle)
    reference = sample(arm, joints, rate, settle=settle, from_rest=from_rest, consistent=consistent)
    with simulator(arm, 1.0 / rate) as engine:
        recorder = _Recorder(len(reference.time), arm.joint_count)
        drive = _computed_torque(kp, kd, arm.effort_limit) if mode == "computed_torque" else _servo
        done = _run(engine, reference, drive, recorder, progress)
        name, repaired = engine.name, engine.repaired_links
    return ExecutionLog(
        arm=arm,
        joints=joints,
        simulator=name,
        mode=mode,
        rate=rate,
        motion=reference.motion,
        planned_steps=len(reference.time),
        repaired_links=repaired,
        time=reference.time[:done],
        desired_position=reference.position[:done],
        desired_velocity=reference.velocity[:done],
        desired_tool_pose=arm.forward_kinematics(reference.position[:done]),
        **recorder.arrays(done),
        contacts=tuple(ContactEvent(k, float(reference.time[k]), c) for k, c in recorder.contacts),
    )


def contacts_along(
    arm: Arm,
    position: NDArray[np.float64],
    *,
    simulator: Callable[[Arm, float], Simulator] = Bullet,
) -> list[tuple[int, Contact]]:
    """Contacts of the arm with itself and the floor at joints (T, n), without dynamics: (index, contact)."""
    with simulator(arm, 1e-3) as engine:
        return [(k, contact) for k, q in enumerate(position) for contact in engine.contacts_at(q)]


Drive = Callable[[Simulator, Reference, int], tuple[NDArray[np.float64], NDArray[np.float64]]]
"""Makes step k of the engine; returns the torque wanted and the torque given, (n,) Nm each."""


def _run(engine: Simulator, reference: Reference, drive: Drive, recorder: _Recorder, progress: Progress | None) -> int:
    """Drive the engine along the reference; returns the steps done while the state was finite."""
    total = len(reference.time)
    engine.reset(reference.position[0], reference.velocity[0])
    for k in range(total):
        if not recorder.state(k, engine):
            return k
        recorder.torques(k, *drive(engine, reference, k))
        recorder.contacts += [(k, contact) for contact in engine.contacts()]
        if progress and ((k + 1) % _PROGRESS_STEPS == 0 or k + 1 == total):
            progress(k + 1, total)
    return total


def _computed_torque(kp: float, kd: float, limit: NDArray[np.float64]) -> Drive:
    def drive(engine: Simulator, reference: Reference, k: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        position, velocity = engine.state()
        acceleration = reference.acceleration[k] + kd * (reference.velocity[k] - velocity)
        demand = engine.inverse_dynamics(acceleration + kp * (reference.position[k] - position))
        torque = np.minimum(np.maximum(demand, -limit), limit)
        engine.apply_torque(torque)
        engine.step()
        return demand, torque

    return drive


def _servo(engine: Simulator, reference: Reference, k: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    engine.servo(reference.position[min(k + 1, len(reference.time) - 1)])
    engine.step()
    torque = engine.servo_torque()
    return torque, torque


class _Recorder:
    """Arrays of the whole run, taken before it starts."""

    def __init__(self, steps: int, joints: int) -> None:
        self._position = np.empty((steps, joints))
        self._velocity = np.empty((steps, joints))
        self._demand = np.empty((steps, joints))
        self._torque = np.empty((steps, joints))
        self._tool_pose = np.empty((steps, 4, 4))
        self.contacts: list[tuple[int, Contact]] = []

    def state(self, k: int, engine: Simulator) -> bool:
        """Record where the arm is; False if that is not finite."""
        position, velocity = engine.state()
        self._position[k], self._velocity[k] = position, velocity
        self._tool_pose[k] = engine.tool_pose()
        return math.isfinite(position.sum() + velocity.sum())  # one bad number spoils the sum

    def torques(self, k: int, demand: NDArray[np.float64], torque: NDArray[np.float64]) -> None:
        self._demand[k], self._torque[k] = demand, torque

    def arrays(self, done: int) -> dict[str, NDArray[np.float64]]:
        return {
            "position": self._position[:done],
            "velocity": self._velocity[:done],
            "torque_demand": self._demand[:done],
            "torque": self._torque[:done],
            "tool_pose": self._tool_pose[:done],
        }


def _refuse(arm: Arm, joints: JointTrajectory, rate: float, mode: str, kp: float, kd: float, settle: float) -> None:
    """Turn down what can not be carried out, before anything is loaded."""
    if mode not in CAVEATS:
        raise InvalidArgument(f"mode: '{mode}', expected one of {', '.join(CAVEATS)}.")
    if not 10.0 <= rate <= 1e5:
        raise InvalidArgument(f"rate: {rate}, expected 10 to 100000 Hz.")
    for name, value in (("kp", kp), ("kd", kd), ("settle", settle)):
        if not 0.0 <= value < np.inf:
            raise InvalidArgument(f"{name}: {value}, expected a number >= 0.")
    _refuse_joints(arm, joints)
    weak = np.flatnonzero(arm.effort_limit <= 0.0)
    if len(weak):
        raise InvalidArgument(
            f"arm.effort_limit[{weak[0]}]: {arm.effort_limit[weak[0]]}, expected a positive torque for "
            f"'{arm.joint_names[weak[0]]}'. State the real ones with arm.with_limits(effort=...)."
        )


def _refuse_joints(arm: Arm, joints: JointTrajectory) -> None:
    if list(joints.joint_names) != list(arm.joint_names):
        raise InvalidArgument(
            f"joints.joint_names: {list(joints.joint_names)}, expected {list(arm.joint_names)}. "
            "Solve the inverse kinematics with this arm."
        )
    if len(joints.time) < 2:
        raise InvalidArgument(f"joints: {len(joints.time)} sample(s), expected at least 2.")
    backwards = np.flatnonzero(~(np.diff(joints.time) > 0.0))
    if len(backwards):
        k = backwards[0] + 1
        raise InvalidArgument(f"joints.time[{k}]: {joints.time[k]} s after {joints.time[k - 1]} s: it runs backwards.")
    for name in ("position", "velocity", "acceleration"):
        bad = np.flatnonzero(~np.isfinite(getattr(joints, name)).all(axis=1))
        if len(bad):
            raise InvalidArgument(f"joints.{name}[{bad[0]}]: not finite. See the inverse kinematics' report.")
