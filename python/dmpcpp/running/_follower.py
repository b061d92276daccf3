"""A motion by its time, slowed down along its path to a stop when one is asked for."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.running._robot import Sample
from dmpcpp.sending import JointMotion, quintic_coefficients

__all__ = ["Follower"]

_STOPS = (0.2, 0.22, 0.24, 0.26, 0.28, 0.3, 0.33, 0.36, 0.4, 0.45, 0.52, 0.6, 0.7, 0.85, 1.0, 1.3, 1.6)
"""s, of which a stop takes the first that holds the limits."""
_ROUNDING = 1e-9  # s; the last sample is sent, too, where its time was added up
_PLACES = 200  # of the motion where the duration of a stop is found beforehand
_EDGE = 0.15  # of a stop in which its deceleration rises, and falls again
_SHARE = 0.98  # of the limits that a stop uses


class Follower:
    """Gives the joints of a motion at any time; ``stop`` slows its clock down to zero on the way.

    With the rate r of the clock, velocity is q' r and acceleration q'' r^2 + q' r'. In a stop r' is a trapezoid, the
    shortest way to zero at limited acceleration and jerk: the arm stays on the path, velocity and acceleration are
    continuous, and both are zero at its end. Its duration is found before the motion begins, for every place of it,
    within the limits of acceleration and jerk. Nothing is allocated in a call beyond numbers.

    Parameters
    ----------
    motion : JointMotion
        From rest to rest.
    arm : Arm
        Whose limits a stop holds.
    speed : float
        Of the clock, above 0 and at most 1.
    watch : callable, optional
        Asked in every call whether to stop. A robot's client may hold the interpreter and have a real-time priority,
        so that no other thread comes to call `stop`: what a person does is looked at from within the loop.
    """

    def __init__(
        self, motion: JointMotion, arm: Arm, speed: float = 1.0, watch: Callable[[], bool] | None = None
    ) -> None:
        """Make the polynomials, and find how long a stop takes where."""
        if not 0.0 < speed <= 1.0:
            raise InvalidArgument(f"speed: {speed}, expected a share above 0 and at most 1.")
        self.speed = speed
        self._knots = (motion.time - motion.time[0]).tolist()
        self._coefficients = list(quintic_coefficients(motion))
        self._end, self._last = self._knots[-1], motion.position[-1].copy()
        self.duration = float(self._end / speed)  # s, unless it is stopped
        self._powers, self._states = np.zeros((3, 6)), np.zeros((3, motion.position.shape[1]))
        self._sample = Sample(*self._states)
        self._stops = self._found_stops(arm)
        self._asked, self._watch = False, watch
        self._stop: tuple[float, float, float] | None = None  # when it began, where on the path, how long it takes

    @property
    def stopping(self) -> bool:
        """Whether a stop was asked for."""
        return self._asked

    @property
    def stop_duration(self) -> float:
        """s, of the stop that was made; 0 without one."""
        return self._stop[2] if self._stop else 0.0

    def stop(self) -> None:
        """Slow down from the next call on; from a signal handler or any thread, as often as one likes."""
        self._asked = True

    def __call__(self, time: float) -> Sample | None:
        """Return the joints ``time`` s after the begin, >= 0; None once they rest at the end or after a stop."""
        if self._watch is not None and not self._asked:
            self._asked = self._watch()
        place, rate, slowing, over = self._clock(time)
        self._evaluate(place, rate, slowing)
        return None if over else self._sample

    def last(self) -> Sample:
        """Return the joints of the last call."""
        return self._sample

    def _clock(self, time: float) -> tuple[float, float, float, bool]:
        """Place on the path [s], the rate of its clock and that one's change, and whether all is over."""
        if self._asked and self._stop is None:
            place = min(self.speed * time, self._end)
            self._stop = time, place, self._stops[min(_PLACES, int(_PLACES * place / self._end) + 1)]
        if self._stop is None:
            return self.speed * time, self.speed, 0.0, self.speed * time > self._end + _ROUNDING
        begin, place, duration = self._stop
        way, rate, slope, _ = _falling(min((time - begin) / duration, 1.0))
        place += self.speed * duration * way
        over = time - begin > duration + _ROUNDING or place > self._end + _ROUNDING
        return place, self.speed * rate, self.speed * slope / duration, over

    def _evaluate(self, place: float, rate: float, slowing: float) -> None:
        """Fill in the states; beyond the end the joints rest there."""
        if place >= self._end:
            self._states[0], self._states[1:] = self._last, 0.0
            return
        k = max(0, min(bisect_right(self._knots, place) - 1, len(self._coefficients) - 1))
        s = max(place - self._knots[k], 0.0)
        q, v, a = self._powers
        power = 1.0
        for i in range(6):
            q[i] = power
            if i < 5:
                v[i + 1] = (i + 1) * power
            if i < 4:
                a[i + 2] = (i + 2) * (i + 1) * power
            power *= s
        np.dot(self._powers, self._coefficients[k], out=self._states)
        states = self._states
        states[2] *= rate * rate
        states[2] += slowing * states[1]
        states[1] *= rate

    def _found_stops(self, arm: Arm) -> list[float]:
        """How long a stop takes from each of the places on; between two the longer one is taken."""
        places = np.linspace(0.0, self._end, _PLACES + 1)
        found = np.full(_PLACES + 1, _STOPS[-1])
        for duration in reversed(_STOPS):
            found[self._stop_holds(arm, places, duration)] = duration
        return [float(max(found[max(k - 1, 0)], found[k])) for k in range(_PLACES + 1)]

    def _stop_holds(self, arm: Arm, places: Array, duration: float) -> Array:
        falling = self.speed * np.array([_falling(u) for u in np.linspace(0.0, 1.0, 41)]).T
        v, a, j = self._derivatives(np.minimum(places[:, None] + duration * falling[0], self._end))
        r, dr, ddr = (falling[k][None, :, None] / duration ** (k - 1) for k in (1, 2, 3))
        acceleration = np.abs(a * r**2 + v * dr) / arm.acceleration_limit
        jerk = np.abs(j * r**3 + 3.0 * a * r * dr + v * ddr) / arm.jerk_limit
        return np.asarray(np.maximum(acceleration, jerk).max(axis=(1, 2)) <= _SHARE)

    def _derivatives(self, place: Array) -> tuple[Array, Array, Array]:
        """First to third derivative (.., n) at places on the path."""
        k = np.clip(np.searchsorted(self._knots, place, side="right") - 1, 0, len(self._coefficients) - 1)
        s = (place - np.asarray(self._knots)[k])[..., None]
        c = np.asarray(self._coefficients)[k]
        c1, c2, c3, c4, c5 = (c[..., i, :] for i in range(1, 6))
        return (
            c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5))),
            2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5)),
            6 * c3 + s * (24 * c4 + s * 60 * c5),
        )


def _falling(u: float) -> tuple[float, float, float, float]:
    """How far the clock goes in a stop by u in 0 to 1, its rate from 1 to 0, and the first two derivatives of that."""
    height = 1.0 / (1.0 - _EDGE)
    if u < _EDGE:
        return (
            u - height * u**3 / (6.0 * _EDGE),
            1.0 - height * u * u / (2.0 * _EDGE),
            -height * u / _EDGE,
            -height / _EDGE,
        )
    if u > 1.0 - _EDGE:
        left = 1.0 - u
        return (
            0.5 - height * left**3 / (6.0 * _EDGE),
            height * left * left / (2.0 * _EDGE),
            -height * left / _EDGE,
            height / _EDGE,
        )
    begun = _EDGE - height * _EDGE**2 / 6.0
    way = begun + (u - _EDGE) - height * ((u * u - _EDGE**2) / 2.0 - _EDGE / 2.0 * (u - _EDGE))
    return way, 1.0 - height * (u - _EDGE / 2.0), -height, 0.0
