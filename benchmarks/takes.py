"""`python -m benchmarks.takes [--letters FILE.npz] [--json]`: sets of takes that belong together, none refused.

Twenty recorded reaches, nine times pouring and nine times opening a box (DMPCPP_RECORDINGS names their folder), and
handwritten letters from a file of one array (takes, T, 2) a letter. Each take is held against the model of the others,
as `dmpcpp fit` does. Exit status: 0 none refused, 3 one was.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import click
import numpy as np
from dmpcpp import PoseDemonstration, PoseDmp, _takes, motion
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from benchmarks import accuracy, demonstrations, human_motion
from benchmarks.figures import Figure

Array = NDArray[np.float64]

_STEP = {"letters": 0.01, "poses": 0.005}  # s, of a sample


def measure(letters: Path | None) -> Iterator[Figure]:
    """Measure set by set how many takes are refused, and the largest miss over the median one."""
    for name, takes in _sets(letters):
        options = PoseDmp.fit(takes).options
        numbers = [str(k) for k in range(1, len(takes) + 1)]
        refused = {check.name.split("_")[1] for check in _takes.takes_apart(takes, numbers, numbers, options)}
        misses = np.array([miss.position_rmse for miss in _takes.misses_of(takes, options)])
        yield Figure(f"{name}, {len(takes)} takes: refused", float(len(refused)), 0.0, "")
        yield Figure("the same: largest miss over the median", float(misses.max() / np.median(misses)), np.inf, "1")


def _sets(letters: Path | None) -> Iterator[tuple[str, list[PoseDemonstration]]]:
    if folder := demonstrations.recordings():
        hand, _ = human_motion.grasping(folder.parent)
        parts = human_motion.reaches(motion.cycles(hand))
        yield "reaches", [motion.demonstration(part) for part in parts]
        for name in ("pouring", "openbox"):
            yield name, [_of_rows(rows) for rows in np.load(folder / f"{name}.npy")]
    if letters:
        for name, paths in np.load(letters).items():
            yield f"letter {name}", [_of_points(path.astype(np.float64)) for path in paths]


def _of_rows(rows: Array) -> PoseDemonstration:
    """Return a demonstration of rows x, y, z in cm and w, x, y, z."""
    pose = np.tile(np.eye(4), (len(rows), 1, 1))
    pose[:, :3, :3] = Rotation.from_quat(rows[:, [4, 5, 6, 3]]).as_matrix()
    pose[:, :3, 3] = rows[:, :3] / 100.0
    return PoseDemonstration(_STEP["poses"] * np.arange(len(rows)), pose)


def _of_points(path: Array) -> PoseDemonstration:
    pose = np.tile(np.eye(4), (len(path), 1, 1))
    pose[:, :2, 3] = path
    return PoseDemonstration(_STEP["letters"] * np.arange(len(path)), pose)


@click.command()
@click.option(
    "--letters", type=click.Path(exists=True, path_type=Path), help="File of one array (takes, T, 2) a letter."
)
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON instead of the table.")
def main(letters: Path | None, as_json: bool) -> None:
    """Hold each take of sets that belong together against the model of the others."""
    measured = list(measure(letters))
    if as_json:
        figures = [figure.to_dict() | {"goal": min(figure.goal, 1e9)} for figure in measured]
        click.echo(json.dumps({"figures": figures}, indent=2))
    else:
        accuracy.show(measured)
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


if __name__ == "__main__":
    main()
