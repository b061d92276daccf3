"""`dmpcpp reproduce`: the source's own experiments, as a table and as pictures."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from dmpcpp.cli._config import save_config
from dmpcpp.cli._group import FAILED, refuse_file

if TYPE_CHECKING:
    from rich.table import Table

    from dmpcpp.trials.reproduction import NoiseLevel, Reproduction


@click.command()
@click.option("--repeat", default=0, show_default=True, type=click.IntRange(0), help="Random motions to learn as well.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="Random seed of the motions.")
@click.option(
    "--out",
    default="dmpcpp-reproduction",
    show_default=True,
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder for the pictures and summary.json.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON instead of the tables.")
def reproduce(repeat: int, seed: int, out: Path, as_json: bool) -> None:
    """Repeat the experiments of the thesis proposal behind this library, by its equations and by the default.

    Its helix and a rotation, each learned under DmpOptions.source() and under the default options; with --repeat K
    also K random motions, clean and with noise.

    Example: dmpcpp reproduce --repeat 50 --out reproduction
    """
    from dmpcpp.trials import reproduction

    refuse_file(out)
    with _progress(as_json or not repeat) as progress:
        run = reproduction.reproduce(repeat, seed, progress)
    reproduction.write(run, out)
    save_config(out / "config.toml")
    if as_json:
        click.echo(json.dumps(run.summary(), indent=2, allow_nan=False))
    else:
        _print(run, out)
    if not run.ok:
        sys.exit(FAILED)


@contextmanager
def _progress(hidden: bool) -> Iterator[Callable[[float], None]]:
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True, disable=hidden or not sys.stderr.isatty()) as bar:
        task = bar.add_task("learning random motions", total=1.0)
        yield lambda done: bar.update(task, completed=done)


def _print(run: Reproduction, out: Path) -> None:
    from rich.console import Console

    console = Console(highlight=False)
    console.print(_helix_table(run))
    console.print(_rotations_table(run))
    for quantity, unit, scale in (("position", "mm", 1e3), ("orientation", "deg", math.degrees(1.0))):
        levels = [level for level in run.levels if level.quantity == quantity]
        if levels:
            console.print(_levels_table(levels, unit, scale))
    for check in run.checks:
        mark = "[green]ok[/]  " if check.ok else "[bold red]FAIL[/]"
        console.print(f"{mark} {check.name} {check.value:.2g} <= {check.limit:g}  {check.detail}", soft_wrap=True)
    verdict = "[bold green]reproduced[/]" if run.ok else "[bold red]not reproduced[/]"
    console.print(verdict, end="; ")
    console.print(f"written to {out}/", soft_wrap=True, markup=False)


def _table(title: str, *columns: str) -> Table:
    from rich.markup import escape
    from rich.table import Table

    table = Table(title=escape(title), title_justify="left")
    for k, column in enumerate(columns):
        table.add_column(escape(column), justify="left" if k == 0 else "right")
    return table


def _helix_table(run: Reproduction) -> Table:
    axes = [f"{what} {axis}" for what in ("max", "RMSE") for axis in "xyz"]
    table = _table("helix x = sin(.05 k), y = cos(.05 k), z = 2 k: errors", "", *axes)
    for name, errors in run.helix.errors.items():
        table.add_row(name, *(f"{value:.3g}" for value in (*errors.max, *errors.rmse)))
    return table


def _rotations_table(run: Reproduction) -> Table:
    title = "rotation, Euler angles (.8 sin t, .5 cos t, .6 t): errors [deg]"
    table = _table(title, "product of the angles", "T [s]", "", "max", "RMSE")
    products = {"source": "source's, Rz' Ry' Rx'", "ZYX": "Rz Ry Rx"}
    for experiment in run.rotations:
        for name, errors in experiment.errors.items():
            turns = (f"{math.degrees(value):.3g}" for value in (errors.max, errors.rmse))
            table.add_row(products[experiment.convention], f"{experiment.demonstration.duration:g}", name, *turns)
    return table


def _levels_table(levels: list[NoiseLevel], unit: str, scale: float) -> Table:
    first = next(iter(levels[0].rmse.values()))
    title = f"{first.count} random motions: {levels[0].quantity} against the motion without noise [{unit}]"
    table = _table(title, "noise", "", "RMSE, mean", "std", "worst", "largest error")
    for level in levels:
        for name, rmse in level.rmse.items():
            numbers = (rmse.mean, rmse.std, rmse.worst, level.max[name].worst)
            table.add_row(f"{scale * level.noise:.3g}", name, *(_number(scale * value) for value in numbers))
    return table


def _number(value: float) -> str:
    return f"{value:.0f}" if value >= 1e3 else f"{value:.3g}"
