"""Random placements of a motion, small changes of one, and the poses that stand for it while these are compared."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.planning._placement import Placement
from dmpcpp.recordings import Recording
from dmpcpp.robot import random_postures

__all__ = ["about_base", "drawn_through", "far_apart", "middle_of", "neighbour"]


def drawn_through(
    middle: Array,
    free: Placement,
    arm: Arm,
    random: np.random.Generator,
    scale: tuple[float, float],
    count: int,
    tilt: float = np.pi,
) -> Iterator[Placement]:
    """Yield placements with which some configuration of the arm holds the pose `middle` (4, 4).

    Exactly where the tool may have any rotation in the hand; where that is `tilt` rad at most, the position alone. Up
    axis and centre are those of `free`.
    """
    held = arm.forward_kinematics(random_postures(arm, count, random))
    yaws = random.uniform(-np.pi, np.pi, count)
    scales = random.uniform(*scale, count)
    for pose, yaw, size in zip(held, yaws, scales, strict=True):
        turned = replace(free, yaw=yaw, scale=size)
        unplaced = turned.apply(middle)
        held_in_hand = unplaced[:3, :3].T @ pose[:3, :3]
        tool = _proper(held_in_hand) if tilt >= np.pi else _within(random.normal(size=3), tilt * random.uniform())
        yield replace(turned, position=pose[:3, 3] - unplaced[:3, 3], tool_rotation=tool)


def about_base(placement: Placement, angle: float) -> Placement:
    """Return the placement turned about the vertical axis of the arm's base."""
    turn = Rotation.from_euler("z", angle).as_matrix()
    return replace(placement, position=turn @ placement.position, yaw=_wrapped(placement.yaw + angle))


def neighbour(
    placement: Placement, random: np.random.Generator, step: float, scale: tuple[float, float], tilt: float = np.pi
) -> Placement:
    """Return a placement up to about 5 cm, 10 deg and 10 % away for a step of 1."""
    turn = Rotation.from_rotvec(random.normal(0.0, 0.15 * step, 3)).as_matrix()
    return replace(
        placement,
        position=placement.position + random.normal(0.0, 0.04 * step, 3),
        yaw=_wrapped(placement.yaw + random.normal(0.0, 0.15 * step)),
        scale=float(np.clip(placement.scale * np.exp(random.normal(0.02, 0.1 * step)), *scale)),
        tool_rotation=_at_most(_proper(placement.tool_rotation @ turn), tilt),
    )


def middle_of(recording: Recording, centre: Array) -> int:
    """Return the sample closest to the middle of the path."""
    return int(np.argmin(np.linalg.norm(recording.position - centre, axis=1)))


def far_apart(recording: Recording, first: int, count: int) -> list[int]:
    """Return samples each as far as can be from those before it: the extremes of the motion come first.

    Distance counts 1 rad as 0.2 m, about what a wrist needs of a hand's reach.
    """
    orientation = Rotation.from_matrix(recording.rotation)
    chosen = [first]
    nearest = np.full(len(recording), np.inf)
    while len(chosen) < min(count, len(recording)):
        last = chosen[-1]
        moved = np.linalg.norm(recording.position - recording.position[last], axis=1)
        turned = (orientation[last].inv() * orientation).magnitude()
        nearest = np.minimum(nearest, moved + 0.2 * turned)
        chosen.append(int(np.argmax(nearest)))
    return chosen


def _wrapped(angle: float) -> float:
    return float(np.remainder(angle + np.pi, 2 * np.pi) - np.pi)


def _within(direction: Array, angle: float) -> Array:
    """Return the rotation by `angle` rad about a direction."""
    return Rotation.from_rotvec(angle * direction / np.linalg.norm(direction)).as_matrix()


def _at_most(rotation: Array, angle: float) -> Array:
    """Return the rotation, or where it turns further, the one by `angle` rad about its axis."""
    turned = Rotation.from_matrix(rotation).as_rotvec()
    return rotation if np.linalg.norm(turned) <= angle else _within(turned, angle)


def _proper(rotation: Array) -> Array:
    """Return the rotation with the rounding of products taken out."""
    return Rotation.from_matrix(rotation).as_matrix()
