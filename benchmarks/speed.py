"""`python -m benchmarks.speed [--json]`: times beside movement_primitives and pydmps, in one run and one thread.

Every figure is the median of several CPU times of this thread; a ratio compares two of them that were taken in turn.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, replace
from typing import Any

import click
import dmpcpp
import numpy as np

from benchmarks.demonstrations import DT, TIME, reach, turning
from benchmarks.peers import installed

BASIS_COUNT = 100
_ROUNDS = 7
_SHORTEST = 0.02  # s, of one round; what is quicker is repeated within it

MANY = 1000

Work = Callable[[], object]


@dataclass(frozen=True)
class Speed:
    """One task: our seconds, the peer's, and how many times faster we shall be at least."""

    task: str
    ours: float
    peer: str
    theirs: float
    goal: float

    @property
    def ratio(self) -> float:
        """How many times faster we are."""
        return self.theirs / self.ours


def compare(task: str, ours: Work, peer: str, theirs: Work, goal: float) -> Speed:
    """Time both in turn, so that a machine whose speed drifts does not favour one."""
    repeats = [_repeats(work) for work in (ours, theirs)]
    rounds = [[_seconds(work, n) for work, n in zip((ours, theirs), repeats, strict=True)] for _ in range(_ROUNDS)]
    mine, other = (statistics.median(times) for times in zip(*rounds, strict=True))
    return Speed(task, mine, peer, other, goal)


def _seconds(work: Work, repeats: int) -> float:
    begin = time.thread_time()
    for _ in range(repeats):
        work()
    return (time.thread_time() - begin) / repeats


def _repeats(work: Work) -> int:
    repeats = 1
    while _seconds(work, repeats) * repeats < _SHORTEST:
        repeats *= 2
    return repeats


def measure() -> Iterator[Speed]:
    """Yield every task for which a peer is installed."""
    there = installed()
    if there["movement_primitives"]:
        yield from _beside_movement_primitives()
    if there["pydmps"]:
        yield from _beside_pydmps()


def _poses() -> np.ndarray:
    poses = np.tile(np.eye(4), (len(TIME), 1, 1))
    poses[:, :3, :3] = turning(3.0)
    poses[:, :3, 3] = reach()
    return poses


def _beside_movement_primitives() -> Iterator[Speed]:
    from movement_primitives.dmp import DMP, CartesianDMP
    from scipy.spatial.transform import Rotation

    position, poses, name = reach(), _poses(), "movement_primitives"
    turns = Rotation.from_matrix(poses[:, :3, :3]).as_quat()[:, [3, 0, 1, 2]]
    turns *= np.cumprod(np.r_[1.0, np.sign(np.sum(turns[1:] * turns[:-1], axis=1))])[:, None]
    rows = np.c_[position, turns]

    def theirs_position() -> Any:
        dmp = DMP(n_dims=3, execution_time=TIME[-1], dt=DT, n_weights_per_dim=BASIS_COUNT)
        dmp.imitate(TIME, position)
        return dmp

    def theirs_pose() -> Any:
        dmp = CartesianDMP(execution_time=TIME[-1], dt=DT, n_weights_per_dim=BASIS_COUNT)
        dmp.imitate(TIME, rows)
        return dmp

    yield _each(compare(f"fit of {MANY} on one time grid, each", _many_fits(position), name, theirs_position, 50))
    pose_model, pose_dmp = _fit_pose(poses), theirs_pose()
    yield compare("fit, position", lambda: _fit_position(position), name, theirs_position, 25)
    yield compare("fit, pose", lambda: _fit_pose(poses), name, theirs_pose, 100)
    yield compare("rollout of 1000 steps, pose", lambda: pose_model.rollout(dt=DT).pose, name, pose_dmp.open_loop, 250)
    run = dmpcpp.PoseRun(pose_model)
    pose_dmp.reset()
    state, velocity = rows[0].copy(), np.zeros(6)
    yield compare(
        "step, pose", lambda: (run.step(DT) or run.reset(), run.pose), name, lambda: pose_dmp.step(state, velocity), 80
    )


def _many_fits(position: np.ndarray) -> Work:
    """One call on as many different demonstrations, as arrays: (M, T, 3)."""
    scale = np.linspace(0.5, 1.5, MANY)[:, None, None]
    many = scale * position
    return lambda: dmpcpp.Dmp.fit_each(TIME, many, basis_count=BASIS_COUNT)


def _each(speed: Speed) -> Speed:
    return replace(speed, ours=speed.ours / MANY)


def _beside_pydmps() -> Iterator[Speed]:
    from pydmps.dmp_discrete import DMPs_discrete

    position = reach()
    model = _fit_position(position)
    dmp = DMPs_discrete(n_dmps=3, n_bfs=BASIS_COUNT, dt=1.0 / len(position))
    dmp.imitate_path(y_des=position.T.copy())
    yield compare(
        "rollout of 1000 steps, position",
        lambda: model.rollout(dt=DT).position,
        "pydmps",
        lambda: dmp.rollout(timesteps=len(position)),
        100,
    )
    run = dmpcpp.Run(model)
    dmp.reset_state()
    yield compare("step, position", lambda: (run.step(DT) or run.reset(), run.position), "pydmps", dmp.step, 13)


def _fit_position(position: np.ndarray) -> dmpcpp.Dmp:
    return dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, position), basis_count=BASIS_COUNT)


def _fit_pose(poses: np.ndarray) -> dmpcpp.PoseDmp:
    return dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(TIME, poses), basis_count=BASIS_COUNT)


def import_milliseconds() -> tuple[float, float]:
    """Return what importing numpy takes, and dmpcpp after it: medians of new processes, ms of CPU time."""
    code = (
        "import time; a = time.process_time(); import numpy; b = time.process_time(); import dmpcpp; "
        "c = time.process_time(); print(b - a, c - b)"
    )
    runs = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True) for _ in range(9)]
    times = [[1e3 * float(number) for number in run.stdout.split()] for run in runs]
    numpy_, ours = (statistics.median(column) for column in zip(*times, strict=True))
    return numpy_, ours


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print numbers for machines.")
def main(as_json: bool) -> None:
    """Time the work of every day beside movement_primitives and pydmps (pip install "dmpcpp[bench]")."""
    measured = list(measure())
    if as_json:
        click.echo(json.dumps([{**asdict(speed), "ratio": speed.ratio} for speed in measured], indent=2))
        return
    for name, found in installed().items():
        click.echo(f"{name} {found or 'is not installed'}")
    for speed in measured:
        mark = "ok  " if speed.ratio >= speed.goal else "MISS"
        click.echo(
            f"{mark} {speed.task:32} {1e6 * speed.ours:10.2f} us   {speed.peer} {1e6 * speed.theirs:10.1f} us   "
            f"{speed.ratio:6.0f} x (goal {speed.goal:g})"
        )
    numpy_, ours = import_milliseconds()
    click.echo(
        f"{'ok  ' if ours <= 20.0 else 'MISS'} import: numpy {numpy_:.0f} ms, dmpcpp {ours:.1f} ms more (goal 20)"
    )


if __name__ == "__main__":
    main()
