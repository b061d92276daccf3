"""Learn recordings: noise estimate, fit, reproduction check; improve what was learned by trial."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dmpcpp import metrics, motion
from dmpcpp._core import EndPeaks, FitReport, NoiseEstimate, NoiseKind, PoseDemonstration, PoseDmp, assess
from dmpcpp._takes import takes_apart
from dmpcpp.checks import Check, Checked
from dmpcpp.errors import InvalidArgument
from dmpcpp.improvement import Improvement, improve
from dmpcpp.metrics import StageErrors
from dmpcpp.motion import Noise
from dmpcpp.recordings import Recording

__all__ = [
    "Evidence",
    "Improvement",
    "Lesson",
    "evidence",
    "improve",
    "learn",
    "learnable",
    "reproduction",
    "reproduction_checks",
    "teach",
]

_LIMIT_POSITION, _LIMIT_ANGLE = 1e-3, math.radians(0.5)  # m, rad RMSE to the motion without its noise
_LIMIT_SHARE = 0.5  # of the error that smoothing leaves, if that is more


def learn(
    demonstration: PoseDemonstration,
    basis_count: int | None = None,
    *,
    noise: Noise | None = None,
    smooth: bool = True,
    rhythmic: bool = False,
) -> PoseDmp:
    """Learn a demonstration as `PoseDmp.fit` does by default.

    Noise is taken out where the samples show that they carry any, and the model has as many kernels as it needs; its
    options say what was used.

    Parameters
    ----------
    demonstration : PoseDemonstration
    basis_count : int, optional
        Number of kernels; default: automatic.
    noise : Noise, optional
        Has no effect, which a warning says: noise is found in the demonstration itself. Goes in 0.3.
    smooth : bool
        Smooth if noise is detected.
    rhythmic : bool
        The demonstration is one cycle of a motion that repeats (`motion.one_cycle`).
    """
    if noise is not None:
        warnings.warn(
            "learn: noise has no effect, it is found in the demonstration itself.", DeprecationWarning, stacklevel=2
        )
    return PoseDmp.fit(
        demonstration,
        basis_count=basis_count or 0,
        derivatives="automatic" if smooth else "interpolate",
        motion="rhythmic" if rhythmic else "discrete",
    )


@dataclass(frozen=True)
class Evidence:
    """What a demonstration shows of noise, and whether it was taken out.

    Attributes
    ----------
    position, orientation : NoiseEstimate
        m, rad.
    smoothed : bool
    motion : PoseDemonstration
        As it was learned.
    """

    position: NoiseEstimate
    orientation: NoiseEstimate
    smoothed: bool
    motion: PoseDemonstration

    @property
    def noise(self) -> Noise:
        """Standard deviation along and about one axis; 0 where there is none."""
        return Noise(self.position.sigma, self.orientation.sigma)

    @property
    def sentence(self) -> str:
        """Whether there is noise, what was done about it and how that was decided, in one sentence."""
        parts = [
            f"{1e3 * self.position.sigma:.2g} mm in positions ({_told(self.position)})" if self.position.found else "",
            f"{math.degrees(self.orientation.sigma):.2g} deg in orientations ({_told(self.orientation)})"
            if self.orientation.found
            else "",
        ]
        found = " and ".join(part for part in parts if part)
        if not found:
            return "No measurement noise detected; samples are learned unchanged."
        return f"Noise of {found} found and {'smoothed out' if self.smoothed else 'learned with the motion'}."

    def to_dict(self) -> dict[str, Any]:
        """For JSON; m, rad, Hz."""
        return {
            "smoothed": self.smoothed,
            "sentence": self.sentence,
            "position": _as_dict(self.position),
            "orientation": _as_dict(self.orientation),
        }


def _told(found: NoiseEstimate) -> str:
    kind = "white" if found.kind == NoiseKind.white else "wandering, seen at rest"
    kept = f"motion up to {found.cutoff:.2g} Hz kept"
    return f"{kind}, {kept}, accelerations {found.sharpness:.2g} times as large with it"


def _as_dict(found: NoiseEstimate) -> dict[str, Any]:
    names = ("sigma", "removed", "cutoff", "freedom", "flatness", "evenness", "correlation", "sharpness", "measured")
    numbers = {name: getattr(found, name) for name in names}
    return {"kind": found.kind.name, **{k: v if math.isfinite(v) else None for k, v in numbers.items()}}


def evidence(demonstration: PoseDemonstration, *, smooth: bool = True) -> Evidence:
    """Return what a demonstration shows of noise; `smooth` as in `learn`."""
    position, orientation = demonstration.noise_estimates()
    smoothed = smooth and (position.found or orientation.found)
    return Evidence(position, orientation, smoothed, demonstration.denoised() if smoothed else demonstration)


def reproduction(
    model: PoseDmp, demonstration: PoseDemonstration, measured: NDArray[np.bool_] | None = None
) -> StageErrors:
    """Errors of the model's rollout at the samples of the demonstration, or at those (T,) that were measured."""
    poses, again = demonstration.pose, model.rollout_at(demonstration.time).pose
    return metrics.compare(poses, again) if measured is None else metrics.compare(poses[measured], again[measured])


def reproduction_checks(model: PoseDmp, found: Evidence) -> tuple[Check, ...]:
    """Hold the model against the motion as it was learned, without the noise that was taken out of it.

    The limits are 1 mm and 0.5 deg RMSE, or half the error that smoothing itself leaves, sigma sqrt(3 freedom), if
    that is more. The detail of each check says what was taken out of the samples.
    """
    errors = reproduction(model, found.motion)
    position = max(_LIMIT_POSITION, _LIMIT_SHARE * _left(found.position))
    angle = max(_LIMIT_ANGLE, _LIMIT_SHARE * _left(found.orientation))
    return (
        Check(
            "reproduction_position_rmse",
            errors.position_rmse <= position,
            errors.position_rmse,
            position,
            "m",
            detail=f"{1e3 * found.position.removed * found.smoothed:.2g} mm of noise taken out",
        ),
        Check(
            "reproduction_angle_rmse",
            errors.angle_rmse <= angle,
            errors.angle_rmse,
            angle,
            "rad",
            detail=f"{math.degrees(found.orientation.removed) * found.smoothed:.2g} deg of noise taken out",
        ),
    )


def _left(found: NoiseEstimate) -> float:
    """Return the error that smoothing leaves."""
    return found.sigma * math.sqrt(3.0 * found.freedom) if found.found else 0.0


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
        One recording: reproduction error. Several: one failed check for each that does not match the others.
    evidence : tuple of Evidence
        What each recording shows of noise, and whether it was taken out.
    """

    recordings: tuple[Recording, ...]
    demonstrations: tuple[PoseDemonstration, ...]
    model: PoseDmp
    fit: FitReport
    noise: tuple[Noise, ...]
    checks: tuple[Check, ...]
    evidence: tuple[Evidence, ...] = ()

    def summary(self) -> dict[str, Any]:
        """Return what `dmpcpp fit --json` prints; m, rad, s."""
        return {
            **self.judged(),
            "basis_count": self.model.options.basis_count,
            "regression": self.model.options.regression.name,
            "derivatives": self.model.options.derivatives.name,
            "duration": self.model.duration,
            "start": self.model.start.tolist(),
            "goal": self.model.goal.tolist(),
            "fit": {
                "rmse": self.fit.rmse.tolist(),
                "largest": self.fit.largest.tolist(),
                "suggested_basis_count": self.fit.suggested_basis_count,
                "ends": [[_accelerations(part) for part in parts] for parts in self.fit.ends],
                "warnings": list(self.fit.warnings),
            },
            "recordings": [
                {
                    "source": recording.source,
                    "body": recording.body,
                    "samples": len(recording),
                    "duration": recording.duration,
                    "noise": {"position": noise.position, "angle": noise.angle},
                    "evidence": found.to_dict(),
                    "history": list(recording.history),
                }
                for recording, noise, found in zip(self.recordings, self.noise, self.evidence, strict=True)
            ],
        }


def _accelerations(peaks: EndPeaks) -> dict[str, float]:
    """Return what an end of a part (position, then orientation) holds, for JSON; m/s^2 or rad/s^2."""
    return {name: getattr(peaks, name) for name in ("start", "start_samples", "goal", "goal_samples")}


def learnable(recording: Recording, *, smooth: bool = True, keep_rests: bool = False) -> Recording:
    """Return the part of a recording that is learned, between the rests at its ends; parameters as in `teach`.

    Raises
    ------
    InvalidArgument
        One that cannot be learned or is no motion of a hand (`motion.plausible`).
    """
    recording = motion.plausible(motion.continuous(recording))
    return recording if keep_rests else motion.without_rests(recording, smooth=smooth)


def teach(
    recordings: Sequence[Recording],
    *,
    basis_count: int | None = None,
    smooth: bool = True,
    numbers: Sequence[str] | None = None,
    keep_rests: bool = False,
) -> Lesson:
    """Learn one recording, or several of one motion together.

    Parameters
    ----------
    recordings : sequence of Recording
        At least one; all in one frame.
    basis_count : int, optional
        Kernels; by default as many as each recording alone needs, the most of them.
    smooth : bool
        Whether noise that is found may be smoothed out.
    numbers : sequence of str, optional
        What checks call each recording: "2", or "2.3" of the third part of a file; from "1" by default.
    keep_rests : bool
        Whether rests before and behind the motion are learned with it (`motion.rests`).

    Raises
    ------
    InvalidArgument
        There is none, or one that cannot be learned or is no motion of a hand (`motion.plausible`).
    """
    if not recordings:
        raise InvalidArgument("recordings: none, expected at least one.")
    kept = tuple(learnable(recording, smooth=smooth, keep_rests=keep_rests) for recording in recordings)
    demonstrations = tuple(map(motion.demonstration, kept))
    found = tuple(evidence(demonstration, smooth=smooth) for demonstration in demonstrations)
    if len(kept) == 1:
        model = learn(demonstrations[0], basis_count, smooth=smooth)
        checks = reproduction_checks(model, found[0])
    else:
        model = PoseDmp.fit(
            list(demonstrations), basis_count=basis_count or 0, derivatives="automatic" if smooth else "interpolate"
        )
        called = numbers or [str(k) for k in range(1, len(kept) + 1)]
        checks = takes_apart(demonstrations, [recording.source for recording in kept], called, model.options)
    report = assess(model, list(demonstrations))
    return Lesson(kept, demonstrations, model, report, tuple(each.noise for each in found), checks, found)
