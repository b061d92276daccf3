"""How long a report takes and how large it is: `python -m benchmarks.report [ARM ...]`."""

from __future__ import annotations

import sys
import tempfile
import time

from dmpcpp import arms, imitation, recordings, report


def main(names: list[str]) -> None:
    """Print seconds, those of the processor and megabytes of the report of the demo's motion, for each arm."""
    print(f"{'arm':<8} {'report s':>9} {'CPU s':>6} {'MB':>6}")
    for name in names:
        run = imitation.imitate(recordings.clip("dance_b", "right_hand"), arms.find(name))
        with tempfile.TemporaryDirectory() as folder:
            imitation.write(run, folder)
            began, worked = time.perf_counter(), time.process_time()
            page = report.write(folder)
            taken, worked = time.perf_counter() - began, time.process_time() - worked
            print(f"{name:<8} {taken:>9.1f} {worked:>6.1f} {page.stat().st_size / 1e6:>6.2f}")


if __name__ == "__main__":
    main(sys.argv[1:] or ["panda", "iiwa", "xarm6"])
