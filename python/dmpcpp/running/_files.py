"""The log of a run as the CSV that `dmpcpp verify` reads."""

from __future__ import annotations

import csv
import io
from os import PathLike

import numpy as np

from dmpcpp._atomic import write_text
from dmpcpp._typing import Array
from dmpcpp.running._robot import CycleLog
from dmpcpp.running._session import Briefing, Run
from dmpcpp.verification import JointLog

__all__ = ["as_joint_log", "write_log"]


def write_log(path: str | PathLike[str], briefing: Briefing, run: Run, *, online: bool = False) -> None:
    """Write every cycle: time [s] (0 at the motion's first sample), joints, velocities, torques, what was commanded,
    the period [s], our own work in the cycle [s] and the phase (approach, lead-in, motion, lead-out; of a motion whose
    goal moved `online` only approach and motion).
    """
    names, log = briefing.plan.joint_names, run.log
    header = ["time", *names]
    header += [f"{name}{suffix}" for suffix in ("_vel", "_torque", "_commanded") for name in names]
    plain = (log["position"], log["velocity"], log["torque"], log["commanded"])
    phases = np.where(run.time < briefing.plan.time[0], "approach", "motion") if online else _phases(briefing, run.time)
    values = np.column_stack([run.time, *plain, log["period"], log["work"]])
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*header, "period", "work", "phase"])
    writer.writerows([*row, phase] for row, phase in zip(values.tolist(), phases, strict=True))
    write_text(path, text.getvalue())


def as_joint_log(log: CycleLog, time: Array, names: tuple[str, ...], source: str) -> JointLog:
    """Return the cycles as `verification.verify` takes them; of cycles with one time the last counts."""
    kept = np.append(np.diff(time) > 0.0, True)[: len(time)]
    parts = (log["position"], log["velocity"], log["torque"])
    return JointLog(time[kept], *(part[kept] for part in parts), names, source)


def _phases(briefing: Briefing, time: Array) -> list[str]:
    plan = briefing.plan
    during = plan.motion or slice(0, len(plan.time))
    first, last = plan.time[during][[0, -1]]
    edges = (plan.time[0] - 1e-9, first - 1e-9, last + 1e-9)
    names = ("approach", "lead-in", "motion", "lead-out")
    return [names[k] for k in np.searchsorted(edges, time, side="right")]
