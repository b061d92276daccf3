"""What an arm's own computer recorded of its joints, from a CSV file or from a ROS bag."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.recordings.text import data_lines, number, read_text

Array = NDArray[np.float64]

_TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
_TIMES = ("time", "timestamp", "t", "stamp")
_VELOCITIES, _TORQUES = ("_vel", "_velocity"), ("_torque", "_effort", "_eff")
_BAGS = (".bag", ".mcap", ".db3")


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
                "Sort the log and drop what was recorded twice."
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


def read_log(path: str | PathLike[str], *, time_unit: str = "s", topic: str | None = None) -> JointLog:
    """Read a joint log.

    A CSV has a header with ``time`` and one column for each joint [rad] under its name in the URDF; columns
    ``<joint>_vel`` [rad/s] and ``<joint>_torque`` or ``<joint>_effort`` [Nm] are taken where every joint has one,
    others (such as ``<joint>_acc``) are left out. A ROS bag (folder, .db3, .mcap or .bag) holds
    ``sensor_msgs/JointState``; its times count from the first message.

    Parameters
    ----------
    path : path
    time_unit : {"s", "ms", "us", "ns"}
        Of a CSV.
    topic : str, optional
        Of a bag; needed where several topics hold joint states.

    Raises
    ------
    FileError
        The file is missing or can not be read.
    InvalidArgument
        It is damaged, or no joint log; the message says where and why.
    MissingDependency
        A bag, and rosbags is not installed.
    """
    path = Path(path)
    if not path.exists():
        raise FileError(f"{path}: no such file.")
    if path.is_dir() or path.suffix.lower() in _BAGS:
        from dmpcpp.verification.ros_log import read_bag

        return read_bag(path, topic)
    if time_unit not in _TIME_UNITS:
        raise InvalidArgument(f"time_unit: '{time_unit}', expected one of {', '.join(_TIME_UNITS)}.")
    return _read_csv(path, _TIME_UNITS[time_unit])


def _read_csv(path: Path, second: float) -> JointLog:
    lines = [(line, next(csv.reader([text]))) for line, text in data_lines(read_text(path))]
    rows = [(line, [cell.strip() for cell in cells]) for line, cells in lines]
    header, clock, names = _header(path, rows[0][1] if rows else [])
    values = np.array([_numbers(path, line, row, header) for line, row in rows[1:]]).reshape(-1, len(header))
    column = dict(zip(header, values.T, strict=True))
    position = np.column_stack([column[name] for name in names])
    velocity, torque = (_columns(column, names, kind) for kind in (_VELOCITIES, _TORQUES))
    return JointLog(second * column[clock], position, velocity, torque, names, path.name)


def _header(path: Path, header: list[str]) -> tuple[list[str], str, tuple[str, ...]]:
    """The header, and in it the name of the time and those of the joints."""
    clock = next((name for name in header if name.lower() in _TIMES), None)
    if clock is None or len(set(header)) != len(header):
        raise InvalidArgument(f"{path.name}: line 1, expected a header: time,<joints>, each name once.")
    suffixes = ("_acc", *_VELOCITIES, *_TORQUES)
    names = tuple(name for name in header if name != clock and not name.endswith(suffixes))
    if not names:
        raise InvalidArgument(f"{path.name}: line 1, no column of a joint beside '{clock}'.")
    return header, clock, names


def _numbers(path: Path, line: int, row: list[str], header: list[str]) -> list[float]:
    if len(row) != len(header):
        raise InvalidArgument(f"{path.name}: line {line}, {len(row)} cells, expected {len(header)}.")
    try:
        return [number(cell, line, column) for cell, column in zip(row, header, strict=True)]
    except InvalidArgument as error:
        raise InvalidArgument(f"{path.name}: {error}") from None


def _columns(column: dict[str, Array], names: Sequence[str], suffixes: Sequence[str]) -> Array | None:
    """A column for each joint, if there is one."""
    for suffix in suffixes:
        if all(name + suffix in column for name in names):
            return np.column_stack([column[name + suffix] for name in names])
    return None


def _refuse_values(name: str, values: Array, shape: tuple[int, ...]) -> None:
    if values.shape != shape:
        raise InvalidArgument(f"{name}: shape {values.shape}, expected {shape}.")
    if not np.isfinite(values).all():
        index = np.argwhere(~np.isfinite(values))[0].tolist()
        raise InvalidArgument(f"{name}{index}: {values[tuple(index)]}, expected a finite number.")
