"""The repetition that the source asks for: many random motions, clean and with noise, and their statistics."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp._core import Demonstration, Dmp, DmpOptions, OrientationDemonstration, OrientationDmp
from dmpcpp._typing import Array
from dmpcpp.metrics import rotation_angles
from dmpcpp.trials.reproduction._experiments import DT, PRESETS

NOISY_PRESETS = PRESETS | {"smoothed": lambda: DmpOptions(derivatives="smooth")}
"""The defaults learn a demonstration as it is, noise too; smoothing takes the noise out first."""

POSITION_NOISE = (0.0, 0.1e-3, 1e-3, 3e-3)
"""Standard deviation per axis [m]."""
ANGLE_NOISE = (0.0, math.radians(0.05), math.radians(0.3))
"""Standard deviation per component of a rotation vector [rad]."""

_SINUSOIDS = 4  # a component
_FREQUENCY = (0.1, 1.5)  # Hz; the source's helix has 1.6
_DURATION = (1.0, 5.0)  # s; the source's two
_POSITION_AMPLITUDE, _ANGLE_AMPLITUDE = 0.2, 0.8  # m and rad, the sum of a component's sinusoids at most


@dataclass(frozen=True)
class Statistics:
    """Mean, standard deviation and worst case of K errors, and of how many."""

    mean: float
    std: float
    worst: float
    count: int

    @staticmethod
    def of(values: ArrayLike) -> Statistics:
        """Of the numbers (K,), K >= 1; the standard deviation is that of a sample, 0 for K = 1."""
        v = np.asarray(values, dtype=np.float64)
        return Statistics(float(v.mean()), float(v.std(ddof=min(1, len(v) - 1))), float(v.max()), len(v))


@dataclass(frozen=True)
class NoiseLevel:
    """What the presets made of K random motions at one level of noise.

    Attributes
    ----------
    quantity : str
        "position" or "orientation".
    noise : float
        Standard deviation per component added to the demonstration [m or rad].
    rmse, max : dict of str to Statistics
        By the name of the preset: of the K root mean square, and largest, distances to the motion without
        noise, at the demonstrated samples [m or rad].
    """

    quantity: str
    noise: float
    rmse: dict[str, Statistics]
    max: dict[str, Statistics]

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def repeat(count: int, seed: int = 0, progress: Callable[[float], None] | None = None) -> tuple[NoiseLevel, ...]:
    """Learn `count` random motions at every level of noise under every one of NOISY_PRESETS.

    Position and Euler angles (ZYX) are sums of 4 sinusoids per component, 0.1 to 1.5 Hz, at most 0.2 m and 0.8 rad,
    over 1 to 5 s at 200 Hz: neither starts nor ends at rest. Motion i of a seed is the same whatever `count`.

    Parameters
    ----------
    count : int
        K >= 1.
    seed : int
    progress : callable, optional
        Called as progress(share done).
    """
    errors: list[dict[tuple[str, float, str], Array]] = []
    for index in range(count):
        errors.append(dict(_errors(np.random.default_rng([seed, index]))))
        if progress:
            progress((index + 1) / count)
    levels = [("position", noise) for noise in POSITION_NOISE] + [("orientation", noise) for noise in ANGLE_NOISE]
    return tuple(_level(quantity, noise, errors) for quantity, noise in levels)


def random_motion(rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """Return time (T,) [s], positions (T, 3) [m] and rotations (T, 3, 3) of a smooth random motion."""
    time = DT * np.arange(round(rng.uniform(*_DURATION) / DT) + 1)
    position = _sinusoids(rng, time, _POSITION_AMPLITUDE)
    angles = _sinusoids(rng, time, _ANGLE_AMPLITUDE)
    return time, position, Rotation.from_euler("ZYX", angles).as_matrix()


def with_position_noise(position: Array, noise: float, rng: np.random.Generator) -> Array:
    """Positions (T, d) with independent normal noise of standard deviation `noise` per component."""
    return position + noise * rng.standard_normal(position.shape)


def with_angle_noise(rotation: Array, noise: float, rng: np.random.Generator) -> Array:
    """Rotations (T, 3, 3), each turned by a rotation vector of independent normal components [rad]."""
    turn = Rotation.from_rotvec(noise * rng.standard_normal((len(rotation), 3))).as_matrix()
    return np.asarray(turn @ rotation)


def _sinusoids(rng: np.random.Generator, time: Array, amplitude: float) -> Array:
    """Three components (T, 3) of at most `amplitude`."""
    shape = (3, _SINUSOIDS)
    share = rng.uniform(0.2, 1.0, shape)
    frequency, phase = rng.uniform(*_FREQUENCY, shape), rng.uniform(0.0, 2.0 * np.pi, shape)
    waves = np.sin(2.0 * np.pi * frequency * time[:, None, None] + phase)
    return np.asarray(amplitude * np.sum(share * waves, axis=2) / share.sum(axis=1))


def _errors(rng: np.random.Generator) -> Iterator[tuple[tuple[str, float, str], Array]]:
    """Distances (T,) to the clean motion, by quantity, noise and preset."""
    time, position, rotation = random_motion(rng)
    for noise in POSITION_NOISE:
        shown = Demonstration(time, with_position_noise(position, noise, rng))
        for name, options in NOISY_PRESETS.items():
            again = Dmp.fit(shown, options()).rollout_at(time).position
            yield ("position", noise, name), np.linalg.norm(again - position, axis=1)
    for noise in ANGLE_NOISE:
        turning = OrientationDemonstration(time, with_angle_noise(rotation, noise, rng))
        for name, options in NOISY_PRESETS.items():
            turned = OrientationDmp.fit(turning, options()).rollout_at(time).rotation
            yield ("orientation", noise, name), rotation_angles(rotation, turned)


def _level(quantity: str, noise: float, errors: list[dict[tuple[str, float, str], Array]]) -> NoiseLevel:
    of = {name: [run[quantity, noise, name] for run in errors] for name in NOISY_PRESETS}
    rmse = {name: Statistics.of([np.sqrt(np.mean(run**2)) for run in runs]) for name, runs in of.items()}
    return NoiseLevel(
        quantity, noise, rmse, {name: Statistics.of([run.max() for run in runs]) for name, runs in of.items()}
    )
