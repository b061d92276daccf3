"""`python -m benchmarks.recordings [--json]`: what real recordings of people ask, measured in one run.

`--long` measures a recording of a million rows instead, which it makes itself (`benchmarks.long_recording`).
Exit status: 0 every goal reached, 3 one missed. DMPCPP_RECORDINGS names the folder of recordings.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn

import click
from dmpcpp import motion

from benchmarks import human_motion, long_recording
from benchmarks.figures import Figure


def measure(folder: Path) -> Iterator[Figure]:
    """Measure everything, figure by figure."""
    yield from human_motion.alignment_time()
    yield from human_motion.repetitions(folder)
    yield from human_motion.prediction(folder)
    yield from human_motion.tracking_noise(folder)
    yield from human_motion.spread_of_demonstrations(folder)
    yield from human_motion.mean_executed(folder)


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON instead of lines.")
@click.option("--long", "long", is_flag=True, help="Measure processor time and memory of a million rows instead.")
@click.option("--rows", default=long_recording.ROWS, show_default=True, help="Rows of the long recording.")
def main(as_json: bool, long: bool, rows: int) -> None:
    """Measure cutting, predicting, cleaning, aligning and executing real recordings."""
    if long:
        _end(list(long_recording.measure(rows)), [], as_json)
    folder = Path(os.environ.get("DMPCPP_RECORDINGS", ""))
    if not (folder / "qualisys_dfki").is_dir():
        raise click.UsageError("DMPCPP_RECORDINGS does not name a folder of recordings (with qualisys_dfki, ..).")
    cycles = motion.cycles(human_motion.grasping(folder)[0])
    _end(list(measure(folder)), human_motion.starts(cycles), as_json)


def _end(measured: list[Figure], starts: list[float], as_json: bool) -> NoReturn:
    """Print the figures and end with the status that says whether every goal was reached."""
    if as_json:
        figures = [figure.to_dict() for figure in measured]
        click.echo(json.dumps({"cycle_starts": starts, "figures": figures}, indent=2))
    else:
        _print(measured, starts)
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


def _print(measured: list[Figure], starts: list[float]) -> None:
    for figure in measured:
        mark = "ok  " if figure.ok else "MISS"
        click.echo(f"{mark} {figure.name:78} {figure.value:8.3f}  goal {figure.goal:7.3f} {figure.unit}")
    if starts:
        click.echo(f"the repetitions begin at {', '.join(f'{start:.2f}' for start in starts)} s")


if __name__ == "__main__":
    main()
