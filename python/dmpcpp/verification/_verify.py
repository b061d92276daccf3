"""A recorded run under the measures and checks of a simulated one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import butter, sosfiltfilt

from dmpcpp import metrics
from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Checked, accepted_names
from dmpcpp.comparison import MotionComparison, compare_motions
from dmpcpp.errors import InvalidArgument
from dmpcpp.export import JointSamples
from dmpcpp.robot import POSE, Follow, assumptions, limits_summary, unjudged
from dmpcpp.sending import states_at
from dmpcpp.simulation import ExecutionLog, Simulator, Tolerances, judge, path_checks
from dmpcpp.verification._joint_log import JointLog
from dmpcpp.verification._lag import estimate_lag

_AROUND = 1.0  # s of the log before and after the motion that are looked at too
_COVERAGE = 0.99  # share of the plan that the log must hold
_GAP = 0.1  # s; a longer silence of the log hides too much
_SAMPLES = 4  # of the log within the motion, at least
_TURN = 2.0 * np.pi  # rad (m); no joint is that far beyond its limits: it is another unit
_NOT_RECORDED = (
    "finite",
    "self_collision",
    "floor_contact",
    "object_contact",
    "inertia",
    "kinematics_mismatch",
    "jerk_ratio",  # an encoder's noise is not a motion's jerk
    "dynamics_mismatch",
)
_NO_TORQUE = "the log holds no torques: they are not judged"
_OF_TORQUE = ("torque_ratio", "torque_clipped")


@dataclass(frozen=True, eq=False)
class Verification(Checked):
    """How a real arm carried out a plan.

    Attributes
    ----------
    lag : float
        Start of the plan on the log's clock [s]: a clock offset. Tracking delay: `comparison.lag`.
    log : ExecutionLog
        The run on the plan's clock, sampled evenly; its mode is "recorded".
    comparison : MotionComparison
        Of the tool, against the forward kinematics of the plan; the lag is already taken out.
    velocity_margin, torque_margin : float or None
        ``metrics.margin`` to the arm's limits; None where the limits are unknown, or without torques in the log.
    checks : tuple of Check
    notes : tuple of str
        What reading the log changed.
    accepted : tuple of str
        Checks that a person takes although they were not judged.
    """

    lag: float
    log: ExecutionLog
    comparison: MotionComparison
    velocity_margin: float | None
    torque_margin: float | None
    checks: tuple[Check, ...]
    notes: tuple[str, ...] = ()
    accepted: tuple[str, ...] = ()

    def summary(self) -> dict[str, Any]:
        """For JSON; m, rad, s."""
        return {
            **self.judged(),
            "arm": self.log.arm.name,
            "source": self.log.simulator,
            "mode": self.log.mode,
            "caveat": self.log.caveat,
            "notes": list(self.notes),
            "lag": self.lag,
            "rate": self.log.rate,
            "comparison": self.comparison.to_dict(),
            "velocity_margin": self.velocity_margin,
            "torque_margin": self.torque_margin,
            "limits": limits_summary(self.log.arm),
            "assumed": list(assumptions(self.log.arm)),
        }


def verify(
    arm: Arm,
    joints: JointTrajectory | JointSamples,
    log: JointLog,
    *,
    tolerances: Tolerances | None = None,
    cutoff: float = 20.0,
    simulator: Callable[[Arm, float], Simulator] | None = None,
    accept: Iterable[str] = (),
    follow: str | Follow = POSE,
) -> Verification:
    """Hold the log of a real arm against the plan that it was given.

    The log is moved by its estimated lag onto the plan's clock, and sampled evenly at the median of its own rate by
    the cubic spline through it. Tool poses are the arm's forward kinematics of the measured joints. Velocity is the
    measured one, or else the derivative of the spline, and acceleration its difference: both after a zero-phase
    Butterworth low-pass, since the noise of an encoder is no motion.

    Parameters
    ----------
    arm : Arm
    joints : JointTrajectory or JointSamples
        The plan. Where lead-in and lead-out are in it (``JointSamples.motion``), tracking is judged over the motion and
        limits over all.
    log : JointLog
        Of any joints, the arm's among them.
    tolerances : Tolerances, optional
    cutoff : float
        Of the low-pass [Hz], > 0; without effect from 0.45 of the log's rate.
    follow : str or Follow
        The part of the tool's pose that is judged, the part that the arm follows: "pose", "position", "axis:z", ..
    simulator : callable, optional
        Engine in whose geometry the executed joints are looked at for contacts; None: not looked at.
    accept : iterable of str
        Names of checks (`checks.ACCEPTABLE`) that may remain unjudged for lack of a limit; one that is judged and fails
        is never accepted.

    Raises
    ------
    InvalidArgument
        Plan joints differ from the arm's, the log lacks a joint, positions far beyond limits (degrees?), too few log
        samples within the plan, or a plan that does not move.
    """
    _refuse(arm, joints, cutoff)
    follow = Follow.of(follow)
    accepted = accepted_names(accept)
    of_arm = log.of(arm.joint_names)
    _refuse_another_unit(arm, of_arm)
    lag = estimate_lag(joints, of_arm) + _begin(joints)
    run = replace(_on_the_plans_clock(arm, joints, of_arm, lag, cutoff), follow=follow)
    during = run.motion
    checks = (*_log_checks(joints, of_arm, lag), *_checks(run, tolerances, of_arm.torque is not None))
    if simulator is not None:
        zero = np.zeros_like(run.position[during])
        executed = JointSamples(run.time[during], run.position[during], zero, zero, tuple(arm.joint_names))
        checks = (*checks, *path_checks(arm, executed, simulator=simulator))
    return Verification(
        lag=lag,
        log=run,
        comparison=compare_motions(run.desired_tool_pose[during], run.tool_pose[during], run.rate),
        velocity_margin=_margin(arm, "velocity", run.velocity, arm.velocity_limit),
        torque_margin=None if of_arm.torque is None else _margin(arm, "effort", run.torque, arm.effort_limit),
        checks=checks,
        notes=of_arm.notes if of_arm.torque is not None else (*of_arm.notes, _NO_TORQUE),
        accepted=accepted,
    )


def _begin(joints: JointTrajectory | JointSamples) -> float:
    """How long after the first sample the motion begins [s]: behind its lead-in, if there is one."""
    motion = getattr(joints, "motion", None)
    return float(joints.time[motion.start] - joints.time[0]) if motion else 0.0


def _duration(joints: JointTrajectory | JointSamples) -> float:
    """Of the motion, without lead-in and lead-out [s]."""
    time = joints.time[getattr(joints, "motion", None) or slice(None)]
    return float(time[-1] - time[0])


def _margin(arm: Arm, kind: str, values: Array, limit: Array) -> float | None:
    return None if unjudged(arm, kind) else metrics.margin(values, limit)


def _refuse(arm: Arm, joints: JointTrajectory | JointSamples, cutoff: float) -> None:
    if list(joints.joint_names) != list(arm.joint_names):
        raise InvalidArgument(f"joints: {list(joints.joint_names)}, expected those of the arm, {arm.joint_names}.")
    if len(joints.time) < 2:
        raise InvalidArgument(f"joints: {len(joints.time)} sample(s), expected at least 2.")
    if not 0.0 < cutoff < np.inf:
        raise InvalidArgument(f"cutoff: {cutoff}, expected a positive number of Hz.")


def _refuse_another_unit(arm: Arm, log: JointLog) -> None:
    beyond = np.maximum(log.position - arm.upper, arm.lower - log.position)
    sample, joint = np.unravel_index(np.argmax(beyond), beyond.shape)
    if beyond[sample, joint] > _TURN:
        raise InvalidArgument(
            f"{log.source}: '{log.joint_names[joint]}' is at {log.position[sample, joint]:.4g} rad, far beyond its "
            f"limits of {arm.lower[joint]:.4g} and {arm.upper[joint]:.4g}. Is the log in degrees (angle_unit)?"
        )


def _on_the_plans_clock(
    arm: Arm, joints: JointTrajectory | JointSamples, log: JointLog, lag: float, cutoff: float
) -> ExecutionLog:
    time, step = _even_times(joints, log, lag)
    inside = np.flatnonzero((time >= -1e-9) & (time <= _duration(joints) + 1e-9))
    spline = CubicSpline(log.time, log.position)
    at = np.clip(time + lag, log.time[0], log.time[-1])
    velocity = spline(at, 1) if log.velocity is None else CubicSpline(log.time, log.velocity)(at)
    torque = np.full_like(velocity, np.nan) if log.torque is None else CubicSpline(log.time, log.torque)(at)
    desired_position, desired_velocity, _ = states_at(joints, time + _begin(joints))
    position = spline(at)
    return ExecutionLog(
        arm=arm,
        joints=joints,
        simulator=log.source,
        mode="recorded",
        rate=1.0 / step,
        motion=slice(int(inside[0]), int(inside[-1]) + 1),
        planned_steps=len(time),
        inertia_repairs=(),
        time=time,
        desired_position=desired_position,
        desired_velocity=desired_velocity,
        desired_tool_pose=arm.forward_kinematics(desired_position),
        position=position,
        velocity=_low_passed(velocity, 1.0 / step, cutoff),
        torque_demand=torque,
        torque=torque,
        tool_pose=arm.forward_kinematics(position),
        contacts=(),
    )


def _even_times(joints: JointTrajectory | JointSamples, log: JointLog, lag: float) -> tuple[Array, float]:
    """Times on the plan's clock from a sample of the log on, in steps of the median during the motion [s]."""
    duration = _duration(joints)
    clock = log.time - lag
    during = clock[(clock >= -1e-9) & (clock <= duration + 1e-9)]
    if len(during) < _SAMPLES:
        raise InvalidArgument(
            f"{log.source}: {len(during)} of its samples lie within the plan's {duration:.3g} s, expected at least "
            f"{_SAMPLES}; they are {np.median(np.diff(log.time)):.3g} s apart. Is its time in another unit (time_unit)?"
        )
    step = float(np.median(np.diff(during)))
    before = _begin(joints)
    after = float(joints.time[-1] - joints.time[0]) - duration - before
    around = clock[(clock >= -before - _AROUND) & (clock <= duration + after + _AROUND)]
    return around[0] + step * np.arange(1 + int((around[-1] - around[0]) / step + 1e-6)), step


def _low_passed(values: Array, rate: float, cutoff: float) -> Array:
    if cutoff >= 0.45 * rate or len(values) < 2:
        return values
    sections = butter(2, cutoff, fs=rate, output="sos")
    return np.asarray(sosfiltfilt(sections, values, axis=0, padlen=min(len(values) - 1, int(3 * rate / cutoff))))


def _log_checks(joints: JointTrajectory | JointSamples, log: JointLog, lag: float) -> tuple[Check, Check]:
    """Whether the log holds the motion, and whole."""
    begin, end = lag, lag + _duration(joints)
    covered = max(0.0, min(end, float(log.time[-1])) - max(begin, float(log.time[0]))) / (end - begin)
    concerned = (log.time[:-1] < end) & (log.time[1:] > begin)  # a silence before or after the motion hides nothing
    gaps = np.where(concerned, np.diff(log.time), 0.0)
    widest = int(np.argmax(gaps))
    detail = "" if covered >= _COVERAGE else "the log begins too late or ends too early"
    return (
        Check("log_coverage", covered >= _COVERAGE, float(covered), _COVERAGE, "1", None, detail),
        Check("log_gap", bool(gaps[widest] <= _GAP), float(gaps[widest]), _GAP, "s", float(log.time[widest] - lag)),
    )


def _checks(run: ExecutionLog, tolerances: Tolerances | None, with_torque: bool) -> tuple[Check, ...]:
    left_out = _NOT_RECORDED if with_torque else (*_NOT_RECORDED, *_OF_TORQUE)
    return tuple(check for check in judge(run, tolerances).checks if check.name not in left_out)
