"""What importing the package brings and what it does not."""

import os
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import dmpcpp
import pytest


def test_there_is_one_version():
    assert dmpcpp.__version__ == version("dmpcpp")


def test_importing_needs_numpy_alone():
    code = "import sys, dmpcpp; print(*sorted({m.split('.')[0] for m in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"scipy", "pybullet", "matplotlib", "click", "rich"} & set(loaded)


def test_modules_come_when_they_are_used_and_an_unknown_name_is_an_attribute_error():
    assert dmpcpp.metrics.__name__ == "dmpcpp.metrics"
    assert "recordings" in dir(dmpcpp)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        dmpcpp.nothing  # noqa: B018


def test_type_stubs_and_their_marker_are_installed():
    folder = Path(dmpcpp.__file__).parent
    assert (folder / "py.typed").exists()
    assert "class PoseDmp" in (folder / "_core" / "__init__.pyi").read_text()


def test_the_module_runs_as_a_program():
    done = subprocess.run([sys.executable, "-m", "dmpcpp", "--version"], capture_output=True, text=True, check=True)
    assert dmpcpp.__version__ in done.stdout


def test_the_type_stubs_are_those_of_the_module(tmp_path):
    """Generated anew by scripts/stubs.sh and compared."""
    pytest.importorskip("pybind11_stubgen")
    root = Path(__file__).resolve().parents[2]
    environment = {**os.environ, "PYTHON": sys.executable}
    subprocess.run([root / "scripts" / "stubs.sh", tmp_path], check=True, env=environment, capture_output=True)
    for made in sorted((tmp_path / "_core").glob("*.pyi")):
        assert made.read_text() == (root / "python" / "dmpcpp" / "_core" / made.name).read_text(), made.name
