"""What a second thread gains, beside the most that the machine gives at that moment.

By the clock on the wall whatever else runs on the machine counts too: every measurement is taken many times and the
quietest kept, and hashing on two threads, which share nothing, says what there was to gain. What the threads themselves
spend on the processor, and how often they let go of it to wait for each other, does not depend on the neighbours: with
a processor for each, the pair takes as long as its longer thread.
"""

from __future__ import annotations

import hashlib
import os
import resource
import threading
import time
from collections.abc import Callable

import numpy as np
from dmpcpp import Arm, InverseKinematics

from benchmarks.kinematics_arms import Array, random_joints

_ROUNDS = 100
_REST = 0.03  # s before each: on a busy machine one that has rested gets its turn sooner


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
        f"{name:6} two threads: {solving.describe()}, serial answers bit for bit: {same}\n"
        f"{name:6} the machine's own ceiling, arithmetic alone: {spinning.describe()} "
        f"({os.cpu_count()} processors, load {os.getloadavg()[0]:.1f})",
        flush=True,
    )


class Pair:
    """Work for two threads, done in turn and side by side again and again; the quietest of each is kept."""

    def __init__(self, work: Callable[[int], None]) -> None:
        """Take work that is called with 0 and with 1, the number of the thread."""
        self._work = work
        self._spent, self._waits = [0.0, 0.0], [0, 0]  # of each thread, the last time
        self._in_turn, self._together = np.full(2, np.inf), np.full(2, np.inf)  # s by the clock, s of CPU
        self._waited, self._runs = 0, 0

    def run(self) -> None:
        """Measure once more, each way."""
        self._in_turn = np.minimum(self._in_turn, (_seconds(self._do_in_turn), sum(self._spent)))
        self._together = np.minimum(self._together, (_seconds(self._do_together), max(self._spent)))
        self._waited += sum(self._waits)
        self._runs += 1

    def describe(self) -> str:
        """Say how many times the throughput, by the clock and by what the threads themselves spent."""
        by_clock, by_threads = self._in_turn / self._together
        return (
            f"{by_clock:.2f} times the throughput by the clock, {by_threads:.2f} by the CPU time of the longer thread, "
            f"the two waited {self._waited / self._runs:.2f} times a run"
        )

    def _do_in_turn(self) -> None:
        for i in range(2):
            self._do(i)

    def _do_together(self) -> None:
        pair = [threading.Thread(target=self._do, args=(i,)) for i in range(2)]
        for thread in pair:
            thread.start()
        for thread in pair:
            thread.join()

    def _do(self, i: int) -> None:
        begin, waits = time.thread_time(), _waits_of_this_thread()
        self._work(i)
        self._spent[i], self._waits[i] = time.thread_time() - begin, _waits_of_this_thread() - waits


def _waits_of_this_thread() -> int:
    return resource.getrusage(resource.RUSAGE_THREAD).ru_nvcsw


def _seconds(work: Callable[[], None]) -> float:
    time.sleep(_REST)
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin
