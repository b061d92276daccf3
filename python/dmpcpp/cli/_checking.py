"""`dmpcpp check-urdf` and `dmpcpp doctor`: is the robot's description, and is the installation, fit for the work."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import click

from dmpcpp.cli._flags import in_flags
from dmpcpp.cli._group import FAILED
from dmpcpp.cli._tables import arm_line
from dmpcpp.errors import InvalidArgument

_OF_COMMANDS = ("velocity", "acceleration", "effort", "density", "dynamics")
"""Options of the commands that use an arm, which what to do names."""


@click.command("check-urdf")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--base", metavar="LINK", help="Base link of the arm (default: the URDF's root).")
@click.option("--tip", metavar="LINK", help="Link that follows the hand (default: the longest chain's tool).")
@click.option(
    "--package-path", multiple=True, metavar="DIR|NAME=DIR", help="Where packages of package:// paths are; repeatable."
)
@click.option("--json", "as_json", is_flag=True, help="Print the report as JSON instead of the table.")
def check_urdf(file: Path, base: str | None, tip: str | None, package_path: tuple[str, ...], as_json: bool) -> None:
    """List every defect of FILE, a URDF, that affects loading, planning or physics.

    Exit status: 0 none, 2 the file cannot be read, 3 there are some.

    Example: dmpcpp check-urdf my_robot.urdf --base link0 --tip tool0
    """
    from dmpcpp.robot import urdf_check

    report = urdf_check.check(file, base or "", tip or "", package_path)
    if as_json:
        click.echo(json.dumps(report.summary(), indent=2))
    else:
        for defect in report.defects:
            kind = click.style("error  ", fg="red", bold=True) if defect.fatal else click.style("warning", fg="yellow")
            said = in_flags(f"{defect.what}. {defect.to_do}", _OF_COMMANDS)
            click.echo(f"{kind} {defect.where}: {said}")
        if report.arm is not None:
            arm = report.arm
            click.echo(f"{arm.name}: {arm_line(arm)}")
        fatal = sum(defect.fatal for defect in report.defects)
        count = len(report.defects)
        click.echo(f"{fatal} error(s), {count - fatal} warning(s)" if count else "no defect found")
    if not report.ok:
        sys.exit(FAILED)


@click.command()
@click.option(
    "--get",
    type=click.Choice(["hand-model"]),
    help="Obtain a part: the two public networks that find a hand in a video, out of the wheel of mediapipe 0.10.21.",
)
@click.option("--wheel", type=click.Path(path_type=Path), metavar="FILE", help="That wheel, where there is no network.")
@click.option("--json", "as_json", is_flag=True, help="Print the findings as JSON instead of the table.")
def doctor(get: str | None, wheel: Path | None, as_json: bool) -> None:
    """Check the installation and list what is missing, or obtain a part of it.

    --get hand-model downloads 36 MB with pip, checks two networks of it (Apache License 2.0) by their sums, and keeps 8
    MB in the user's cache (~/.cache/dmpcpp). Nothing is downloaded without it.

    Exit status: 0 the main job (`dmpcpp demo`) can be done, 3 something that it needs is missing.

    Example: dmpcpp doctor --get hand-model
    """
    from dmpcpp.doctor import examine

    if wheel is not None and get is None:
        raise InvalidArgument("--wheel: without --get it says nothing. State --get hand-model too.")
    if get is not None:
        from dmpcpp import cameras

        click.echo(f"hand model: {cameras.get_hand_model(wheel)}")
        return

    found = examine()
    if as_json:
        click.echo(json.dumps(found.summary(), indent=2))
    else:
        from rich.console import Console
        from rich.markup import escape
        from rich.table import Table

        table = Table(title="installation", title_justify="left")
        for title in ("", "part", "found", "for", "to do"):
            table.add_column(title)
        for part in found.parts:
            mark = "[green]ok[/]" if part.ok else "[bold red]missing[/]" if part.needed else "[yellow]missing[/]"
            table.add_row(mark, *map(escape, (part.name, part.found, part.purpose, "" if part.ok else part.to_do)))
        console = Console(highlight=False)
        console.print(table)
        console.print("ready" if found.ok else "not ready: install what is missing in red")
    if not found.ok:
        sys.exit(FAILED)
