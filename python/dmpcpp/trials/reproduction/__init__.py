"""The source's own experiments, repeated: under its own equations and under the defaults of this library.

>>> from dmpcpp import reproduction
>>> run = reproduction.reproduce(repeat=20)                    # doctest: +SKIP
>>> run.ok, run.helix.errors["default"].max                    # doctest: +SKIP
>>> reproduction.write(run, "dmpcpp-reproduction")             # doctest: +SKIP

The source is the thesis proposal of 2019 behind `DmpOptions.source()`: docs/formulation.md.
"""

from dmpcpp.trials.reproduction._experiments import (
    PRESETS,
    TITLES,
    AngleErrors,
    AxisErrors,
    PositionExperiment,
    RotationExperiment,
    helix,
    rotation,
)
from dmpcpp.trials.reproduction._files import write
from dmpcpp.trials.reproduction._repetition import NOISY_PRESETS, NoiseLevel, Statistics, repeat
from dmpcpp.trials.reproduction._run import SOURCE_ERRORS, Reproduction, reproduce

__all__ = [
    "NOISY_PRESETS",
    "PRESETS",
    "SOURCE_ERRORS",
    "TITLES",
    "AngleErrors",
    "AxisErrors",
    "NoiseLevel",
    "PositionExperiment",
    "Reproduction",
    "RotationExperiment",
    "Statistics",
    "helix",
    "repeat",
    "reproduce",
    "rotation",
    "write",
]
