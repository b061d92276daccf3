"""Worker processes end with the command that began them."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from dmpcpp.trials._processes import workers

from tests.python.command import write_hand

PATIENCE = 120.0  # s; what never comes fails the test


def children(parent):
    """The processes that a process began, and those that they began."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, rest = stat.read_text().rsplit(")", 1)
        except OSError:
            continue  # it has just ended
        if int(rest.split()[1]) == parent and rest.split()[0] != "Z":
            pid = int(name.split()[0])
            found += [pid, *children(pid)]
    return found


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def at_work(pid):
    try:
        return "pybullet" in Path(f"/proc/{pid}/maps").read_text()
    except OSError:
        return False


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "it never came to that"
        time.sleep(0.05)


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="processes are looked at in /proc")
@pytest.mark.parametrize("command", ["batch", "generality"])
def test_sigterm_to_a_command_ends_its_workers_too(command, tmp_path):
    pytest.importorskip("pybullet")
    (tmp_path / "takes").mkdir()
    for name in ("a", "b"):
        write_hand(tmp_path / "takes" / f"{name}.npz")
    stated = {
        "batch": ["batch", "takes", "--quat-order", "xyzw", "--jobs", "2"],
        "generality": ["generality", "-k", "4", "--jobs", "2"],
    }
    process = subprocess.Popen(
        [sys.executable, "-m", "dmpcpp", *stated[command], "--out", "out"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
    )
    begun = []
    try:
        wait_until(lambda: process.poll() is not None or any(map(at_work, children(process.pid))))
        assert process.poll() is None
        begun = children(process.pid)
        process.send_signal(signal.SIGTERM)
        _, said = process.communicate(timeout=PATIENCE)
        assert process.returncode == 143 and "dmpcpp: terminated." in said and "Traceback" not in said
        wait_until(lambda: not any(map(alive, begun)))
        assert not list((tmp_path / "out").rglob("outcome.json"))  # ended, not waited for
    finally:
        for pid in [process.pid, *begun]:
            if alive(pid):
                os.kill(pid, signal.SIGKILL)


def test_workers_are_waited_for_unless_the_block_is_left_by_an_exception():
    with workers(1) as pool:
        done = pool.submit(time.sleep, 0.2)
    assert done.result() is None
    with pytest.raises(KeyboardInterrupt), workers(1) as pool:
        running = pool.submit(time.sleep, 10 * PATIENCE)
        wait_until(running.running)
        raise KeyboardInterrupt
    assert isinstance(running.exception(), Exception)
