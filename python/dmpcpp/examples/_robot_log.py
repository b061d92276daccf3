"""What a robot's encoders would have recorded of a plan: a stand-in where there is no robot."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from dmpcpp import export
from dmpcpp.errors import FileError

__all__ = ["robot_log"]

_SEED = 2026
_BEFORE = 0.4  # s that the log begins before the motion
_RATE = 250.0  # Hz
_LAG = 0.008  # s between command and joint
_ENCODER = 2 * np.pi / 2**19  # rad a count
_ERROR = 5e-5  # rad, standard deviation of what the controller leaves


def robot_log(run: str | Path) -> str:
    """Return a CSV log (time in s, joints in rad) of a robot that followed `joints.csv` of a run's folder.

    Raises
    ------
    FileError
        The folder has no joints.csv.
    """
    source = Path(run) / "joints.csv"
    if not source.is_file():
        raise FileError(f"{source}: not found, expected the folder of a verified run.")
    plan = export.read_joints(source)
    generator = np.random.default_rng(_SEED)
    clock = np.arange(0.0, plan.time[-1] - plan.time[0] + 2 * _BEFORE, 1 / _RATE)
    then = np.clip(plan.time[0] + clock - _BEFORE - _LAG, plan.time[0], plan.time[-1])
    joints = np.stack([np.interp(then, plan.time, column) for column in plan.position.T], axis=1)
    sway = generator.normal(0, _ERROR, joints.shape[1]) * np.sin(2 * np.pi * 0.5 * clock)[:, None]
    counted = np.round((joints + sway) / _ENCODER) * _ENCODER
    rows = [",".join(f"{value:.6f}" for value in (t, *row)) for t, row in zip(clock, counted, strict=True)]
    return "\n".join([",".join(("time", *plan.joint_names)), *rows]) + "\n"
