"""How many updates a second the teaching page's session makes: `python -m benchmarks.view`."""

from __future__ import annotations

import time
from dataclasses import replace

import dmpcpp
import numpy as np
from dmpcpp import arms
from dmpcpp.view import Choice, Session

UPDATES = 100


def main() -> None:
    """Print the median and the 95th percentile of an update, and updates a second, for each kind of change."""
    panda, times = arms.find("panda"), np.linspace(0.0, 3.0, 300)
    middle = np.array([0.0, 0.2, 0.0, -1.9, 0.0, 2.1, 0.8])
    poses = panda.forward_kinematics(middle + 0.25 * np.sin(np.c_[times]))
    session = Session(dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(times, poses), basis_count=100), panda)
    print(f"{'change':<10} {'median ms':>10} {'p95 ms':>10} {'updates/s':>10}")
    for name in ("goal", "start", "duration", "alpha", "kernels"):
        taken = [_timed(session, _choice(session.demonstrated, name, k)) for k in range(UPDATES)]
        median, late = np.median(taken), np.percentile(taken, 95)
        print(f"{name:<10} {1e3 * median:>10.1f} {1e3 * late:>10.1f} {1.0 / median:>10.0f}")


def _choice(begin: Choice, name: str, k: int) -> Choice:
    share = np.sin(0.3 * k)
    if name == "duration":
        return replace(begin, duration=begin.duration * (1.5 + share))
    if name == "alpha":
        return replace(begin, alpha=begin.alpha * (1.5 + share))
    if name == "kernels":
        return replace(begin, basis_count=20 + 3 * k)
    pose = getattr(begin, name).copy()
    pose[:3, 3] += 0.05 * share * np.array([1.0, -1.0, 0.5])
    return replace(begin, **{name: pose})


def _timed(session: Session, choice: Choice) -> float:
    began = time.perf_counter()
    session.update(choice)
    return time.perf_counter() - began


if __name__ == "__main__":
    main()
