"""What the controller follows: a joint trajectory sampled at the control rate, from rest to rest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array

LEAD_ACCELERATION = 5.0  # rad/s^2 (m/s^2): gentle beside what arms can do (10 to 20)
_LEAD_SHARE = 0.9  # of the acceleration limits that lead-in and lead-out use at most

Interpolation = Literal["quintic", "cubic"]
INTERPOLATIONS: tuple[str, ...] = get_args(Interpolation)


@dataclass(frozen=True)
class Reference:
    """Joint states to follow, one a control step.

    Attributes
    ----------
    time : (N,) s; 0 is the first sample of the trajectory, the lead-in before it is negative
    position, velocity, acceleration : (N, n) rad, rad/s, rad/s^2
    motion : slice
        The steps that belong to the trajectory itself: those without lead-in, lead-out and settling.
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    motion: slice


States = tuple[Array, Array, Array]
"""Position, velocity and acceleration, (N, n) each."""
Between = Callable[[JointTrajectory, Array], States]
"""Interpolates a trajectory at times (N,)."""


def sample(
    arm: Arm,
    joints: JointTrajectory,
    rate: float,
    *,
    settle: float,
    from_rest: bool,
    consistent: bool,
    interpolation: Interpolation = "quintic",
) -> Reference:
    """Sample a joint trajectory at ``rate`` [Hz], from rest to rest.

    Between its samples the trajectory is the quintic through their positions, velocities and accelerations, or
    the cubic through the first two. A motion cut from a recording starts and ends in mid-swing: a lead-in runs
    the arm up to the first state and a lead-out stops it after the last, both with a smoothstep velocity
    3 u^2 - 2 u^3 of at most LEAD_ACCELERATION (more where a joint limit is near). Then the last position is
    held for ``settle`` seconds.

    ``consistent`` replaces velocity and acceleration by the differences of the positions,
    qd[k] = (q[k] - q[k-1]) / dt and qdd[k] = (q[k+1] - 2 q[k] + q[k-1]) / dt^2. These are what an engine with
    semi-implicit Euler steps (qd += dt qdd; q += dt qd) needs to meet every sample exactly.
    """
    dt, duration = 1.0 / rate, float(joints.time[-1] - joints.time[0])
    lead_in = _ramp_duration(arm, joints.position[0], -joints.velocity[0]) if from_rest else 0.0
    lead_out = _ramp_duration(arm, joints.position[-1], joints.velocity[-1])
    before = int(np.ceil(lead_in / dt - 1e-9))
    inside = int(np.floor(duration / dt + 1e-6)) + 1
    after = int(np.ceil((lead_out + settle) / dt - 1e-9))
    steps = np.arange(-before - 1, inside + after + 1)  # one more on either side for the differences
    states = _states(joints, steps / rate, lead_in, lead_out, _cubic if interpolation == "cubic" else _quintic)
    if consistent:
        states = _differences(states[0], dt)
    position, velocity, acceleration = (state[1:-1] for state in states)
    return Reference(steps[1:-1] / rate, position, velocity, acceleration, slice(before, before + inside))


def from_rest_to_rest(arm: Arm, joints: JointTrajectory, rate: float) -> Reference:
    """Sample a trajectory at ``rate`` [Hz] with its lead-in and lead-out: what an arm that stands can be sent.

    Velocities and accelerations are the derivatives of the quintic; both ends are at rest.
    """
    return sample(arm, joints, rate, settle=0.0, from_rest=True, consistent=False)


def states_at(joints: JointTrajectory, time: Array) -> States:
    """Position, velocity and acceleration at ``time`` (N,) s after the first sample, by the quintic.

    Before the first sample and after the last the trajectory stands still there.
    """
    end = joints.time[-1] - joints.time[0]
    position, velocity, acceleration = _quintic(joints, np.clip(time, 0.0, end) + joints.time[0])
    moving = ((time >= 0.0) & (time <= end))[:, None]
    return position, np.where(moving, velocity, 0.0), np.where(moving, acceleration, 0.0)


def _states(joints: JointTrajectory, time: Array, lead_in: float, lead_out: float, between: Between) -> States:
    """The whole reference at ``time``, counted from the first sample of the trajectory."""
    end = joints.time[-1] - joints.time[0]
    early, late = time < 0.0, time > end
    position, back, acceleration = _ramp(joints.position[0], -joints.velocity[0], -time[early], lead_in)
    pieces = (
        (position, -back, acceleration),  # the lead-in is a lead-out seen backwards
        between(joints, time[~early & ~late] + joints.time[0]),
        _ramp(joints.position[-1], joints.velocity[-1], time[late] - end, lead_out),
    )
    position, velocity, acceleration = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    return position, velocity, acceleration


def _ramp_duration(arm: Arm, position: Array, velocity: Array) -> float:
    """How long to take from ``velocity`` to rest: gently, but short of the joint limits if that can be."""
    speed = np.abs(velocity)
    gentle = float(np.max(1.5 * speed / np.minimum(LEAD_ACCELERATION, _LEAD_SHARE * arm.acceleration_limit)))
    room = np.where(velocity > 0.0, arm.upper - position, position - arm.lower)
    moving = speed > 1e-9
    nearest = float(np.min(2.0 * room[moving] / speed[moving], initial=np.inf))
    return min(gentle, max(nearest, 0.02))


def _ramp(position: Array, velocity: Array, time: Array, duration: float) -> States:
    """Slow down from ``velocity`` to rest within ``duration``, ``time`` (N,) >= 0 after ``position``.

    v(u) = v0 (1 - 3 u^2 + 2 u^3) with u = t / duration, peak acceleration 1.5 v0 / duration. A duration of 0
    keeps the velocity: what lies one step beside a motion that is met in flight.
    """
    t = time[:, None]
    if duration == 0.0:
        return position + t * velocity, np.repeat(velocity[None], len(t), 0), np.zeros_like(t * velocity)
    u = np.minimum(t / duration, 1.0)
    return (
        position + velocity * duration * (u - u**3 + 0.5 * u**4),
        velocity * (1.0 - 3.0 * u**2 + 2.0 * u**3),
        velocity / duration * (6.0 * u**2 - 6.0 * u),
    )


def _quintic(joints: JointTrajectory, time: Array) -> States:
    """The piecewise quintic with position, velocity and acceleration of every sample: C2."""
    k, h, s = _intervals(joints.time, time)
    p, v, a = joints.position[k], joints.velocity[k], joints.acceleration[k]
    gap = joints.position[k + 1] - (p + h * (v + 0.5 * h * a))
    slope = h * (joints.velocity[k + 1] - (v + h * a))
    bend = h**2 * (joints.acceleration[k + 1] - a)
    c3, c4, c5 = 10 * gap - 4 * slope + bend / 2, -15 * gap + 7 * slope - bend, 6 * gap - 3 * slope + bend / 2
    c3, c4, c5 = c3 / h**3, c4 / h**4, c5 / h**5
    return (
        p + s * (v + s * (a / 2 + s * (c3 + s * (c4 + s * c5)))),
        v + s * (a + s * (3 * c3 + s * (4 * c4 + s * 5 * c5))),
        a + s * (6 * c3 + s * (12 * c4 + s * 20 * c5)),
    )


def _cubic(joints: JointTrajectory, time: Array) -> States:
    """The piecewise cubic with position and velocity of every sample (Hermite): C1."""
    k, h, s = _intervals(joints.time, time)
    p, v = joints.position[k], joints.velocity[k]
    gap = (joints.position[k + 1] - p) / h - v
    slope = joints.velocity[k + 1] - v
    c2, c3 = (3 * gap - slope) / h, (slope - 2 * gap) / h**2
    return p + s * (v + s * (c2 + s * c3)), v + s * (2 * c2 + s * 3 * c3), 2 * c2 + 6 * s * c3


def _intervals(knots: Array, time: Array) -> tuple[NDArray[np.intp], Array, Array]:
    """The sample before each time, the length (N, 1) of the interval that it opens, the time (N, 1) in it."""
    k = np.clip(np.searchsorted(knots, time, side="right") - 1, 0, len(knots) - 2)
    return k, (knots[k + 1] - knots[k])[:, None], (time - knots[k])[:, None]


def _differences(position: Array, dt: float) -> States:
    velocity, acceleration = np.zeros_like(position), np.zeros_like(position)
    velocity[1:] = np.diff(position, axis=0) / dt
    acceleration[1:-1] = np.diff(position, n=2, axis=0) / dt**2
    return position, velocity, acceleration
