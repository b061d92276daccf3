"""From a moving state to rest, joint by joint, within the limits: a lead-out, and seen backwards a lead-in.

With w = 1 - t / L, the share of a ramp of length L that is left,

    v(w) = A w^3 - B w^4,    A = 4 v0 + a0 L,    B = 3 v0 + a0 L

starts with the velocity v0 and the acceleration a0 and ends (w = 0) with velocity, acceleration and jerk zero. Position
is a quintic in t, so that a quintic through samples on its grid is the ramp itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array

__all__ = ["LEAD_ACCELERATION", "Ramp", "ramp"]

LEAD_ACCELERATION = 5.0
"""rad/s^2 (m/s^2): gentle beside what arms can do (10 to 20)."""
_LEAD_SHARE = 0.9  # of the limits of acceleration and jerk that a ramp uses at most
_JERK_TIME = 0.1  # s in which a gentle ramp reaches the acceleration limit: shorter ones show in tracking
_LONGEST = 3.0  # s


@dataclass(frozen=True, eq=False)
class Ramp:
    """How the joints come to rest.

    Attributes
    ----------
    length : (n,) s
        Of each joint; 0 for one at rest already.
    velocity, acceleration : (n,)
        With which it starts.
    fits : bool
        Whether limits of position, velocity, acceleration and jerk hold; if not, it is the one that comes closest.
    """

    length: Array
    velocity: Array
    acceleration: Array
    fits: bool

    def states(self, position: Array, time: Array) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration (N, n) at ``time`` (N,) >= 0 s after ``position`` (n,)."""
        length = np.where(self.length > 0.0, self.length, 1.0)
        w = np.clip(1.0 - time[:, None] / length, 0.0, 1.0) * (self.length > 0.0)
        a, b = _factors(self.velocity, self.acceleration, self.length)
        return (
            position + _way(a, b, self.length, 1.0) - _way(a, b, self.length, w),
            w**3 * (a - b * w) + 0.0,  # no negative zero at the end
            w**2 * (4.0 * b * w - 3.0 * a) / length + 0.0,
        )


def ramp(arm: Arm, position: Array, velocity: Array, acceleration: Array, step: float) -> Ramp:
    """Find for every joint how long it takes to come to rest, in whole steps [s].

    The shortest gentle ramp, with an acceleration of at most LEAD_ACCELERATION or the motion's own; else, near a
    limit, the gentlest that holds the limits.
    """
    lengths = step * np.arange(1, 1 + max(1, int(np.ceil(_LONGEST / step))))[:, None]
    peaks = _peaks(velocity, acceleration, lengths)
    share = _share(arm, peaks, velocity, acceleration)
    inside = _within(arm, position, _excursion(velocity, acceleration, lengths))
    gentle = _gentle(arm, peaks, acceleration)
    # Cheapest first: within all limits and gentle, by length; within, by acceleration; else what comes closest.
    cost = np.where(inside & (share <= 1.0), np.where(gentle, lengths / 1e3, 1.0 + share), 1e3 * (1.0 + share))
    cost = np.where(inside, cost, 1e6 * (1.0 + lengths))
    best = np.argmin(cost, axis=0)
    moving = (velocity != 0.0) | (acceleration != 0.0)
    found = np.where(moving, lengths[best, 0], 0.0)
    return Ramp(found, velocity, acceleration, bool((np.min(cost, axis=0) < 1e3)[moving].all()))


def _factors(velocity: Array, acceleration: Array, length: Array) -> tuple[Array, Array]:
    return 4.0 * velocity + acceleration * length, 3.0 * velocity + acceleration * length


def _way(a: Array, b: Array, length: Array, w: Array | float) -> Array:
    """How far it is from w to the end: the integral of v over time."""
    return np.asarray(length * w**4 * (a / 4.0 - b * w / 5.0))


def _peaks(velocity: Array, acceleration: Array, length: Array) -> tuple[Array, Array, Array]:
    """Largest |velocity|, |acceleration| and |jerk| of ramps (L, n): at the start, or where the derivative is zero."""
    a, b = _factors(velocity, acceleration, length)
    v = [w**3 * (a - b * w) for w in (1.0, _inside(3.0 * a, 4.0 * b))]
    acc = [w**2 * (3.0 * a - 4.0 * b * w) / length for w in (1.0, _inside(a, 2.0 * b))]
    jerk = [w * (6.0 * a - 12.0 * b * w) / length**2 for w in (1.0, _inside(a, 4.0 * b))]
    largest = [np.maximum(np.abs(first), np.abs(second)) for first, second in (v, acc, jerk)]
    return largest[0], largest[1], largest[2]


def _excursion(velocity: Array, acceleration: Array, length: Array) -> tuple[Array, Array]:
    """Lowest and highest displacement of ramps (L, n): at the start, the end, or where the joint turns back."""
    a, b = _factors(velocity, acceleration, length)
    whole = _way(a, b, length, 1.0)
    places = np.stack([np.zeros_like(whole), whole, whole - _way(a, b, length, _inside(a, b))])
    return places.min(axis=0), places.max(axis=0)


def _inside(numerator: Array, denominator: Array) -> Array:
    """The quotient where it lies within 0 to 1, else 0."""
    w = np.divide(numerator, denominator, out=np.zeros_like(numerator), where=denominator != 0.0)
    return np.where((w > 0.0) & (w < 1.0), w, 0.0)


def _share(arm: Arm, peaks: tuple[Array, Array, Array], velocity: Array, acceleration: Array) -> Array:
    """Of what a ramp may use of the limits, the largest share (L, n); the motion's own start is never too much."""
    v, a, j = peaks
    allowed_v = np.maximum(arm.velocity_limit, np.abs(velocity))
    allowed_a = np.maximum(_LEAD_SHARE * arm.acceleration_limit, np.abs(acceleration))
    shares = [v / allowed_v - 1e-9, a / allowed_a - 1e-9, j / (_LEAD_SHARE * arm.jerk_limit)]
    return np.asarray(np.max(shares, axis=0))


def _gentle(arm: Arm, peaks: tuple[Array, Array, Array], acceleration: Array) -> Array:
    _, a, j = peaks
    soft = np.minimum(LEAD_ACCELERATION, _LEAD_SHARE * arm.acceleration_limit)
    return np.asarray((a <= np.maximum(soft, np.abs(acceleration) + 1e-9)) & (j <= arm.acceleration_limit / _JERK_TIME))


def _within(arm: Arm, position: Array, excursion: tuple[Array, Array]) -> Array:
    lowest, highest = excursion
    above = position + highest <= np.maximum(arm.upper, position)
    below = position + lowest >= np.minimum(arm.lower, position)
    return np.asarray(above & below)
