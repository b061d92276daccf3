"""The demonstrations of the source, and what is left of them after learning and rolling out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from dmpcpp._core import Demonstration, Dmp, DmpOptions, OrientationDemonstration, OrientationDmp
from dmpcpp._typing import Array
from dmpcpp.metrics import rotation_angles

DT = 0.005
"""The source's sampling interval [s]."""

PRESETS: dict[str, Callable[[], DmpOptions]] = {"source": DmpOptions.source, "default": DmpOptions}
"""Under which options every experiment is run."""

TITLES = {"source": "source's equations", "default": "default", "smoothed": "default, smoothed"}
"""What people read for the name of a preset."""


@dataclass(frozen=True, eq=False)
class AxisErrors:
    """Errors of a reproduced position at the demonstrated samples, axis by axis.

    Attributes
    ----------
    max, rmse : (d,)
        Largest and root mean square |y - y_demonstrated|, in the demonstration's unit.
    """

    max: Array
    rmse: Array

    def to_dict(self) -> dict[str, list[float]]:
        """For JSON."""
        return {"max": self.max.tolist(), "rmse": self.rmse.tolist()}


@dataclass(frozen=True)
class AngleErrors:
    """Errors of a reproduced orientation at the demonstrated samples: geodesic angles [rad], 0 to pi."""

    max: float
    rmse: float

    def to_dict(self) -> dict[str, float]:
        """For JSON."""
        return {"max": self.max, "rmse": self.rmse}


@dataclass(frozen=True, eq=False)
class PositionExperiment:
    """Positions, demonstrated and reproduced under every preset at the same times.

    Attributes
    ----------
    demonstration : Demonstration
    models : dict of str to Dmp
        By the name of the preset.
    reproduced : dict of str to (T, d)
    """

    demonstration: Demonstration
    models: dict[str, Dmp]
    reproduced: dict[str, Array]

    @property
    def errors(self) -> dict[str, AxisErrors]:
        """By the name of the preset."""
        return {name: axis_errors(self.demonstration.position, y) for name, y in self.reproduced.items()}

    def to_dict(self) -> dict[str, Any]:
        """For JSON: what was shown and the errors."""
        return _described(self.demonstration) | {"errors": {k: v.to_dict() for k, v in self.errors.items()}}


@dataclass(frozen=True, eq=False)
class RotationExperiment:
    """Orientations, demonstrated and reproduced under every preset at the same times.

    Attributes
    ----------
    convention : str
        In which the Euler angles make a matrix, as in `so3.from_euler`.
    demonstration : OrientationDemonstration
    reproduced : dict of str to (T, 3, 3)
        By the name of the preset.
    """

    convention: str
    demonstration: OrientationDemonstration
    reproduced: dict[str, Array]

    @property
    def errors(self) -> dict[str, AngleErrors]:
        """By the name of the preset."""
        return {name: angle_errors(self.demonstration.rotation, r) for name, r in self.reproduced.items()}

    def to_dict(self) -> dict[str, Any]:
        """For JSON: what was shown and the errors [rad]."""
        described = {"convention": self.convention} | _described(self.demonstration)
        return described | {"errors": {k: v.to_dict() for k, v in self.errors.items()}}


def helix() -> PositionExperiment:
    """The source's section 3.1: x = sin(0.05 k), y = cos(0.05 k), z = 2 k, k = 0..200, dt = 0.005 s; no unit."""
    k = np.arange(201)
    demonstration = Demonstration(DT * k, np.c_[np.sin(0.05 * k), np.cos(0.05 * k), 2.0 * k])
    models = {name: Dmp.fit(demonstration, options()) for name, options in PRESETS.items()}
    rollouts = {name: model.rollout(dt=DT).position for name, model in models.items()}
    return PositionExperiment(demonstration, models, rollouts)


def rotation(duration: float, convention: str) -> RotationExperiment:
    """The source's section 3.2, which names no motion: Euler angles (.8 sin t, .5 cos t, .6 t), t = 0..duration [s].

    `convention` is "source" for the source's passive product Rz(a)^T Ry(b)^T Rx(c)^T, or "ZYX" for the usual
    Rz(a) Ry(b) Rx(c), body to world.
    """
    time = DT * np.arange(round(duration / DT) + 1)
    angles = np.c_[0.8 * np.sin(time), 0.5 * np.cos(time), 0.6 * time]
    demonstration = OrientationDemonstration.from_euler(time, angles, convention)
    reproduced = {
        name: OrientationDmp.fit(demonstration, options()).rollout(dt=DT).rotation for name, options in PRESETS.items()
    }
    return RotationExperiment(convention, demonstration, reproduced)


def axis_errors(reference: Array, positions: Array) -> AxisErrors:
    """Errors of `positions` (T, d) against `reference` (T, d), sample by sample."""
    error = np.abs(positions - reference)
    return AxisErrors(error.max(axis=0), np.sqrt(np.mean(error**2, axis=0)))


def angle_errors(reference: Array, rotations: Array) -> AngleErrors:
    """Errors of `rotations` (T, 3, 3) against `reference` (T, 3, 3), sample by sample."""
    angle = rotation_angles(reference, rotations)
    return AngleErrors(float(angle.max()), float(np.sqrt(np.mean(angle**2))))


def _described(demonstration: Demonstration | OrientationDemonstration) -> dict[str, Any]:
    return {"duration": demonstration.duration, "samples": len(demonstration)}
