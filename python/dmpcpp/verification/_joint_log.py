"""What an arm's own computer recorded of its joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["JointLog"]


@dataclass(frozen=True, eq=False)
class JointLog:
    """Measured joint states.

    Attributes
    ----------
    time : (T,) s, strictly increasing, on any clock
    position : (T, n) rad
    velocity : (T, n) rad/s, or None where it was not recorded
    torque : (T, n) Nm, or None where it was not recorded
    joint_names : tuple of n str
    source : str
        For the report.
    notes : tuple of str
        What reading it changed.

    Raises
    ------
    InvalidArgument
        Sizes that differ, fewer than 4 samples, times that do not increase, numbers that are not finite.
    """

    time: Array
    position: Array
    velocity: Array | None
    torque: Array | None
    joint_names: tuple[str, ...]
    source: str = "log"
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what is no log."""
        shape = (len(self.time), len(self.joint_names))
        for name in ("position", "velocity", "torque"):
            values = getattr(self, name)
            if values is not None:
                _refuse_values(name, values, shape)
        if len(self.time) < 4:
            raise InvalidArgument(f"{self.source}: {len(self.time)} sample(s), expected at least 4.")
        _refuse_values("time", self.time, shape[:1])
        backwards = np.flatnonzero(np.diff(self.time) <= 0.0)
        if len(backwards):
            k = int(backwards[0]) + 1
            raise InvalidArgument(
                f"{self.source}: time[{k}]: {self.time[k]:.9g} s after {self.time[k - 1]:.9g} s, expected later. "
                "Sort the log."
            )

    def of(self, names: Sequence[str]) -> JointLog:
        """The log of these joints in this order.

        Raises
        ------
        InvalidArgument
            A joint is not in the log; the message lists those that are.
        """
        missing = [name for name in names if name not in self.joint_names]
        if missing:
            raise InvalidArgument(
                f"{self.source}: no joint '{missing[0]}'; the log has {', '.join(self.joint_names)}. "
                "Name its columns or joints as the arm's URDF does."
            )
        columns = [self.joint_names.index(name) for name in names]
        velocity, torque = (None if each is None else each[:, columns] for each in (self.velocity, self.torque))
        return JointLog(self.time, self.position[:, columns], velocity, torque, tuple(names), self.source, self.notes)


def _refuse_values(name: str, values: Array, shape: tuple[int, ...]) -> None:
    if values.shape != shape:
        raise InvalidArgument(f"{name}: shape {values.shape}, expected {shape}.")
    if not np.isfinite(values).all():
        index = np.argwhere(~np.isfinite(values))[0].tolist()
        raise InvalidArgument(f"{name}{index}: {values[tuple(index)]}, expected a finite number.")
