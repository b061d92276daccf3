"""Motions that several tests look at."""

import numpy as np
from dmpcpp.recordings import Recording
from scipy.spatial.transform import Rotation


def screw(rate: float = 100.0, duration: float = 2.0, spin: float = 1.5) -> Recording:
    """A body that circles while it turns about its own x axis at a constant rate."""
    time = np.arange(int(duration * rate) + 1) / rate
    return Recording(
        time=time,
        position=np.column_stack([np.sin(2 * time), np.cos(2 * time), 0.1 * time]),
        rotation=Rotation.from_rotvec(np.outer(spin * time, [1.0, 0.0, 0.0])).as_matrix(),
        body="hand",
    )


def lose(recording: Recording, *indices: int) -> Recording:
    """The recording with some samples missing."""
    position, rotation = recording.position.copy(), recording.rotation.copy()
    position[list(indices)], rotation[list(indices)] = np.nan, np.nan
    return recording.with_("lost", position=position, rotation=rotation)


def angle_between(a: np.ndarray, b: np.ndarray) -> float:
    """Largest angle between rotations (T, 3, 3)."""
    return float((Rotation.from_matrix(a).inv() * Rotation.from_matrix(b)).magnitude().max())


def reaches(count: int, rate: float = 100.0, pause: float = 0.3, dither: float = 0.0) -> Recording:
    """A hand that reaches 0.3 m out, rests there and comes back, `count` times; each 1 s out, 0.5 s rest, 1 s back."""
    steps = np.arange(round((2.5 + pause) * rate)) / rate
    jerk = lambda u: u**3 * (10 - 15 * u + 6 * u**2)  # noqa: E731
    one = jerk(np.clip(steps, 0, 1)) - jerk(np.clip(steps - 1.5, 0, 1))
    share = np.concatenate([np.zeros(round(pause * rate)), *[one] * count])
    time = np.arange(len(share)) / rate
    position = np.column_stack([0.3 * share, 0.1 * share**2, dither * np.sin(2 * np.pi * 0.05 * time)])
    rotation = Rotation.from_rotvec(np.outer(share, [0.0, 0.0, 0.5])).as_matrix()
    return Recording(time=time, position=position, rotation=rotation, body="hand", up_axis="z")
