"""`python -m benchmarks.adaptation [--json]`: via-points, joins, rhythm and distributions, beside other packages.

On curves of its own; with DMPCPP_LETTERS, an .npz of handwritten letters (one array (demonstrations, samples, 2) each),
on these too. Exit status: 0 every goal reached, 3 one missed.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import click
import dmpcpp
import numpy as np
from dmpcpp import (
    Demonstration,
    Dmp,
    OrientationDemonstration,
    OrientationDmp,
    PoseDemonstration,
    PoseDmp,
    PoseRun,
    Run,
    Via,
    so3,
)
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from benchmarks import accuracy, distributions, peers
from benchmarks.figures import Figure

Array = NDArray[np.float64]

_PHASES = (0.2, 0.4, 0.6, 0.8)
_SAMPLES = 1001
_DISPLACED = 0.2  # of the diagonal
_MS = 1e3


def curves(count: int = 26) -> dict[str, list[Array]]:
    """Return plane curves with a few variations each: (demonstrations, 200, 2), seeded."""
    found = {}
    for seed in range(count):
        rng = np.random.default_rng(seed)
        knots = rng.normal(size=(7, 2)).cumsum(axis=0)
        phases = np.linspace(0, 1, 200)
        found[f"curve {seed}"] = [
            make_interp_spline(np.linspace(0, 1, 7), knots + 0.1 * rng.normal(size=knots.shape), k=5)(phases)
            for _ in range(10)
        ]
    return found


def letters() -> dict[str, list[Array]]:
    """Return the letters that DMPCPP_LETTERS names, if it does."""
    path = Path(os.environ.get("DMPCPP_LETTERS", ""))
    if not path.is_file():
        return {}
    return {f"letter {name}": list(np.asarray(table, dtype=float)) for name, table in np.load(path).items()}


def measure() -> Iterator[Figure]:
    """Measure everything, figure by figure."""
    for name, motions in (("curves", curves()), ("letters", letters())):
        if motions:
            yield from via_points(name, motions)
            yield from moving(name, motions)
            yield from joins(name, motions)
            yield from distributions.planar(name, motions)
    yield from distributions.poses()
    yield from distributions.costs()
    yield from distributions.grasp()
    yield from distributions.trials()
    yield from via_poses()
    yield from times()
    yield from rhythm()
    yield from turning()
    yield from changes()
    yield from periods()


def _model(path: Array) -> Dmp:
    return Dmp.fit(Demonstration(np.linspace(0, 1, len(path)), path))


def _diagonal(path: Array) -> float:
    return float(np.linalg.norm(np.ptp(path, axis=0)))


def _aside(path: Array, phase: float) -> Array:
    """Return a displacement across the way, a fifth of the diagonal long."""
    k = round(phase * (len(path) - 1))
    way = path[min(k + 1, len(path) - 1)] - path[max(k - 1, 0)]
    across = np.array([-way[1], way[0]])
    return _DISPLACED * _diagonal(path) * across / max(np.linalg.norm(across), 1e-12)


def via_points(name: str, motions: dict[str, list[Array]]) -> list[Figure]:
    """Displace each motion by a fifth of its diagonal at four phases, one at a time."""
    times = np.linspace(0, 1, _SAMPLES)
    miss, goal, most, beyond, effort = [], [], [], [], []
    theirs: dict[str, list[float]] = {"miss": [], "goal": [], "most": []}
    for takes in motions.values():
        model = _model(takes[0])
        plain = model.rollout_at(times)
        size = _diagonal(takes[0])
        for phase in _PHASES:
            k = round(phase * (_SAMPLES - 1))
            aside = _aside(takes[0], phase)
            past = model.rollout_at(times, via=[Via(phase, plain.position[k] + aside, reach=0.2)])
            away = np.linalg.norm(past.position - plain.position, axis=1)
            outside = np.abs(times - phase) >= 0.2
            miss.append(np.linalg.norm(past.position[k] - plain.position[k] - aside) / size)
            goal.append(away[-1] / size)
            most.append(away.max() / np.linalg.norm(aside))
            beyond.append(away[outside].max() / size)
            effort.append(_rms(past.acceleration) / _rms(plain.acceleration))
        if peers.installed()["movement_primitives"]:
            for key, values in _promp(takes).items():
                theirs[key] += values
    others = {key: {"movement_primitives": float(np.max(values))} for key, values in theirs.items() if values}
    return [
        Figure(f"{name}, via-point: missed, of the diagonal", float(max(miss)), 1e-9, "1", others.get("miss", {})),
        Figure(f"{name}, via-point: goal moved", float(max(goal)), 1e-12, "1", others.get("goal", {})),
        Figure(f"{name}, via-point: changed outside the reach", float(max(beyond)), 0.0, "1"),
        Figure(
            f"{name}, via-point: largest deviation over the displacement",
            float(max(most)),
            1.001,
            "1",
            others.get("most", {}),
        ),
        Figure(f"{name}, via-point: RMS of the acceleration over that without", float(max(effort)), 1.8, "1"),
    ]


def _promp(takes: list[Array]) -> dict[str, list[float]]:
    """Condition a probabilistic primitive of all takes on the same displacements."""
    from movement_primitives.promp import ProMP

    steps = np.linspace(0, 1, 200)
    times = np.tile(steps, (len(takes), 1))
    promp = ProMP(n_dims=2, n_weights_per_dim=24)
    promp.imitate(
        times,
        np.array([np.array([np.interp(steps, np.linspace(0, 1, len(t)), t[:, d]) for d in (0, 1)]).T for t in takes]),
    )
    mean = promp.mean_trajectory(steps.copy())
    size = _diagonal(mean)
    found: dict[str, list[float]] = {"miss": [], "goal": [], "most": []}
    for phase in _PHASES:
        k = round(phase * 199)
        aside = _aside(mean, phase)
        past = promp.condition_position(mean[k] + aside, t=steps[k]).mean_trajectory(steps.copy())
        away = np.linalg.norm(past - mean, axis=1)
        found["miss"].append(float(np.linalg.norm(past[k] - mean[k] - aside) / size))
        found["goal"].append(float(away[-1] / size))
        found["most"].append(float(away.max() / np.linalg.norm(aside)))
    return found


def moving(name: str, motions: dict[str, list[Array]]) -> list[Figure]:
    """Set a via-point on the way, move it in each step, and change the goal: what is missed, and whether the
    acceleration is continuous, its largest step at half the time step over that at the whole."""
    miss, halves = [], []
    for takes in motions.values():
        model, size = _model(takes[0]), _diagonal(takes[0])
        steps = []
        for dt in (2e-3, 1e-3):
            run = Run(model)
            target = run.ahead(0.7).point + _aside(takes[0], 0.7)
            jump, before = 0.0, run.acceleration.copy()
            while run.phase < 0.7 - 1e-9:
                if run.phase < 0.3 <= run.phase + dt + 1e-9:
                    run.via(0.7, target, reach=0.3)
                if 0.4 <= run.phase < 0.6:
                    target = target + 0.1 * size * dt
                    run.move_via(0.7, target)
                if run.phase < 0.5 <= run.phase + dt + 1e-9:
                    run.goal = model.goal + 0.1 * size
                run.step(dt)
                jump = max(jump, float(np.linalg.norm(run.acceleration - before)))
                before = run.acceleration.copy()
            miss.append(np.linalg.norm(run.position - target) / size)
            steps.append(jump)
        halves.append(steps[1] / steps[0])
    return [
        Figure(f"{name}, moving via-point and goal: missed, of the diagonal", float(max(miss)), 1e-9, "1"),
        Figure(f"{name}, moving: steps of the acceleration at dt / 2 over those at dt", float(max(halves)), 0.6, "1"),
    ]


def joins(name: str, motions: dict[str, list[Array]]) -> list[Figure]:
    """Go on with the next motion at half of each, and beside it by the spring alone."""
    models = [_model(takes[0]) for takes in motions.values()]
    jump, spring, late, peaks = [], [], [], []
    for first, second in pairwise(models):
        run, alone = Run(first), second.rollout(dt=1e-3)
        peak = np.linalg.norm(alone.acceleration, axis=1).max()
        run.step(0.5)
        before = run.acceleration.copy()
        restart = Run(second)
        restart.start_from(run.position, run.velocity)
        spring.append(np.linalg.norm(restart.acceleration - before) / peak)
        run.join(second, reach=0.4)
        jump.append(np.linalg.norm(run.acceleration - before) / peak)
        most = 0.0
        for k in range(1, len(alone.time)):
            run.step(1e-3)
            most = max(most, float(np.linalg.norm(run.acceleration)))
            if k >= 401:
                late.append(np.linalg.norm(run.position - alone.position[k]))
        peaks.append(most / peak)
    others = {"restart by the spring": float(np.median(spring))}
    return [
        Figure(f"{name}, join at speed: jump of the acceleration over the peak", float(max(jump)), 1e-9, "1", others),
        Figure(f"{name}, join: off the next motion behind its reach", float(max(late)), 1e-9, "1"),
        Figure(f"{name}, join: peak acceleration over the next motion's, median", float(np.median(peaks)), 1.05, "1"),
    ]


def via_poses() -> list[Figure]:
    """Turn a pose by 30 deg about ten axes in each form: what is missed, and the largest deviation anywhere."""
    rng = np.random.default_rng(0)
    grid = np.linspace(0, 2, 201)
    poses = np.tile(np.eye(4), (201, 1, 1))
    poses[:, :3, :3] = [so3.exp([1.2 * np.sin(t), 0.5 * t, 0.4 * np.cos(2 * t)]) for t in grid]
    poses[:, :3, 3] = np.c_[0.3 * np.sin(grid), 0.2 * np.cos(grid), 0.1 * grid]
    miss, most = [], []
    for form in ("ude", "log_linear", "turning"):
        model = PoseDmp.fit(PoseDemonstration(grid, poses), orientation_form=form)
        plain = model.rollout_at(np.linspace(0, 2, _SAMPLES))
        for _ in range(10):
            axis = rng.normal(size=3)
            pose = plain.pose[500].copy()
            pose[:3, :3] = so3.exp(np.radians(30) * axis / np.linalg.norm(axis)) @ pose[:3, :3]
            past = model.rollout_at(plain.time, via=[Via(0.5, pose)])
            miss.append(so3.distance(past.pose[500, :3, :3], pose[:3, :3]))
            most.append(max(so3.distance(a[:3, :3], b[:3, :3]) for a, b in zip(past.pose, plain.pose, strict=True)))
    return [
        Figure("via-pose of 30 deg: missed", float(np.degrees(max(miss))), 1e-7, "deg"),
        Figure("via-pose of 30 deg: largest deviation over 30 deg", float(np.degrees(max(most)) / 30), 1.01, "1"),
    ]


def times() -> list[Figure]:
    """Time from Python: setting a via-point with the step that aims at it, and steps beside it."""
    path = curves(1)["curve 0"][0]
    model = PoseDmp.fit(_pose_demonstration())
    run = PoseRun(model)
    pose = run.ahead(0.6).point
    plain = _seconds(lambda: PoseRun(model), lambda r: r.step(1e-4), 2000)
    rising = _seconds(lambda: _risen(model, pose), lambda r: r.step(1e-4), 500)
    setting = _seconds(lambda: PoseRun(model), lambda r: (r.via(0.6, pose), r.step(0.0)), 500)
    others = {}
    if peers.installed()["movement_primitives"]:
        from movement_primitives.promp import ProMP

        steps = np.linspace(0, 1, 200)
        promp = ProMP(n_dims=2, n_weights_per_dim=24)
        promp.imitate(np.tile(steps, (2, 1)), np.array([path, path + 0.01]))
        point = path[100]
        others["movement_primitives"] = 1e6 * _seconds(lambda: promp, lambda p: p.condition_position(point, t=0.5), 200)
    return [
        Figure("via-pose: set and aimed at, from Python", 1e6 * setting, 60.0, "us", others),
        Figure("a step within its reach over one without", rising / plain, 3.0, "1"),
    ]


def _closed(phase: Array) -> Array:
    """Return a closed curve (T, 3) of five harmonics at phases (T,)."""
    rng = np.random.default_rng(3)
    curve = np.zeros((len(phase), 3))
    for h in range(1, 6):
        cosine, sine = rng.normal(size=(2, 3)) / h
        curve += np.cos(2 * np.pi * h * phase)[:, None] * cosine + np.sin(2 * np.pi * h * phase)[:, None] * sine
    return curve


def rhythm() -> list[Figure]:
    """Learn a closed curve of 200 samples, N = 50, by both regressions: the error in cycles 3 to 5."""
    around = np.linspace(0, 1, 201)
    later = np.linspace(2, 5, 3001)
    truth, size = _closed(later), float(np.linalg.norm(np.ptp(_closed(around), axis=0)))
    found = []
    for regression in ("ridge", "lwr"):
        model = Dmp.fit(
            Demonstration(around, _closed(around)),
            motion="rhythmic",
            basis_count=50,
            regression=regression,
            derivatives="interpolate",
        )
        error = 100 * _rms(model.rollout_at(later).position - truth) / size
        others = {"pydmps": _pydmps_error(size)} if peers.installed()["pydmps"] and not found else {}
        found.append(Figure(f"closed curve, N = 50, {regression}: RMSE of the diagonal", error, 1e-4, "%", others))
    return found


def _pydmps_error(size: float) -> float:
    from pydmps.dmp_rhythmic import DMPs_rhythmic

    dmp = DMPs_rhythmic(n_dmps=3, n_bfs=50, dt=2 * np.pi / 1000)
    dmp.imitate_path(y_des=_closed(np.linspace(0, 1, 201)).T)
    path = np.asarray(dmp.rollout(timesteps=5 * 1000)[0])[2000:5000]
    lags = [np.arange(2000, 5000) / 1000 + lag for lag in np.linspace(-0.01, 0.01, 81)]
    return 100 * min(_rms(path - _closed(phases)) for phases in lags) / size


def turning() -> Iterator[Figure]:
    """Orientations, N = 100: the largest error in cycles 3 to 5, about the centre and with whole turns."""
    around = np.linspace(0, 1, 401)
    later = np.linspace(2, 5, 1501)
    for name, angle, turns, goal in (
        ("0.9 rad", 0.9, 0, 1e-5),
        ("2.7 rad", 2.7, 0, 1e-3),
        ("one turn a cycle", 0.9, 1, 1e-5),
        ("two turns a cycle", 0.9, 2, 1e-5),
    ):
        model = OrientationDmp.fit(
            OrientationDemonstration(around, _wobble(around, angle, turns)),
            motion="rhythmic",
            basis_count=100,
            derivatives="interpolate",
        )
        again = model.rollout_at(later).rotation
        error = max(so3.distance(a, b) for a, b in zip(again, _wobble(later, angle, turns), strict=True))
        yield Figure(f"rhythmic orientation, {name}: largest error", float(np.degrees(error)), goal, "deg")


def _wobble(phases: Array, angle: float, turns: int) -> Array:
    axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
    turn = 2 * np.pi * phases
    vector = angle * np.c_[np.cos(turn), np.sin(turn), 0.3 * np.sin(2 * turn)] / 1.04
    return np.array([so3.exp(v) @ so3.exp(turns * u * axis) for v, u in zip(vector, turn, strict=True)])


def changes() -> list[Figure]:
    """Change amplitude, centre and tempo on the way: steps of the acceleration at dt / 2 over those at dt."""
    around = np.linspace(0, 1, 201)
    model = Dmp.fit(Demonstration(around, _closed(around)), motion="rhythmic", basis_count=50)
    steps = []
    for dt in (2e-3, 1e-3, 5e-4):
        run, jump = Run(model), 0.0
        before = run.acceleration.copy()
        for k in range(round(4 / dt)):
            now = k * dt
            if abs(now - 1) < dt / 4:
                run.amplitude = 0.5
            if abs(now - 2) < dt / 4:
                run.goal = model.goal + 0.1
            if abs(now - 3) < dt / 4:
                run.duration = 0.5
            run.step(dt)
            jump = max(jump, float(np.linalg.norm(run.acceleration - before)))
            before = run.acceleration.copy()
        steps.append(jump)
    return [
        Figure(
            "rhythm changed on the way: steps of the acceleration, halved",
            max(steps[1] / steps[0], steps[2] / steps[1]),
            0.55,
            "1",
        )
    ]


def periods() -> Iterator[Figure]:
    """Find the period of 20 seeded recordings, with noise, with a start that is no part of them; and of a person."""
    for name, noise, transient, goal in (("1 % noise", 0.01, 0.0, 1e-4), ("1 % noise, transient", 0.01, 0.5, 5e-4)):
        errors = []
        for seed in range(20):
            rng = np.random.default_rng(seed)
            period = rng.uniform(0.7, 1.6)
            grid = np.linspace(0, 8 * period + rng.uniform(0, 1), 1500)
            curve = _closed(grid / period)
            size = float(np.linalg.norm(np.ptp(curve, axis=0)))
            curve += transient * size * np.maximum(1 - grid / 0.6, 0)[:, None] * [1, -1, 0.5]
            curve += noise * size / np.sqrt(3) * rng.normal(size=curve.shape)
            errors.append(abs(dmpcpp.find_cycle(Demonstration(grid, curve)).period / period - 1))
        yield Figure(f"period, {name}: median error", float(np.median(errors)), goal, "1")
    folder = Path(os.environ.get("DMPCPP_RECORDINGS", "")) / "c3d_ktk" / "sample_propulsion.c3d"
    if folder.is_file():
        yield from propulsion(folder)


def propulsion(path: Path) -> Iterator[Figure]:
    """Leave as little as possible of a person who propels a wheelchair: what one cycle does not explain."""
    from dmpcpp import recordings

    markers = recordings.markers(path)
    for name in ("GloveR1", "GloveL1"):
        seen = markers.chosen([name])
        kept = np.isfinite(seen.position[:, 0]).all(axis=1)
        grid, path = seen.time[kept], seen.position[kept, 0]
        found = dmpcpp.find_cycle(Demonstration(grid, path))
        line = np.c_[np.ones(len(grid)), grid]
        moved = _rms(path - line @ np.linalg.lstsq(line, path, rcond=None)[0])
        left = 100 * found.unexplained * moved / float(np.linalg.norm(np.ptp(path, axis=0)))
        yield Figure(f"wheelchair, {name}: left by one cycle, RMS of the range", left, 3.5, "%")


def _risen(model: PoseDmp, pose: Array) -> PoseRun:
    run = PoseRun(model)
    run.via(0.6, pose)
    run.step(0.45 * model.duration)
    return run


def _pose_demonstration() -> PoseDemonstration:
    grid = np.linspace(0, 1, 201)
    poses = np.tile(np.eye(4), (201, 1, 1))
    poses[:, :3, :3] = [so3.exp([np.sin(t), 0.5 * t, 0.4 * np.cos(2 * t)]) for t in grid]
    poses[:, :3, 3] = np.c_[0.3 * np.sin(3 * grid), 0.2 * np.cos(grid), 0.1 * grid]
    return PoseDemonstration(grid, poses)


def _seconds(make: Callable[[], Any], call: Callable[[Any], Any], count: int) -> float:
    """Return the seconds that a call takes, the least of five rounds."""
    best = np.inf
    for _ in range(5):
        value = make()
        start = time.process_time()
        for _ in range(count):
            call(value)
        best = min(best, (time.process_time() - start) / count)
    return float(best)


def _rms(away: Array) -> float:
    return float(np.sqrt(np.mean(np.sum(away**2, axis=1))))


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON instead of the table.")
def main(as_json: bool) -> None:
    """Measure via-points, joins, rhythmic motions and distributions, with the goal of every figure."""
    measured = list(measure())
    if as_json:
        click.echo(json.dumps({"figures": [figure.to_dict() for figure in measured]}, indent=2))
    else:
        accuracy.show(measured)
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


if __name__ == "__main__":
    main()
