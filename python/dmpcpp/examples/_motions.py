"""Motions of a hand that never was: minimum-jerk pieces between postures, seeded noise on top.

Point-to-point movements of people follow the minimum-jerk polynomial closely (Flash & Hogan 1985, eq. 3); the world is
z-up, in m, s and unit quaternions (x, y, z, w).
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array

__all__ = ["HandMotion", "minimum_jerk", "phone", "screw", "session", "stir", "take"]

_SEED = 2026
_MARKER_NOISE = 2e-4  # m, of a motion-capture system
_MARKER_TURN = 1e-3  # rad


@dataclasses.dataclass(frozen=True)
class HandMotion:
    """A hand's poses over time.

    Attributes
    ----------
    time : Array
        (T,) in s.
    position : Array
        (T, 3) in m.
    turn : Rotation
        T rotations, hand -> world.
    """

    time: Array
    position: Array
    turn: Rotation

    def quaternions(self) -> Array:
        """Return (T, 4), x, y, z, w, without a jump to the opposite sign."""
        found: Array = self.turn.as_quat()
        flips = np.where(np.sum(found[1:] * found[:-1], axis=1) < 0, -1.0, 1.0)
        found[1:] *= np.cumprod(flips)[:, None]
        return found

    def kept(self, there: NDArray[np.bool_]) -> HandMotion:
        """Return the samples where `there` (T,) is true."""
        return HandMotion(self.time[there], self.position[there], self.turn[there])

    def noisy(self, generator: np.random.Generator, metres: float, radians: float) -> HandMotion:
        """Return the motion as a tracker with white noise of these standard deviations sees it."""
        moved = self.position + generator.normal(0, metres, self.position.shape)
        turned = Rotation.from_rotvec(generator.normal(0, radians, self.position.shape)) * self.turn
        return HandMotion(self.time, moved, turned)


def minimum_jerk(phase: Array) -> Array:
    """Return the way gone (0 to 1) at `phase`; outside 0 to 1 it rests (Flash & Hogan 1985, eq. 3)."""
    s = np.clip(phase, 0.0, 1.0)
    return s**3 * (10 - 15 * s + 6 * s**2)


def _between(time: Array, begin: float, end: float) -> Array:
    return minimum_jerk((time - begin) / (end - begin))


def _arc(time: Array, pieces: list[tuple[float, float, Array, float]], start: Array) -> Array:
    """Return positions (T, 3): from `start`, each piece (begin, end, goal, lift) goes to a goal over a hump."""
    position, here = np.tile(start, (len(time), 1)), start
    for begin, end, goal, lift in pieces:
        way = _between(time, begin, end)
        position += way[:, None] * (goal - here)
        position[:, 2] += lift * 16 * (way * (1 - way)) ** 2
        here = goal
    return position


def take(number: int) -> HandMotion:
    """Return one of several takes of a reach: 100 Hz, ends and tempo that differ a little."""
    generator = np.random.default_rng([_SEED, number])
    time = np.arange(0, 1.5 + 0.1 * number, 0.02)
    start = np.array([0.30, -0.25, 0.10]) + generator.normal(0, 0.006, 3)
    goal = np.array([0.52, 0.10, 0.18]) + generator.normal(0, 0.006, 3)
    position = _arc(time, [(0.0, time[-1], goal, 0.08)], start)
    turn = Rotation.from_rotvec(_between(time, 0.0, time[-1])[:, None] * np.array([0.3, -0.2, 0.8]))
    return HandMotion(time, position, turn).noisy(generator, _MARKER_NOISE, _MARKER_TURN)


def session() -> HandMotion:
    """Return five reaches to five places with rests between them, 25 Hz."""
    generator = np.random.default_rng([_SEED, 10])
    time = np.arange(0, 15.0, 0.04)
    home = np.array([0.30, -0.20, 0.10])
    pieces, turned = [], np.zeros((len(time), 3))
    for k in range(5):
        begin = 0.6 + 2.9 * k
        goal = home + np.array([0.20, 0.09 * k, 0.05 + 0.02 * k])
        pieces += [(begin, begin + 1.0, goal, 0.05), (begin + 1.1, begin + 2.1, home, 0.03)]
        there = _between(time, begin, begin + 1.0) - _between(time, begin + 1.1, begin + 2.1)
        turned += there[:, None] * np.array([0.0, 0.1 * k, 0.3])
    position = _arc(time, pieces, home)
    return HandMotion(time, position, Rotation.from_rotvec(turned)).noisy(generator, _MARKER_NOISE, _MARKER_TURN)


def stir() -> HandMotion:
    """Return a hand that goes to a pot, stirs six rounds of 1.2 s and stops, 25 Hz."""
    generator = np.random.default_rng([_SEED, 11])
    time = np.arange(0, 8.8, 0.04)
    angle = 2 * np.pi * np.clip((time - 0.8) / 1.2, 0, 6)
    radius = 0.06 * (_between(time, 0.0, 0.8) - _between(time, 8.0, 8.8))
    centre = np.array([0.45, 0.0, 0.15])
    position = centre + np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.1 * radius * np.cos(2 * angle)], 1)
    lean = np.stack([-2.0 * radius * np.sin(angle), 2.0 * radius * np.cos(angle), 0 * angle], 1)
    return HandMotion(time, position, Rotation.from_rotvec(lean)).noisy(generator, _MARKER_NOISE, _MARKER_TURN)


def screw() -> HandMotion:
    """Return a hand that turns a lid by one and a half turns while it comes down by 12 mm, 50 Hz."""
    generator = np.random.default_rng([_SEED, 12])
    time = np.arange(0, 3.0, 0.02)
    way = _between(time, 0.2, 2.8)
    position = np.array([0.45, 0.0, 0.20]) + np.outer(way, [0.0, 0.0, -0.012])
    turn = Rotation.from_rotvec(np.outer(3 * np.pi * way, [0.0, 0.0, 1.0]))
    return HandMotion(time, position, turn).noisy(generator, _MARKER_NOISE, _MARKER_TURN)


def phone() -> HandMotion:
    """Return what a phone held in the hand logs: about 60 Hz with jitter, 4 % of the samples and once 0.15 s lost."""
    generator = np.random.default_rng([_SEED, 13])
    count = 150
    time = np.arange(count) / 60 + generator.uniform(-0.002, 0.002, count)
    end = float(time[-1])
    position = _arc(time, [(0.1, end - 0.1, np.array([0.50, 0.15, 0.25]), 0.10)], np.array([0.30, -0.20, 0.10]))
    turn = Rotation.from_rotvec(np.outer(_between(time, 0.1, end - 0.1), [0.2, 0.5, 0.4]))
    lost = generator.random(count) < 0.04
    lost[[0, -1]] = False
    lost[70:79] = True
    return HandMotion(time, position, turn).noisy(generator, 1e-3, 3e-3).kept(~lost)
