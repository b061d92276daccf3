"""Python without PyBullet: its arms and motions out of one of its wheels, and MuJoCo as the engine."""

import importlib.util
from importlib.machinery import ModuleSpec
from zipfile import ZipFile

import pytest
from dmpcpp import _pybullet_data
from dmpcpp._engines import default_engine
from dmpcpp.errors import MissingDependency

WHEEL = "pybullet-9.9-cp311-cp311-manylinux2014_x86_64.whl"
METADATA = "Metadata-Version: 2.1\nName: pybullet\nVersion: 9.9\n"


@pytest.fixture
def index(tmp_path, monkeypatch):
    """A folder that pip takes packages from, and nowhere else."""
    folder = tmp_path / "index"
    folder.mkdir()
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(folder))
    monkeypatch.setenv("PIP_CONFIG_FILE", "/dev/null")
    return folder


def test_the_data_alone_comes_out_of_a_wheel(index, tmp_path):
    with ZipFile(index / WHEEL, "w") as wheel:
        wheel.writestr("pybullet.so", "compiled for another Python")
        wheel.writestr("pybullet_data/__init__.py", "")
        wheel.writestr("pybullet_data/franka_panda/panda.urdf", "<robot/>")
        wheel.writestr("pybullet-9.9.dist-info/METADATA", METADATA)
        wheel.writestr("pybullet-9.9.dist-info/WHEEL", "Wheel-Version: 1.0\n")
    site = tmp_path / "site-packages"
    site.mkdir()
    assert _pybullet_data.fetch(site) == site / "pybullet_data"
    assert sorted(path.relative_to(site).as_posix() for path in site.rglob("*") if path.is_file()) == [
        "pybullet_data/__init__.py",
        "pybullet_data/franka_panda/panda.urdf",
    ]


def test_read_only_packages_leave_the_data_in_the_users_cache(index, tmp_path, monkeypatch):
    with ZipFile(index / WHEEL, "w") as wheel:
        wheel.writestr("pybullet_data/__init__.py", "")
        wheel.writestr("pybullet-9.9.dist-info/METADATA", METADATA)
        wheel.writestr("pybullet-9.9.dist-info/WHEEL", "Wheel-Version: 1.0\n")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: ModuleSpec(name, None) if name == "pip" else None)
    assert _pybullet_data.find() is None
    monkeypatch.setattr(_pybullet_data.os, "access", lambda path, mode: False)
    assert _pybullet_data.fetch() == tmp_path / "cache" / "dmpcpp" / "pybullet_data" == _pybullet_data.find()


def test_a_python_without_pip_is_told_how_to_get_it(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingDependency, match="no pip.*python -m ensurepip"):
        _pybullet_data.fetch()


def test_without_a_wheel_the_error_is_what_pip_said_and_nothing_is_left(index, tmp_path):
    site = tmp_path / "site-packages"
    site.mkdir()
    with pytest.raises(MissingDependency, match="arms and motions: ERROR: No matching distribution found for pybullet"):
        _pybullet_data.fetch(site)
    assert list(site.iterdir()) == []


@pytest.mark.parametrize(
    "installed, engine",
    [({"pybullet", "mujoco"}, "bullet"), ({"pybullet"}, "bullet"), ({"mujoco"}, "mujoco"), (set(), "bullet")],
)
def test_mujoco_is_the_engine_where_it_alone_is_installed(installed, engine, monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: ModuleSpec(name, None) if name in installed else None)
    assert default_engine() == engine
