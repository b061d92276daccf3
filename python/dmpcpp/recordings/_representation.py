"""An orientation's numbers made rotation matrices, whatever they are: the one place for all formats.

Which numbers stand for a rotation is said by the names of the columns, the format or the caller; the numbers themselves
can only contradict.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._orientation import HELD_FIXED, from_euler, from_matrices, from_quaternions, held_fixed
from dmpcpp.recordings._statement import Stated

__all__ = ["ANGLES", "CELLS", "NUMBERED", "QUATERNION", "SIX", "TURNS", "VECTOR", "check_norm", "oriented", "turn_in"]

QUATERNION = ("qx", "qy", "qz", "qw")
NUMBERED = ("q0", "q1", "q2", "q3")
ANGLES = ("rx", "ry", "rz")
VECTOR = ("v0", "v1", "v2")
CELLS = tuple(f"m{i}{j}" for i in range(3) for j in range(3))
SIX = ("s0", "s1", "s2", "s3", "s4", "s5")
TURNS = (QUATERNION, NUMBERED, VECTOR, ANGLES, CELLS, SIX)
"""Kinds of orientation by what their columns hold: a quaternion by name or in an order to be asked, a rotation vector,
three angles (or a rotation vector) to be asked, a matrix, and 6D (Zhou et al., CVPR 2019)."""

_NEAR_HALF_TURN = 0.3  # rad; a rotation vector of a tool that points down keeps that close to a length of pi
_WHOLE_TURN = 2.0 * np.pi + 0.2  # rad; no rotation vector is longer
_NORM_SPREAD, _NORM_ROUNDING = 1e-3, 8.0  # of a quaternion's norm; times the printed decimals' rounding


def turn_in(where: Mapping[str, object]) -> tuple[str, ...]:
    """Return the kind of orientation whose columns are all there; none where there is none."""
    return next((kind for kind in TURNS if all(name in where for name in kind)), ())


def oriented(values: Array, kind: tuple[str, ...], stated: Stated, lost: NDArray[np.bool_]) -> tuple[Array, list[str]]:
    """Return the rotations (T, 3, 3) of the numbers (T, len(kind)), NaN where lost (T,), and what to tell.

    Raises
    ------
    NotStated
        The representation, its order or unit is not known.
    InvalidArgument
        The numbers are none of that representation.
    """
    if not kind:
        return held_fixed(lost), [HELD_FIXED]
    if kind in (QUATERNION, NUMBERED):
        return _quaternions(values, kind, stated, lost)
    if kind == VECTOR:
        return _vectors(values, stated.angle_unit, lost)
    if kind == ANGLES:
        return _three(values, stated, lost)
    if kind == CELLS:
        return from_matrices(values.reshape(-1, 3, 3), missing=lost)
    return _six(values, stated, lost)


def _quaternions(
    values: Array, kind: tuple[str, ...], stated: Stated, lost: NDArray[np.bool_]
) -> tuple[Array, list[str]]:
    if kind == QUATERNION:
        check_norm(values, lost)
        return from_quaternions(values, "xyzw", missing=lost)
    if stated.quat_order is None:
        raise NotStated(
            "quat_order",
            "quat_order: four numbers do not tell where the scalar stands. Specify quat_order='wxyz' (scalar first) or "
            "'xyzw'.",
        )
    check_norm(values, lost)
    return from_quaternions(values, stated.quat_order, missing=lost)


def check_norm(values: Array, lost: NDArray[np.bool_]) -> None:
    """Refuse four numbers whose norm spreads more than printed decimals explain: x y z roll pitch yaw gripper, say.

    Raises
    ------
    InvalidArgument
        With the range of the norm.
    """
    there = values[~lost]
    if not len(there) or not np.isfinite(there).all():
        return
    with np.errstate(over="ignore"):
        norm = np.linalg.norm(there, axis=1)
    low, high = float(norm.min()), float(norm.max())
    if high - low <= max(_NORM_SPREAD, _NORM_ROUNDING * _resolution(there)) or not 0.5 < low < high < 2.0:
        return  # what is far from 1 is refused by its index
    raise InvalidArgument(
        f"quaternion: the norm ranges from {low:.4g} to {high:.4g}; that of a quaternion is 1 throughout. Are the last "
        "numbers something else, x y z roll pitch yaw gripper for instance? Specify what each column holds: "
        "layout='x,y,z,rx,ry,rz,gripper' with euler_order='xyz' and angle_unit='rad'."
    )


def _resolution(values: Array) -> float:
    """Return the rounding of numbers that were printed with few decimals, 0 where it cannot be recognised."""
    for decimals in range(1, 5):
        if np.abs(values - np.round(values, decimals)).max() < 1e-12:
            return float(10.0**-decimals)
    return 0.0


def _vectors(values: Array, unit: str | None, lost: NDArray[np.bool_]) -> tuple[Array, list[str]]:
    """Return the rotations of rotation vectors (axis times angle), in rad unless specified."""
    if unit not in (None, "deg", "rad"):
        raise InvalidArgument(f"angle_unit: {unit!r}, expected 'deg' or 'rad'.")
    vectors = np.where(lost[:, None], 0.0, values)
    if not np.isfinite(vectors).all():
        k = int(np.argmin(np.isfinite(vectors).all(axis=1)))
        raise InvalidArgument(f"rotation vector[{k}]: not finite. Crop the sample out or fill the gap.")
    longest = float(np.abs(vectors).max(initial=0.0))
    if unit is None and longest > _WHOLE_TURN:
        raise NotStated(
            "angle_unit",
            f"angle_unit: a rotation vector of {longest:.4g} rad is more than a whole turn. Specify "
            f"angle_unit='deg', or "
            "angle_unit='rad' if it is right.",
        )
    turned = Rotation.from_rotvec(np.clip(vectors, -1e6, 1e6), degrees=unit == "deg").as_matrix()
    return _blanked(turned, lost), ["orientation: rotation vectors" + (" in rad" if unit is None else "")]


def _three(values: Array, stated: Stated, lost: NDArray[np.bool_]) -> tuple[Array, list[str]]:
    """Return the rotations of three numbers that are angles or a rotation vector."""
    if stated.euler_order is None:
        raise NotStated(
            "euler_order",
            "euler_order: three numbers rx, ry, rz are Euler angles or a rotation vector, and do not tell which. "
            "Specify "
            "euler_order='rotvec', or the order of the angles: 'ZYX' about the moving axes, 'xyz' about the fixed ones."
            f"{_half_turns(values, stated.angle_unit, lost)}",
        )
    if stated.euler_order == "rotvec":
        return _vectors(values, stated.angle_unit, lost)
    doubt = _half_turns(values, stated.angle_unit, lost)
    return from_euler(values, stated.euler_order, stated.angle_unit, lost), [
        Note("warning", doubt.strip())
    ] if doubt else []


def _half_turns(values: Array, unit: str | None, lost: NDArray[np.bool_]) -> str:
    """Return a hint that three numbers look like a rotation vector: their length stays near half a turn."""
    there = values[~lost] * (np.pi / 180.0 if unit == "deg" else 1.0)
    if len(there) < 2 or not np.isfinite(there).all():
        return ""
    length = np.linalg.norm(there, axis=1)
    low, high = float(length.min()), float(length.max())
    flips = np.einsum("ij,ij->i", there[1:], there[:-1]) < 0.0
    near = np.abs(np.minimum(length[1:], length[:-1]) - np.pi) < _NEAR_HALF_TURN
    steady = (
        np.pi - _NEAR_HALF_TURN < low <= high < np.pi + _NEAR_HALF_TURN and not (np.ptp(there, axis=0) < 1e-9).all()
    )
    if not steady and not (flips & near).any():
        return ""
    how = f"stays within {low:.3g} to {high:.3g} rad" if steady else "turns its sign near half a turn"
    return f" These look like a rotation vector: its length {how}; then euler_order='rotvec'."


def _six(values: Array, stated: Stated, lost: NDArray[np.bool_]) -> tuple[Array, list[str]]:
    """Return the rotations of two rows, or two columns, of the matrix, made orthonormal."""
    if stated.rotation not in ("rot6d", "rot6d_columns"):
        raise NotStated(
            "rotation",
            "rotation: six numbers of an orientation are two rows or two columns of its matrix. Specify "
            "rotation='rot6d' "
            "(rows, as UMI and LeRobot write it) or 'rot6d_columns'.",
        )
    there = np.where(lost[:, None], [1.0, 0, 0, 0, 1.0, 0], values)
    first, second = there[:, :3], there[:, 3:]
    matrices = np.stack([first, second, np.cross(first, second)], axis=1)
    if stated.rotation == "rot6d_columns":
        matrices = np.swapaxes(matrices, 1, 2)
    return from_matrices(matrices, "rot6d", lost)


def _blanked(rotation: Array, lost: NDArray[np.bool_]) -> Array:
    return np.where(lost[:, None, None], np.nan, rotation)
