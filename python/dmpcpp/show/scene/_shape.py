"""The shape of an arm at given joints, as triangles: for pictures that no browser draws."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dmpcpp._core import Arm
from dmpcpp.show.scene._robot import RobotShape

Array = NDArray[np.float64]

__all__ = ["triangles"]


def triangles(arm: Arm, joints: ArrayLike) -> Array:
    """Return what the arm collides with at joints (K, n) [rad]: (K, F, 3, 3) corners of F triangles [m], in its base.

    Other joints of the robot, such as fingers, are in the middle of their range.

    Raises
    ------
    InvalidArgument
        joints of another shape, or a mesh of the URDF can not be found or read.
    MissingDependency
        yourdfpy is not installed.
    """
    shape = RobotShape(arm)
    return np.stack([shape.triangles(values) for values in np.atleast_2d(np.asarray(joints, dtype=np.float64))])
