"""What the controller follows: a joint trajectory sampled at the control rate, from rest to rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.sending import (
    INTERPOLATIONS,
    LEAD_ACCELERATION,
    Interpolation,
    RestToRest,
    States,
    interpolated,
    states_at,
)
from dmpcpp.sending import from_rest_to_rest as led_in_and_out

__all__ = [
    "INTERPOLATIONS",
    "LEAD_ACCELERATION",
    "Interpolation",
    "Reference",
    "from_rest_to_rest",
    "sample",
    "states_at",
]


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


def sample(
    arm: Arm,
    joints: JointTrajectory | RestToRest,
    rate: float,
    *,
    settle: float,
    from_rest: bool,
    consistent: bool,
    interpolation: Interpolation = "quintic",
) -> Reference:
    """Sample a joint trajectory at ``rate`` [Hz], from rest to rest.

    Between its samples the trajectory is the quintic through their positions, velocities and accelerations, or
    the cubic through the first two. A motion cut from a recording starts and ends in mid-swing: the lead-in and the
    lead-out of ``sending.from_rest_to_rest`` run the arm up to the first state and stop it after the last. Then the
    last position is held for ``settle`` seconds.

    ``consistent`` replaces velocity and acceleration by the differences of the positions,
    qd[k] = (q[k] - q[k-1]) / dt and qdd[k] = (q[k+1] - 2 q[k] + q[k-1]) / dt^2. These are what an engine with
    semi-implicit Euler steps (qd += dt qdd; q += dt qd) needs to meet every sample exactly.
    """
    whole = joints if isinstance(joints, RestToRest) else led_in_and_out(arm, joints)
    origin, (first, last) = whole.origin, whole.path
    begin = whole.time[0] if from_rest else origin
    before = _steps(origin - begin, rate)
    after = _steps(whole.time[-1] - origin + settle, rate)
    inside = slice(before - _whole_steps(origin - first, rate), before + _whole_steps(last - origin, rate) + 1)
    steps = np.arange(-before - 1, after + 2)  # one more on either side for the differences
    states = _states(whole, origin + steps / rate, interpolation, stands=from_rest)
    if consistent:
        states = _differences(states[0], 1.0 / rate)
    position, velocity, acceleration = (state[1:-1] for state in states)
    return Reference(steps[1:-1] / rate, position, velocity, acceleration, inside)


def from_rest_to_rest(arm: Arm, joints: JointTrajectory, rate: float) -> Reference:
    """Sample a trajectory at ``rate`` [Hz] with its lead-in and lead-out: what an arm that stands can be sent.

    Velocities and accelerations are the derivatives of the quintic; both ends are at rest, exactly.
    """
    return sample(arm, joints, rate, settle=0.0, from_rest=True, consistent=False)


def _steps(duration: float, rate: float) -> int:
    """Steps that cover a duration; a rounding error is none."""
    return int(np.ceil(duration * rate - 1e-6))


def _whole_steps(duration: float, rate: float) -> int:
    """Steps that fit into a duration."""
    return int(np.floor(duration * rate + 1e-6))


def _states(whole: RestToRest, time: Array, way: Interpolation, *, stands: bool) -> States:
    """States at ``time`` on the clock of the joints; at rest behind their end and, if it stands, before them.

    A motion that is met in flight has the velocity of its first sample before it.
    """
    begin, end = whole.time[0] if stands else whole.time[whole.motion.start], whole.time[-1]
    position, velocity, acceleration = interpolated(whole, np.clip(time, begin, end), way)
    resting = (time >= end) | (time <= begin) if stands else time >= end
    velocity[resting], acceleration[resting] = 0.0, 0.0
    early = time < begin
    if not stands and early.any():
        position[early] += (time[early] - begin)[:, None] * velocity[early]
        acceleration[early] = 0.0
    return position, velocity, acceleration


def _differences(position: Array, dt: float) -> States:
    velocity, acceleration = np.zeros_like(position), np.zeros_like(position)
    velocity[1:] = np.diff(position, axis=0) / dt
    acceleration[1:-1] = np.diff(position, n=2, axis=0) / dt**2
    return position, velocity, acceleration
