"""The torque that joints ask for, by the arm's own inverse dynamics."""

from __future__ import annotations

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array

__all__ = ["effort", "effort_share"]


def effort(arm: Arm, position: Array, velocity: Array, acceleration: Array) -> Array:
    """Torques [Nm, N] (T, n) for joints (T, n), by KDL; without friction."""
    rows = zip(position, velocity, acceleration, strict=True)
    return np.array([arm.inverse_dynamics(*row) for row in rows]).reshape(position.shape)


def effort_share(arm: Arm, position: Array, velocity: Array, acceleration: Array) -> float:
    """Return the largest torque over its limit; 0 where none is stated."""
    if not np.isfinite(arm.effort_limit).any() or len(position) == 0:
        return 0.0
    return float(np.max(np.abs(effort(arm, position, velocity, acceleration)) / arm.effort_limit))
