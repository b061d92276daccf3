"""Measured quaternions and matrices made proper rotations, with a note on how far off they were."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated

__all__ = [
    "HELD_FIXED",
    "REFUSE_ABOVE",
    "WARN_ABOVE",
    "QuatOrder",
    "from_euler",
    "from_matrices",
    "from_quaternions",
    "held_fixed",
    "no_turn",
    "sign_flips",
]

QuatOrder = Literal["xyzw", "wxyz"]

WARN_ABOVE = 1e-3
"""A quaternion's norm (or a matrix's singular value) further from 1 than this deserves a look."""
REFUSE_ABOVE = 0.1
"""Further off than this it is not a measured rotation: wrong columns, corrupt or filtered data."""
HELD_FIXED = "no orientation recorded: held fixed, as stated"
"""What the history says of `held_fixed`."""
_MOST_TURNS = 8 * np.pi  # rad; degrees pass for radians below
_ROUNDING = 1e-9  # below this nothing is worth a word


def from_quaternions(
    quaternions: Array, order: QuatOrder, name: str = "quaternion", missing: NDArray[np.bool_] | None = None
) -> tuple[Array, list[str]]:
    """Turn quaternions into rotation matrices.

    Parameters
    ----------
    quaternions : array (T, 4)
        Each of norm 1 within 0.1; its sign does not matter.
    order : "xyzw" or "wxyz"
        Where the scalar stands; the data do not show it.
    name : str
        How messages call the quantity.
    missing : array of bool (T,), optional
        Samples that were lost; whatever stands there is not looked at.

    Returns
    -------
    rotations : array (T, 3, 3)
        NaN where missing.
    notes : list of str
        The corrections: renormalisation with the largest correction, sign flips with their number.

    Raises
    ------
    InvalidArgument
        A non-finite number, a norm off by more than 0.1 (with the index), an unknown order.
    """
    if order not in ("xyzw", "wxyz"):
        raise InvalidArgument(f"quat_order: {order!r}, expected 'xyzw' or 'wxyz'.")
    missing = np.zeros(len(quaternions), dtype=bool) if missing is None else missing
    quaternions = np.where(missing[:, None], [0.5, 0.5, 0.5, 0.5], quaternions)
    _check_finite(name, quaternions)
    with np.errstate(over="ignore"):
        norm = np.linalg.norm(quaternions, axis=1)
    off = np.abs(norm - 1.0)
    _refuse(name, "|q|", norm, off, "Check the quaternion columns; the recording may be corrupt there.")
    unit = quaternions / norm[:, None]
    notes = _renormalised(name, off)
    flips = np.flatnonzero(~missing)[sign_flips(unit[~missing])]
    if len(flips):
        notes.append(f"{name}: sign flips fixed: {len(flips)} (the first at frame {flips[0]})")
    rotation = _matrices(unit if order == "wxyz" else np.roll(unit, 1, axis=1))
    return _blanked(rotation, missing), notes


def from_matrices(
    matrices: Array, name: str = "rotation", missing: NDArray[np.bool_] | None = None
) -> tuple[Array, list[str]]:
    """Replace each 3 x 3 matrix by the nearest rotation: the orthogonal factor of its polar decomposition.

    Parameters
    ----------
    matrices : array (T, 3, 3)
        Singular values within 0.1 of 1, positive determinant.
    missing : array of bool (T,), optional
        Samples that were lost; whatever stands there is not looked at.

    Returns
    -------
    rotations : array (T, 3, 3)
        NaN where missing.
    notes : list of str

    Raises
    ------
    InvalidArgument
        A non-finite number, a reflection, or a matrix too far from a rotation; with the index.
    """
    missing = np.zeros(len(matrices), dtype=bool) if missing is None else missing
    matrices = np.where(missing[:, None, None], np.eye(3), matrices)
    _check_finite(name, matrices)
    matrices = np.clip(matrices, -10.0, 10.0)  # far from any rotation; keeps garbage from overflowing
    determinant = np.linalg.det(matrices)
    if (determinant < 0.0).any():
        k = int(np.argmax(determinant < 0.0))
        raise InvalidArgument(
            f"{name}[{k}]: det(R) = {determinant[k]:.3f}, expected +1 (a reflection). Check the axis order."
        )
    u, singular, vt = np.linalg.svd(matrices)
    off = np.abs(singular - 1.0).max(axis=1)
    worst = np.take_along_axis(singular, np.abs(singular - 1.0).argmax(axis=1)[:, None], axis=1)[:, 0]
    _refuse(name, "singular value", worst, off, "Check that the matrices are rotations without scale.")
    return _blanked(u @ vt, missing), _renormalised(name, off)


def from_euler(angles: Array, order: str | None, unit: str | None, missing: NDArray[np.bool_] | None = None) -> Array:
    """Turn three angles about the axes into rotation matrices.

    Parameters
    ----------
    angles : array (T, 3)
        About x, y and z, in this order of columns, whatever the order of the rotations.
    order : str
        Of the rotations as scipy writes it: "XYZ" about the moving axes, the left one first; "xyz" about the
        axes of the world.
    unit : "deg" or "rad"
    missing : array of bool (T,), optional
        Samples that were lost.

    Returns
    -------
    array (T, 3, 3)
        NaN where missing.

    Raises
    ------
    NotStated
        No order or no unit.
    InvalidArgument
        One that is unknown, or an angle that is not finite.
    """
    from scipy.spatial.transform import Rotation

    if order is None:
        raise NotStated("euler_order", "euler_order: three angles without a known order. State for instance 'ZYX'.")
    if unit is None:
        raise NotStated("angle_unit", "angle_unit: not stated. State angle_unit='deg' or 'rad'.")
    if (
        not isinstance(order, str)
        or sorted(order.lower()) != ["x", "y", "z"]
        or order not in (order.lower(), order.upper())
    ):
        raise InvalidArgument(f"euler_order: {order!r}, expected x, y and z once each, 'ZYX' or 'xyz' for instance.")
    if unit not in ("deg", "rad"):
        raise InvalidArgument(f"angle_unit: {unit!r}, expected 'deg' or 'rad'.")
    missing = np.zeros(len(angles), dtype=bool) if missing is None else missing
    angles = np.where(missing[:, None], 0.0, angles)
    _check_finite("angles", angles)
    if unit == "rad":
        _check_radians(angles)
    sorted_angles = angles[:, ["xyz".index(axis) for axis in order.lower()]]
    return _blanked(Rotation.from_euler(order, sorted_angles, degrees=unit == "deg").as_matrix(), missing)


def held_fixed(missing: NDArray[np.bool_]) -> Array:
    """Return the identity (T, 3, 3) for each sample of a motion without orientations; NaN where missing (T,)."""
    return _blanked(np.tile(np.eye(3), (len(missing), 1, 1)), missing)


def no_turn(what: str) -> NotStated:
    """Return the error for positions without orientations, which an arm's tool has to have."""
    return NotStated(
        "fixed_orientation",
        f"fixed_orientation: {what}: a position and no orientation. State fixed_orientation=True to hold the "
        "tool's fixed, or give the orientation too.",
    )


def sign_flips(quaternions: Array) -> np.ndarray:
    """Return the k at which q[k] lies in the hemisphere opposite to q[k-1]; q and -q are one rotation."""
    return np.flatnonzero(np.einsum("ij,ij->i", quaternions[1:], quaternions[:-1]) < 0.0) + 1


def _blanked(rotation: Array, missing: NDArray[np.bool_]) -> Array:
    return np.where(missing[:, None, None], np.nan, rotation)


def _check_radians(angles: Array) -> None:
    """Refuse angles (T, 3) that range so far that they are more likely degrees."""
    extent = np.ptp(angles, axis=0)
    k = int(np.argmax(extent))
    if extent[k] > _MOST_TURNS:
        raise InvalidArgument(
            f"angle_unit: r{'xyz'[k]} ranges over {extent[k]:.4g} rad, more than four turns. Are these degrees? State "
            "angle_unit='deg', or write the angles within one turn."
        )


def _check_finite(name: str, array: Array) -> None:
    finite = np.isfinite(array).all(axis=tuple(range(1, array.ndim)))
    if not finite.all():
        raise InvalidArgument(f"{name}[{int(np.argmin(finite))}]: not finite. Cut the sample out or fill the gap.")


def _refuse(name: str, what: str, value: Array, off: Array, advice: str) -> None:
    if (off > REFUSE_ABOVE).any():
        k = int(np.argmax(off > REFUSE_ABOVE))
        raise InvalidArgument(f"{name}[{k}]: {what} = {value[k]:.4g}, expected 1 within {REFUSE_ABOVE:g}. {advice}")


def _renormalised(name: str, off: Array) -> list[str]:
    if off.max(initial=0.0) <= _ROUNDING:
        return []
    k = int(np.argmax(off))
    note = f"{name}: renormalised, off by at most {off[k]:.2g} (frame {k})"
    return [Note("warning" if off[k] > WARN_ABOVE else "changed", note)]


def _matrices(wxyz: Array) -> Array:
    """Return R (T, 3, 3) with R v = q v q* for unit quaternions (T, 4), scalar first."""
    w, x, y, z = wxyz.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)
