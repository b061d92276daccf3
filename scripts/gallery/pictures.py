"""Every picture by its name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from scripts.gallery import arm, learning, rotation

__all__ = ["PHYSICS", "PICTURES"]

PICTURES: dict[str, Callable[[], Any]] = {
    "goals": learning.goals,
    "tempo": learning.tempo,
    "online": learning.online,
    "scaling": learning.scaling,
    "kernels": learning.kernels,
    "regression": learning.regression,
    "noise": learning.noise,
    "spread": learning.spread,
    "euler": rotation.euler,
    "turn": rotation.turn,
    "arm": arm.moments,
    "timing": arm.timing,
    "disturbance": arm.disturbance,
}
"""What makes each picture."""

PHYSICS = frozenset({"arm", "timing", "disturbance"})
"""Those that need the known arms, and a simulator."""
