"""Fixtures shared by the tests of the Python package."""

import os
import re
from collections import Counter
from pathlib import Path

import pytest
from dmpcpp import Arm, arms


@pytest.fixture(scope="session")
def recorded() -> Path:
    """Folder of real recordings, outside the project; DMPCPP_RECORDINGS says where."""
    folder = os.environ.get("DMPCPP_RECORDINGS")
    if not folder or not Path(folder).is_dir():
        pytest.skip("DMPCPP_RECORDINGS does not name a folder of recordings")
    return Path(folder)


@pytest.fixture(params=["panda", "iiwa", "xarm6"])
def arm(request: pytest.FixtureRequest) -> Arm:
    """Each of the arms that PyBullet ships."""
    return _known_arm(request.param)


@pytest.fixture
def panda() -> Arm:
    """The Franka Panda that PyBullet ships."""
    return _known_arm("panda")


@pytest.fixture
def needs_bullet() -> None:
    """For a test of PyBullet itself; others take the engine that there is."""
    pytest.importorskip("pybullet", reason="the extra `sim`")


def _known_arm(name: str) -> Arm:
    pytest.importorskip("pybullet_data")
    return arms.find(name)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add --slow."""
    parser.addoption("--slow", action="store_true", help="run the long tests too")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Skip what is marked slow unless --slow is given."""
    if config.getoption("--slow"):
        return
    for item in items:
        if "slow" in item.keywords:
            item.add_marker(pytest.mark.skip(reason="slow: run with --slow"))


# Why a test was left out, by a pattern over the reason of its skip: what that is, and what runs it.
_LEFT_OUT = (
    (r"^slow", "slow", "scripts/test.sh --slow"),
    (r"DMPCPP_RECORDINGS", "needs recordings of people", "DMPCPP_RECORDINGS=FOLDER scripts/test.sh"),
    (r"pybullet_data", "needs the arms that ship with PyBullet", "scripts/test.sh"),
    (r"pybullet|extra `sim`", "needs PyBullet", "scripts/test.sh, without --without-bullet"),
    (r"extra `franka`", "needs the extra franka", "pip install 'dmpcpp[franka]'"),
    (r"Chromium", "needs Chromium", "apt install chromium, then scripts/test.sh"),
    (r"'distributed", "needs the extra cluster", "scripts/test.sh --with cluster"),
    (r"'(sphinx|myst|furo)", "needs the extra docs", "scripts/test.sh --with docs"),
    (
        r"example-robot-data|'(pinocchio|toppra|movement_primitives|pytransform3d|pydmps|roboticstoolbox|pin|pink)\b",
        "needs the extra bench (other packages to compare with)",
        "scripts/test.sh --with bench",
    ),
)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say what was left out, why, and what runs it; a file that was left out as a whole counts as one."""
    left_out: Counter[tuple[str, str]] = Counter()
    for report in terminalreporter.stats.get("skipped", []):
        reason = str(report.longrepr[2]).removeprefix("Skipped: ")
        known = (entry[1:] for entry in _LEFT_OUT if re.search(entry[0], reason))
        left_out[next(known, (reason, "see the reason"))] += 1
    if not left_out:
        return
    terminalreporter.section("left out")
    for (why, command), count in left_out.most_common():
        terminalreporter.line(f"{count:5d}  {why}: {command}")
