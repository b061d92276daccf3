"""What of a hand's pose an arm follows: all of it, the position and one axis of the tool, or the position alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.metrics import angle_errors

__all__ = ["POSE", "Follow", "following"]

_AXES = "xyz"


@dataclass(frozen=True)
class Follow:
    """What is followed.

    Attributes
    ----------
    kind : str
        "pose", "axis" or "position".
    axis : str
        "x", "y" or "z": the axis of the tool whose direction is followed where `kind` is "axis"; turning about it is
        free.
    """

    kind: str = "pose"
    axis: str = "z"

    @staticmethod
    def of(value: str | Follow) -> Follow:
        """Read "pose", "position", "axis" (z) or "axis:x".

        Raises
        ------
        InvalidArgument
            Another text.
        """
        if isinstance(value, Follow):
            return value
        kind, colon, axis = value.partition(":")
        axis = axis if colon else "z"
        if kind not in ("pose", "position", "axis") or axis not in (*_AXES,) or (colon and kind != "axis"):
            raise InvalidArgument(f"follow: '{value}', expected position, axis, axis:x, axis:y, axis:z or pose.")
        return Follow(kind, axis)

    @property
    def weight(self) -> Array:
        """(6,) for `InverseKinematics`: what of moving along and turning about x, y, z of the wanted pose counts."""
        weight = np.ones(6)
        if self.kind == "position":
            weight[3:] = 0.0
        if self.kind == "axis":
            weight[3 + _AXES.index(self.axis)] = 0.0
        return weight

    @property
    def directions(self) -> int:
        """How many directions of a pose are followed: 6, 5 or 3."""
        return int(self.weight.sum())

    def angle_errors(self, reference: ArrayLike, poses: ArrayLike) -> Array | None:
        """Angles (T,) [rad] between poses (T, 4, 4) as far as they are followed; None where no orientation is."""
        if self.kind == "position":
            return None
        if self.kind == "pose":
            return angle_errors(reference, poses)
        k = _AXES.index(self.axis)
        a, b = (np.asarray(each, dtype=np.float64)[:, :3, k] for each in (reference, poses))
        return np.asarray(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.sum(a * b, axis=1)))

    def describe(self) -> str:
        """Return what is not judged, for a verdict; "" for whole poses."""
        if self.kind == "position":
            return "followed is the position alone: the orientation is not judged"
        if self.kind == "axis":
            return f"followed are the position and the tool's {self.axis} axis: turning about it is not judged"
        return ""

    def __str__(self) -> str:
        """As it is stated."""
        return f"axis:{self.axis}" if self.kind == "axis" else self.kind


POSE = Follow()
"""The whole pose."""


def following(arm: Arm, follow: str | Follow | None) -> Follow:
    """Return what is followed: as stated, else whole poses, which an arm of fewer than six joints cannot follow.

    Raises
    ------
    InvalidArgument
        Fewer joints than directions to follow; the message says what to state.
    """
    stated = POSE if follow is None else Follow.of(follow)
    n = arm.joint_count
    if n >= stated.directions or follow == "pose":
        return stated
    what = "position and orientation" if stated.kind == "pose" else "position and an axis"
    axis = " or follow=axis:z" if n >= 5 else ""
    joints = "1 joint" if n == 1 else f"{n} joints"
    raise InvalidArgument(f"{joints} cannot follow {what}; choose follow=position{axis}")
