"""Dynamic movement primitives: a person's motion, learned and carried out by a robot arm.

The core (``Dmp``, ``OrientationDmp``, ``PoseDmp`` and their runs, ``so3``, model files) and the kinematics (``Arm``,
``InverseKinematics``) are C++. Around them are modules, imported when they are used: ``recordings`` and
``inspection`` (files), ``motion`` (cleaning, cutting, noise), ``learning``, ``improvement`` (by trial), ``arms`` and
``urdf_check`` (robots), ``retarget`` (placement), ``planning``, ``simulation``, ``imitation`` (the whole flow),
``export``, ``verification`` (logs of real arms), ``variation`` (how takes differ), ``two_hands``, ``checks``,
``metrics``, ``comparison``, ``plot``, ``view``, ``scene`` and ``report`` (pictures), ``batch``, ``generality`` and
``reproduction`` (many runs), ``grasp``, ``examples`` (small recordings to try), ``doctor`` (the installation), and
``errors``.
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
        "examples",
        "export",
        "generality",
        "grasp",
        "imitation",
        "improvement",
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
        "two_hands",
        "urdf_check",
        "variation",
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
