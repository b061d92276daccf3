"""Distributions, two hands and improvement by trial, for `python -m benchmarks.adaptation`, beside other packages."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp import (
    Demonstration,
    Dmp,
    DmpDistribution,
    Given,
    PoseDemonstration,
    PoseDistribution,
    improvement,
    so3,
    two_hands,
)
from numpy.typing import NDArray

from benchmarks import peers
from benchmarks.figures import Figure

Array = NDArray[np.float64]

_SAMPLES = 67  # of each demonstration
_QUARTER = 4  # every fourth demonstration is held out
_FIRST = 0.3  # what is seen of a motion that goes on


def _rmse(away: Array) -> float:
    return float(np.sqrt(np.mean(np.sum(away**2, axis=1))))


def _split(takes: list[Array], seed: int = 0) -> tuple[list[Array], list[Array]]:
    order = np.random.default_rng(seed).permutation(len(takes))
    held = max(2, len(takes) // _QUARTER)
    return [takes[k] for k in order[held:]], [takes[k] for k in order[:held]]


def _thinned(take: Array) -> Array:
    return take[np.linspace(0, len(take) - 1, _SAMPLES).round().astype(int)]


def planar(name: str, motions: dict[str, list[Array]]) -> Iterator[Figure]:
    """Learn three quarters of the demonstrations of each motion, judge the others."""
    phases = np.linspace(0, 1, _SAMPLES)
    found: dict[str, list[float]] = {key: [] for key in ("nll", "inside", "mean", "rest", "first", "three", "units")}
    theirs: dict[str, list[float]] = {key: [] for key in ("nll", "three", "first")}
    for takes in motions.values():
        learn, unseen = _split([_thinned(take) for take in takes])
        for key, value in _judged(learn, unseen, phases).items():
            found[key] += value
        if peers.installed()["movement_primitives"]:
            for key, value in _promp_judged(learn, unseen, phases).items():
                theirs[key] += value
    other = {key: {"movement_primitives": float(np.mean(value))} for key, value in theirs.items() if value}
    mean = {key: float(np.mean(value)) for key, value in found.items()}
    size = f"{name}, distribution"
    yield Figure(f"{size}: held-out -log p a number, mean", mean["nll"], -3.0, "1", other.get("nll", {}))
    yield Figure(f"{size}: the same, worst motion", max(found["nll"]), 1.0, "1")
    yield Figure(f"{size}: in mm and in m, difference", max(found["units"]), 1e-9, "1")
    yield Figure(f"{size}: after the first 30 %, RMSE", mean["first"], 8.0, "% of diagonal", other.get("first", {}))
    yield Figure(f"{size}: given start, middle, end, RMSE", mean["three"], 6.6, "% of diagonal", other.get("three", {}))
    yield Figure(f"{size}: that over the mean's RMSE", mean["three"] / mean["mean"], 1.02, "1")
    yield Figure(f"{size}: after the first 30 %, over the mean's", mean["first"] / mean["rest"], 1.02, "1")
    yield Figure(f"{size}: unseen outside two sigma", 100 - mean["inside"], 8.0, "%")
    yield Figure(f"{size}: unseen inside two sigma", mean["inside"], 97.0, "%")


def _judged(learn: list[Array], unseen: list[Array], phases: Array) -> dict[str, list[float]]:
    learned = DmpDistribution.fit([Demonstration(phases, take) for take in learn])
    in_mm = DmpDistribution.fit([Demonstration(phases, 1e3 * take) for take in learn])
    band = learned.spread(len(phases))
    sigma = np.sqrt(np.array([np.diag(c) for c in band.covariance]) + learned.noise[0] ** 2)
    seen = round(_FIRST * (len(phases) - 1)) + 1
    found: dict[str, list[float]] = {key: [] for key in ("nll", "inside", "mean", "rest", "first", "three", "units")}
    nll = []
    for take in unseen:
        size = float(np.linalg.norm(np.ptp(take, axis=0))) / 100
        nll.append(-learned.log_likelihood(Demonstration(phases, take)) / take.size)
        again = -in_mm.log_likelihood(Demonstration(phases, 1e3 * take)) / take.size
        found["units"].append(abs(again - nll[-1] - np.log(1e3)))
        found["inside"].append(100 * float(np.mean(np.abs(take - band.mean) < 2 * sigma)))
        found["mean"].append(_rmse(band.mean - take) / size)
        found["rest"].append(_rmse((band.mean - take)[seen - 1 :]) / size)
        going = learned.continued(Demonstration(phases[:seen], take[:seen]), duration=1.0)
        found["first"].append(_rmse((going.rollout(len(phases)).position - take)[seen - 1 :]) / size)
        given = [
            Given(s, take[round(s * (len(phases) - 1))], covariance=learned.observation_covariance(s))
            for s in (0.0, 0.5, 1.0)
        ]
        found["three"].append(_rmse(learned.condition(given).rollout(len(phases)).position - take) / size)
    found["nll"] = [float(np.mean(nll))]
    return found


def _promp(takes: list[Array], phases: Array, weights: int = 20) -> Any:
    from movement_primitives.promp import ProMP

    promp = ProMP(n_dims=takes[0].shape[1], n_weights_per_dim=weights)
    promp.imitate(np.tile(phases, (len(takes), 1)), np.array(takes))
    return promp


def _promp_judged(learn: list[Array], unseen: list[Array], phases: Array) -> dict[str, list[float]]:
    """Judge movement_primitives' ProMP, from its own mean and covariance of trajectories and its own noise."""
    promp = _promp(learn, phases)
    mean = promp.mean_trajectory(phases.copy())
    covariance = promp.cov_trajectory(phases.copy()) + promp.variance * np.eye(mean.size)
    values, axes = np.linalg.eigh((covariance + covariance.T) / 2)
    values = np.maximum(values, 1e-12 * values.max())
    seen = round(_FIRST * (len(phases) - 1)) + 1
    found: dict[str, list[float]] = {"nll": [], "three": [], "first": []}
    for take in unseen:
        size = float(np.linalg.norm(np.ptp(take, axis=0))) / 100
        away = axes.T @ (take - mean).T.ravel()
        found["nll"].append(float(np.sum(away**2 / values + np.log(2 * np.pi * values)) / 2 / take.size))
        noise = promp.variance * np.eye(take.shape[1])
        for key, places in (("three", (0, len(phases) // 2, len(phases) - 1)), ("first", range(seen))):
            helped = promp
            for k in places:
                helped = helped.condition_position(take[k], y_cov=noise, t=phases[k])
            start = 0 if key == "three" else seen - 1
            found[key].append(_rmse((helped.mean_trajectory(phases.copy()) - take)[start:]) / size)
    return found


def poses() -> Iterator[Figure]:
    """Leave out each recorded pouring and each opening of a box in turn (DMPCPP_RECORDINGS)."""
    folder = Path(os.environ.get("DMPCPP_RECORDINGS", "")) / "robotasks_clfd"
    for name, middle in (("pouring", (4.2, 6.0)), ("openbox", (4.2, 6.0))):
        if not (folder / f"{name}.npy").is_file():
            continue
        takes = [_pose_take(take[::9]) for take in np.load(folder / f"{name}.npy")]
        errors = {key: np.zeros((len(takes), 2)) for key in ("mean", "ends", "three")}
        inside = []
        for j, unseen in enumerate(takes):
            learned = PoseDistribution.fit(takes[:j] + takes[j + 1 :])
            inside.append(_pose_inside(learned, unseen))
            count = len(unseen.time)
            given = {
                s: Given(s, unseen.pose[round(s * (count - 1))], covariance=learned.observation_covariance(s))
                for s in (0.0, 0.5, 1.0)
            }
            for key, known in (("mean", []), ("ends", [given[0.0], given[1.0]]), ("three", list(given.values()))):
                errors[key][j] = _pose_errors(learned.condition(known).rollout(count).pose, unseen.pose)
        mean = {key: value.mean(axis=0) for key, value in errors.items()}
        for k, (what, unit) in enumerate((("position", "% of diagonal"), ("angle", "deg"))):
            alone = {"the mean alone": float(mean["mean"][k])}
            yield Figure(f"{name}, given start and end: {what}", float(mean["ends"][k]), mean["mean"][k], unit, alone)
            yield Figure(f"{name}, given the middle too: {what}", float(mean["three"][k]), middle[k], unit, alone)
        yield Figure(f"{name}: unseen outside two sigma", 100 - float(np.mean(inside)), 8.0, "%")
        yield Figure(f"{name}: unseen inside two sigma", float(np.mean(inside)), 97.0, "%")


def _pose_take(take: Array) -> PoseDemonstration:
    quaternions = take[:, 3:7] / np.linalg.norm(take[:, 3:7], axis=1)[:, None]
    times = np.linspace(0, 1, len(take))
    return PoseDemonstration.from_quaternions(times, 0.01 * take[:, :3], quaternions, "wxyz")


def _pose_errors(found: Array, shown: Array) -> tuple[float, float]:
    size = float(np.linalg.norm(np.ptp(shown[:, :3, 3], axis=0))) / 100
    angles = [so3.distance(a[:3, :3], b[:3, :3]) for a, b in zip(found, shown, strict=True)]
    return _rmse((found - shown)[:, :3, 3]) / size, float(np.degrees(np.sqrt(np.mean(np.square(angles)))))


def _pose_inside(learned: PoseDistribution, unseen: PoseDemonstration) -> float:
    band = learned.spread(len(unseen.time))
    sigma = np.sqrt(np.array([np.diag(c) for c in band.covariance]) + np.repeat(learned.noise**2, 3))
    away = [
        np.r_[b[:3, 3] - a[:3, 3], so3.log(b[:3, :3] @ a[:3, :3].T)]
        for a, b in zip(band.mean, unseen.pose, strict=True)
    ]
    return 100 * float(np.mean(np.abs(away) < 2 * sigma))


def costs() -> Iterator[Figure]:
    """Measure fits of 13 x 200 x 2 and 5 x 400 x 6 numbers, and conditioning, from Python."""
    rng = np.random.default_rng(0)
    for count, samples, axes, goal in ((13, 200, 2, 1.0), (5, 400, 6, 5.0)):
        phases = np.linspace(0, 1, samples)
        way = np.array([np.sin((k + 2) * phases + k) for k in range(axes)]).T
        takes = [
            way + 0.1 * phases[:, None] * rng.normal(size=axes) + 0.01 * rng.normal(size=way.shape)
            for _ in range(count)
        ]
        demonstrations = [Demonstration(phases, take) for take in takes]
        others = {}
        if peers.installed()["movement_primitives"]:
            others["movement_primitives"] = 1e3 * _seconds(lambda t=takes, p=phases: _promp(t, p), 1)
        name = f"distribution of {count} x {samples} x {axes}"
        yield Figure(
            f"{name}: fit", 1e3 * _seconds(lambda d=demonstrations: DmpDistribution.fit(d), 5), goal, "ms", others
        )
    phases = np.linspace(0, 1, 100)
    way = np.array([np.sin((k + 2) * phases + k) for k in range(3)]).T
    learned = DmpDistribution.fit([Demonstration(phases, way + s) for s in 0.1 * rng.normal(size=(8, 3))])
    given = [Given(0.5, way[50] + 0.05)]
    others = {}
    if peers.installed()["movement_primitives"]:
        promp = _promp([way + s for s in 0.1 * rng.normal(size=(8, 3))], phases, 24)
        others["movement_primitives"] = 1e6 * _seconds(lambda: promp.condition_position(way[50], t=0.5), 50)
    yield Figure(
        "condition on one position, mean and covariance, from Python",
        1e6 * _seconds(lambda: learned.condition(given), 50),
        45.0,
        "us",
        others,
    )


def trials() -> Iterator[Figure]:
    """Search past a place that the demonstration misses by 0.3, 8 seeds: trials to 0.08, cost after 600."""
    times = np.linspace(0, 1, 101)
    model = Dmp.fit(Demonstration(times, np.c_[times, 0.3 * np.sin(3 * times)]))
    place = model.rollout_at(np.array([0.5])).position[0] + [0.0, 0.3]

    def miss(motion: Any) -> float:
        middle = int(np.argmin(np.abs(motion.time - 0.5)))
        effort = 1e-5 * _rmse(motion.acceleration)
        return float(np.linalg.norm(motion.position[middle] - place)) + effort

    for search in ("via", "weights"):
        best = [
            np.minimum.accumulate(improvement.improve(model, miss, search=search, rollouts=601, seed=seed).costs)
            for seed in range(8)
        ]
        count = [float(np.argmax(costs < 0.08)) if costs[-1] < 0.08 else np.inf for costs in best]
        yield Figure(f"improvement by trial, {search}: trials to 0.08, median", float(np.median(count)), 25.0, "1")
        last = float(np.median([costs[-1] for costs in best]))
        yield Figure(f"improvement by trial, {search}: cost after 600, median", last, 0.01, "1")


def grasp() -> Iterator[Figure]:
    """Hold a thing with both hands: how far the grasp moves for new goals and tempi."""
    times = np.linspace(0, 2, 150)
    left = np.tile(np.eye(4), (len(times), 1, 1))
    left[:, :3, :3] = [so3.exp([0.5 * t, 0.3 * np.sin(t), 0.8 * t]) for t in times]
    left[:, :3, 3] = np.c_[0.3 * np.sin(times), 0.2 * times, 0.1 * np.cos(2 * times)]
    grip = np.eye(4)
    grip[:3, :3], grip[:3, 3] = so3.exp([0.2, 3.0, 0.1]), [0.05, 0.4, -0.02]
    model = two_hands.TwoHands.fit(PoseDemonstration(times, left), PoseDemonstration(times, left @ grip))
    goal = model.held.goal.copy()
    goal[:3, 3] += [0.2, -0.1, 0.15]
    far, turned = 0.0, 0.0
    for duration in (0.7, 2.0, 5.0):
        moved = model.rollout(goal, duration, 0.01)
        for found in np.linalg.inv(moved.left) @ moved.right:
            far = max(far, float(np.linalg.norm(found[:3, 3] - grip[:3, 3])))
            turned = max(turned, float(np.degrees(so3.distance(found[:3, :3], grip[:3, :3]))))
    yield Figure("two hands, new goal and tempi: the grasp off, position", far, 1e-9, "m")
    yield Figure("two hands, new goal and tempi: the grasp off, angle", turned, 1e-9, "deg")


def _seconds(call: Callable[[], Any], count: int) -> float:
    best = np.inf
    for _ in range(3):
        start = time.process_time()
        for _ in range(count):
            call()
        best = min(best, (time.process_time() - start) / count)
    return float(best)
