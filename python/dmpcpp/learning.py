"""As many kernels as a motion needs, its noise taken out, and the promise that the motion is reproduced."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dmpcpp import metrics, motion
from dmpcpp._core import Derivatives, DmpOptions, FitReport, PoseDemonstration, PoseDmp, assess
from dmpcpp.checks import Check, Checked
from dmpcpp.errors import InvalidArgument
from dmpcpp.metrics import StageErrors
from dmpcpp.motion import Noise
from dmpcpp.recordings import Recording

__all__ = ["Lesson", "learn", "reproduction", "reproduction_checks", "teach"]

_KERNELS = (50, 100, 200, 400, 800)  # tried in this order until the motion is reproduced
_GOOD_POSITION, _GOOD_ANGLE = 0.2e-3, math.radians(0.1)  # m, rad RMSE; below that more kernels are no use
_KERNELS_PER_SAMPLE = 4  # more than that would learn the spline between the samples, not the motion
_LIMIT_POSITION, _LIMIT_ANGLE = 1e-3, math.radians(0.5)  # m, rad RMSE; what a reproduction must reach
_MOST_POSITION, _MOST_ANGLE = 8e-3, math.radians(1.5)  # m, rad; what noise can excuse: fast motions look like it
_LIMIT_NOISE = 3.0  # times the noise per axis; a motion without its noise lies sqrt(3) times it from the samples
_SHAKEN = 5.0  # times; people's fast motions come to 3 with what looks like noise in them, calm ones with noise to 1000
_SAMPLES = 1000  # at which accelerations are looked at
_GOOD_NOISE = 1.8  # likewise, what more kernels can not get below


def learn(
    demonstration: PoseDemonstration,
    basis_count: int | None = None,
    *,
    noise: Noise | None = None,
    smooth: bool = True,
) -> PoseDmp:
    """Learn a demonstration with as many kernels as it needs to be reproduced to 0.2 mm and 0.1 deg RMSE.

    Parameters
    ----------
    demonstration : PoseDemonstration
    basis_count : int, optional
        The number of kernels instead.
    noise : Noise, optional
        What was found in the demonstration (`motion.noise`). Where a model without it would miss 1 mm or 0.5 deg,
        smoothing it out is tried first, and 1.8 times the noise per axis is close enough. Where it would not, noise is
        smoothed out all the same if it makes the accelerations: if they are five times as large with it.
    smooth : bool
        Whether noise may be smoothed out; without it being known, this is tried where even the most kernels do not
        reproduce the motion. The model's options tell: `derivatives` is "smooth".

    Returns
    -------
    PoseDmp
        The first that is close enough, or the one that came closest.
    """
    known = noise is not None and max(noise.position, noise.angle) > 0.0
    believed = _believed(noise or Noise(0.0, 0.0))
    noisy = _is_noisy(noise or Noise(0.0, 0.0)) and smooth
    counts = _KERNELS if basis_count is None else (basis_count,)
    ways = ("interpolate",) if not smooth else ("smooth", "interpolate") if noisy else ("interpolate", "smooth")
    if basis_count is not None:
        ways = ways[:1]
    model = _closest(demonstration, ways, counts, believed if noisy else Noise(0.0, 0.0))[1]
    if not (known and smooth) or model.options.derivatives == Derivatives.smooth:
        return model
    miss, calm = _closest(demonstration, ("smooth",), counts, believed)
    return calm if miss <= 1.0 and _is_shaken(model, calm) else model


def _closest(
    demonstration: PoseDemonstration, ways: Sequence[str], counts: Sequence[int], noise: Noise
) -> tuple[float, PoseDmp]:
    """Return the first model that is close enough, or the closest, and how many times further off than that it is."""
    best: tuple[float, PoseDmp] | None = None
    for derivatives in ways:  # noise is learned with the motion unless it is taken out
        for count in counts:
            if best is not None and count > _KERNELS_PER_SAMPLE * len(demonstration):
                break
            model = PoseDmp.fit(demonstration, basis_count=count, derivatives=derivatives)
            miss = _miss(reproduction(model, demonstration), noise)
            if best is None or miss < best[0]:
                best = miss, model
            if miss <= 1.0:
                return miss, model
    assert best is not None
    return best


def _is_noisy(noise: Noise) -> bool:
    return math.sqrt(3.0) * noise.position > _LIMIT_POSITION or math.sqrt(3.0) * noise.angle > _LIMIT_ANGLE


def _is_shaken(model: PoseDmp, calm: PoseDmp) -> bool:
    """Whether the noise, and not the motion, makes a model's accelerations: they bound how fast an arm can be."""
    with_noise, without = (_largest_accelerations(each) for each in (model, calm))
    return any(a > _SHAKEN * b for a, b in zip(with_noise, without, strict=True))


def _largest_accelerations(model: PoseDmp) -> tuple[float, float]:
    """Return the largest acceleration [m/s^2] and angular acceleration [rad/s^2] of the motion."""
    rate = model.rollout(dt=model.duration / _SAMPLES).acceleration
    return float(np.linalg.norm(rate[:, :3], axis=1).max()), float(np.linalg.norm(rate[:, 3:], axis=1).max())


def reproduction(model: PoseDmp, demonstration: PoseDemonstration) -> StageErrors:
    """Errors of the model's rollout at the samples of the demonstration."""
    return metrics.compare(demonstration.pose, model.rollout_at(demonstration.time).pose)


def reproduction_checks(errors: StageErrors, noise: Noise) -> tuple[Check, ...]:
    """Hold the reproduction against 1 mm and 0.5 deg RMSE, or three times the noise per axis if that is more, 8 mm
    and 1.5 deg at most.

    A model that takes the noise out lies away from the samples by the noise: sqrt(3) times that of an axis. The
    detail of each check is the noise per axis.
    """
    believed = _believed(noise)
    position = max(_LIMIT_POSITION, _LIMIT_NOISE * believed.position)
    angle = max(_LIMIT_ANGLE, _LIMIT_NOISE * believed.angle)
    return (
        Check(
            "reproduction_position_rmse",
            errors.position_rmse <= position,
            errors.position_rmse,
            position,
            "m",
            detail=f"noise {1e3 * noise.position:.2g} mm",
        ),
        Check(
            "reproduction_angle_rmse",
            errors.angle_rmse <= angle,
            errors.angle_rmse,
            angle,
            "rad",
            detail=f"noise {math.degrees(noise.angle):.2g} deg",
        ),
    )


def _believed(noise: Noise) -> Noise:
    """The noise, no more than 8 mm and 1.5 deg can be laid to."""
    return Noise(min(noise.position, _MOST_POSITION / _LIMIT_NOISE), min(noise.angle, _MOST_ANGLE / _LIMIT_NOISE))


def _miss(errors: StageErrors, noise: Noise) -> float:
    """How many times further off than close enough."""
    position = max(_GOOD_POSITION, _GOOD_NOISE * noise.position)
    angle = max(_GOOD_ANGLE, _GOOD_NOISE * noise.angle)
    return max(errors.position_rmse / position, errors.angle_rmse / angle)


@dataclass(frozen=True, eq=False)
class Lesson(Checked):
    """A model and what it was learned from.

    Attributes
    ----------
    recordings : tuple of Recording
    demonstrations : tuple of PoseDemonstration
    model : PoseDmp
    fit : FitReport
    noise : tuple of Noise
        Found in each recording.
    checks : tuple of Check
        Whether a single recording is reproduced; empty where several were learned together, which no model can
        reproduce all.
    """

    recordings: tuple[Recording, ...]
    demonstrations: tuple[PoseDemonstration, ...]
    model: PoseDmp
    fit: FitReport
    noise: tuple[Noise, ...]
    checks: tuple[Check, ...]

    def summary(self) -> dict[str, Any]:
        """Return what `dmpcpp fit --json` prints; m, rad, s."""
        return {
            **self.judged(),
            "basis_count": self.model.options.basis_count,
            "duration": self.model.duration,
            "start": self.model.start.tolist(),
            "goal": self.model.goal.tolist(),
            "fit": {
                "rmse": self.fit.rmse.tolist(),
                "largest": self.fit.largest.tolist(),
                "suggested_basis_count": self.fit.suggested_basis_count,
                "warnings": list(self.fit.warnings),
            },
            "recordings": [
                {
                    "source": recording.source,
                    "body": recording.body,
                    "samples": len(recording),
                    "duration": recording.duration,
                    "noise": {"position": noise.position, "angle": noise.angle},
                    "history": list(recording.history),
                }
                for recording, noise in zip(self.recordings, self.noise, strict=True)
            ],
        }


def teach(recordings: Sequence[Recording], *, basis_count: int | None = None, smooth: bool = True) -> Lesson:
    """Learn one recording, or several of one motion together.

    Parameters
    ----------
    recordings : sequence of Recording
        At least one; all in one frame.
    basis_count : int, optional
        Kernels; by default as many as each recording alone needs, the most of them.
    smooth : bool
        Whether noise that is found may be smoothed out.

    Raises
    ------
    InvalidArgument
        There is none, or one that can not be learned or is no motion of a hand (`motion.plausible`).
    """
    if not recordings:
        raise InvalidArgument("recordings: none, expected at least one.")
    kept = tuple(motion.plausible(motion.continuous(recording)) for recording in recordings)
    demonstrations = tuple(map(motion.demonstration, kept))
    noise = tuple(map(motion.noise, kept))
    alone = [
        learn(demonstration, basis_count, noise=found, smooth=smooth)
        for demonstration, found in zip(demonstrations, noise, strict=True)
    ]
    if len(alone) == 1:
        model, checks = alone[0], reproduction_checks(reproduction(alone[0], demonstrations[0]), noise[0])
    else:
        model, checks = PoseDmp.fit(list(demonstrations), _options_of(alone)), ()
    return Lesson(kept, demonstrations, model, assess(model, list(demonstrations)), noise, tuple(checks))


def _options_of(models: Sequence[PoseDmp]) -> DmpOptions:
    """Return the options with which motions are learned together that were learned alone: those of the most kernels,
    and smoothed if any of them had to be.
    """
    options = max(models, key=lambda model: model.options.basis_count).options
    if any(model.options.derivatives == Derivatives.smooth for model in models):
        options.derivatives = Derivatives.smooth
    return options
