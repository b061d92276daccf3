"""All experiments in one call, and what must hold of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from dmpcpp.checks import Check, Checked
from dmpcpp.errors import InvalidArgument
from dmpcpp.trials.reproduction import _repetition as repetition
from dmpcpp.trials.reproduction._experiments import PositionExperiment, RotationExperiment, helix, rotation
from dmpcpp.trials.reproduction._repetition import NoiseLevel

SOURCE_ERRORS = (0.327, 0.116, 10.5)
"""Largest errors of the source's equations on its helix in x, y, z: an independent computation with numpy."""

_TOLERANCE = 0.02
_SHARE_OF_SOURCE = 1e-3  # what the default may leave of the source's errors
_DURATIONS = (1.0, 5.0)  # s
_CONVENTIONS = ("source", "ZYX")


@dataclass(frozen=True, eq=False)
class Reproduction(Checked):
    """The source's experiments under its own equations and under the default.

    Attributes
    ----------
    helix : PositionExperiment
    rotations : tuple of RotationExperiment
        1 and 5 s, each in the source's Euler convention and in ZYX.
    levels : tuple of NoiseLevel
        The repetition; empty unless asked for.
    seed : int
        Of the repetition.
    checks : tuple of Check
    """

    helix: PositionExperiment
    rotations: tuple[RotationExperiment, ...]
    levels: tuple[NoiseLevel, ...]
    seed: int
    checks: tuple[Check, ...]

    def summary(self) -> dict[str, Any]:
        """Return what `summary.json` holds; the helix has no unit, the rest is in m and rad."""
        return {
            **self.judged(),
            "helix": self.helix.to_dict(),
            "rotations": [experiment.to_dict() for experiment in self.rotations],
            "repetition": {"seed": self.seed, "levels": [level.to_dict() for level in self.levels]},
        }


def reproduce(repeat: int = 0, seed: int = 0, progress: Callable[[float], None] | None = None) -> Reproduction:
    """Run the source's experiments, and `repeat` random motions at every level of noise.

    Parameters
    ----------
    repeat : int
        K random motions; none by default.
    seed : int
        Of the random motions and their noise, 0 or larger.
    progress : callable, optional
        Called as progress(share done) during the repetition.
    """
    for name, value in (("repeat", repeat), ("seed", seed)):
        if value < 0:
            raise InvalidArgument(f"{name}: {value}, expected 0 or more.")
    spiral = helix()
    rotations = tuple(rotation(duration, convention) for convention in _CONVENTIONS for duration in _DURATIONS)
    levels = repetition.repeat(repeat, seed, progress) if repeat else ()
    return Reproduction(spiral, rotations, levels, seed, _checks(spiral))


def _checks(spiral: PositionExperiment) -> tuple[Check, ...]:
    """The source's errors come out again, and the default leaves a thousandth of them."""
    source, default = spiral.errors["source"].max, spiral.errors["default"].max
    checks = []
    for axis, found, ours, known in zip("xyz", source, default, SOURCE_ERRORS, strict=True):
        off, share = float(abs(found / known - 1.0)), float(ours / found)
        as_known = f"helix_{axis}_source_as_known", off <= _TOLERANCE, off, _TOLERANCE, "1"
        checks.append(Check(*as_known, detail=f"{found:.4g}, expected {known:g}"))
        checks.append(Check(f"helix_{axis}_default_to_source", share <= _SHARE_OF_SOURCE, share, _SHARE_OF_SOURCE, "1"))
    return tuple(checks)
