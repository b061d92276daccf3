"""A grasp from recording to verdict."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from dmpcpp import export, sending
from dmpcpp._atomic import write_text
from dmpcpp._core import Arm
from dmpcpp.checks import Check, Checked
from dmpcpp.grasp._execution import GraspLog, carry_out
from dmpcpp.grasp._planning import GraspPlan, Planner
from dmpcpp.grasp._task import Bottle
from dmpcpp.grasp._verdict import judge
from dmpcpp.recordings import Recording
from dmpcpp.sending import RestToRest

__all__ = ["CAVEAT", "Grasp", "grasp", "write"]

CAVEAT = (
    "the controller knows the arm's masses exactly and the bottle's not at all; contact is rigid with Coulomb "
    "friction, and nothing but friction holds the bottle"
)
"""What this simulation can and cannot see."""


@dataclass(frozen=True, eq=False)
class Grasp(Checked):
    """A grasp from recording to verdict.

    Attributes
    ----------
    recording : Recording
        The reach as it was cut out.
    arm : Arm
    plan : GraspPlan
    sent : RestToRest
        The joints with a lead-in and a lead-out: what was carried out, and what a robot may get.
    log : GraspLog
    checks : tuple of Check
    """

    recording: Recording
    arm: Arm
    plan: GraspPlan
    sent: RestToRest
    log: GraspLog
    checks: tuple[Check, ...]

    def summary(self) -> dict[str, Any]:
        """Return the grasp for JSON; m, s and rad."""
        return {
            **self.judged(),
            "arm": self.arm.name,
            "bottle": asdict(self.plan.bottle),
            "recording": {
                "source": self.recording.source,
                "body": self.recording.body,
                "duration": self.recording.duration,
                "history": list(self.plan.history),
            },
            "basis_count": self.plan.model.options.basis_count,
            "pitch": self.plan.pitch,
            "clearance": self.plan.clearance,
            "obstacles": [obstacle.to_dict() for obstacle in self.plan.around.obstacles],
            "slowdown": self.plan.slowdown,
            "phases": self.log.phases,
            "leads": self.sent.to_dict(),
            "duration": self.log.steps / self.log.rate,
            "simulator": self.log.simulator,
            "mode": "computed_torque",
            "caveat": CAVEAT,
        }


def grasp(planner: Planner, bottle: Bottle, progress: Callable[[float], None] | None = None) -> Grasp:
    """Plan to grasp a bottle, carry it out under physics and judge it; the same arguments give the same result.

    Raises
    ------
    InvalidArgument
        The bottle cannot be reached; see `Planner.plan`.
    MissingDependency
        PyBullet is not installed.
    """
    plan = planner.plan(bottle)
    log = carry_out(plan, planner.arm, planner.gripper, progress=progress)
    sent = sending.from_rest_to_rest(planner.arm, plan.joints)
    checks = (*judge(log, planner.arm), sending.ready(sending.check(sent, planner.arm)))
    return Grasp(planner.recording, planner.arm, plan, sent, log, checks)


def write(run: Grasp, folder: str | PathLike[str], formats: Iterable[str] = ()) -> export.Written:
    """Write summary.json and, of a grasp that is ok, the joints for a robot; `imitation.write` has the rules.

    The joints are those of the arm: the gripper closes between the summary's phases "close" and "lift", which count
    from the end of the lead-in.
    """
    chosen = export.chosen(formats, run.arm)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").unlink(missing_ok=True)
    export.remove_robot_files(folder)
    sent = export.write_robot_files(folder, run.sent, run.arm, chosen) if run.ok else export.Written()
    write_text(folder / "summary.json", json.dumps(run.summary(), indent=2, allow_nan=False) + "\n")
    return sent
