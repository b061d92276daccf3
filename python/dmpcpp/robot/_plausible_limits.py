"""Limits that no arm has: what a description holds in place of a figure that its author did not know.

A velocity or effort of zero never reaches an ``Arm``: it counts as not stated. What is left is judged by magnitude:
angles in degrees, lengths in millimetres, and numbers that stand for "no limit".
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from dmpcpp._core import Arm
from dmpcpp.robot._xml import parsed

__all__ = ["LimitDoubt", "joint_types", "limit_doubts", "unjudged", "why"]

_FASTEST = {"turning": 50.0, "sliding": 20.0}
"""rad/s, m/s: the fastest wrists turn at about 12 rad/s, parallel kinematics at 30."""
_STRONGEST = {"turning": 1e5, "sliding": 1e6}
"""Nm, N: an arm that lifts 1000 kg at 3 m asks for 5e4 Nm."""
_MOST_ACCELERATION = {"turning": 2000.0, "sliding": 500.0}
"""rad/s^2, m/s^2"""
_MOST_TURNS = 4.0 * math.pi
"""rad: cables end a joint's range at two turns to either side."""
_LONGEST_STROKE = 20.0
"""m"""
_AS_DEGREES = (5.0, 720.0)
"""A speed in this range is one of an arm, in deg/s."""


@dataclass(frozen=True)
class LimitDoubt:
    """A limit that is missing or that no arm has.

    Attributes
    ----------
    joint : str
    kind : str
        "position", "velocity", "acceleration" or "effort".
    what, to_do : str
        What is wrong with it, and the way out.
    missing : bool
        Whether nobody states one.
    """

    joint: str
    kind: str
    what: str
    to_do: str
    missing: bool = False


def limit_doubts(arm: Arm) -> tuple[LimitDoubt, ...]:
    """Return every limit of position, velocity, acceleration and effort by which a motion cannot be judged."""
    types = joint_types(arm.urdf)
    return tuple(
        doubt
        for k, name in enumerate(arm.joint_names)
        for doubt in _of_joint(arm, k, name, "sliding" if types.get(name) == "prismatic" else "turning")
    )


def unjudged(arm: Arm, kind: str) -> tuple[LimitDoubt, ...]:
    """Return the doubts of one kind, in the order of the joints."""
    return tuple(doubt for doubt in limit_doubts(arm) if doubt.kind == kind)


def why(doubts: tuple[LimitDoubt, ...]) -> str:
    """Return one sentence for doubts of one kind: the joints, what is wrong with their limits, and what to do."""
    grouped: dict[tuple[str, str], list[str]] = {}
    for doubt in doubts:
        grouped.setdefault((doubt.what, doubt.to_do), []).append(doubt.joint)
    return " ".join(f"{_listed(joints)}: {what}. {to_do}" for (what, to_do), joints in grouped.items())


def _listed(joints: list[str]) -> str:
    return ", ".join(joints) if len(joints) < 4 else f"{joints[0]} to {joints[-1]} ({len(joints)} joints)"


@lru_cache(maxsize=16)
def joint_types(urdf: str) -> dict[str, str]:
    """Return the type of every joint of a URDF; none for a text that is not XML."""
    try:
        robot = parsed(urdf)
    except (ET.ParseError, ValueError):
        return {}
    return {joint.get("name", ""): joint.get("type", "") for joint in robot.findall("joint")}


def _of_joint(arm: Arm, k: int, name: str, motion: str) -> Iterator[LimitDoubt]:
    yield from _position(name, float(arm.lower[k]), float(arm.upper[k]), motion)
    unit = "rad" if motion == "turning" else "m"
    yield from _velocity(name, float(arm.velocity_limit[k]), motion, f"{unit}/s")
    yield from _acceleration(name, float(arm.acceleration_limit[k]), motion, f"{unit}/s^2")
    yield from _effort(name, float(arm.effort_limit[k]), motion)


def _position(name: str, lower: float, upper: float, motion: str) -> Iterator[LimitDoubt]:
    farthest = max((abs(end) for end in (lower, upper) if math.isfinite(end)), default=0.0)
    if motion == "turning" and farthest > _MOST_TURNS:
        wide = farthest > 720.0
        what = f"its range is {lower:g} to {upper:g} rad" + ("" if wide else ": these are degrees")
        to_do = 'Make it type="continuous".' if wide else f"State radians: {_radians(lower)} to {_radians(upper)}."
        yield LimitDoubt(name, "position", what, to_do)
    elif motion == "sliding" and farthest > _LONGEST_STROKE:
        yield LimitDoubt(
            name, "position", f"its range is {lower:g} to {upper:g} m: these are millimetres", "State metres."
        )


def _velocity(name: str, limit: float, motion: str, unit: str) -> Iterator[LimitDoubt]:
    to_do = f"Set it with arms.with_stated(arm, velocity=...) [{unit}]."
    if not math.isfinite(limit):
        yield LimitDoubt(name, "velocity", "no velocity limit is stated", to_do, missing=True)
    elif limit > _FASTEST[motion]:
        what = f"its velocity limit is {limit:g} {unit}, more than any arm has"
        if motion == "turning" and _AS_DEGREES[0] <= limit <= _AS_DEGREES[1]:
            what, to_do = f"{what}: these are degrees", f"{to_do[:-1]}, {limit:g} deg/s are {_radians(limit)} rad/s."
        yield LimitDoubt(name, "velocity", what, to_do)


def _acceleration(name: str, limit: float, motion: str, unit: str) -> Iterator[LimitDoubt]:
    to_do = f"Set it with arms.with_stated(arm, acceleration=...) [{unit}]."
    if not math.isfinite(limit):
        yield LimitDoubt(name, "acceleration", "no acceleration limit is stated", to_do, missing=True)
    elif limit > _MOST_ACCELERATION[motion]:
        what = f"its acceleration limit is {limit:g} {unit}, more than any arm has"
        yield LimitDoubt(name, "acceleration", what, to_do)


def _effort(name: str, limit: float, motion: str) -> Iterator[LimitDoubt]:
    unit = "Nm" if motion == "turning" else "N"
    to_do = f"Set it with arms.with_stated(arm, effort=...) [{unit}]."
    if not math.isfinite(limit):
        yield LimitDoubt(name, "effort", "no effort limit is stated", to_do, missing=True)
    elif limit > _STRONGEST[motion]:
        yield LimitDoubt(name, "effort", f"its effort limit is {limit:g} {unit}, more than any arm has", to_do)


def _radians(degrees: float) -> str:
    return f"{np.radians(degrees):.4g}"
