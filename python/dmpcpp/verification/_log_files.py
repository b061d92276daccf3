"""Joint logs from CSV files and from ROS bags."""

from __future__ import annotations

import math
from collections.abc import Sequence
from os import PathLike
from pathlib import Path

import numpy as np

from dmpcpp._text import Row, data_lines, number, read_text, split_all
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument, within
from dmpcpp.verification._joint_log import JointLog
from dmpcpp.verification._ros_log import read_bag

__all__ = ["read_log"]

_TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
_ANGLE_UNITS = {"rad": 1.0, "deg": math.pi / 180.0}
_DELIMITERS = ";\t,"
_TIMES = ("time", "timestamp", "t", "stamp")
_VELOCITIES, _TORQUES = ("_vel", "_velocity"), ("_torque", "_effort", "_eff")
_LEFT_OUT = ("phase", "period", "work")  # columns of joints.csv and of the log of `dmpcpp run`
_FRANKA_JOINTS = 7
_LIBFRANKA = ("state.q[{}]", "state.dq[{}]", "state.tau_J[{}]")
_BAGS = (".bag", ".mcap", ".db3")


def read_log(
    path: str | PathLike[str],
    *,
    time_unit: str = "s",
    angle_unit: str = "rad",
    topic: str | None = None,
    joints: Sequence[str] | None = None,
) -> JointLog:
    """Read a joint log.

    A CSV (separated by commas, semicolons, tabs or blanks) has a header with ``time`` and one column for each joint
    [rad] under its name in the URDF; columns ``<joint>_vel`` [rad/s] and ``<joint>_torque`` or ``<joint>_effort``
    [Nm] are taken where every joint has one, others (such as ``<joint>_acc``) are left out. The CSV of libfranka's
    ``logToCSV`` is known by its columns ``state.q[0]`` ..: its times are ms, its joints those of ``joints`` in their
    order. A ROS bag (folder, .db3, .mcap or .bag) holds ``sensor_msgs/JointState``; its times count from the first
    message. Of samples with one time the last is kept, and ``notes`` says so, and where the joints were planned.

    Parameters
    ----------
    path : path
    time_unit : {"s", "ms", "us", "ns"}
        Of a CSV.
    angle_unit : {"rad", "deg"}
        Of all positions and velocities of a CSV.
    topic : str, optional
        Of a bag; needed where several topics hold joint states.
    joints : sequence of str, optional
        Joints that are asked for; of libfranka's log, which does not name them, their names. Messages of a bag
        without them (of a gripper on the same topic) are left out.

    Raises
    ------
    FileError
        The file is missing or cannot be read.
    InvalidArgument
        It is damaged, or no joint log; the message says where and why.
    MissingDependency
        A bag, and rosbags is not installed.
    """
    path = Path(path)
    if not path.exists():
        raise FileError(f"{path}: no such file.")
    for name, unit, known in (("time_unit", time_unit, _TIME_UNITS), ("angle_unit", angle_unit, _ANGLE_UNITS)):
        if unit not in known:
            raise InvalidArgument(f"{name}: '{unit}', expected one of {', '.join(known)}.")
    try:
        if path.is_dir() or path.suffix.lower() in _BAGS:
            return read_bag(path, topic, joints)
        return _read_csv(path, _TIME_UNITS[time_unit], _ANGLE_UNITS[angle_unit], joints)
    except InvalidArgument as error:
        raise error if str(error).startswith(f"{path.name}: ") else within(path.name, error) from None


def _read_csv(path: Path, second: float, radian: float, joints: Sequence[str] | None) -> JointLog:
    whole, rows = _table(read_text(path))
    header, rows = _without(_LEFT_OUT, whole, rows)
    if _LIBFRANKA[0].format(0) in header:
        return _of_libfranka(path, header, rows, joints)
    clock, names = _clock_and_joints(header)
    values = np.array([_numbers(row, header) for row in rows]).reshape(-1, len(header))
    column = dict(zip(header, values.T, strict=True))
    time = second * column[clock]
    kept = np.append(np.diff(time) != 0.0, True)[: len(time)]  # the last of those with one time
    notes = () if kept.all() else (f"{int((~kept).sum())} samples with the time of another left out",)
    if "phase" in whole and f"{names[0]}_acc" in whole:
        notes = (*notes, "the log is the joints.csv of a plan: planned joints, nothing that was recorded")
    position = radian * np.column_stack([column[name] for name in names])[kept]
    velocity, torque = (_columns(column, names, kind) for kind in (_VELOCITIES, _TORQUES))
    velocity = None if velocity is None else radian * velocity[kept]
    torque = None if torque is None else torque[kept]
    return JointLog(time[kept], position, velocity, torque, names, path.name, notes)


def _of_libfranka(path: Path, header: list[str], rows: list[Row], joints: Sequence[str] | None) -> JointLog:
    """What `franka::logToCSV` writes: milliseconds, and joints by their number."""
    values = np.array([_numbers(row, header) for row in rows]).reshape(-1, len(header))
    column = dict(zip(header, values.T, strict=True))
    found = [[column.get(name.format(k)) for k in range(_FRANKA_JOINTS)] for name in _LIBFRANKA]
    if any(each is None for each in found[0]) or "time" not in column:
        raise InvalidArgument(f"line 1: expected time and {_LIBFRANKA[0].format('0..6')} of libfranka's log.")
    position, velocity, torque = (
        None if any(each is None for each in columns) else np.column_stack(columns) for columns in found
    )
    names = tuple(joints) if joints is not None and len(joints) == _FRANKA_JOINTS else None
    if names is None:
        raise InvalidArgument(f"the log is of {_FRANKA_JOINTS} joints without names, expected an arm of so many.")
    note = f"log of libfranka: times in ms, joints 1 to {_FRANKA_JOINTS} are {', '.join(names)}"
    kept = np.append(np.diff(column["time"]) != 0.0, True)[: len(column["time"])]
    parts = (None if part is None else part[kept] for part in (position, velocity, torque))
    return JointLog(1e-3 * column["time"][kept], *parts, names, path.name, (note,))


def _table(text: str) -> tuple[list[str], list[Row]]:
    """The header and the numbered rows; separated by what the header is."""
    lines = list(data_lines(text))
    first = lines[0][1] if lines else ""
    delimiter = next((candidate for candidate in _DELIMITERS if candidate in first), " ")
    rows = [(line, [cell.strip() for cell in cells]) for line, cells in split_all(lines, delimiter)]
    return (rows[0][1] if rows else []), rows[1:]


def _without(names: Sequence[str], header: list[str], rows: list[Row]) -> tuple[list[str], list[Row]]:
    """The table without columns of these names; a row of another length stays as it is and is refused later."""
    kept = [k for k, name in enumerate(header) if name not in names]
    if len(kept) == len(header):
        return header, rows
    shorter = [(n, [cells[k] for k in kept] if len(cells) == len(header) else cells) for n, cells in rows]
    return [header[k] for k in kept], shorter


def _clock_and_joints(header: list[str]) -> tuple[str, tuple[str, ...]]:
    """The name of the time and those of the joints."""
    clock = next((name for name in header if name.lower() in _TIMES), None)
    if clock is None or len(set(header)) != len(header):
        shown = ",".join(header[:4]) + (",..." if len(header) > 4 else "")
        raise InvalidArgument(f"line 1: '{shown}', expected a header: time,<joints>, each name once.")
    suffixes = ("_acc", "_commanded", *_VELOCITIES, *_TORQUES)
    names = tuple(name for name in header if name != clock and not name.endswith(suffixes))
    if not names:
        raise InvalidArgument(f"line 1, no column of a joint beside '{clock}'.")
    return clock, names


def _numbers(row: Row, header: list[str]) -> list[float]:
    line, cells = row
    if len(cells) != len(header):
        raise InvalidArgument(f"line {line}, {len(cells)} cells, expected {len(header)}.")
    return [number(cell, line, column) for cell, column in zip(cells, header, strict=True)]


def _columns(column: dict[str, Array], names: Sequence[str], suffixes: Sequence[str]) -> Array | None:
    """A column for each joint, if there is one."""
    for suffix in suffixes:
        if all(name + suffix in column for name in names):
            return np.column_stack([column[name + suffix] for name in names])
    return None
