"""What a recording of a million rows costs: processor time and memory of `dmpcpp inspect` and `dmpcpp imitate`.

`python -m benchmarks.recordings --long` makes the recording, a hand that reaches out and back for 2.8 hours at 100 Hz
with a tracker's noise of 0.3 mm, as a table, and starts both commands on it.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from benchmarks.figures import Figure

ROWS = 1_000_000
RATE = 100.0  # Hz
PERIOD = 6.0  # s, of a reach there and back with a rest
NOISE = 3e-4  # m
BLOCK = 100_000  # rows written at once

GOALS = {"inspect": 20.0, "imitate": 60.0}  # CPU s
MEMORY = 1000.0  # MB


def measure(rows: int = ROWS) -> Iterator[Figure]:
    """Yield processor time [s] and peak memory [MB] of both commands."""
    with tempfile.TemporaryDirectory() as folder:
        path = write(Path(folder) / "session.csv", rows)
        for command, goal in GOALS.items():
            extra = ["--out", f"{folder}/out", "--no-report"] if command == "imitate" else []
            seconds, megabytes, status = run([command, str(path), "--up", "z", *extra])
            name = f"{command} of {rows} rows (exit status {status})"
            yield Figure(f"{name}: processor time", seconds, goal, "s")
            yield Figure(f"{name}: peak memory", megabytes, MEMORY, "MB")


def write(path: Path, rows: int = ROWS) -> Path:
    """Write the table: time [s], position [m], quaternion x y z w."""
    rng = np.random.default_rng(0)
    with path.open("w") as file:
        file.write("time,x,y,z,qx,qy,qz,qw\n")
        for begin in range(0, rows, BLOCK):
            np.savetxt(file, _block(np.arange(begin, min(begin + BLOCK, rows)), rng), fmt="%.9g", delimiter=",")
    return path


def _block(k: NDArray[np.int_], rng: np.random.Generator) -> NDArray[np.float64]:
    """Return rows of a hand that reaches out (2 s), rests (1 s), comes back (2 s) and rests (1 s)."""
    time = k / RATE
    phase = np.mod(time, PERIOD)
    share = np.clip(np.where(phase < 3.0, phase / 2.0, (5.0 - phase) / 2.0), 0.0, 1.0)
    way = 10 * share**3 - 15 * share**4 + 6 * share**5
    position = np.array([0.3, 0.1, 0.9]) + way[:, None] * [0.25, 0.2, 0.15]
    turn = Rotation.from_rotvec(way[:, None] * [0.3, 0.0, 0.6]).as_quat()
    return np.column_stack([time, position + NOISE * rng.standard_normal(position.shape), turn])


def run(arguments: Sequence[str]) -> tuple[float, float, int]:
    """Return processor time [s], peak memory [MB] and exit status of a command, its own process measured alone."""
    with Path(os.devnull).open("w") as nowhere:
        quiet = [(os.POSIX_SPAWN_DUP2, nowhere.fileno(), 1), (os.POSIX_SPAWN_DUP2, nowhere.fileno(), 2)]
        command = [sys.executable, "-m", "dmpcpp", *arguments]
        pid = os.posix_spawn(sys.executable, command, os.environ, file_actions=quiet)
        _, status, used = os.wait4(pid, 0)
    return used.ru_utime + used.ru_stime, 1024 * used.ru_maxrss / 1e6, os.waitstatus_to_exitcode(status)
