"""An imitation as files: the model, the plan, the joints, the execution, a picture and the summary."""

from __future__ import annotations

import json
from collections.abc import Iterable
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from dmpcpp import export, metrics, motion
from dmpcpp._atomic import replacing, write_text
from dmpcpp._core import save
from dmpcpp._typing import Array
from dmpcpp.show import plot
from dmpcpp.show.report import RunRecord, drawn, write_record

if TYPE_CHECKING:
    from dmpcpp.imitation._flow import Imitation

__all__ = ["write"]


def write(run: Imitation, folder: str | PathLike[str], formats: Iterable[str] = ()) -> export.Written:
    """Write model.json, plan.npz, execution.npz, picture.png and summary.json, each whole or not at all, and what
    robots are sent: joints.csv and more by the names in `export.FORMATS`.

    The summary comes last: a folder that has one has all, and `report.write` makes its report. Files for robots are
    written of a verified run, from rest to rest as it was simulated; what an earlier run left of them is removed. One
    that a robot must not get costs itself only.

    Returns
    -------
    export.Written
        The names of the files for robots, none of a run that is not verified, and why one was refused.

    Raises
    ------
    InvalidArgument
        An unknown format, or one that this arm does not take.
    MissingDependency
        What a format needs is not installed.
    FileError
        The folder or a file cannot be written.
    """
    chosen = export.chosen(formats, run.log.arm)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").unlink(missing_ok=True)
    export.remove_robot_files(folder)
    arm = run.log.arm
    save(run.model, folder / "model.json")
    wanted = run.tempo.wanted if run.tempo else None
    follow = str(run.log.follow)
    export.write_plan(folder / "plan.npz", run.plan, base=arm.base, tip=arm.tip, follow=follow, wanted_time=wanted)
    curves = _curves(run)
    write_record(folder / "execution.npz", _record(run, curves))
    _picture(run, curves, folder / "picture.png")
    sent = export.write_robot_files(folder, run.sent, arm, chosen) if run.ok else export.Written()
    write_text(folder / "summary.json", json.dumps(run.summary(), indent=2, allow_nan=False) + "\n")
    return sent


def _curves(run: Imitation) -> tuple[plot.ErrorCurve, ...]:
    """How far apart two stages are, over the time of the executed motion."""
    demonstrated, during = motion.poses(run.recording), run.log.motion
    again = run.model.rollout_at(run.recording.time).pose
    solved = run.log.arm.forward_kinematics(run.joints.position)

    def curve(label: str, time: Array, a: Array, b: Array) -> plot.ErrorCurve:
        return plot.ErrorCurve(label, time, metrics.position_errors(a, b), metrics.angle_errors(a, b))

    return (
        curve("demonstration → DMP", _when(run), demonstrated, again),
        curve("DMP → FK(IK)", run.plan.time, run.plan.pose, solved),
        curve(
            "FK(IK) → executed",
            run.log.time[during],
            run.log.desired_tool_pose[during],
            run.log.tool_pose[during],
        ),
    )


def _when(run: Imitation) -> Array:
    """Return when the recorded samples are carried out [s]."""
    time = run.recording.time
    return run.tempo.when(time) if run.tempo else run.slowdown * time


def _record(run: Imitation, curves: tuple[plot.ErrorCurve, ...]) -> RunRecord:
    log, during = run.log, run.log.motion
    few = drawn(len(log.time[during]))
    return RunRecord(
        arm=log.arm,
        demonstrated_time=run.recording.time,
        demonstrated_pose=motion.poses(run.recording),
        executed_time=log.time[during][few],
        executed_pose=log.tool_pose[during][few],
        executed_joints=log.position[during][few],
        joint_time=log.time,
        position=log.position,
        velocity=log.velocity,
        torque=log.torque,
        errors=curves,
    )


def _picture(run: Imitation, curves: tuple[plot.ErrorCurve, ...], path: Path) -> None:
    with replacing(path) as temporary:
        plot.picture(
            temporary,
            demonstrated=motion.poses(run.recording),
            planned=run.plan.pose,
            executed=run.log.tool_pose[run.log.motion],
            errors=curves,
            title=f"{run.recording.source} ({run.recording.body}) on {run.log.arm.name}",
            note=f"{run.verdict_word}; {run.slowdown:.2f} x the recorded duration; {run.log.simulator}, {run.log.mode}",
        )
