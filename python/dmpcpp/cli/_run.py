"""`dmpcpp run`: a verified plan on a robot, the library's own physics or a real one."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._arm_options import contact_options, follow_option, optional_arm_options, taken_arm, taken_surroundings
from dmpcpp.cli._choices import engines
from dmpcpp.cli._config import options_of_run
from dmpcpp.cli._group import FAILED, INTERRUPTED, refuse_file
from dmpcpp.cli._limit_options import accept_option, names
from dmpcpp.cli._numbers import numbers
from dmpcpp.cli._options import DEFAULT_ENGINE, SHOWN_ENGINE
from dmpcpp.cli._run_folder import joints_of, require_verified
from dmpcpp.cli._verification import check_limit_option, print_verification, tolerances_of
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from dmpcpp.running import Briefing, Robot, Run
    from dmpcpp.verification import Verification

_LONG = 1e-3  # s; a cycle of our own work that is longer is counted


@click.command()
@click.argument("plan", type=click.Path(path_type=Path))
@click.option(
    "--robot",
    "address",
    default="sim",
    show_default=True,
    metavar="sim|franka://HOST",
    help="The library's own physics in real time, or a real robot.",
)
@click.option("--go", is_flag=True, help="Move a real robot; without it nothing is moved.")
@click.option(
    "--countdown", type=click.FloatRange(1.0), metavar="S", help="Count down S seconds instead of a key that is held."
)
@click.option("--yes", is_flag=True, help="Where there is no terminal: move without a key or a countdown.")
@click.option(
    "--speed",
    default=1.0,
    show_default=True,
    type=click.FloatRange(0.0, 1.0, min_open=True),
    help="Share of the plan's speed.",
)
@click.option(
    "--goal-from",
    metavar="FILE|stdin|udp://HOST:PORT",
    help="Move the goal while the robot moves: lines or packets 't x y z [qx qy qz qw]' [s, m, base frame of the arm]; "
    "udp://:PORT listens to this machine alone. The model of the folder then runs in the loop.",
)
@click.option("--from-joints", metavar="Q1,Q2,..", help="Where a simulated robot stands [rad] (default: at the start).")
@optional_arm_options("The arm of the plan (default: that of the folder).")
@follow_option
@contact_options
@check_limit_option
@accept_option
@click.option(
    "--simulator",
    default=DEFAULT_ENGINE,
    show_default=SHOWN_ENGINE,
    type=engines(),
    help="Physics engine of a simulated robot, and for the contacts of the approach.",
)
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder for robot.csv and verification.json (default: PLAN/robot).",
)
def run(
    plan: Path,
    address: str,
    go: bool,
    countdown: float | None,
    yes: bool,
    speed: float,
    goal_from: str | None,
    from_joints: str | None,
    stated: tuple[str, ...],
    accept: tuple[str, ...],
    simulator: str,
    out: Path | None,
    **arm: Any,
) -> None:
    """Run PLAN, a folder of `dmpcpp imitate` or `plan` or its joints.csv, on a robot, and verify what it did.

    A real robot is looked at first: where it stands, the way to the start, the limits, the duration. It moves only with
    --go: at a terminal while space is held, or after --countdown S; without a terminal only with --yes as well. Ctrl-C
    and a released key slow it down along its path to a stop; a second Ctrl-C leaves the stop to the robot.

    With --goal-from the motion ends where the goal is last seen: the verdict is how near, within which limits. Contacts
    and torques on the way there are not judged.

    Example: dmpcpp run reach --speed 0.5
    """
    from dmpcpp import export, running
    from dmpcpp.cli._run_online import OnlineRun
    from dmpcpp.planning import clear_of_itself
    from dmpcpp.robot import Follow

    simulated = running.is_simulated(address)
    folder = out or (plan if plan.is_dir() else plan.absolute().parent) / "robot"
    require_verified(plan)
    joints = export.read_joints(joints_of(plan))
    refuse_file(folder)
    options = arm | options_of_run(plan if plan.is_dir() else plan.absolute().parent, arm, same="arm")
    if options["arm"] is None:
        raise InvalidArgument("--arm: not given, and there is no config.toml beside the plan. State the arm.")
    around, chosen = taken_surroundings(options), taken_arm(options)
    engine = around.in_world(_engine(simulator))
    stands = numbers("--from-joints", from_joints, chosen.joint_count) if from_joints else joints.position[0]
    followed = Follow.of(options["follow"] or "pose")
    online = OnlineRun.of(plan, goal_from, followed, tolerances_of(stated)) if goal_from else None
    robot = running.robot_at(address, chosen, stands, engine=engine)
    try:
        found = _briefed(
            robot, chosen, joints, speed, lambda limited: clear_of_itself(limited, engine, around.margin).keeps_clear
        )
        _print_briefing(found, chosen)
        if found.problems:
            raise InvalidArgument(found.problems[0])
        if not (simulated or _may_move(go, countdown, yes)):
            return
        moved = online.execute if online else running.execute
        result = _moved(moved, robot, found, simulated or yes, countdown)
    finally:
        robot.close()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "verification.json").unlink(missing_ok=True)
    running.write_log(folder / "robot.csv", found, result, online=online is not None)
    _print_cycles(result, folder / "robot.csv")
    if result.stopped or not result.end.complete:
        click.echo("stopped on the way; not verified." if result.stopped else f"not verified: {result.end.reason}")
        sys.exit(INTERRUPTED if result.stopped else FAILED)
    if online:
        sys.exit(0 if online.verdict(found, result, folder) else FAILED)
    judging = {"follow": followed, "accept": names(accept), "simulator": engine}
    verified = _verified(found, result, folder, tolerances=tolerances_of(stated), **judging)
    if not verified.ok:
        sys.exit(FAILED)


def _engine(name: str) -> Any:
    from dmpcpp import simulation

    return simulation.ENGINES[name]


def _briefed(robot: Robot, arm: Any, joints: Any, speed: float, clear: Any) -> Briefing:
    """Return the briefing; what keeps the robot from being looked at is wrong input."""
    from dmpcpp import running

    try:
        return running.brief(robot, arm, joints, speed=speed, clear=clear)
    except running.RobotError as error:
        raise InvalidArgument(str(error)) from None


def _may_move(go: bool, countdown: float | None, yes: bool) -> bool:
    """Whether a person has said that the real robot may move; says what is missing otherwise."""
    if not go:
        click.echo("         nothing was moved. Add --go to move this robot.")
        return False
    if not (sys.stdin.isatty() or yes):
        raise InvalidArgument("--go: there is no terminal to hold a key at. Add --yes to move the robot without.")
    if yes and not sys.stdin.isatty():
        return True
    if countdown is None:
        from dmpcpp.cli._hold_to_run import wait_for_key

        click.echo("hold SPACE to move; the robot stops along its path when it is released.")
        return wait_for_key()
    for left in range(int(countdown), 0, -1):
        click.echo(f"moving in {left} s; Ctrl-C ends it")
        time.sleep(1.0)
    return True


def _moved(execute: Callable[..., Run], robot: Robot, found: Briefing, unwatched: bool, countdown: float | None) -> Run:
    from dmpcpp import running

    try:
        if unwatched or countdown is not None:
            return execute(robot, found)
        return _moved_while_held(execute, robot, found)
    except running.RobotError as error:
        raise InvalidArgument(str(error)) from None


def _moved_while_held(execute: Callable[..., Run], robot: Robot, found: Briefing) -> Run:
    from dmpcpp.cli._hold_to_run import held_key

    with held_key() as released:
        return execute(robot, found, watch=released)


def _print_briefing(found: Briefing, arm: Any) -> None:
    from dmpcpp.cli._tables import arm_line

    off, joint = found.distance
    way, duration = found.duration
    limits = {one.name: one.value for one in reversed(found.checks) if one.unit == "1" and one.name != "robot_spacing"}
    shown = [f"{name.removeprefix('robot_').replace('_', ' ')} {100 * most:.0f} %" for name, most in limits.items()]
    stands = " ".join(f"{q:.2f}" for q in found.state.commanded)
    lines = {
        "robot": f"{found.info.name}: {found.state.mode}",
        "arm": arm_line(arm),
        "stands": f"{stands}; the motion starts {off:.3g} rad away" + (f" ({joint})" if off > 0.0 else ""),
        "approach": f"{way:.1f} s at 10 % of the limits" if way else "none: the robot stands at the start",
        "motion": f"{duration:.2f} s, rest to rest",
        "limits": ", ".join(reversed(shown)),
    }
    for label, text in lines.items():
        click.echo(f"{label:<9}{text}")
    for note in (*found.info.notes, *found.advice):
        click.echo(f"{'note':<9}{note}")


def _print_cycles(result: Run, path: Path) -> None:
    import numpy as np

    work = 1e3 * result.log["work"]
    if len(work) == 0:
        click.echo("no cycle was answered.")
        return
    median, most = np.quantile(work, (0.5, 0.999))
    click.echo(
        f"{len(work)} cycles, {result.log.lost} lost; our work in one: median {median:.3f} ms, 99.9 % at most "
        f"{most:.3f} ms, {int((work > 1e3 * _LONG).sum())} above 1 ms; log: {path}"
    )


def _verified(found: Briefing, result: Run, folder: Path, **judging: Any) -> Verification:
    """Hold the log against the plan, print it and write verification.json."""
    import json

    from dmpcpp import running, verification
    from dmpcpp._atomic import write_text

    log = running.as_joint_log(result.log, result.time, found.plan.joint_names, found.info.name)
    verified = verification.verify(found.arm, found.plan, log, **judging)
    write_text(folder / "verification.json", json.dumps(verified.summary(), indent=2, allow_nan=False) + "\n")
    print_verification(verified)
    return verified
