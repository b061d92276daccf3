"""The motions that the benchmarks learn: 1000 samples, dt = 0.005 s, lengths in m, rotations body to world."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]

COUNT, DT = 1000, 0.005
TIME: Array = DT * np.arange(COUNT)


def helix() -> Array:
    """Eight turns (1000, 3) of 100 mm radius, 200 mm high, as fast at both ends as in between."""
    k = np.arange(COUNT)
    return np.c_[0.1 * np.sin(0.05 * k), 0.1 * np.cos(0.05 * k), 2e-4 * k]


def reach() -> Array:
    """A minimum-jerk reach (1000, 3) of 540 mm."""
    return minimum_jerk(TIME / TIME[-1])[:, None] * [0.3, -0.2, 0.4]


def turning(end: float, *, rest_to_rest: bool = False) -> Array:
    """Rotations (1000, 3, 3) Rz(.8 sin t) Ry(.5 cos t) Rx(.6 t), t = 0..`end`, evenly or from rest to rest.

    To 4.995 it passes 179.95 deg from where it ends.
    """
    share = TIME / TIME[-1]
    return euler_rotations(end * (minimum_jerk(share) if rest_to_rest else share))


def reach_rotation(angle: float) -> Array:
    """Rotations (1000, 3, 3) by a minimum-jerk angle, 0 to `angle` [rad], about (1, 2, 3)."""
    axis = np.array([1.0, 2.0, 3.0]) / math.sqrt(14.0)
    return Rotation.from_rotvec(angle * minimum_jerk(TIME / TIME[-1])[:, None] * axis).as_matrix()


def euler_rotations(t: Array) -> Array:
    """Rz(.8 sin t) Ry(.5 cos t) Rx(.6 t), (T, 3, 3)."""
    return Rotation.from_euler("ZYX", np.c_[0.8 * np.sin(t), 0.5 * np.cos(t), 0.6 * t]).as_matrix()


def minimum_jerk(s: Array) -> Array:
    """10 s^3 - 15 s^4 + 6 s^5 of s in 0..1."""
    return s**3 * (10.0 - 15.0 * s + 6.0 * s**2)


def recordings() -> Path | None:
    """Return the folder that DMPCPP_RECORDINGS names, if it holds the hand-guided poses."""
    folder = Path(os.environ.get("DMPCPP_RECORDINGS", "")) / "robotasks_clfd"
    return folder if (folder / "pouring.npy").exists() else None


def recorded_poses(folder: Path) -> Iterator[tuple[Array, Array]]:
    """Positions (1000, 3) and rotations (1000, 3, 3) of 18 hand-guided motions: 9 pour, 9 open a box.

    RoboTasks of github.com/sayantanauddy/clfd (MIT): cm, quaternions w first. They came without times.
    """
    for task in ("pouring", "openbox"):
        for rows in np.load(folder / f"{task}.npy"):
            yield rows[:, :3] / 100.0, Rotation.from_quat(rows[:, [4, 5, 6, 3]]).as_matrix()
