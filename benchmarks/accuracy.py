"""`python -m benchmarks.accuracy [--json]`: the figures of accuracy beside other packages, in one run.

Exit status: 0 every goal reached, 3 one missed. Without DMPCPP_RECORDINGS the recorded poses are left out; packages
that are not installed are named and left out.
"""

from __future__ import annotations

import json
import platform
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import click

from benchmarks import demonstrations, figures, peers
from benchmarks.figures import Figure

if TYPE_CHECKING:
    from rich.table import Table

_COLUMNS = ("movement_primitives", "movement_primitives, stepped", "pydmps")
_NO_RECORDINGS = "recorded poses left out: DMPCPP_RECORDINGS does not name a folder with robotasks_clfd"


def measure() -> Iterator[Figure]:
    """Measure everything, figure by figure."""
    yield from figures.helix()
    yield from figures.reach()
    yield from figures.rotation()
    yield from figures.rotation_through_pi()
    yield from figures.reach_rotations()
    folder = demonstrations.recordings()
    if folder:
        yield from figures.recorded(folder)
    for duration in (1.0, 2.0):
        yield from figures.noise(duration)
        yield from figures.noise_together(duration)
    yield from figures.rates()
    yield from figures.source()


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON instead of the table.")
def main(as_json: bool) -> None:
    """Measure accuracy beside movement_primitives and pydmps, with the goal of every figure."""
    measured = list(measure())
    if as_json:
        click.echo(json.dumps(_summary(measured), indent=2, allow_nan=False))
    else:
        show(measured)
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


def _summary(measured: list[Figure]) -> dict[str, Any]:
    return {
        "verdict": "pass" if all(figure.ok for figure in measured) else "fail",
        "python": platform.python_version(),
        "machine": platform.machine(),
        "packages": peers.installed(),
        "figures": [figure.to_dict() for figure in measured],
    }


def show(measured: list[Figure]) -> None:
    """Print the figures as a table, with the other packages that are there."""
    from rich.console import Console

    console = Console(highlight=False, width=None if sys.stdout.isatty() else 140)
    console.print(_table(measured))
    for name, version in peers.installed().items():
        missing = f'not installed: pip install "dmpcpp[bench]" or {peers.PACKAGES[name]}'
        console.print(f"{name} {version or missing}", markup=False)
    if not demonstrations.recordings():
        console.print(_NO_RECORDINGS)
    console.print(f"{sum(figure.ok for figure in measured)} of {len(measured)} goals reached")


def _table(measured: list[Figure]) -> Table:
    from rich.table import Table

    table = Table(title="root mean square errors unless the line says otherwise", title_justify="left")
    for k, title in enumerate(("", "unit", "dmpcpp", "goal", "", *_COLUMNS)):
        table.add_column(title, justify="right" if k in (2, 3) or k > 4 else "left")
    for figure in measured:
        mark = "[green]ok[/]" if figure.ok else "[bold red]MISS[/]"
        others = (f"{figure.peers[name]:.3g}" if name in figure.peers else "" for name in _COLUMNS)
        table.add_row(figure.name, figure.unit, f"{figure.value:.3g}", f"{figure.goal:.3g}", mark, *others)
    return table


if __name__ == "__main__":
    main()
