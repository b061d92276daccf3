"""The engine that ``execute`` and the checks take where none is named."""

from __future__ import annotations

from typing import Any

from dmpcpp._core import Arm
from dmpcpp._engines import default_engine
from dmpcpp.simulation._bullet import Bullet
from dmpcpp.simulation._mujoco import MuJoCo
from dmpcpp.simulation._simulator import Simulator


def default_simulator(arm: Arm, time_step: float, **options: Any) -> Simulator:
    """Return a ``Bullet``, or a ``MuJoCo`` where that alone is installed; the arguments are theirs."""
    engine = MuJoCo if default_engine() == "mujoco" else Bullet
    return engine(arm, time_step, **options)
