"""The command line, run as a user runs it."""

import subprocess
import sys
from pathlib import Path

import numpy as np


def run(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run `dmpcpp ARGUMENTS` in a folder; no user ever sees a traceback."""
    command = [sys.executable, "-m", "dmpcpp", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, timeout=600)
    assert "Traceback" not in done.stderr + done.stdout, done.stderr
    return done


def write_hand(path: Path, count: int = 120, turn: float = 0.4, lift: float = 0.1) -> None:
    """Write a hand that draws an arc while it turns, as .npz with quaternions x y z w."""
    time = np.linspace(0.0, 2.0, count)
    angle = turn * np.sin(np.pi * time / 2)
    position = np.c_[0.2 * np.sin(time), 0.15 * np.cos(time), lift * time]
    np.savez(path, time=time, pose=np.c_[position, 0 * time, np.sin(angle / 2), 0 * time, np.cos(angle / 2)])
