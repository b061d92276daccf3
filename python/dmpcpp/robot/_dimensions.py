"""Whether a description's lengths and masses are those of an arm: it may hold millimetres and grams."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator

from dmpcpp._core import Arm
from dmpcpp.checks import Check
from dmpcpp.robot._reach import farthest_reach
from dmpcpp.robot._xml import parsed

__all__ = ["dimension_checks", "dimension_doubts"]

_LONGEST = 20.0
"""m, stretched out; the largest arms of industry reach 5 m."""
_HEAVIEST = 2e4
"""kg; the heaviest weigh 5 t."""


def dimension_doubts(arm: Arm) -> tuple[tuple[str, str], ...]:
    """Return what is out of proportion and what to do, a pair each."""
    return tuple(_doubts(arm))


def dimension_checks(arm: Arm) -> tuple[Check, ...]:
    """Return the check ``dimensions``, not judged, for an arm that is out of proportion; nothing for any other."""
    doubts = dimension_doubts(arm)
    if not doubts:
        return ()
    return (Check.not_judged("dimensions", "m", " ".join(f"{what}. {to_do}" for what, to_do in doubts)),)


def _doubts(arm: Arm) -> Iterator[tuple[str, str]]:
    _, length = farthest_reach(arm)
    if _LONGEST < length < float("inf"):
        what = f"stretched out the arm is {length:.3g} m long"
        yield what, f"Are its lengths in millimetres? In metres it would be {length / 1000:.3g} m long."
    mass = _mass(arm.urdf)
    if mass > _HEAVIEST:
        yield (
            f"the robot weighs {mass:.3g} kg",
            f"Are its masses in grams? In kilograms it would weigh {mass / 1000:.3g}.",
        )


def _mass(urdf: str) -> float:
    try:
        found = parsed(urdf).iterfind("link/inertial/mass")
        return sum(max(0.0, float(mass.get("value", 0.0))) for mass in found)
    except (ET.ParseError, ValueError):
        return 0.0
