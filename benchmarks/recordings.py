"""`python -m benchmarks.recordings [--json]`: what real recordings of people ask, measured in one run.

Exit status: 0 every goal reached, 3 one missed. DMPCPP_RECORDINGS names the folder of recordings.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import click
from dmpcpp import motion

from benchmarks import human_motion
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
def main(as_json: bool) -> None:
    """Measure cutting, predicting, cleaning, aligning and executing real recordings."""
    folder = Path(os.environ.get("DMPCPP_RECORDINGS", ""))
    if not (folder / "qualisys_dfki").is_dir():
        raise click.UsageError("DMPCPP_RECORDINGS does not name a folder of recordings (with qualisys_dfki, ..).")
    cycles = motion.cycles(human_motion.grasping(folder)[0])
    measured = list(measure(folder))
    if as_json:
        figures = [figure.to_dict() for figure in measured]
        click.echo(json.dumps({"cycle_starts": human_motion.starts(cycles), "figures": figures}, indent=2))
    else:
        _print(measured, human_motion.starts(cycles))
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


def _print(measured: list[Figure], starts: list[float]) -> None:
    for figure in measured:
        mark = "ok  " if figure.ok else "MISS"
        click.echo(f"{mark} {figure.name:78} {figure.value:8.3f}  goal {figure.goal:7.3f} {figure.unit}")
    click.echo(f"the repetitions begin at {', '.join(f'{start:.2f}' for start in starts)} s")


if __name__ == "__main__":
    main()
