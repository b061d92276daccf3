"""Whether the motors can hold the arm up at all: what gravity alone asks of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm, LimitSource
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._plausible_limits import joint_types

__all__ = ["Overload", "overloads", "random_postures", "require_holdable"]

_POSTURES = 100
_MOST = 0.5
"""Share of random postures that cannot be held, from which the limit is no limit and no motion is searched for."""
_SOURCES = {LimitSource.urdf: "the URDF allows", LimitSource.user: "you allow", LimitSource.maker: "its maker allows"}


@dataclass(frozen=True)
class Overload:
    """A joint whose effort limit is below what gravity alone asks.

    Attributes
    ----------
    joint : str
    asked, limit : float
        Nm (N of a sliding joint); the most of the postures looked at, and the limit.
    share : float
        Of the postures that cannot be held, by this joint alone.
    sentence : str
    """

    joint: str
    asked: float
    limit: float
    share: float
    sentence: str


def random_postures(arm: Arm, count: int = _POSTURES, seed: int | np.random.Generator = 0) -> Array:
    """Return joints (count, n) drawn evenly from the arm's range; a joint without limits from one turn."""
    lower = np.where(np.isfinite(arm.lower), arm.lower, -np.pi)
    upper = np.where(np.isfinite(arm.upper), arm.upper, np.pi)
    return np.random.default_rng(seed).uniform(lower, upper, (count, arm.joint_count))


def overloads(arm: Arm, position: Array) -> tuple[Overload, ...]:
    """Return the joints that cannot hold the arm up at some of the postures (T, n)."""
    asked = np.abs(arm.gravity_effort(position))
    beyond = asked > arm.effort_limit
    return tuple(
        _overload(arm, k, float(asked[:, k].max()), float(beyond[:, k].mean()))
        for k in range(arm.joint_count)
        if beyond[:, k].any()
    )


def require_holdable(arm: Arm, position: Array | None = None) -> None:
    """Refuse an arm that its motors cannot hold up at the planned postures (T, n).

    Without postures 100 random ones are looked at, and an arm that cannot hold most of them is refused.

    Raises
    ------
    InvalidArgument
        Names the joint, what gravity alone asks and the limit.
    """
    postures = random_postures(arm) if position is None else position
    most = _MOST if position is None else 0.0
    found = [overload for overload in overloads(arm, postures) if overload.share > most]
    if found:
        raise InvalidArgument(" ".join(overload.sentence for overload in found))


def _overload(arm: Arm, k: int, asked: float, share: float) -> Overload:
    name, limit = arm.joint_names[k], float(arm.effort_limit[k])
    unit = "N" if joint_types(arm.urdf).get(name) == "prismatic" else "Nm"
    who = _SOURCES.get(arm.limit_sources["effort"][k], "its limit is")
    sentence = (
        f"joint '{name}': gravity alone asks {asked:.3g} {unit}, {who} {limit:.3g}. "
        f"Set the real limit with arms.with_stated(arm, effort=...) [{unit}]."
    )
    return Overload(name, asked, limit, share, sentence)
