"""Trajectories out, in the files that robot engineers use, and back in; each written whole or not at all.

Joint CSV: `time,<joints>,<joints>_vel,<joints>_acc`, and `phase` where a lead-in and a lead-out are in it; s, rad
(m for a sliding joint). Plan: a .npz with `time`, `pose`, `twist`, `wanted_time`, names of units and frames. TUM:
`t tx ty tz qx qy qz qw`; read it, or a plan, with `recordings.load`.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp._atomic import replacing, write_text
from dmpcpp._text import number, read_text
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.export._checks import JointSamples, checked, finite, strict_times
from dmpcpp.recordings import read_arrays
from dmpcpp.sending import PHASES, JointMotion

if TYPE_CHECKING:
    from dmpcpp import Arm

__all__ = ["Plan", "read_joints", "read_plan", "write_joint_arrays", "write_joints", "write_plan", "write_tum"]

_PHASE = "phase"
_UNITS = "time s; pose m; twist m/s and rad/s, in the base frame"


class PoseMotion(Protocol):
    """What `write_plan` takes: a dmpcpp.PoseTrajectory, or anything with its fields."""

    @property
    def time(self) -> Array:
        """(T,) s."""

    @property
    def pose(self) -> Array:
        """(T, 4, 4) [R p; 0 1]."""

    @property
    def twist(self) -> Array:
        """(T, 6) m/s, rad/s."""


@dataclass(frozen=True, eq=False)
class Plan:
    """Cartesian trajectory in plan.npz (joint plan: `planning.JointPlan`): time (T,) s, pose (T, 4, 4) of tip in base,
    twist (T, 6), names of both frames.

    `wanted_time` (T,) s is the time of each sample before it was slowed down; None in plans of before 0.2.
    """

    time: Array
    pose: Array
    twist: Array
    base: str
    tip: str
    follow: str = "pose"
    wanted_time: Array | None = None


def write_joints(path: str | PathLike[str], trajectory: JointMotion, arm: Arm | None = None) -> None:
    """Write a joint trajectory as CSV; the numbers read back exactly.

    Parameters
    ----------
    path : path
    trajectory : JointTrajectory
        time (T,), position, velocity and acceleration (T, n), joint_names (n); a `sending.RestToRest` brings the
        column `phase`, which says of each sample whether it is of the lead-in, the motion or the lead-out.
    arm : Arm, optional
        Which gets the joints: `sending.require` decides whether it may.

    Raises
    ------
    InvalidArgument
        A number that is not finite (named by row and joint), arrays whose sizes differ, time that does not
        increase, a joint without a name or two of the same name.
    FileError
        The file cannot be written; an older one is untouched.
    """
    samples = checked(trajectory, arm)
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    rows = np.column_stack([samples.time, samples.position, samples.velocity, samples.acceleration]).tolist()
    header = _header(samples.joint_names)
    if samples.motion is not None:
        header = [*header, _PHASE]
        rows = [[*row, phase] for row, phase in zip(rows, samples.phase, strict=True)]
    writer.writerow(header)
    writer.writerows(rows)
    write_text(path, text.getvalue())


def read_joints(path: str | PathLike[str]) -> JointSamples:
    """Read a joint CSV that `write_joints` wrote.

    Raises
    ------
    FileError
        The file is missing or cannot be read.
    InvalidArgument
        The header is another, or a line is damaged; the message names it.
    """
    path = Path(path)
    lines = read_text(path).splitlines()
    try:
        rows = list(csv.reader(lines))
    except csv.Error as error:
        raise InvalidArgument(f"{path.name}: not a CSV ({error}).") from None
    header = rows[0] if rows else []
    names = tuple(header[1 : 1 + (len(header) - 1) // 3])
    if not names or header not in (_header(names), [*_header(names), _PHASE]):
        raise InvalidArgument(f"{path.name}: line 1, expected time,<joints>,<joints>_vel,<joints>_acc[,phase].")
    _refuse_lengths(path, rows[1:], header)
    motion = _motion(path, [row.pop() for row in rows[1:]]) if header[-1] == _PHASE else None
    values = _numbers(rows[1:], header)
    position, velocity, acceleration = np.split(values[:, 1:], 3, axis=1)
    return JointSamples(strict_times(values[:, 0]), position, velocity, acceleration, names, motion)


def write_joint_arrays(path: str | PathLike[str], trajectory: JointMotion, arm: Arm | None = None) -> None:
    """Write joints as .npz: `time`, `position`, `velocity`, `acceleration`, `joint_names`, `phase` and `units`.

    Parameters and errors are those of `write_joints`.
    """
    samples = checked(trajectory, arm)
    with replacing(path) as beside, beside.open("wb") as file:
        np.savez(
            file,
            time=samples.time,
            position=samples.position,
            velocity=samples.velocity,
            acceleration=samples.acceleration,
            joint_names=np.array(samples.joint_names),
            phase=np.array(samples.phase),
            units="time s; position rad (m of a sliding joint), and their derivatives",
        )


def write_plan(
    path: str | PathLike[str],
    trajectory: PoseMotion,
    *,
    base: str = "base",
    tip: str = "tip",
    follow: str = "pose",
    wanted_time: ArrayLike | None = None,
) -> None:
    """Write a pose trajectory as .npz with the arrays `time`, `pose`, `twist` and the texts `units`, `base`, `tip`
    and `follow`.

    Parameters
    ----------
    path : path
    trajectory : PoseTrajectory
        time (T,), pose (T, 4, 4), twist (T, 6).
    base, tip : str
        The frames: poses are of `tip` in `base`.
    follow : str
        The part of each pose that the arm follows.
    wanted_time : array_like (T,), optional
        s, the time of each sample before it was slowed down.

    Raises
    ------
    InvalidArgument
        A number that is not finite, arrays whose sizes differ, or time that does not increase.
    FileError
        The file cannot be written; an older one is untouched.
    """
    time = strict_times(trajectory.time)
    pose = finite("pose", trajectory.pose, (len(time), 4, 4))
    twist = finite("twist", trajectory.twist, (len(time), 6))
    names = {"units": _UNITS, "base": base, "tip": tip, "follow": follow}
    wanted = {} if wanted_time is None else {"wanted_time": finite("wanted_time", wanted_time, (len(time),))}
    with replacing(path) as beside, beside.open("wb") as file:
        np.savez(file, time=time, pose=pose, twist=twist, **names, **wanted)


def read_plan(path: str | PathLike[str]) -> Plan:
    """Read a .npz that `write_plan` wrote.

    Raises
    ------
    FileError
        The file is missing or cannot be read.
    InvalidArgument
        An array is missing, damaged or of another size.
    """
    path = Path(path)
    arrays = read_arrays(path)
    missing = [name for name in ("time", "pose", "twist", "base", "tip") if name not in arrays]
    if missing:
        raise InvalidArgument(f"{path.name}: no array {missing[0]!r}; it holds: {', '.join(arrays) or 'none'}.")
    time = strict_times(arrays["time"])
    pose = finite("pose", arrays["pose"], (len(time), 4, 4))
    twist = finite("twist", arrays["twist"], (len(time), 6))
    wanted = arrays.get("wanted_time")
    wanted = None if wanted is None else finite("wanted_time", wanted, (len(time),))
    return Plan(time, pose, twist, str(arrays["base"]), str(arrays["tip"]), str(arrays.get("follow", "pose")), wanted)


def write_tum(path: str | PathLike[str], time: ArrayLike, pose: ArrayLike) -> None:
    """Write poses as a TUM trajectory: lines of `t tx ty tz qx qy qz qw`, s and m.

    Parameters
    ----------
    path : path
    time : array_like (T,)
        s, strictly increasing.
    pose : array_like (T, 4, 4)
        [R p; 0 1], m.

    Raises
    ------
    InvalidArgument
        A number that is not finite, arrays whose sizes differ, time that does not increase, or a reflection.
    FileError
        The file cannot be written; an older one is untouched.
    """
    time = strict_times(time)
    pose = finite("pose", pose, (len(time), 4, 4))
    determinant = np.linalg.det(pose[:, :3, :3])
    if (determinant <= 0.0).any():
        k = int(np.argmax(determinant <= 0.0))
        raise InvalidArgument(f"pose[{k}]: det(R) = {determinant[k]:.3f}, expected +1 (a reflection).")
    quaternion = Rotation.from_matrix(pose[:, :3, :3]).as_quat()
    rows = np.column_stack([time, pose[:, :3, 3], quaternion]).tolist()
    lines = ["# timestamp tx ty tz qx qy qz qw", *(" ".join(map(repr, row)) for row in rows)]
    write_text(path, "\n".join(lines) + "\n")


def _header(names: Sequence[str]) -> list[str]:
    return ["time", *names, *(f"{name}_vel" for name in names), *(f"{name}_acc" for name in names)]


def _refuse_lengths(path: Path, rows: list[list[str]], header: list[str]) -> None:
    for line, row in enumerate(rows, start=2):
        if len(row) != len(header):
            raise InvalidArgument(f"{path.name}: line {line}, {len(row)} cells, expected {len(header)}.")


def _numbers(rows: list[list[str]], header: list[str]) -> Array:
    columns = [name for name in header if name != _PHASE]
    values = [
        [number(cell, line, column) for cell, column in zip(row, columns, strict=True)]
        for line, row in enumerate(rows, start=2)
    ]
    return np.array(values).reshape(len(values), len(columns))


def _motion(path: Path, phases: list[str]) -> slice:
    """The samples between lead-in and lead-out."""
    order = [PHASES.index(phase) if phase in PHASES else -1 for phase in phases]
    for line, (before, phase) in enumerate(zip([0, *order], order, strict=False), start=2):
        if phase < before:
            raise InvalidArgument(
                f"{path.name}: line {line}, phase '{phases[line - 2]}', expected {', '.join(PHASES)} in this order."
            )
    return slice(order.count(0), order.count(0) + order.count(1))
