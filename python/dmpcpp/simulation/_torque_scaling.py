"""How slow a motion must be for the motors: the torque limits as a factor on the duration."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.simulation._default import default_simulator
from dmpcpp.simulation._simulator import Simulator


def torque_duration_factor(
    arm: Arm,
    joints: JointTrajectory,
    *,
    share: float = 0.95,
    simulator: Callable[[Arm, float], Simulator] = default_simulator,
) -> float:
    """The smallest factor on the duration that keeps the torque within ``share`` of the effort limits.

    At s = 1 / factor times the speed the torque of a sample is gravity + s * damping + s^2 * (inertia and
    Coriolis), so each sample and joint gives the largest s by the roots of a quadratic (Hollerbach, "Dynamic
    scaling of manipulator trajectories", ASME J. Dyn. Syst. Meas. Control, 1984). Larger factors hold too.

    Parameters
    ----------
    arm : Arm
    joints : JointTrajectory
    share : float
        Of the effort limit; the rest is left to the feedback.
    simulator : callable
        Gives the engine whose inverse dynamics is asked.

    Returns
    -------
    float
        Factor; below 1 the motion may be that much faster; inf if a pose cannot be held.
    """
    limit = share * np.minimum(arm.effort_limit, np.finfo(np.float64).max)
    with simulator(arm, 1e-3) as engine:
        torque = np.array([_terms(engine, *state) for state in _rows(joints)])
    gravity, damping, inertia = torque.transpose(1, 0, 2)
    if (np.abs(gravity) > limit).any():
        return float("inf")
    speed = np.minimum(_first_root(inertia, damping, gravity - limit), _first_root(inertia, damping, gravity + limit))
    return float(1.0 / speed.min())


def _rows(joints: JointTrajectory) -> zip[tuple[Array, ...]]:
    return zip(joints.position, joints.velocity, joints.acceleration, strict=True)


def _terms(
    engine: Simulator,
    position: Array,
    velocity: Array,
    acceleration: Array,
) -> tuple[Array, ...]:
    """Torque without motion, and its terms in the speed and its square: told apart by going backwards."""
    engine.reset(position, np.zeros_like(velocity))
    gravity = engine.inverse_dynamics(np.zeros_like(acceleration))
    engine.reset(position, velocity)
    forward = engine.inverse_dynamics(acceleration)
    engine.reset(position, -velocity)
    backward = engine.inverse_dynamics(acceleration)
    return gravity, 0.5 * (forward - backward), 0.5 * (forward + backward) - gravity


def _first_root(a: Array, b: Array, c: Array) -> Array:
    """Smallest root s > 0 of a s^2 + b s + c, infinity where there is none."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # a joint without a limit has a huge one
        root = np.sqrt(b * b - 4.0 * a * c)
        q = -0.5 * (b + np.copysign(root, b))  # the two roots are q / a and c / q, without cancellation
        roots = np.stack([q / a, c / q])
    return np.asarray(np.where(roots > 0.0, roots, np.inf).min(axis=0))
