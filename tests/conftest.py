"""Compiles what changed in the C++ before any test imports it, where dmpcpp runs from its checkout."""

import importlib.util
import os
import subprocess
from pathlib import Path

import pytest

BUILD = Path(__file__).parents[1] / "build" / "release"


def _runs_from_build() -> bool:
    package = importlib.util.find_spec("dmpcpp")
    if package is None or package.origin is None:
        return False
    modules = Path(package.origin).parent.glob("_core.*.so")
    return any(module.resolve().is_relative_to(BUILD) for module in modules)


if "PYTEST_XDIST_WORKER" not in os.environ and _runs_from_build():
    _done = subprocess.run(["cmake", "--build", BUILD, "--target", "_core"], capture_output=True, text=True)
    if _done.returncode != 0:
        pytest.exit(f"the C++ does not compile:\n{_done.stdout[-3000:]}", returncode=1)
