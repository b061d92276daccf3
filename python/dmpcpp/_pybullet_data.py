"""The arms and motions that ship with PyBullet, for a Python that has no PyBullet."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import sysconfig
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

from dmpcpp.errors import MissingDependency

__all__ = ["fetch", "find"]

# Its files are the same for every Python and processor; the newest wheels are of CPython 3.11.
_WHEEL = ("--python-version=3.11", "--implementation=cp", "--abi=cp311", "--platform=manylinux2014_x86_64")


def find() -> Path | None:
    """Folder of the installed package pybullet_data, found without importing it; None where there is none."""
    spec = importlib.util.find_spec("pybullet_data")
    return Path(spec.origin).parent if spec and spec.origin else None


def fetch(site_packages: Path | None = None) -> Path:
    """Download a wheel of PyBullet with pip (100 MB) and unpack pybullet_data alone beside the installed packages.

    Parameters
    ----------
    site_packages : Path, optional
        Where to unpack; the packages of this Python unless given.

    Returns
    -------
    Path
        The folder pybullet_data.

    Raises
    ------
    MissingDependency
        pip found no wheel; the message ends with what it printed last.
    """
    target = (site_packages or Path(sysconfig.get_path("purelib"))) / "pybullet_data"
    with TemporaryDirectory(dir=target.parent, prefix="pybullet_data-") as scratch:
        pip = (sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:", *_WHEEL)
        done = subprocess.run([*pip, f"--dest={scratch}", "pybullet>=3.2.5"], capture_output=True, text=True)
        if done.returncode != 0:
            last = done.stderr.strip().splitlines()[-1:] or ["no message"]
            raise MissingDependency(f"pip could not download pybullet's arms and motions: {last[0]}")
        (wheel,) = Path(scratch).glob("*.whl")
        with ZipFile(wheel) as archive:
            archive.extractall(scratch, [name for name in archive.namelist() if name.startswith("pybullet_data/")])
        (Path(scratch) / "pybullet_data").rename(target)  # complete, or not there
    return target
