"""Carry out a joint trajectory on a simulated arm: torques in, everything measured out."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import asdict

import numpy as np

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import POSE, Disturbance, Follow
from dmpcpp.sending import RestToRest
from dmpcpp.simulation._control import MODES, ComputedTorque, Controller, Gains, Mode, Servo
from dmpcpp.simulation._control_loop import ControlLoop, Progress, Recorder, Sensors, by_motors, by_torque
from dmpcpp.simulation._default import default_simulator
from dmpcpp.simulation._dynamics_check import DynamicsMismatch, dynamics_mismatch
from dmpcpp.simulation._execution_log import ContactEvent, ExecutionLog
from dmpcpp.simulation._reference import INTERPOLATIONS, Interpolation, Reference, sample
from dmpcpp.simulation._simulator import Simulator


def execute(
    arm: Arm,
    joints: JointTrajectory | RestToRest,
    *,
    rate: float = 1000.0,
    mode: Mode = "computed_torque",
    kp: float = 1600.0,
    kd: float = 80.0,
    ki: float = 0.0,
    settle: float = 0.5,
    from_rest: bool = True,
    consistent: bool = True,
    interpolation: Interpolation = "quintic",
    disturbance: Disturbance | None = None,
    simulator: Callable[..., Simulator] = default_simulator,
    follow: str | Follow = POSE,
    progress: Progress | None = None,
) -> ExecutionLog:
    """Carry out ``joints`` on ``arm`` under physics; two calls give the same log bit for bit.

    Parameters
    ----------
    arm : Arm
    joints : JointTrajectory or RestToRest
        (T, n), T >= 2, in the order of ``arm.joint_names``; with its leads as they are to be carried out, or without:
        then they are found.
    rate : float
        Control and physics steps a second [Hz], 10 to 1e5.
    mode : {"computed_torque", "position", "position_velocity", "velocity"}
        ``"computed_torque"``: torque = inverse dynamics of (qdd_ref + kd (qd_ref - qd) + kp (q_ref - q) + ki
        integral of (q_ref - q)) in the state that is seen, clipped at the effort limits (Siciliano et al.,
        Robotics, 2009, section 8.5.2). The others are sanity checks: the engine's own motors reach a velocity
        inside the step, which tests kinematics and the torque cap only and cannot feel a load. Commanded velocity,
        T the control period: ``"position"``: (q_ref[next] - q)/T; ``"position_velocity"``: qd_ref + (q_ref - q)/T;
        ``"velocity"``: qd_ref + 10/s (q_ref - q).
    kp, kd, ki : float
        Gains of the computed torque [1/s^2, 1/s, 1/s^3], >= 0; critically damped where kd = 2 sqrt(kp), stable
        where ki < kp kd. An integral takes away what a constant load leaves.
    settle : float
        How long the arm holds the last position [s], >= 0.
    from_rest : bool
        Run up to the first state from rest, before time 0. If False the simulated arm is put into the first
        state in flight: no arm can do that.
    consistent : bool
        Take the reference's velocity and acceleration by differences of its samples: what a semi-implicit
        engine follows without error. If False they are the derivatives of the spline.
    interpolation : {"quintic", "cubic"}
        Between the samples: through their positions, velocities and accelerations, or without the last.
    disturbance : Disturbance, optional
        What the controller does not know.
    simulator : callable
        ``simulator(arm, time_step)`` gives a ``Simulator``; ``functools.partial(Bullet, floor=None)`` has no
        ground. With a disturbance of the arm also called with ``disturbance=``.
    follow : str or Follow
        The part of the tool's pose that is judged, the part that the arm follows: "pose", "position", "axis:z", ..
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
    disturbance = disturbance or Disturbance()
    gains, judged = Gains(kp, kd, ki), Follow.of(follow)
    _refuse(arm, joints, rate, mode, interpolation, gains, settle)
    hold = _hold(rate, disturbance)
    reference = sample(
        arm, joints, rate, settle=settle, from_rest=from_rest, consistent=consistent, interpolation=interpolation
    )
    with ExitStack() as engines:
        plant, model = _plant_and_model(engines, simulator, arm, 1.0 / rate, disturbance)
        dynamics = dynamics_mismatch(model, arm)
        if mode == "computed_torque":
            controller: Controller = ComputedTorque(model, gains, arm.effort_limit, hold / rate)
            drive = by_torque(arm.effort_limit)
        else:
            controller, drive = Servo(mode, hold / rate, hold), by_motors
        recorder = Recorder(len(reference.time), arm.joint_count)
        ControlLoop(plant, controller, drive, Sensors(disturbance, 1.0 / rate), hold).run(reference, recorder, progress)
        return _log(joints, mode, plant, reference, recorder, disturbance, judged, dynamics)


def _log(
    joints: JointTrajectory | RestToRest,
    mode: str,
    plant: Simulator,
    reference: Reference,
    recorder: Recorder,
    disturbance: Disturbance,
    follow: Follow,
    dynamics: DynamicsMismatch,
) -> ExecutionLog:
    done = slice(recorder.done)
    return ExecutionLog(
        arm=plant.arm,
        joints=joints.joints if isinstance(joints, RestToRest) else joints,
        simulator=plant.name,
        mode=mode,
        rate=1.0 / plant.time_step,
        motion=reference.motion,
        planned_steps=len(reference.time),
        inertia_repairs=plant.inertia_repairs,
        time=reference.time[done],
        desired_position=reference.position[done],
        desired_velocity=reference.velocity[done],
        desired_tool_pose=plant.arm.forward_kinematics(reference.position[done]),
        **recorder.arrays(),
        contacts=tuple(ContactEvent(k, float(reference.time[k]), c) for k, c in recorder.contacts),
        disturbance=disturbance,
        follow=follow,
        dynamics=dynamics,
    )


def _hold(rate: float, disturbance: Disturbance) -> int:
    """Steps between two actions of the controller."""
    if disturbance.control_rate is None:
        return 1
    hold = round(rate / disturbance.control_rate)
    if hold < 1 or abs(hold * disturbance.control_rate - rate) > 1e-9 * rate:
        raise InvalidArgument(
            f"disturbance.control_rate: {disturbance.control_rate:g} Hz does not divide the simulation's {rate:g} Hz."
        )
    return hold


def _plant_and_model(
    engines: ExitStack, simulator: Callable[..., Simulator], arm: Arm, time_step: float, disturbance: Disturbance
) -> tuple[Simulator, Simulator]:
    """The arm that moves, and the one that its controller believes in: the same unless it is disturbed."""
    model = engines.enter_context(simulator(arm, time_step))
    if not disturbance.changes_arm:
        return model, model
    return engines.enter_context(simulator(arm, time_step, disturbance=disturbance)), model


def _refuse(
    arm: Arm,
    joints: JointTrajectory | RestToRest,
    rate: float,
    mode: str,
    interpolation: str,
    gains: Gains,
    settle: float,
) -> None:
    """Turn down what cannot be carried out, before anything is loaded."""
    for name, choice, known in (("mode", mode, MODES), ("interpolation", interpolation, INTERPOLATIONS)):
        if choice not in known:
            raise InvalidArgument(f"{name}: '{choice}', expected one of {', '.join(known)}.")
    if not 10.0 <= rate <= 1e5:
        raise InvalidArgument(f"rate: {rate}, expected 10 to 100000 Hz.")
    for name, value in (*asdict(gains).items(), ("settle", settle)):
        if not 0.0 <= value < np.inf:
            raise InvalidArgument(f"{name}: {value}, expected a number >= 0.")
    _refuse_joints(arm, joints)
    weak = np.flatnonzero(arm.effort_limit <= 0.0)
    if len(weak):
        raise InvalidArgument(
            f"arm.effort_limit[{weak[0]}]: {arm.effort_limit[weak[0]]}, expected a positive torque for "
            f"'{arm.joint_names[weak[0]]}'. State the real ones with arm.with_limits(effort=...)."
        )


def _refuse_joints(arm: Arm, joints: JointTrajectory | RestToRest) -> None:
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
