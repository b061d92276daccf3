"""Random motions of a hand, new goals and tempi for them, and noise: what the trials are made of."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.distance import pdist
from scipy.spatial.transform import Rotation

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.planning import Placement
from dmpcpp.recordings import Recording
from dmpcpp.robot import random_postures

__all__ = ["NOISE", "Change", "Noise", "drawn_placement", "noisy", "random_change", "random_motion"]

_RATE = 100.0  # Hz
_DURATION = (2.0, 5.0)  # s
_SINUSOIDS = 3  # a component
_FREQUENCY = (0.1, 0.6)  # Hz
_SPAN, _TURN = (0.2, 0.4), (math.radians(30.0), math.radians(90.0))  # m, rad
_TEMPO = (0.5, 2.0)
_GOAL = 0.1  # m
_DRAWS = 200  # of a place for the motion before its reach is given up
_CLOUD = 5000  # random joints that tell how far an arm reaches


@dataclass(frozen=True)
class Noise:
    """Standard deviation per component of position [m] and rotation vector [rad]."""

    position: float
    angle: float


NOISE = {
    "none": Noise(0.0, 0.0),
    "low": Noise(0.5e-3, math.radians(0.1)),
    "high": Noise(2e-3, math.radians(0.5)),
}
"""Motion capture at its best, and as it often is."""


@dataclass(frozen=True)
class Change:
    """What a motion shall be made into: a goal moved by (3,) [m], a duration of `tempo` times its own."""

    goal: Array
    tempo: float


def random_motion(random: np.random.Generator) -> Recording:
    """Draw a smooth motion of 2 to 5 s at 100 Hz; it neither starts nor ends at rest.

    Each component of position and of rotation vector is a sum of three sinusoids of 0.1 to 0.6 Hz. The two
    positions furthest apart are 0.2 to 0.4 m apart, the two orientations furthest apart 30 to 90 deg.
    """
    count = round(random.uniform(*_DURATION) * _RATE) + 1
    time = np.arange(count) / _RATE
    position, turn = _sinusoids(random, time), _sinusoids(random, time)
    position *= random.uniform(*_SPAN) / pdist(position).max()
    turn = _turned(turn, random.uniform(*_TURN))
    return Recording(time, position, Rotation.from_rotvec(turn).as_matrix(), "hand", "random motion", "z")


def random_change(random: np.random.Generator) -> Change:
    """Draw a goal up to 0.1 m away in any direction, and a tempo of 0.5 to 2, evenly on a logarithmic scale."""
    direction = random.standard_normal(3)
    goal = random.uniform(0.0, _GOAL) * direction / np.linalg.norm(direction)
    return Change(goal, float(np.exp(random.uniform(*np.log(_TEMPO)))))


def noisy(recording: Recording, noise: Noise, random: np.random.Generator) -> Recording:
    """Add independent normal noise to every sample."""
    if noise.position == 0.0 and noise.angle == 0.0:
        return recording
    turn = Rotation.from_rotvec(noise.angle * random.standard_normal((len(recording), 3)))
    return recording.with_(
        f"noise of {1e3 * noise.position:g} mm and {math.degrees(noise.angle):g} deg added",
        position=recording.position + noise.position * random.standard_normal(recording.position.shape),
        rotation=(turn * Rotation.from_matrix(recording.rotation)).as_matrix(),
    )


def drawn_placement(recording: Recording, arm: Arm, random: np.random.Generator) -> Placement:
    """Draw where the motion stands: its middle at a random pose of the tip, in its size, all of it within reach.

    Within reach means no further from the base than the tip of 5000 random joints, and above the floor; no
    inverse kinematics is asked whether the arm can follow.
    """
    reach = arm.forward_kinematics(random_postures(arm, _CLOUD))[:, :3, 3]
    furthest = float(np.linalg.norm(reach, axis=1).max())
    middle = len(recording) // 2
    for _ in range(_DRAWS):
        held = arm.forward_kinematics(random_postures(arm, 1, random))[0]
        placement = Placement(held[:3, 3], yaw=float(random.uniform(-np.pi, np.pi)), centre=recording.position[middle])
        tool = (placement.rotation @ recording.rotation[middle]).T @ held[:3, :3]
        placement = replace(placement, tool_rotation=Rotation.from_matrix(tool).as_matrix())
        position = placement.apply_to(recording).position
        if np.linalg.norm(position, axis=1).max() <= furthest and position[:, 2].min() > 0.0:
            break
    return placement


def _sinusoids(random: np.random.Generator, time: Array) -> Array:
    shape = (3, _SINUSOIDS)
    size, phase = random.uniform(0.2, 1.0, shape), random.uniform(0.0, 2.0 * np.pi, shape)
    angle = 2.0 * np.pi * random.uniform(*_FREQUENCY, shape) * time[:, None, None] + phase
    return np.asarray(np.sum(size * np.sin(angle), axis=2))


def _turned(turn: Array, span: float) -> Array:
    """Rotation vectors in proportion to `turn`, the two orientations furthest apart `span` [rad] apart."""
    turn = (turn - turn.mean(axis=0)) * span / pdist(turn).max()
    for _ in range(8):  # the angle between two orientations is not the distance of their vectors, but nearly
        turn = turn * span / _largest_angle(turn)
    return turn


def _largest_angle(turn: Array) -> float:
    quaternion = Rotation.from_rotvec(turn).as_quat()
    return float(2.0 * np.arccos(np.clip(np.abs(quaternion @ quaternion.T).min(), 0.0, 1.0)))
