"""Fixtures shared by the tests of the Python package."""

import os
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
