"""From recordings to one model, and how well it reproduces them.

>>> from dmpcpp import recordings, teaching
>>> lesson = teaching.teach([recordings.clip("dance_b")])                 # doctest: +SKIP
>>> lesson.model, lesson.fit.rmse                                         # doctest: +SKIP
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from dmpcpp import motion, simulation
from dmpcpp._core import Arm, Derivatives, DmpOptions, FitReport, PoseDemonstration, PoseDmp, assess
from dmpcpp.errors import InvalidArgument
from dmpcpp.imitation import clear_of_itself
from dmpcpp.learning import learn, reproduction, reproduction_checks
from dmpcpp.motion import Noise
from dmpcpp.planning import place
from dmpcpp.recordings import Recording
from dmpcpp.simulation import Check, Checked

__all__ = ["Lesson", "placed", "teach"]


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


def placed(
    recordings: Sequence[Recording], arm: Arm, *, scale: tuple[float, float] = (0.25, 1.0), seed: int = 0
) -> list[Recording]:
    """Place the first recording in an arm's workspace, clear of the arm itself, and the others by the same placement.

    Raises
    ------
    InvalidArgument
        One of them is no motion of a hand (`motion.plausible`), or no placement carries the first.
    MissingDependency
        PyBullet, in whose geometry contacts are looked at, is not installed.
    """
    whole = [motion.plausible(motion.continuous(recording)) for recording in recordings]
    clear = clear_of_itself(arm, simulation.Bullet)
    placement = place(whole[0], arm, seed, scale=scale, accept=clear)
    return [placement.apply_to(recording) for recording in whole]
