"""`dmpcpp verify`: what a real arm recorded, held against the plan that it was given."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._arm_options import arm_options, contact_options, follow_option, taken_arm, taken_surroundings
from dmpcpp.cli._choices import engines
from dmpcpp.cli._config import options_of_run
from dmpcpp.cli._flags import flags_of
from dmpcpp.cli._group import FAILED
from dmpcpp.cli._limit_options import accept_option, names
from dmpcpp.cli._options import DEFAULT_ENGINE, SHOWN_ENGINE
from dmpcpp.cli._tables import print_checks
from dmpcpp.cli._verdict import print_verdict
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from rich.table import Table

    from dmpcpp.simulation import Tolerances
    from dmpcpp.verification import Verification


def check_limit_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --check-limit."""
    return click.option(
        "--check-limit",
        "stated",
        multiple=True,
        metavar="NAME=VALUE",
        help="Override the limit of a check [m, rad, ratios], e.g. position_max=0.005; repeatable.",
    )(command)


@click.command()
@click.argument("plan", type=click.Path(path_type=Path))
@click.argument("log", type=click.Path(path_type=Path))
@arm_options
@follow_option
@contact_options
@click.option("--topic", metavar="NAME", help="Topic of the joint states; required if a bag has several.")
@click.option("--time-unit", default="s", show_default=True, metavar="s|ms|us|ns", help="Time unit of a CSV log.")
@click.option("--angle-unit", default="rad", show_default=True, metavar="rad|deg", help="Angle unit of a CSV log.")
@click.option("--low-pass", default=20.0, show_default=True, metavar="HZ", help="Cutoff for velocity and acceleration.")
@check_limit_option
@click.option("--tolerance", "stated_before", multiple=True, hidden=True)  # its name before 0.2
@accept_option
@click.option(
    "--simulator",
    default=DEFAULT_ENGINE,
    show_default=SHOWN_ENGINE,
    type=engines("none"),
    help="Physics engine that checks the executed path for contacts.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON instead of the tables.")
def verify(
    plan: Path,
    log: Path,
    topic: str | None,
    time_unit: str,
    angle_unit: str,
    low_pass: float,
    stated: tuple[str, ...],
    stated_before: tuple[str, ...],
    accept: tuple[str, ...],
    simulator: str,
    as_json: bool,
    **arm: Any,
) -> None:
    """Compare LOG, recorded on a real arm, with PLAN: the joints.csv of `dmpcpp imitate`, or its folder.

    In the folder of a run, arm, limits, contacts and what is followed are as in that run unless stated.

    LOG is a CSV with the columns time, <joints> and optionally <joint>_vel and <joint>_torque, or a ROS bag with
    sensor_msgs/JointState. Its time lag is estimated from the joints: the two clocks need not agree.

    Example: dmpcpp verify reach/joints.csv log.csv --arm panda --check-limit position_max=0.005
    """
    from dmpcpp import export, simulation, verification

    if stated_before:
        click.echo("dmpcpp: --tolerance is --check-limit now; the old name works until 0.3.", err=True)
    tolerances = tolerances_of((*stated_before, *stated))
    joints = export.read_joints(plan / "joints.csv" if plan.is_dir() else plan)
    as_run = options_of_run(plan if plan.is_dir() else plan.parent, arm, same="arm")
    arm |= as_run
    robot, around = taken_arm(arm), taken_surroundings(arm)
    engine = simulation.ENGINES.get(simulator)
    options = {"time_unit": time_unit, "angle_unit": angle_unit, "topic": topic}
    result = verification.verify(
        robot,
        joints,
        verification.read_log(log, **options, joints=robot.joint_names),
        tolerances=tolerances,
        cutoff=low_pass,
        simulator=around.in_world(engine) if engine else None,
        follow=arm["follow"] or "pose",
        accept=names(accept),
    )
    if as_json:
        click.echo(json.dumps(result.summary(), indent=2, allow_nan=False))
    else:
        if as_run:
            typed = flags_of(click.get_current_context().command)
            click.echo(f"as in the run: {', '.join(f'{typed[name]} {_shown(as_run[name])}' for name in as_run)}")
        print_verification(result)
    if not result.ok:
        sys.exit(FAILED)


def _shown(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, tuple | list) else str(value)


def tolerances_of(stated: tuple[str, ...]) -> Tolerances:
    from dmpcpp.simulation import Tolerances

    known = {field.name: field for field in fields(Tolerances)}
    values: dict[str, float] = {}
    for text in stated:
        name, equals, value = text.partition("=")
        if name not in known or not equals:
            raise InvalidArgument(f"--check-limit: '{text}', expected NAME=VALUE with a NAME of {', '.join(known)}.")
        try:
            values[name] = float(value)
        except ValueError:
            raise InvalidArgument(f"--check-limit: '{text}', expected a number after '='.") from None
        if not math.isfinite(values[name]):
            raise InvalidArgument(f"--check-limit: '{text}', expected a finite number.")
    return Tolerances(**values)  # type: ignore[arg-type]


def print_verification(result: Verification) -> None:
    from rich.console import Console

    from dmpcpp.robot import assumptions

    console = Console(highlight=False)
    for line in result.notes:
        console.print(line, style="dim", soft_wrap=True, markup=False)
    console.print(f"plan starts at {result.lag:.4f} s on the log's clock")
    console.print(_measures_table(result))
    print_checks(console, result.checks)
    how = f"{result.log.arm.name}, {result.log.simulator}, {result.log.mode} ({result.log.caveat})."
    print_verdict(console, result, how, assumed=assumptions(result.log.arm))


def _measures_table(result: Verification) -> Table:
    from rich.table import Table

    found, errors = result.comparison, result.comparison.errors
    rows = (
        ("position RMSE, max", 1e3, "mm", errors.position_rmse, errors.position_max),
        ("angle RMSE, max", math.degrees(1.0), "deg", errors.angle_rmse, errors.angle_max),
        ("last pose: position", 1e3, "mm", found.final.position),
        ("last pose: angle", math.degrees(1.0), "deg", found.final.angle),
        ("DTW a sample, Frechet", 1e3, "mm", found.dtw, found.frechet),
        ("remaining lag of the tool", 1e3, "ms", found.lag),
        ("smoothness against the plan: SPARC, log jerk", 1.0, "", found.sparc, found.log_dimensionless_jerk),
        ("margin of velocity, torque", 100.0, "%", result.velocity_margin, result.torque_margin),
    )
    table = Table(title="executed against the plan, lag taken out", title_justify="left")
    table.add_column("")
    for title in ("value", "", "unit"):
        table.add_column(title, justify="left" if title == "unit" else "right")
    for name, scale, unit, *values in rows:
        shown = ["-" if value is None else f"{scale * value:.3g}" for value in values]
        table.add_row(name, *(shown if len(shown) == 2 else [*shown, ""]), unit)
    return table
