"""`dmpcpp grasp`: a person's reach leads a hand to a bottle, which is grasped, lifted and held up."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._add_options import add_options
from dmpcpp.cli._arm_options import follow_option, obstacle_options
from dmpcpp.cli._group import FAILED, refuse_file
from dmpcpp.cli._robot_files import export_option, print_written
from dmpcpp.cli._tables import mark, note_style, number
from dmpcpp.cli._verdict import print_verdict
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from rich.table import Table

    from dmpcpp.grasp import Bottle, Grasp
    from dmpcpp.recordings import Recording


def _bottle_options(command: Callable[..., None]) -> Callable[..., None]:
    options = (
        click.option(
            "--x", type=float, metavar="M", help="Distance of the bottle in front of the robot (default: 0.5)."
        ),
        click.option("--y", type=float, metavar="M", help="Distance of the bottle to the robot's left (default: 0)."),
        click.option("--yaw", type=float, metavar="DEG", help="Approach direction; 0 is straight ahead (default: 0)."),
        click.option(
            "--height", type=float, metavar="M", help="Height of the support; 0 is the floor (default: 0.25)."
        ),
        click.option("--mass", type=float, metavar="KG", help="Mass of the bottle (default: 0.3)."),
        click.option(
            "--friction",
            type=float,
            metavar="MU",
            help="Sliding friction of the bottle (fingers: 1; the product counts; default: 0.8).",
        ),
        click.option(
            "--seed", type=click.IntRange(0), help="Random seed: draws place, yaw and a position error of 4 mm."
        ),
    )
    return add_options(command, options)


def _recording_options(command: Callable[..., None]) -> Callable[..., None]:
    options = (
        click.option(
            "--recording", type=click.Path(path_type=Path), metavar="FILE", help="A reach of your own, in any format."
        ),
        click.option("--body", metavar="NAME", help="Body whose motion is used; required if the file holds several."),
        click.option("--format", "format_", metavar="NAME", help="File format (default: recognised)."),
        click.option("--unit", metavar="m|cm|mm", help="Unit of lengths, where the format does not say it."),
        click.option("--rate", type=float, metavar="HZ", help="Samples per second of a file without times."),
        click.option("--quat-order", metavar="xyzw|wxyz", help="Order of the quaternions of an array."),
        click.option("--up-axis", metavar="x|y|z", help="The recording's axis that points up."),
        click.option("--start", type=float, metavar="S", help="Start of the reach [s] (default: found)."),
        click.option("--end", type=float, metavar="S", help="End of the reach [s]."),
    )
    return add_options(command, options)


@click.command()
@_bottle_options
@_recording_options
@follow_option
@obstacle_options
@click.option(
    "--clutter",
    default=0,
    metavar="K",
    type=click.IntRange(0, 50),
    help="Posts around the bottle, drawn from --seed, that the arm must not touch.",
)
@click.option(
    "--video",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Write a film (.mp4, .gif) or still (.png).",
)
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder for summary.json and, if the bottle is held up, the arm's joints.csv.",
)
@export_option
@click.option("--json", "as_json", is_flag=True, help="Print the result as JSON instead of the table.")
def grasp(
    x: float | None,
    y: float | None,
    yaw: float | None,
    height: float | None,
    mass: float | None,
    friction: float | None,
    seed: int | None,
    follow: str | None,
    obstacle: tuple[str, ...],
    obstacle_margin: float,
    clutter: int,
    video: Path | None,
    out: Path | None,
    formats: tuple[str, ...],
    as_json: bool,
    **recording: Any,
) -> None:
    """Grasp a bottle with Franka's Panda, lift it by 10 cm and hold it up for 2 s.

    One human reach is learned and led to the bottle by its goal. Friction alone holds the bottle.

    Example: dmpcpp grasp --x 0.45 --y 0.1 --video grasp.mp4
    """
    import numpy as np

    from dmpcpp import export
    from dmpcpp import grasp as task
    from dmpcpp.grasp import film, refuse_format
    from dmpcpp.robot import Surroundings, arms, obstacles_of

    if video:
        refuse_format(video)
    bottle = _bottle({"x": x, "y": y, "yaw": yaw, "height": height}, mass, friction, seed)
    panda = arms.find("panda")
    if formats and out is None:
        raise InvalidArgument("--export: it needs a folder. State --out FOLDER.")
    if out:
        refuse_file(out)
    export.chosen(formats, panda)  # what cannot be written is refused before anything runs
    posts = task.clutter(clutter, bottle, np.random.default_rng([seed or 0, 1]))
    around = Surroundings(obstacles=(*obstacles_of(obstacle), *posts), margin=obstacle_margin)
    planner = task.Planner(_reach(**recording), panda, follow=follow, surroundings=around)
    with _progress(as_json) as progress:
        run = task.grasp(planner, bottle, progress("executing under physics"))
        if video:
            film(run, planner.gripper, video, progress("drawing"))
    if as_json:
        click.echo(json.dumps(run.summary(), indent=2, allow_nan=False))
    else:
        _print(run, video)
    written = task.write(run, out, formats) if out else None
    whole = written is None or print_written(written, run.ok, "not held up", quiet=as_json)
    if not (run.ok and whole):
        sys.exit(FAILED)


def _bottle(place: dict[str, float | None], mass: float | None, friction: float | None, seed: int | None) -> Bottle:
    """Return the bottle as drawn or as it stands by default, changed by what was stated."""
    from dataclasses import replace

    import numpy as np

    from dmpcpp.grasp import Bottle, random_bottle

    bottle = Bottle() if seed is None else random_bottle(np.random.default_rng(seed))
    stated = {name: value for name, value in place.items() if value is not None}
    if "yaw" in stated:
        stated["yaw"] = math.radians(stated["yaw"])
    cylinder = bottle.cylinder
    if mass is not None:
        cylinder = replace(cylinder, mass=mass)
    if friction is not None:
        cylinder = replace(cylinder, friction=replace(cylinder.friction, lateral=friction))
    return replace(bottle, cylinder=cylinder, **stated)  # type: ignore[arg-type]


def _reach(
    recording: Path | None,
    body: str | None,
    format_: str | None,
    start: float | None,
    end: float | None,
    **stated: Any,
) -> Recording:
    from dmpcpp import grasp, motion, recordings

    said = {name: value for name, value in stated.items() if value is not None}
    if recording is None:
        unused = [
            name
            for name, value in {"body": body, "format": format_, "start": start, "end": end, **said}.items()
            if value is not None
        ]
        if unused:
            raise InvalidArgument(f"--{unused[0].replace('_', '-')}: it describes a recording; state --recording FILE.")
        return grasp.default_reach()
    loaded = recordings.load(recording, body, format_, **said)
    if start is None and end is None:
        return grasp.longest_reach(loaded)
    return motion.crop(loaded, start or 0.0, end)


@contextmanager
def _progress(hidden: bool) -> Iterator[Callable[[str], Callable[[float], None]]]:
    """Give bars on stderr by their titles."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description:<24}"), BarColumn(), TimeElapsedColumn())
    off = hidden or not sys.stderr.isatty()
    with Progress(*columns, console=Console(stderr=True), transient=True, disable=off) as bars:

        def begin(title: str) -> Callable[[float], None]:
            task = bars.add_task(title, total=1.0)
            return lambda done: bars.update(task, completed=done)

        yield begin


def _print(run: Grasp, video: Path | None) -> None:
    from rich.console import Console

    from dmpcpp.grasp import CAVEAT
    from dmpcpp.robot import assumptions

    console = Console(highlight=False)
    for line in run.plan.history:
        console.print(line, style=note_style(line), soft_wrap=True, markup=False)
    plan, bottle = run.plan, run.plan.bottle
    place = f"x {bottle.x:.3f}, y {bottle.y:.3f}, z {bottle.height:.3f} m, yaw {math.degrees(bottle.yaw):.1f} deg"
    hand = f"{math.degrees(plan.pitch):.0f} deg down and passes it at {1e3 * plan.clearance:.1f} mm"
    console.print(f"bottle at {place}; the hand points {hand}", soft_wrap=True)
    for note in plan.around.notes():
        console.print(note, soft_wrap=True, markup=False)
    begins = ", ".join(f"{name} {time:.2f} s" for name, time in run.log.phases.items())
    console.print(f"{begins}; the reach takes {plan.slowdown:.2f} x the recorded duration", soft_wrap=True)
    console.print(_table(run))
    how = f"{run.log.simulator}, computed torque. {CAVEAT}."
    print_verdict(console, run, how, assumed=assumptions(run.arm), words=("held up", "not verified"))
    if video:
        console.print(f"written to {video}", soft_wrap=True, markup=False)


def _table(run: Grasp) -> Table:
    from rich.markup import escape
    from rich.table import Table

    shown = {"m": (1e3, "mm"), "rad": (math.degrees(1.0), "deg")}
    table = Table(title="checks", title_justify="left")
    for title in ("", "check", "value", "limit", "unit", "where"):
        table.add_column(title, justify="right" if title in ("value", "limit") else "left", no_wrap=title == "check")
    for check in run.checks:
        scale, unit = shown.get(check.unit, (1.0, check.unit))
        where = f"{check.time:.2f} s " if check.time is not None else ""
        numbers = (number(check.value, scale), number(check.limit, scale))
        table.add_row(mark(check), check.name, *numbers, unit, escape(where + check.detail))
    return table
