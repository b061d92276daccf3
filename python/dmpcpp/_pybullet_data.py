"""The arms and motions that ship with PyBullet, for a Python that has no PyBullet."""

from __future__ import annotations

import importlib.util
import os
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
    """Folder pybullet_data, installed (found without importing it) or fetched; None where there is none."""
    spec = importlib.util.find_spec("pybullet_data")
    if spec and spec.origin:
        return Path(spec.origin).parent
    return kept if (kept := _cache() / "pybullet_data").is_dir() else None


def _cache() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "dmpcpp"


def _site_packages() -> Path:
    """Where this Python keeps packages, or the user's cache where that cannot be written."""
    packages = Path(sysconfig.get_path("purelib"))
    if os.access(packages, os.W_OK):
        return packages
    _cache().mkdir(parents=True, exist_ok=True)
    return _cache()


def fetch(site_packages: Path | None = None) -> Path:
    """Download a wheel of PyBullet with pip (100 MB) and unpack pybullet_data alone beside the installed packages.

    Parameters
    ----------
    site_packages : Path, optional
        Where to unpack. Default: among the packages of this Python, or in the user's cache where those are read-only.

    Returns
    -------
    Path
        The folder pybullet_data.

    Raises
    ------
    MissingDependency
        There is no pip, or it found no wheel; the message ends with what it printed last.
    """
    if importlib.util.find_spec("pip") is None:
        raise MissingDependency(
            "this Python has no pip, which downloads pybullet's arms and motions. Add it: python -m ensurepip "
            "(in an environment of uv: uv pip install pip), then run `dmpcpp fetch` again."
        )
    target = (site_packages or _site_packages()) / "pybullet_data"
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
