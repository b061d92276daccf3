"""`dmpcpp run --goal-from`: the model of a run in the loop, its goal moved while the robot moves."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._tables import print_checks
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from dmpcpp import PoseDmp
    from dmpcpp.robot import Follow
    from dmpcpp.running import Briefing, GoalSource, OnlineMotion, Robot, Run
    from dmpcpp.simulation import Tolerances


@dataclass
class OnlineRun:
    """The model, the source of its goals, and what is tolerated at the end."""

    model: PoseDmp
    goals: GoalSource
    follow: Follow
    tolerances: Tolerances
    motion: OnlineMotion | None = None

    @staticmethod
    def of(plan: Path, address: str, follow: Follow, tolerances: Tolerances) -> OnlineRun:
        """Take the model of a folder, and reach the source."""
        from dmpcpp import PoseDmp, load, running

        path = (plan if plan.is_dir() else plan.absolute().parent) / "model.json"
        if not path.exists():
            raise InvalidArgument(f"--goal-from: {path} is not there. Give the folder of `dmpcpp imitate`.")
        model = load(path)
        if not isinstance(model, PoseDmp):
            raise InvalidArgument(f"--goal-from: {path} holds a {type(model).__name__}, expected a PoseDmp.")
        return OnlineRun(model, running.goals_from(address), follow, tolerances)

    def execute(self, robot: Robot, found: Briefing, *, watch: Callable[[], bool] | None = None) -> Run:
        """Move the robot: the approach, then the model."""
        from dmpcpp import running

        plan = found.plan
        span = plan.time[plan.motion] if plan.motion else plan.time
        first = plan.position[plan.motion.start if plan.motion else 0]
        how: dict[str, Any] = {"approach": found.approach, "follow": self.follow, "watch": watch}
        duration, period = float(span[-1] - span[0]), 1.0 / found.info.rate
        self.motion = running.OnlineMotion(
            self.model, found.arm, first, plan.position[0], self.goals, duration=duration, period=period, **how
        )
        try:
            return running.execute(robot, found, targets=self.motion)
        finally:
            self.goals.close()

    def verdict(self, found: Briefing, result: Run, folder: Path) -> bool:
        """Print and write how near the tip came to the last goal, and within which limits; return whether all hold."""
        from rich.console import Console

        from dmpcpp import running
        from dmpcpp._atomic import write_text

        assert self.motion is not None
        reached = self.motion.reached(result.log["position"][-1])
        checks = running.online_checks(
            reached, result.log["commanded"], found.arm, 1.0 / found.info.rate, self.tolerances
        )
        if str(self.follow) != "pose":
            checks = [each for each in checks if each.name != "goal_angle"]
        ok = all(each.ok for each in checks)
        goal = {"taken": self.goals.taken, "broken": self.goals.broken, "late": self.goals.late}
        summary = {"ok": ok, "goal": goal, "missed": reached.missed, "checks": [each.to_dict() for each in checks]}
        write_text(folder / "verification.json", json.dumps(summary, indent=2, allow_nan=False) + "\n")
        click.echo(self.goals.describe())
        if reached.missed:
            click.echo(f"{reached.missed} cycles off the pose: out of reach, or at a limit of the joints")
        print_checks(Console(), tuple(checks))
        verdict = "verified" if ok else "not verified"
        near = f"{1e3 * reached.position:.3g} mm from the last goal"
        click.echo(f"{verdict}: the tip came to rest {near}; contacts and torques were not judged.")
        return ok
