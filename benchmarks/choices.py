"""`python -m benchmarks.choices`: how the settings behind two figures of `benchmarks.recordings` were chosen.

Predicting reaches: within reaches 1-15 by five folds, and once on reaches 16-20, fifteen together beside the best and
the mean of the single ones. The best single one is known only once the answers are: a model has to beat hindsight.
Cleaning a tracker's recording: every cutoff against the motion capture of the same motion, the one used included.
DMPCPP_RECORDINGS names the folder of recordings.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import click
import dmpcpp
import numpy as np
from dmpcpp import motion
from dmpcpp.recordings import Recording

from benchmarks import human_motion
from benchmarks.human_motion import LEARNED, prediction_error

Learn = Callable[[Sequence[Recording], Recording], dmpcpp.PoseDmp]
"""From lessons, and the reach that is asked for (its start, goal and duration count), a model."""

_FOLDS = 5
_NEAREST = (3, 5, 8)
_KERNELS = (5, 10, 20, 50)
_SPLITS = 100
_SECOND = 0.1  # m; what a second of duration counts when reaches are compared
_CUTOFFS = (2.0, 3.0, 4.0, 5.0, 6.0, 8.0)


# ---- predicting reaches ---------------------------------------------------------------------------------


def together(
    lessons: Sequence[Recording], asked: Recording, scaling: str = "rotation_dilation", basis_count: int = 100
) -> dmpcpp.PoseDmp:
    """Learn all lessons at once."""
    demonstrations = [motion.demonstration(lesson) for lesson in lessons]
    return dmpcpp.PoseDmp.fit(demonstrations, scaling=scaling, basis_count=basis_count)


def aligned(lessons: Sequence[Recording], asked: Recording) -> dmpcpp.PoseDmp:
    """Learn all lessons, brought to one tempo by dynamic time warping before."""
    return together(motion.aligned(lessons), asked)


def nearest(lessons: Sequence[Recording], asked: Recording, count: int) -> dmpcpp.PoseDmp:
    """Learn the lessons whose start, goal and duration are most like those asked for."""
    apart = [np.linalg.norm(_task(lesson) - _task(asked)) for lesson in lessons]
    return together([lessons[k] for k in np.argsort(apart)[:count]], asked)


def folds_error(learn: Learn, parts: Sequence[Recording]) -> float:
    """Return the mean RMSE [mm] over parts, each predicted from the other folds."""
    errors = []
    for k in range(_FOLDS):
        lessons = [part for i, part in enumerate(parts) if i % _FOLDS != k]
        errors.append(_mean_error(learn, lessons, parts[k::_FOLDS]))
    return float(np.mean(errors))


def folds_singles(parts: Sequence[Recording], scaling: str) -> float:
    """Return the same for the single lesson that turns out best in each fold [mm]."""
    alone = np.array([_errors([part], parts, scaling) for part in parts])
    index = np.arange(len(parts)) % _FOLDS
    return float(np.mean([alone[index != k][:, index == k].mean(axis=1).min() for k in range(_FOLDS)]))


def _errors(lessons: Sequence[Recording], asked: Sequence[Recording], scaling: str) -> list[float]:
    model = together(lessons, asked[0], scaling)
    return [prediction_error(model, part) for part in asked]


def _mean_error(learn: Learn, lessons: Sequence[Recording], asked: Sequence[Recording]) -> float:
    return float(np.mean([prediction_error(learn(lessons, part), part) for part in asked]))


def _task(reach: Recording) -> np.ndarray:
    return np.concatenate([reach.position[0], reach.position[-1], [_SECOND * reach.duration]])


def _row(name: str, parts: Sequence[Recording], learn: Learn, scaling: str = "rotation_dilation") -> str:
    lessons, asked = parts[:LEARNED], parts[LEARNED:]
    alone = [float(np.mean(_errors([lesson], asked, scaling))) for lesson in lessons]
    within = (folds_error(learn, lessons), folds_singles(lessons, scaling))
    once = (_mean_error(learn, lessons, asked), min(alone), float(np.mean(alone)))
    return f"{name:34}" + "".join(f"{value:10.2f}" for value in (*within, *once))


def predicting(folder: Path) -> None:
    """Print how each way to learn the reaches does."""
    hand, distance = human_motion.grasping(folder)
    cycles = motion.cycles(hand)
    parts = human_motion.reaches(cycles)
    click.echo("reaches, RMSE [mm]                    1-15, folds: best   16-20:      best      mean")
    click.echo("                                  together    single  together    single    single")
    click.echo(_row("as used", parts, together))
    for scaling in ("none", "per_axis_relative"):
        click.echo(_row(f"scaling {scaling}", parts, partial(together, scaling=scaling), scaling))
    for count in _KERNELS:
        click.echo(_row(f"{count} kernels", parts, partial(together, basis_count=count)))
    click.echo(_row("aligned before", parts, aligned))
    for count in _NEAREST:
        click.echo(_row(f"the {count} most like what is asked", parts, partial(nearest, count=count)))
    for rest in (0.1, 0.15):
        cut = human_motion.reaches(cycles, rest)
        click.echo(_row(f"cut at {100 * rest:.0f} % of the peak speed", cut, together))
    click.echo(_row("ending closest to the pillow", _to_object(cycles, distance), together))
    click.echo(_splits(parts))


def _splits(parts: Sequence[Recording]) -> str:
    """Return how fifteen together and the single one of them that turns out best do over random choices of fifteen."""
    random = np.random.default_rng(0)
    single = human_motion.singly(list(parts))
    both = []
    for _ in range(_SPLITS):
        order = random.permutation(len(parts))
        lessons, asked = order[:LEARNED], order[LEARNED:]
        model = together([parts[k] for k in lessons], parts[0])
        error = float(np.mean([prediction_error(model, parts[k]) for k in asked]))
        both.append((error, single[np.ix_(lessons, asked)].mean(axis=1).min()))
    joint, best = np.array(both).T
    return (
        f"{_SPLITS} random choices of {LEARNED} lessons: together {joint.mean():.2f}, best single {best.mean():.2f}; "
        f"together is better in {100 * np.mean(joint < best):.0f} %"
    )


def _to_object(cycles: Sequence[Recording], distance: np.ndarray) -> list[Recording]:
    """Return the reaches from the first rest's end to where the hand is closest to the object."""
    found = []
    for start, cycle, reach in zip(
        human_motion.starts(cycles), cycles, human_motion.reaches(list(cycles)), strict=True
    ):
        first = round(start * cycle.rate)
        closest = int(np.argmin(distance[first : first + len(cycle)]))
        found.append(motion.crop(cycle, human_motion.starts([reach])[0], cycle.time[closest]))
    return found


# ---- a tracker's noise ----------------------------------------------------------------------------------


def cleaning(folder: Path) -> None:
    """Print what is left after each low-pass, as recorded and as learned."""
    tracked, errors = human_motion.tracking(folder)
    total, shake = errors(tracked.position)
    click.echo(f"\ntracker, RMSE [mm]: as recorded {total:.2f}, above 3 Hz {shake:.2f}")
    click.echo("low-pass [Hz]   N = 100: in all, above 3 Hz   N = 400: in all, above 3 Hz")
    for cutoff in _CUTOFFS:
        left = [errors(human_motion.learned_calmly(tracked, cutoff, count)) for count in (100, 400)]
        click.echo(f"{cutoff:13.0f} " + "".join(f"{value:15.2f}" for pair in left for value in pair))


@click.command()
def main() -> None:
    """Print both tables."""
    folder = Path(os.environ.get("DMPCPP_RECORDINGS", ""))
    if not (folder / "qualisys_dfki").is_dir():
        raise click.UsageError("DMPCPP_RECORDINGS does not name a folder of recordings (with qualisys_dfki, ..).")
    predicting(folder)
    cleaning(folder)


if __name__ == "__main__":
    main()
