"""A grasp from recording to verdict."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from dmpcpp._core import Arm
from dmpcpp.checks import Check, Checked
from dmpcpp.grasp._execution import GraspLog, carry_out
from dmpcpp.grasp._planning import GraspPlan, Planner
from dmpcpp.grasp._task import Bottle
from dmpcpp.grasp._verdict import judge
from dmpcpp.recordings import Recording

__all__ = ["CAVEAT", "Grasp", "grasp"]

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
    log : GraspLog
    checks : tuple of Check
    """

    recording: Recording
    arm: Arm
    plan: GraspPlan
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
            "slowdown": self.plan.slowdown,
            "phases": self.log.phases,
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
    return Grasp(planner.recording, planner.arm, plan, log, judge(log, planner.arm))
