"""The last lines of a test run: what was left out, why, and the command that runs it."""

import subprocess
import sys
from pathlib import Path

TESTS = """
import pytest

@pytest.mark.slow
def test_long(): ...

@pytest.mark.parametrize("k", range(3))
def test_recorded(recorded, k): ...

def test_engine(): pytest.importorskip("no_such_engine", reason="the extra `sim`")

def test_odd(): pytest.skip("the moon is full")

def test_runs(): ...
"""


def test_each_reason_is_counted_with_the_command_that_runs_it(tmp_path, monkeypatch):
    monkeypatch.delenv("DMPCPP_RECORDINGS", raising=False)
    (tmp_path / "conftest.py").write_text(Path(__file__).with_name("conftest.py").read_text())
    (tmp_path / "test_some.py").write_text(TESTS)
    pytest = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", tmp_path, tmp_path]
    done = subprocess.run(pytest, capture_output=True, text=True, cwd=tmp_path)
    assert "1 passed, 6 skipped" in done.stdout, done.stdout
    section = done.stdout.split("left out")[1].splitlines()
    assert [" ".join(line.split()) for line in section[1:5]] == [
        "3 needs recordings of people: DMPCPP_RECORDINGS=FOLDER scripts/test.sh",
        "1 slow: scripts/test.sh --slow",
        "1 needs PyBullet: scripts/test.sh, without --without-bullet",
        "1 the moon is full: see the reason",
    ]
