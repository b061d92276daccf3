"""Checks the installation: what is installed, what is missing, what each part is for."""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import platform
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from dmpcpp._quiet import quiet

__all__ = ["Diagnosis", "Part", "examine"]


@dataclass(frozen=True)
class Part:
    """Something that is there or not.

    Attributes
    ----------
    name : str
    ok : bool
    found : str
        Its version, or why it does not work.
    purpose : str
        What it is for.
    to_do : str
        What to do where it is missing.
    needed : bool
        Whether the main job (`dmpcpp demo`) needs it.
    """

    name: str
    ok: bool
    found: str
    purpose: str
    to_do: str
    needed: bool


@dataclass(frozen=True)
class Diagnosis:
    """All parts; `ok` where all that the main job needs are there."""

    parts: tuple[Part, ...]

    @property
    def ok(self) -> bool:
        """Whether the main job can be done."""
        return all(part.ok for part in self.parts if part.needed)

    def summary(self) -> dict[str, Any]:
        """Return what `dmpcpp doctor --json` prints."""
        return {"ok": self.ok, "parts": [asdict(part) for part in self.parts]}


_PACKAGES = (  # module, distribution, what for, extra, needed
    ("numpy", "numpy", "arrays", "", True),
    ("scipy", "scipy", "preparing recordings, metrics", "", True),
    ("click", "click", "this command line", "", True),
    ("rich", "rich", "tables and progress bars", "", True),
    ("pybullet", "pybullet", "physics: --simulator bullet, both; dmpcpp grasp", "bullet", False),
    ("mujoco", "mujoco", "physics: --simulator mujoco, both", "mujoco", False),
    ("matplotlib", "matplotlib", "pictures and the report's figures", "plot", True),
    ("viser", "viser", "the moving arm in reports, dmpcpp view", "view", False),
    ("yourdfpy", "yourdfpy", "the arm's shapes in reports, dmpcpp view", "view", False),
    ("rosbags", "rosbags", "ROS bags and MCAP recordings", "formats", False),
    ("pyarrow", "pyarrow", "LeRobot data sets", "datasets", False),
    ("h5py", "h5py", "HDF5 data sets", "datasets", False),
    ("zarr", "zarr", "UMI data sets", "datasets", False),
    ("mcap", "mcap", "Foxglove MCAP recordings", "datasets", False),
    ("mcap_protobuf", "mcap-protobuf-support", "Foxglove MCAP recordings", "datasets", False),
    ("pylibfranka", "pylibfranka", "dmpcpp run --robot franka://HOST; Python up to 3.12", "franka", False),
    ("cv2", "opencv-python-headless", "videos of a hand or a tag as recordings", "cameras", False),
    ("ai_edge_litert", "ai-edge-litert", "videos of a hand, five times as fast as without", "cameras", False),
    ("imageio_ffmpeg", "imageio-ffmpeg", "--video", "video", False),
    ("distributed", "distributed", "batches on a cluster", "cluster", False),
)


def examine() -> Diagnosis:
    """Import every package that some part of dmpcpp uses, and try the core and the kinematics."""
    return Diagnosis(
        (
            _python(),
            _tried("core", _core, "learning, rollout", "pip install --force-reinstall dmpcpp"),
            *map(_package, _PACKAGES),
            _hand_model(),
            _tried("physics engine", _engines, "executing and verifying a motion", 'pip install "dmpcpp[mujoco]"'),
            _tried("known arms", _arms, "--arm panda, iiwa, xarm6", "dmpcpp fetch"),
            _tried("motions", _motions, "the motion of dmpcpp demo", "dmpcpp fetch"),
        )
    )


def _python() -> Part:
    ok = sys.version_info >= (3, 11)
    return Part("python", ok, platform.python_version(), "everything", "Install Python 3.11 to 3.13.", True)


def _package(wanted: tuple[str, str, str, str, bool]) -> Part:
    module, distribution, purpose, extra, needed = wanted
    to_do = f'pip install "dmpcpp[{extra}]"{_build(extra)}' if extra else f"pip install {distribution}"
    try:
        with quiet():  # PyBullet tells its build time
            importlib.import_module(module)
    except Exception as error:  # a broken package may raise anything
        return Part(distribution, False, f"{type(error).__name__}: {error}", purpose, to_do, needed)
    return Part(distribution, True, _version(distribution), purpose, "", needed)


def _hand_model() -> Part:
    from dmpcpp.cameras import GET, net_files

    purpose = "videos of a hand as recordings"
    try:
        return Part("hand model", True, str(net_files()[0].parent), purpose, "", False)
    except Exception as error:  # missing, or another file in its place
        return Part("hand model", False, f"{type(error).__name__}: {error}", purpose, GET, False)


def _build(extra: str) -> str:
    """PyBullet has wheels up to Python 3.11."""
    from_source = extra == "bullet" and sys.version_info >= (3, 12)
    return " (compiles it: g++ and some minutes)" if from_source else ""


def _version(distribution: str) -> str:
    try:
        return importlib.metadata.version(distribution)
    except importlib.metadata.PackageNotFoundError:
        return "installed"


def _tried(name: str, attempt: Callable[[], str], purpose: str, to_do: str) -> Part:
    try:
        return Part(name, True, attempt(), purpose, "", True)
    except Exception as error:
        return Part(name, False, f"{type(error).__name__}: {error}", purpose, to_do, True)


def _core() -> str:
    """Learn a straight line and arrive at its end."""
    import numpy as np

    from dmpcpp import Demonstration, Dmp, __version__

    time = np.linspace(0.0, 1.0, 50)
    end = Dmp.fit(Demonstration(time, time**2)).rollout(dt=0.01).position[-1, 0]
    if not abs(end - 1.0) < 1e-2:
        raise ArithmeticError(f"a learned motion ends at {end:.4f}, expected 1; install dmpcpp anew")
    return str(__version__)


def _engines() -> str:
    found = [name for name in ("pybullet", "mujoco") if importlib.util.find_spec(name)]
    if not found:
        raise ImportError("neither PyBullet nor MuJoCo is installed")
    return " and ".join(found)


def _motions() -> str:
    from dmpcpp import recordings

    return f"{len(recordings.clip_names())} clips"


def _arms() -> str:
    from dmpcpp.robot import arms

    return ", ".join(f"{name} ({arms.find(name).joint_count} joints)" for name in arms.KNOWN)
