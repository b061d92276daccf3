"""What a second thread gains, beside the most that the machine gives at that moment.

The clock on the wall tells it, so that whatever else runs on the machine counts too: every measurement is taken many
times and the quietest kept, and hashing on two threads, which share nothing, says what there was to gain.
"""

from __future__ import annotations

import hashlib
import os
import threading
import time
from collections.abc import Callable

import numpy as np
from dmpcpp import Arm, InverseKinematics

from benchmarks.kinematics_arms import Array, random_joints

_ROUNDS = 100
_REST = 0.03  # s before each, short beside it: a busy machine gives one that has waited its turn at once


def threads(name: str, arm: Arm, count: int) -> None:
    """Two threads, each with half of the poses, against one with all; beside it two threads that share nothing."""
    poses = arm.forward_kinematics(random_joints(arm, np.random.default_rng(4), count))
    solver, halves = InverseKinematics(arm), (poses[: count // 2], poses[count // 2 :])
    middle = solver.middle
    serial = [solver.solve_many(half, middle).joints for half in halves]
    found: list[Array] = [middle, middle]

    def solve(i: int) -> None:
        found[i] = solver.solve_many(halves[i], middle).joints

    def spin(_: int) -> None:
        hashlib.pbkdf2_hmac("sha256", b"", b"", 20 * count)  # arithmetic alone, outside the interpreter's lock

    same = True
    solving, spinning = Pair(solve), Pair(spin)
    for _ in range(_ROUNDS):
        solving.run()
        same &= all(np.array_equal(a, b) for a, b in zip(found, serial, strict=True))
        spinning.run()
    print(
        f"{name:6} two threads: {solving.gain:.2f} times the throughput at {solving.cost:.2f} of the CPU time, serial "
        f"answers bit for bit: {same}; arithmetic alone: {spinning.gain:.2f} times at {spinning.cost:.2f} "
        f"({os.cpu_count()} processors, load {os.getloadavg()[0]:.1f})",
        flush=True,
    )


class Pair:
    """Work for two threads: its quietest runs one after the other and side by side, by the clock on the wall."""

    def __init__(self, work: Callable[[int], None]) -> None:
        """Take work that is called with 0 and with 1, the number of the thread."""
        self._work = work
        self._alone, self._together = [np.inf, np.inf], [np.inf, np.inf]  # s on the wall, s of CPU

    def run(self) -> None:
        """Measure once more, each way."""
        _keep_least(self._alone, lambda: [self._work(0), self._work(1)])
        _keep_least(self._together, self._side_by_side)

    def _side_by_side(self) -> None:
        pair = [threading.Thread(target=self._work, args=(i,)) for i in range(2)]
        for thread in pair:
            thread.start()
        for thread in pair:
            thread.join()

    @property
    def gain(self) -> float:
        """Throughput of two threads over that of one."""
        return self._alone[0] / self._together[0]

    @property
    def cost(self) -> float:
        """CPU time side by side over CPU time one after the other."""
        return self._together[1] / self._alone[1]


def _keep_least(least: list[float], work: Callable[[], object]) -> None:
    time.sleep(_REST)
    begin, begin_cost = time.perf_counter(), time.process_time()
    work()
    spent = time.perf_counter() - begin, time.process_time() - begin_cost
    least[:] = map(min, least, spent)
