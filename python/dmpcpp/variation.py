"""Learn how a motion varies: a distribution over several recordings of it, what it passes, how far off that is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp import learning, motion
from dmpcpp._core import Given, PoseDemonstration, PoseDistribution, so3
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Checked
from dmpcpp.errors import InvalidArgument
from dmpcpp.learning import Evidence
from dmpcpp.recordings import Recording

__all__ = ["Variation", "conditioned", "picture", "vary"]

_FEWEST = 4  # of fewer takes each is what the others' spread is made of
_SIGMAS = 4.0
_APART = 0.5  # share of a take's samples that may lie beyond
_PHASES = 51


@dataclass(frozen=True, eq=False)
class Variation(Checked):
    """A distribution over recordings and what it was learned from.

    Attributes
    ----------
    recordings : tuple of Recording
    demonstrations : tuple of PoseDemonstration
        As they were learned, without the noise that was taken out.
    distribution : PoseDistribution
    checks : tuple of Check
        One for each take, from four takes on: how much of it lies beyond 4 sigma of what the others say.
    evidence : tuple of Evidence
        What each recording shows of noise.
    """

    recordings: tuple[Recording, ...]
    demonstrations: tuple[PoseDemonstration, ...]
    distribution: PoseDistribution
    checks: tuple[Check, ...]
    evidence: tuple[Evidence, ...]

    def deviations(self) -> list[dict[str, float]]:
        """Return one standard deviation at the start, the middle and the end: position [m], angle [rad]."""
        spread = self.distribution.spread(3)
        return [
            {"phase": float(s), "position": math.sqrt(np.trace(c[:3, :3])), "angle": math.sqrt(np.trace(c[3:, 3:]))}
            for s, c in zip(spread.phase, spread.covariance, strict=True)
        ]

    def summary(self) -> dict[str, Any]:
        """Return what `dmpcpp fit --distribution --json` prints; m, rad, s."""
        return {
            **self.judged(),
            "control_points": self.distribution.control_points,
            "duration": self.distribution.duration,
            "noise": {"position": float(self.distribution.noise[0]), "angle": float(self.distribution.noise[1])},
            "deviation": self.deviations(),
            "recordings": [
                {
                    "source": recording.source,
                    "body": recording.body,
                    "samples": len(recording),
                    "duration": recording.duration,
                    "evidence": found.to_dict(),
                    "history": list(recording.history),
                }
                for recording, found in zip(self.recordings, self.evidence, strict=True)
            ],
        }


def vary(
    recordings: Sequence[Recording],
    *,
    smooth: bool = True,
    numbers: Sequence[str] | None = None,
    keep_rests: bool = False,
) -> Variation:
    """Learn several recordings of one motion and how they differ.

    Parameters
    ----------
    recordings : sequence of Recording
        At least two; all in one frame. Each counts over its own duration, from start to end.
    smooth, numbers, keep_rests
        As of `learning.teach`.

    Raises
    ------
    InvalidArgument
        Fewer than two, one that cannot be learned, or one that goes another way than all others.
    """
    if len(recordings) < 2:
        raise InvalidArgument(
            f"recordings: {len(recordings)}, expected at least 2: one does not show how motions vary."
        )
    kept = tuple(learning.learnable(recording, smooth=smooth, keep_rests=keep_rests) for recording in recordings)
    found = tuple(learning.evidence(motion.demonstration(one), smooth=smooth) for one in kept)
    takes = tuple(one.motion for one in found)
    called = numbers or [str(k) for k in range(1, len(takes) + 1)]
    learned = PoseDistribution.fit(list(takes))
    checks = _apart(takes, [recording.source for recording in kept], called) if len(takes) >= _FEWEST else ()
    return Variation(kept, takes, learned, checks, found)


def _apart(takes: Sequence[PoseDemonstration], sources: Sequence[str], numbers: Sequence[str]) -> tuple[Check, ...]:
    checks = []
    for k, take in enumerate(takes):
        share = _share_beyond(PoseDistribution.fit([*takes[:k], *takes[k + 1 :]]), take)
        if share > _APART:
            detail = f"take {numbers[k]} ({sources[k]}): share beyond {_SIGMAS:.0f} sigma of the others"
            checks.append(Check(f"take_{numbers[k]}_beyond", False, share, _APART, "1", detail=detail))
    return tuple(checks)


def _share_beyond(others: PoseDistribution, take: PoseDemonstration) -> float:
    """Return the share of a take's phases at which an axis is beyond 4 sigma."""
    band = others.spread(_PHASES)
    times = band.phase * take.duration
    position, rotation = take.position.at(times).position, take.orientation.at(times).rotation
    noise = np.repeat(others.noise**2, 3)
    beyond = 0
    for k in range(_PHASES):
        away = np.r_[position[k] - band.mean[k, :3, 3], so3.log(rotation[k] @ band.mean[k, :3, :3].T)]
        beyond += bool(np.any(np.abs(away) > _SIGMAS * np.sqrt(np.diag(band.covariance[k]) + noise)))
    return beyond / _PHASES


def conditioned(
    distribution: PoseDistribution, given: Sequence[tuple[float, Array]]
) -> tuple[PoseDistribution, list[float]]:
    """Return the distribution of the motions that pass what is given, and how far off each of that is.

    Parameters
    ----------
    distribution : PoseDistribution
    given : sequence of (phase, place)
        Phases 0 to 1; places (3,) [m] or poses (4, 4), passed exactly.

    Returns
    -------
    PoseDistribution, list of float
        Standard deviations (Mahalanobis) between each and what the demonstrations did there.
    """
    known = [Given(phase, place) for phase, place in given]
    return distribution.condition(known), [distribution.distance(one) for one in known]


def picture(
    distribution: PoseDistribution,
    demonstrations: Sequence[PoseDemonstration],
    path: str | Path,
    title: str = "",
) -> Path:
    """Write the band of two standard deviations, with the takes, as a picture; needs matplotlib.

    Rows: x, y, z [m] and the rotation vector from the mean [deg], world frame.
    """
    from dmpcpp.show import plot

    band = distribution.spread(101)
    middle = np.c_[band.mean[:, :3, 3], np.zeros((len(band.phase), 3))]
    deviation = np.sqrt(np.array([np.diag(each) for each in band.covariance]) + np.repeat(distribution.noise**2, 3))
    takes = [(band.phase, _beside(band.mean, take, band.phase)) for take in demonstrations]
    units = np.r_[1.0, 1.0, 1.0, np.full(3, 180 / math.pi)]
    page = plot.figure(9.0, 8.0, title=title, note="mean and band of two standard deviations; points: takes")
    columns = page.subplots(6, 1, sharex=True)
    plot.spread(
        list(columns),
        [(when, values * units) for when, values in takes],
        (band.phase, middle * units),
        deviation * units,
        ("x [m]", "y [m]", "z [m]", "about x [deg]", "about y [deg]", "about z [deg]"),
    )
    return plot.save(page, path)


def _beside(mean: Array, take: PoseDemonstration, phase: Array) -> Array:
    times = phase * take.duration
    position, rotation = take.position.at(times).position, take.orientation.at(times).rotation
    turned = [so3.log(one @ middle[:3, :3].T) for one, middle in zip(rotation, mean, strict=True)]
    return np.c_[position, turned]
