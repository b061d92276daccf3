"""How long `dmpcpp COMMAND --help` takes: `python -m benchmarks.command_line`."""

from __future__ import annotations

import resource
import statistics
import subprocess
import sys
import time

from dmpcpp.cli import main as program

REPEATS = 7


def main() -> None:
    """Print the fastest, the median and the mean processor time of every command's help [s]."""
    print(f"{'command':<12} {'fastest s':>10} {'median s':>10} {'CPU s':>10}")
    for name in sorted(program.commands):
        taken, worked = [], _worked()
        for _ in range(REPEATS):
            began = time.perf_counter()
            subprocess.run([sys.executable, "-m", "dmpcpp", name, "--help"], check=True, capture_output=True)
            taken.append(time.perf_counter() - began)
        print(
            f"{name:<12} {min(taken):>10.2f} {statistics.median(taken):>10.2f} {(_worked() - worked) / REPEATS:>10.2f}"
        )


def _worked() -> float:
    """Return the processor's time of all commands so far [s]: on a machine that does other work, what is left of it."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
