"""What a report draws of an execution, in one file beside the model and the plan."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dmpcpp._atomic import replacing
from dmpcpp._core import Arm, LimitSource
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.show.plot import ErrorCurve

__all__ = ["RunRecord", "read_record", "write_record"]

_MOST_POSES = 2000  # of a path that is drawn; joints and errors are kept at every step


@dataclass(frozen=True, eq=False)
class RunRecord:
    """One execution, as far as it is drawn.

    Attributes
    ----------
    arm : Arm
    demonstrated_time, demonstrated_pose : (K,) s, (K, 4, 4)
        In the arm's base frame.
    executed_time, executed_pose, executed_joints : (T,) s, (T, 4, 4), (T, n)
        The motion itself, at 2000 steps or fewer.
    joint_time, position, velocity, torque : (N,) s, (N, n) rad, rad/s, Nm
        Every step, lead-in and settling included; kept to 7 digits.
    errors : tuple of ErrorCurve
        One a stage.
    """

    arm: Arm
    demonstrated_time: Array
    demonstrated_pose: Array
    executed_time: Array
    executed_pose: Array
    executed_joints: Array
    joint_time: Array
    position: Array
    velocity: Array
    torque: Array
    errors: tuple[ErrorCurve, ...]


_ARRAYS = (
    "demonstrated_time",
    "demonstrated_pose",
    "executed_time",
    "executed_pose",
    "executed_joints",
    "joint_time",
    "position",
    "velocity",
    "torque",
)
_SINGLE = frozenset({"position", "velocity", "torque"})
_LIMITS = ("lower", "upper", "velocity_limit", "effort_limit")
_LATER_LIMITS = ("acceleration_limit", "jerk_limit")  # records of before 0.2 have neither these nor sources
_KINDS = ("position", "velocity", "acceleration", "jerk", "effort")


def drawn(count: int) -> NDArray[np.intp]:
    """Return which of `count` steps are kept of a path that is drawn."""
    return np.unique(np.linspace(0, count - 1, min(count, _MOST_POSES)).round().astype(np.intp))


def write_record(path: str | PathLike[str], record: RunRecord) -> None:
    """Write a record as .npz, whole or not at all; the same record gives the same file.

    Raises
    ------
    FileError
        The file cannot be written.
    """
    arm = record.arm
    fields = {name: getattr(record, name) for name in _ARRAYS}
    fields = {name: array.astype(np.float32) if name in _SINGLE else array for name, array in fields.items()}
    fields |= {f"arm_{name}": getattr(arm, name) for name in (*_LIMITS, *_LATER_LIMITS)}
    fields |= {f"arm_{kind}_source": np.array([s.name for s in each]) for kind, each in arm.limit_sources.items()}
    fields |= {f"arm_{name}": np.array(getattr(arm, name)) for name in ("urdf", "base", "tip", "folder")}
    fields["error_labels"] = np.array([curve.label for curve in record.errors])
    for k, curve in enumerate(record.errors):
        fields[f"error_{k}"] = np.stack([curve.time, curve.position, curve.angle]).astype(np.float32)
    with replacing(path) as beside:
        np.savez_compressed(beside, **fields)


def read_record(path: str | PathLike[str]) -> RunRecord:
    """Read what `write_record` wrote.

    Raises
    ------
    FileError
        The file is not there or cannot be read.
    InvalidArgument
        It is no record of an execution.
    """
    try:
        with np.load(Path(path), allow_pickle=False) as file:
            return _record({name: file[name] for name in file.files})
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    except (KeyError, ValueError, EOFError) as error:
        raise InvalidArgument(
            f"{path}: no record of an execution ({error}); expected one that `dmpcpp imitate` wrote. Run it again."
        ) from None


def _record(found: dict[str, NDArray[np.generic]]) -> RunRecord:
    words = {name: str(found[f"arm_{name}"]) for name in ("base", "tip", "folder")}
    arm = Arm.from_urdf(str(found["arm_urdf"]), **words)
    lower, upper, velocity, effort = (np.asarray(found[f"arm_{name}"], dtype=np.float64) for name in _LIMITS)
    arm = arm.with_limits(lower=lower, upper=upper, velocity=velocity, effort=effort, **_later_limits(found))
    arrays = {name: np.asarray(found[name], dtype=np.float64) for name in _ARRAYS}
    labels = [str(label) for label in found["error_labels"]]
    errors = tuple(ErrorCurve(label, *found[f"error_{k}"].astype(np.float64)) for k, label in enumerate(labels))
    return RunRecord(arm=arm, errors=errors, **arrays)


def _later_limits(found: dict[str, NDArray[np.generic]]) -> dict[str, Any]:
    if f"arm_{_LATER_LIMITS[0]}" not in found:
        return {}
    acceleration, jerk = (np.asarray(found[f"arm_{name}"], dtype=np.float64) for name in _LATER_LIMITS)
    sources = {kind: tuple(LimitSource[str(name)] for name in found[f"arm_{kind}_source"]) for kind in _KINDS}
    return {"acceleration": acceleration, "jerk": jerk, "source": sources}
