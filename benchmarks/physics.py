"""`python -m benchmarks.physics [--json]`: how exactly arms are driven under physics, and how fast, in one run.

Tool position errors in mm and angles in deg against the forward kinematics of the reference, over the motion itself; a
reach of 3 s from rest to rest and a swing of 2 s cut out of a motion, for every arm. Exit status: 0 every goal reached,
3 one missed. What depends on the machine (time) is a figure with a goal too: an idle core is assumed.
"""

from __future__ import annotations

import json
import math
import platform
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import click
import numpy as np
from dmpcpp import Arm, arms, simulation
from dmpcpp.simulation import Bullet, Disturbance, ExecutionLog, MuJoCo, Simulator

from benchmarks.figures import Figure
from benchmarks.joint_motions import HOME, Joints, reach, swing

SEEDS = 20
STIFF = {"kp": 6400.0, "kd": 160.0, "ki": 160000.0}
"""Gains [1/s^2, 1/s, 1/s^3] for an arm that is not well known."""

Engine = Callable[..., Simulator]
_MM, _DEG = 1e3, math.degrees(1.0)
_TIMED_SECONDS, _TIMED_RUNS = 8.0, 5


def motions(arm: Arm, name: str) -> dict[str, Joints]:
    """What is executed."""
    return {"reach": reach(arm, np.add(HOME[name], 0.4), 3.0), "swing": swing(arm, 2.0)}


def nominal(name: str, engine: Engine) -> Iterator[Figure]:
    """Computed torque at 1 kHz that knows the arm: references of the spline, and consistent ones."""
    arm = arms.find(name)
    for motion, joints in motions(arm, name).items():
        log = simulation.execute(arm, joints, consistent=False, simulator=engine)
        title = f"{name}, {motion}, {log.simulator}: nominal"
        yield Figure(f"{title}, RMSE", _MM * log.errors.position_rmse, 0.05, "mm")
        yield Figure(f"{title}, max", _MM * log.errors.position_max, 0.1, "mm")
        yield Figure(f"{title}, angle max", _DEG * log.errors.angle_max, 0.01, "deg")
        log = simulation.execute(arm, joints, simulator=engine)
        yield Figure(f"{title}, consistent reference, max", _MM * log.errors.position_max, 1e-3, "mm")


def disturbed(name: str, engine: Engine, seeds: int = SEEDS) -> Iterator[Figure]:
    """Masses off by 20 %, 0.5 kg unknown 0.1 m before the tip, 0.5 Nms/rad unknown: the worst over the seeds."""
    arm = arms.find(name)
    for motion, joints in motions(arm, name).items():
        logs = [_disturbed(arm, joints, engine, seed) for seed in range(seeds)]
        title = f"{name}, {motion}, {logs[0].simulator}: {seeds} wrong models"
        yield Figure(f"{title}, RMSE", _MM * max(log.errors.position_rmse for log in logs), 0.5, "mm")
        yield Figure(f"{title}, max", _MM * max(log.errors.position_max for log in logs), 1.5, "mm")
        yield Figure(f"{title}, settle", _MM * max(log.verdict["settle_error"].value for log in logs), 0.02, "mm")


def _disturbed(arm: Arm, joints: Joints, engine: Engine, seed: int) -> ExecutionLog:
    unknown = Disturbance(mass_error=0.2, payload=0.5, damping=0.5, seed=seed)
    return simulation.execute(arm, joints, **STIFF, disturbance=unknown, simulator=engine)


def two_engines(name: str) -> Iterator[Figure]:
    """PyBullet and MuJoCo, each with its own inverse dynamics, along one trajectory."""
    arm = arms.find(name)
    scales = {"m": (_MM, "mm"), "rad": (_DEG, "deg"), "1": (100.0, "% of the limit"), "checks": (1.0, "checks")}
    for motion, joints in motions(arm, name).items():
        logs = [simulation.execute(arm, joints, consistent=False, simulator=engine) for engine in (Bullet, MuJoCo)]
        for check in simulation.agreement(*logs):
            scale, unit = scales[check.unit]
            title = f"{name}, {motion}: PyBullet and MuJoCo, {check.name.removeprefix('engines_')}"
            yield Figure(title, scale * check.value, scale * check.limit, unit)


def speed(name: str, engine: Engine) -> Figure:
    """CPU seconds a simulated second at 1 kHz, loading and the full log included: the best of some runs."""
    arm = arms.find(name)
    joints = swing(arm, _TIMED_SECONDS)
    seconds = []
    for _ in range(_TIMED_RUNS):
        begin = time.process_time()
        log = simulation.execute(arm, joints, simulator=engine)
        seconds.append((time.process_time() - begin) / (len(log.time) / log.rate))
    return Figure(f"{name}, {log.simulator}: CPU time a simulated second", min(seconds), 0.06, "s")


def measure(seeds: int) -> Iterator[Figure]:
    """Measure everything, figure by figure."""
    for engine in (Bullet, MuJoCo):
        for name in HOME:
            yield from nominal(name, engine)
            yield speed(name, engine)
        for name in ("panda", "iiwa"):
            yield from disturbed(name, engine, seeds)
    for name in ("panda", "iiwa"):
        yield from two_engines(name)


@click.command()
@click.option("--seeds", default=SEEDS, show_default=True, type=click.IntRange(1), help="Wrong models per motion.")
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON instead of lines.")
def main(seeds: int, as_json: bool) -> None:
    """Measure execution under physics, with the goal of every figure."""
    measured = []
    for figure in measure(seeds):
        measured.append(figure)
        if not as_json:
            mark = "ok  " if figure.ok else "MISS"
            click.echo(f"{mark} {figure.value:10.2g} <= {figure.goal:<6.3g} {figure.unit:14} {figure.name}")
    if as_json:
        click.echo(json.dumps(_summary(measured), indent=2, allow_nan=False))
    sys.exit(0 if all(figure.ok for figure in measured) else 3)


def _summary(measured: list[Figure]) -> dict[str, Any]:
    return {
        "verdict": "pass" if all(figure.ok for figure in measured) else "fail",
        "python": platform.python_version(),
        "machine": platform.machine(),
        "figures": [figure.to_dict() for figure in measured],
    }


if __name__ == "__main__":
    main()
