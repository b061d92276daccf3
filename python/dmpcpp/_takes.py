"""Whether several takes are of one motion: each against the model that is learned from the others."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from dmpcpp import metrics
from dmpcpp._core import DmpOptions, PoseDemonstration, PoseDmp, PoseRun, align
from dmpcpp.checks import Check
from dmpcpp.metrics import StageErrors

_FEWEST = 3  # of two takes that differ nobody knows which is the other one
_TIMES_MEDIAN = 3.0
_SAMPLES = 400  # at which two paths are compared
_SHARE_OF_EXTENT = 0.05
_ANGLE = math.radians(10.0)


def takes_apart(
    demonstrations: Sequence[PoseDemonstration], sources: Sequence[str], numbers: Sequence[str], options: DmpOptions
) -> tuple[Check, ...]:
    """Return a failed check for each take that the model of the others misses by more than 3 times the median of such
    misses (RMS), and by more than 5 % of its extent or 10 deg.

    Each model runs from the take's own start to its goal within its duration; samples are compared as dynamic time
    warping pairs them, as hands that do the same seldom do it in the same rhythm. `numbers` are what the takes are
    called.
    """
    if len(demonstrations) < _FEWEST:
        return ()
    misses = misses_of(demonstrations, options)
    usual_position = float(np.median([miss.position_rmse for miss in misses]))
    usual_angle = float(np.median([miss.angle_rmse for miss in misses]))
    checks = []
    for k, (miss, one) in enumerate(zip(misses, demonstrations, strict=True)):
        position = max(_TIMES_MEDIAN * usual_position, _SHARE_OF_EXTENT * _extent(one))
        angle = max(_TIMES_MEDIAN * usual_angle, _ANGLE)
        detail = f"take {numbers[k]} ({sources[k]}) against the model of the others"
        for what, found, limit, unit in (
            ("position", miss.position_rmse, position, "m"),
            ("angle", miss.angle_rmse, angle, "rad"),
        ):
            if found > limit:
                checks.append(Check(f"take_{numbers[k]}_{what}_rmse", False, found, limit, unit, detail=detail))
    return tuple(checks)


def misses_of(demonstrations: Sequence[PoseDemonstration], options: DmpOptions) -> list[StageErrors]:
    """Return by how much the model of all other takes misses each of them."""
    return [
        _miss(PoseDmp.fit([*demonstrations[:k], *demonstrations[k + 1 :]], options), one)
        for k, one in enumerate(demonstrations)
    ]


def _miss(model: PoseDmp, demonstration: PoseDemonstration) -> StageErrors:
    run = PoseRun(model)
    run.duration = demonstration.duration
    first = np.zeros(1)
    twist = np.r_[demonstration.position.at(first).velocity[0], demonstration.orientation.at(first).angular_velocity[0]]
    run.start_from(demonstration.pose[0], twist)
    run.goal = demonstration.pose[-1]
    poses = []
    for step in np.diff(demonstration.time, prepend=0.0):
        run.step(float(step))
        poses.append(np.array(run.pose))
    some = np.unique(np.linspace(0, len(poses) - 1, _SAMPLES).round().astype(int))
    shown, again = demonstration.pose[some], np.array(poses)[some]
    pairs = align(shown, again).path
    return metrics.compare(shown[pairs[:, 0]], again[pairs[:, 1]])


def _extent(demonstration: PoseDemonstration) -> float:
    return float(np.linalg.norm(np.ptp(demonstration.pose[:, :3, 3], axis=0)))
