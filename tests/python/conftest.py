"""Fixtures shared by the tests of the Python package."""

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def recorded() -> Path:
    """Folder of real recordings, outside the project; DMPCPP_RECORDINGS says where."""
    folder = os.environ.get("DMPCPP_RECORDINGS")
    if not folder or not Path(folder).is_dir():
        pytest.skip("DMPCPP_RECORDINGS does not name a folder of recordings")
    return Path(folder)
