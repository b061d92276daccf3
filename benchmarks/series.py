"""Seeded motions with known truth, and what recording systems do to them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator, make_interp_spline

from benchmarks.demonstrations import minimum_jerk

Array = NDArray[np.float64]
Motion = Callable[[Array], Array]

RATES = (30, 50, 60, 100, 120, 200)
NOISY = ("white", "5 % lost", "10 % lost", "jitter of 20 %", "5 % held", "rounded to 1 mm", "fast")
CLEAN = ("clean", "clean, 5 % lost", "clean, fast")
_MOST_SAMPLES = 400


@dataclass(frozen=True)
class Shown:
    """A motion as it was recorded: times (T,) s, values (T, 3) m, the truth there, which samples were measured."""

    time: Array
    value: Array
    truth: Array
    measured: Array
    sigma: float
    motion: str


def shown(kind: str, seed: int) -> Shown:
    """Return the motion of a seed, as a recording system of this kind shows it."""
    rng = np.random.default_rng([seed, sum(map(ord, kind))])
    rate = int(rng.choice(RATES))
    count = min(int(rng.uniform(1.5, 5.0) * rate) + 1, _MOST_SAMPLES)
    time = np.arange(count) / rate
    name = "fast" if "fast" in kind else ("reach", "via points", "loop", "rests")[seed % 4]
    motion = _MOTIONS[name](rng, time[-1])
    sigma = 0.0 if "clean" in kind else 10 ** rng.uniform(-4, np.log10(2e-3))
    at = time.copy()
    if "jitter" in kind:
        at[1:-1] += rng.uniform(-0.2, 0.2, count - 2) / rate
    truth = motion(time)
    value = motion(at) + sigma * rng.normal(size=truth.shape)
    value, measured = _recorded(kind, rng, time, value)
    return Shown(time, value, truth, measured, sigma, name)


def _recorded(kind: str, rng: np.random.Generator, time: Array, value: Array) -> tuple[Array, Array]:
    measured = np.ones(len(time))
    if "lost" in kind:
        lost = rng.random(len(time)) < (0.1 if "10 %" in kind else 0.05)
        lost[[0, -1]] = False
        value[lost] = PchipInterpolator(time[~lost], value[~lost])(time[lost])
        measured[lost] = 0.0
    if "held" in kind:
        for k in np.flatnonzero(rng.random(len(time)) < 0.05):
            value[k] = value[max(k - 1, 0)]
    return (np.round(value, 3) if "1 mm" in kind else value), measured


def _reach(rng: np.random.Generator, duration: float) -> Motion:
    way = rng.normal(size=3)
    way *= rng.uniform(0.2, 0.6) / np.linalg.norm(way)
    arch = rng.normal(size=3) * rng.uniform(0.0, 0.2)

    def motion(t: Array) -> Array:
        s = minimum_jerk(np.clip(t / duration, 0.0, 1.0))[:, None]
        return np.asarray(s * way + np.sin(np.pi * s) * arch)

    return motion


def _rests(rng: np.random.Generator, duration: float) -> Motion:
    reach = _reach(rng, 0.5 * duration)
    return lambda t: reach(np.clip(t - 0.25 * duration, 0.0, 0.5 * duration))


def _via_points(rng: np.random.Generator, duration: float) -> Motion:
    points = np.cumsum(0.2 * rng.normal(size=(int(rng.integers(4, 7)), 3)), axis=0)
    path = make_interp_spline(np.linspace(0.0, 1.0, len(points)), points, k=3)
    return lambda t: np.asarray(path(minimum_jerk(np.clip(t / duration, 0.0, 1.0))))


def _loop(rng: np.random.Generator, duration: float) -> Motion:
    turns, radius, first = rng.integers(1, 4), rng.uniform(0.05, 0.2), rng.uniform(0.0, 6.0)

    def motion(t: Array) -> Array:
        angle = 2.0 * np.pi * t / duration
        around = turns * angle + first
        return np.c_[radius * np.sin(around), radius * np.cos(around), 0.1 * np.sin(angle)]

    return motion


def _fast(rng: np.random.Generator, duration: float) -> Motion:
    """Sums of sines up to 6 Hz with a largest acceleration of 40 to 200 m/s^2."""
    parts = int(rng.integers(4, 10))
    size, frequency, phase = rng.normal(size=(parts, 3)), rng.uniform(0.5, 6.0, parts), rng.uniform(0.0, 6.0, parts)
    rate = 2.0 * np.pi * frequency

    def sines(t: Array) -> Array:
        return np.asarray(np.sin(np.outer(t, rate) + phase) @ size)

    fine = np.linspace(0.0, duration, 4000)
    peak = np.linalg.norm(np.sin(np.outer(fine, rate) + phase) @ (size * rate[:, None] ** 2), axis=1).max()
    scale = rng.uniform(40.0, 200.0) / peak
    return lambda t: scale * sines(t)


_MOTIONS: dict[str, Callable[[np.random.Generator, float], Motion]] = {
    "reach": _reach,
    "via points": _via_points,
    "loop": _loop,
    "rests": _rests,
    "fast": _fast,
}
