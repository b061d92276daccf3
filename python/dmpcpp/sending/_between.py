"""Joints between their samples: the quintic through positions, velocities and accelerations, or the cubic."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Protocol, get_args

import numpy as np
from numpy.typing import NDArray

from dmpcpp._typing import Array

__all__ = [
    "INTERPOLATIONS",
    "Interpolation",
    "JointMotion",
    "States",
    "interpolated",
    "quintic_coefficients",
    "states_at",
]

Interpolation = Literal["quintic", "cubic"]
INTERPOLATIONS: tuple[str, ...] = get_args(Interpolation)

States = tuple[Array, Array, Array]
"""Position, velocity and acceleration, (N, n) each."""


class JointMotion(Protocol):
    """Joints over time: a dmpcpp.JointTrajectory, or anything with its fields."""

    @property
    def time(self) -> Array:
        """(T,) s, strictly increasing."""

    @property
    def position(self) -> Array:
        """(T, n) rad or m."""

    @property
    def velocity(self) -> Array:
        """(T, n) per s."""

    @property
    def acceleration(self) -> Array:
        """(T, n) per s^2."""

    @property
    def joint_names(self) -> Sequence[str]:
        """(n,)."""


def states_at(joints: JointMotion, time: Array) -> States:
    """Position, velocity and acceleration at ``time`` (N,) s after the first sample, by the quintic.

    Before the first sample and after the last the joints stand still there.
    """
    end = joints.time[-1] - joints.time[0]
    position, velocity, acceleration = interpolated(joints, np.clip(time, 0.0, end) + joints.time[0])
    moving = ((time >= 0.0) & (time <= end))[:, None]
    return position, np.where(moving, velocity, 0.0), np.where(moving, acceleration, 0.0)


def interpolated(joints: JointMotion, time: Array, way: Interpolation = "quintic") -> States:
    """Position, velocity and acceleration at ``time`` (N,) s on the clock of the joints, within their samples."""
    return _cubic(joints, time) if way == "cubic" else _quintic(joints, time)


def quintic_coefficients(joints: JointMotion) -> Array:
    """Polynomials (T - 1, 6, n) in the time since each sample, lowest power first: C2 through all states."""
    p, v, a = (getattr(joints, name) for name in ("position", "velocity", "acceleration"))
    return _coefficients(np.diff(joints.time)[:, None], (p[:-1], v[:-1], a[:-1]), (p[1:], v[1:], a[1:]))


def _coefficients(h: Array, before: States, after: States) -> Array:
    p, v, a = before
    gap = after[0] - (p + h * (v + 0.5 * h * a))
    slope = h * (after[1] - (v + h * a))
    bend = h**2 * (after[2] - a)
    c3, c4, c5 = 10 * gap - 4 * slope + bend / 2, -15 * gap + 7 * slope - bend, 6 * gap - 3 * slope + bend / 2
    return np.stack([p, v, a / 2, c3 / h**3, c4 / h**4, c5 / h**5], axis=1)


def _quintic(joints: JointMotion, time: Array) -> States:
    """The piecewise quintic with position, velocity and acceleration of every sample: C2."""
    k, h, s = _intervals(joints.time, time)
    p, v, a = (getattr(joints, name) for name in ("position", "velocity", "acceleration"))
    c = _coefficients(h, (p[k], v[k], a[k]), (p[k + 1], v[k + 1], a[k + 1]))
    c0, c1, c2, c3, c4, c5 = (c[:, i] for i in range(6))
    return (
        c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
        c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5))),
        2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5)),
    )


def _cubic(joints: JointMotion, time: Array) -> States:
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
