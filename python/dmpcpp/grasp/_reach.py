"""One human reach, cut from a recording, brought to rest at both ends and laid before the robot."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, RotationSpline

from dmpcpp import motion, recordings
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings import Recording

__all__ = ["default_reach", "laid", "longest_reach", "resting"]

_DURATION = (0.3, 3.0)  # s; about what a person's reach takes
_SHORTEST = 0.15  # m
_SLOW = 0.25  # of the peak speed in between: slower than that, the hand pauses
_RAMP = 0.35  # of the duration: how long the resting motion takes to reach the recorded speed
_RATE = 200.0  # Hz of the resting motion


def default_reach() -> Recording:
    """Return the right hand's reach, seen from the chest, of a clip that ships with PyBullet."""
    hand, chest = recordings.clip("jump", "right_hand"), recordings.clip("jump", "chest")
    return longest_reach(motion.relative_to(hand, chest))


def longest_reach(recording: Recording) -> Recording:
    """Cut the reach out of a recording: between two pauses, the longest way and the straightest.

    A pause is a moment of least speed, or an end of the recording, at less than a quarter of the largest speed
    in between. Of all pairs of pauses 0.3 to 3 s apart the one whose distance squared over the length of its
    path is largest is taken.

    Raises
    ------
    InvalidArgument
        No two pauses are at least 0.15 m apart.
    """
    speed = np.linalg.norm(np.gradient(recording.position, recording.time, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(recording.position, axis=0), axis=1))])
    lows = [k for k in range(1, len(speed) - 1) if speed[k] <= min(speed[k - 1], speed[k + 1])]
    best, found = 0.0, None
    for a, b in product([0, *lows], [*lows, len(speed) - 1]):
        if not _DURATION[0] <= recording.time[b] - recording.time[a] <= _DURATION[1]:
            continue
        distance = float(np.linalg.norm(recording.position[b] - recording.position[a]))
        paused = max(speed[a], speed[b]) < _SLOW * speed[a : b + 1].max()
        worth = distance**2 / max(length[b] - length[a], 1e-12)
        if paused and distance >= _SHORTEST and worth > best:
            best, found = worth, (float(recording.time[a]), float(recording.time[b]))
    if found is None:
        raise InvalidArgument(
            f"recording: {recording.body!r} of {recording.source!r} holds no reach of at least {_SHORTEST} m between "
            "two pauses. Cut one out: state where it starts and ends."
        )
    return motion.crop(recording, *found)


def resting(recording: Recording) -> Recording:
    """Return the motion on the same path, from rest to rest.

    A reach that is cut out of a motion starts and ends in mid-swing. Here its clock runs up from and down to a
    standstill: the recorded time is s(t) with a smoothstep slope over the first and the last third or so.
    """
    duration = recording.duration
    ramp = _RAMP * duration
    total = duration + ramp  # each ramp passes half of its length
    time = np.linspace(0.0, total, max(round(total * _RATE) + 1, len(recording)))
    recorded = np.clip(_clock(time, ramp, total), 0.0, duration)
    turning = RotationSpline(recording.time, Rotation.from_matrix(recording.rotation))
    return recording.with_(
        f"from rest to rest: {duration:.3g} s stretched to {total:.3g} s at the ends",
        time=time,
        position=CubicSpline(recording.time, recording.position)(recorded),
        rotation=turning(recorded).as_matrix(),
    )


def _clock(time: Array, ramp: float, total: float) -> Array:
    """Recorded time at `time`: the integral of a slope that rises from 0 to 1 and falls back to 0."""

    def run_up(t: Array) -> Array:
        u = np.clip(t / ramp, 0.0, 1.0)
        return np.asarray(ramp * (u**3 - 0.5 * u**4) + np.maximum(t - ramp, 0.0))

    passed = run_up(time)
    late = time > total - ramp
    passed[late] = total - ramp - run_up(total - time[late])
    return passed


@dataclass(frozen=True, eq=False)
class Laid:
    """A reach in the robot's base frame.

    Attributes
    ----------
    recording : Recording
        From `start` to `goal`.
    scale : float
        Of its positions.
    """

    recording: Recording
    scale: float


def laid(recording: Recording, start: Array, goal: Array, roll: float = 0.0) -> Laid:
    """Carry a reach over to the robot by the similarity that takes its ends to `start` and to `goal`.

    Parameters
    ----------
    recording : Recording
    start : array_like (3,)
        m, where the robot's tip starts.
    goal : array_like (4, 4)
        The tip's last pose. The hand's orientations follow by the constant rotation between hand and tip.
    roll : float
        rad about the line from start to goal, which the two ends leave free; at 0 the recording's up stays as
        far up as it can.

    Raises
    ------
    InvalidArgument
        The motion ends where it starts.
    """
    moved, way = recording.position[-1] - recording.position[0], goal[:3, 3] - start
    if np.linalg.norm(moved) < 1e-6:
        raise InvalidArgument("recording: it ends where it starts, expected a reach.")
    scale = float(np.linalg.norm(way) / np.linalg.norm(moved))
    up = np.eye(3)["xyz".index(recording.up_axis or "z")]
    turn = Rotation.from_rotvec(roll * way / np.linalg.norm(way)).as_matrix()
    turn = turn @ _frame(way, np.array([0.0, 0.0, 1.0])) @ _frame(moved, up).T
    tool = (turn @ recording.rotation[-1]).T @ goal[:3, :3]
    placed = recording.with_(
        f"laid before the robot: scale {scale:.3g}, roll {np.degrees(roll):.0f} deg",
        position=start + scale * (recording.position - recording.position[0]) @ turn.T,
        rotation=Rotation.from_matrix(turn @ recording.rotation @ tool).as_matrix(),
        up_axis="z",
    )
    return Laid(placed, scale)


def _frame(along: Array, up: Array) -> Array:
    """Columns: along, as far up as can be, and the third."""
    first = along / np.linalg.norm(along)
    aside = np.cross(first, up)
    if np.linalg.norm(aside) < 1e-6:  # straight up or down: any other will do
        aside = np.cross(first, np.roll(up, 1))
    aside /= np.linalg.norm(aside)
    return np.column_stack([first, np.cross(aside, first), aside])
