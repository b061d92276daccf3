"""Throughput of a batch with one and two processes: `python -m benchmarks.batch [RECORDINGS]`.

The recordings are hands that draw arcs of different size and turn, made here. What counts is the time of the second
batch over that of the first on a machine with nothing else to do.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from dmpcpp import batch


def main(count: int = 20) -> None:
    """Print seconds, recordings a minute and verdicts for each number of processes, and the scaling."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "takes").mkdir()
        for k in range(count):
            _write(folder / "takes" / f"{k:03}.npz", np.random.default_rng(k))
        taken = {jobs: _timed(folder, jobs) for jobs in (1, 2)}
    print(f"two processes: {taken[1] / taken[2]:.2f} x the throughput of one")


def _timed(folder: Path, jobs: int) -> float:
    work = batch.tasks(folder / "takes", folder / f"out{jobs}", arm="iiwa", reading={"quat_order": "xyzw"})
    began = time.perf_counter()
    outcomes = batch.imitate_many(work, jobs=jobs)
    seconds = time.perf_counter() - began
    passed = sum(outcome.ok for outcome in outcomes)
    each = 60.0 * len(work) / seconds
    print(f"{jobs} process(es): {seconds:.1f} s, {each:.1f} recordings a minute, {passed} of {len(work)} verified")
    return seconds


def _write(path: Path, draw: np.random.Generator) -> None:
    time_, turn = np.linspace(0.0, 2.0, 120), draw.uniform(0.2, 0.6)
    angle = turn * np.sin(np.pi * time_ / 2)
    size = draw.uniform(0.08, 0.2, 3)
    position = size * np.c_[np.sin(time_), np.cos(time_), 0.5 * time_]
    np.savez(path, time=time_, pose=np.c_[position, 0 * time_, np.sin(angle / 2), 0 * time_, np.cos(angle / 2)])


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
