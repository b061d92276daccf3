"""`python -m benchmarks.robustness [--seeds N] [--json]`: learning on recordings that nobody chose.

Seeded motions with known truth, as recording systems show them: what share of them learns its noise, how close the
smoothed motion comes to the truth compared with the best smoothing there is, whether turns stay calm when start or goal
are elsewhere. Exit status: 0 every goal reached, 3 one missed.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from functools import cache

import click
import numpy as np
from dmpcpp import Demonstration, Dmp, OrientationDemonstration, OrientationDmp, Scaling
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from benchmarks import accuracy, new_goals, peers, series
from benchmarks.demonstrations import minimum_jerk
from benchmarks.figures import Figure

Array = NDArray[np.float64]

_LEARNED = 1.5  # times the true largest acceleration
_SHARES = {"rounded to 1 mm": 4.0}  # percent that may learn noise, 1 elsewhere


def measure(seeds: int, scaling: str = "automatic") -> Iterator[Figure]:
    """Measure everything, figure by figure."""
    yield from default_on_noise(seeds)
    for kind in series.NOISY:
        yield from noise(kind, seeds)
    for kind in series.CLEAN:
        yield from clean(kind, seeds)
    yield from turns()
    yield from new_goals.goals(scaling)


def default_on_noise(seeds: int) -> list[Figure]:
    """1 mm at 200 Hz on a 4 s reach, everything by default, against the truth; movement_primitives at its best."""
    time = np.linspace(0.0, 4.0, 801)
    truth = minimum_jerk(time / 4.0)[:, None] * [0.3, -0.2, 0.4]
    ours, theirs, kernels = [], [], []
    for seed in range(seeds):
        value = truth + 1e-3 * np.random.default_rng(seed).normal(size=truth.shape)
        model = Dmp.fit(Demonstration(time, value))
        ours.append(_rms(model.rollout_at(time).position - truth))
        kernels.append(model.options.basis_count)
        if peers.installed()["movement_primitives"]:
            theirs.append(min(_rms(_of_others(time, value, count) - truth) for count in (5, 10, 20, 50, 100)))
    others = {"movement_primitives": 1e3 * float(np.mean(theirs))} if theirs else {}
    return [
        Figure("1 mm, 200 Hz, reach of 4 s: default against the truth", 1e3 * float(np.mean(ours)), 0.4, "mm", others),
        Figure("the same: kernels, largest", float(max(kernels)), 50.0, "1"),
    ]


def noise(kind: str, seeds: int) -> list[Figure]:
    """Noise learned [% of the seeds], error over that of the best smoothing, kernels of calm reaches."""
    learned, ratios, kernels = 0, [], []
    for seed in range(seeds):
        one = series.shown(kind, seed)
        demonstration = Demonstration(one.time, one.value).with_measured(one.measured)
        found, smooth = demonstration.noise_estimate(), demonstration.denoised()
        learned += _peak(smooth, one.time) > _LEARNED * _peak(Demonstration(one.time, one.truth), one.time)
        if found.found:
            ratios.append(_rms(smooth.position - one.truth) / _best(one))
        if one.motion in ("reach", "rests"):
            kernels.append(Dmp.fit(demonstration).options.basis_count)
    figures = [Figure(f"{kind}: noise learned", float(100.0 * learned / seeds), _SHARES.get(kind, 1.0), "%")]
    if ratios:
        name = f"{kind}: error over the best smoothing's"
        figures.append(Figure(f"{name}, median", float(np.median(ratios)), 1.05, "1"))
        figures.append(Figure(f"{name}, 95 %", float(np.percentile(ratios, 95)), 1.1, "1"))
    if kernels:
        figures.append(Figure(f"{kind}: kernels of reaches, 90 %", float(np.percentile(kernels, 90)), 50.0, "1"))
    return figures


def clean(kind: str, seeds: int) -> list[Figure]:
    """Clean motions taken for noise."""
    shown = [series.shown(kind, seed) for seed in range(seeds)]
    taken = sum(Demonstration(one.time, one.value).with_measured(one.measured).noise_estimate().found for one in shown)
    return [Figure(f"{kind}: taken for noise", 100.0 * taken / seeds, 0.0, "%")]


def turns() -> list[Figure]:
    """Turns of 300 to 1080 deg, N = 100: reproduction, and goals 20, 60 and 150 deg off in ten directions."""
    worst = {20.0: 0.0, 60.0: 0.0, 150.0: 0.0}
    errors, travel = [], 0.0
    rng = np.random.default_rng(0)
    for degrees in (300.0, 360.0, 370.0, 720.0, 1080.0):
        time = np.linspace(0.0, 4.0, 1001)
        axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14.0)
        shown = Rotation.from_rotvec(np.radians(degrees) * minimum_jerk(time / 4.0)[:, None] * axis)
        model = OrientationDmp.fit(OrientationDemonstration(time, shown.as_matrix()), basis_count=100)
        again = Rotation.from_matrix(model.rollout_at(time).rotation)
        errors.append(np.degrees(_rms((again * shown.inv()).as_rotvec())))
        rate, way = _effort(model, None)
        for off in worst:
            for _ in range(10):
                turn = rng.normal(size=3)
                turn *= np.radians(off) / np.linalg.norm(turn)
                now, longer = _effort(model, Rotation.from_rotvec(turn).as_matrix() @ model.goal)
                worst[off] = max(worst[off], now / rate)
                travel = max(travel, (longer - way) / np.radians(off))
    limits = {20.0: 1.1, 60.0: 1.3, 150.0: 2.0}
    return [
        Figure("turns of 300 to 1080 deg, N = 100", float(max(errors)), 0.002, "deg"),
        *(
            Figure(
                f"the same, goal {off:g} deg off: peak rate over the demonstrated", float(worst[off]), limits[off], "1"
            )
            for off in worst
        ),
        Figure("the same: way added over the offset", float(travel), 1.05, "1"),
    ]


def _of_others(time: Array, value: Array, count: int) -> Array:
    from movement_primitives.dmp import DMP

    dmp = DMP(n_dims=3, execution_time=time[-1], dt=time[1], n_weights_per_dim=count)
    dmp.imitate(time, value)
    return np.asarray(dmp.open_loop()[1])[: len(time)]


def _effort(model: OrientationDmp, goal: Array | None) -> tuple[float, float]:
    """Return the largest rate [rad/s] and the way travelled [rad]."""
    motion = model.rollout(goal=goal, dt=model.duration / 1000)
    rate = np.linalg.norm(motion.angular_velocity, axis=1)
    return float(rate.max()), float(rate.sum() * model.duration / 1000)


def _rms(away: Array) -> float:
    return float(np.sqrt(np.mean(np.sum(away**2, axis=1))))


def _peak(demonstration: Demonstration, time: Array) -> float:
    fine = np.linspace(0.0, time[-1], 4 * len(time))
    return float(np.linalg.norm(demonstration.at(fine).acceleration, axis=1).max())


def _best(one: series.Shown) -> float:
    """Return the error of the best smoothing: of third differences, its weight chosen by the truth."""
    roughness, basis = _whittaker(len(one.time))
    value, truth = basis.T @ one.value, basis.T @ one.truth
    weights = 10.0 ** np.arange(-3.0, 16.0, 0.1)
    errors = [np.sum((value / (1.0 + weight * roughness[:, None]) - truth) ** 2) for weight in weights]
    return float(np.sqrt(min(errors) / len(one.time)))


@cache
def _whittaker(count: int) -> tuple[Array, Array]:
    differences = np.diff(np.eye(count), 3, axis=0)
    values, vectors = np.linalg.eigh(differences.T @ differences)
    return np.maximum(values, 0.0), vectors


@click.command()
@click.option("--seeds", default=100, show_default=True, type=click.IntRange(4), help="Motions of each class.")
@click.option(
    "--scaling",
    default="automatic",
    show_default=True,
    type=click.Choice(list(Scaling.__members__)),
    help="With which new goals are approached.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON instead of the table.")
def main(seeds: int, scaling: str, as_json: bool) -> None:
    """Measure how learning stands noise, losses, full turns and new goals, with the goal of every figure."""
    measured = list(measure(seeds, scaling))
    if as_json:
        click.echo(json.dumps({"seeds": seeds, "figures": [figure.to_dict() for figure in measured]}, indent=2))
    else:
        accuracy.show(measured)
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


if __name__ == "__main__":
    main()
