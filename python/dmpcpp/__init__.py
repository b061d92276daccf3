"""Dynamic movement primitives: a person's motion, learned and carried out by a robot arm.

The core (``Dmp``, ``OrientationDmp``, ``PoseDmp`` and their runs, ``so3``, model files) and the kinematics (``Arm``,
``InverseKinematics``) are C++; what surrounds them are the modules ``recordings``, ``motion``, ``retarget``,
``simulation``, ``metrics``, ``export``, ``plot``, ``arms``, ``imitation``, ``grasp`` and ``generality``, imported when
they are used.
Times are in s, lengths in m, angles in rad; arrays are float64.
"""

import importlib
from types import ModuleType

from dmpcpp._core import *  # noqa: F403
from dmpcpp._core import __version__ as __version__
from dmpcpp._core import so3 as so3

_MODULES = frozenset(
    {
        "arms",
        "batch",
        "checks",
        "comparison",
        "doctor",
        "errors",
        "export",
        "generality",
        "grasp",
        "imitation",
        "inspection",
        "learning",
        "metrics",
        "motion",
        "planning",
        "plot",
        "recordings",
        "report",
        "reproduction",
        "retarget",
        "scene",
        "simulation",
        "teaching",
        "urdf_check",
        "verification",
        "view",
    }
)


def __getattr__(name: str) -> ModuleType:
    """Import a module of the package when it is first used, so that importing dmpcpp needs numpy alone."""
    if name in _MODULES:
        return importlib.import_module(f"dmpcpp.{name}")
    raise AttributeError(f"module 'dmpcpp' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Every public name, the modules that are not imported yet among them."""
    return sorted({*globals(), *_MODULES})
