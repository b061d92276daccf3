"""Where the limits of an arm come from, as run summaries and verdicts say it."""

from __future__ import annotations

import math
from typing import Any

from dmpcpp._core import Arm, LimitSource
from dmpcpp.robot._body_inertia import links_by_density
from dmpcpp.robot._payload import payload_of

__all__ = ["assumptions", "limits_summary"]

_VALUES = {
    "velocity": "velocity_limit",
    "acceleration": "acceleration_limit",
    "jerk": "jerk_limit",
    "effort": "effort_limit",
}
_UNITS = {"velocity": "rad/s", "acceleration": "rad/s^2", "jerk": "rad/s^3", "effort": "Nm"}


def limits_summary(arm: Arm) -> dict[str, Any]:
    """Return the limits of each kind with their sources, joint by joint, for JSON; None where nobody states one."""
    found: dict[str, Any] = {
        kind: {"values": [_plain(x) for x in getattr(arm, name).tolist()], "sources": _names(arm.limit_sources[kind])}
        for kind, name in _VALUES.items()
    }
    found["position"] = {
        "lower": [_plain(x) for x in arm.lower.tolist()],
        "upper": [_plain(x) for x in arm.upper.tolist()],
        "sources": _names(arm.limit_sources["position"]),
    }
    return {**found, "tool_speed": _plain(arm.tool_speed_limit), "payload": payload_of(arm)}


def assumptions(arm: Arm) -> tuple[str, ...]:
    """Return one phrase for every kind of limit that was assumed: "acceleration limit 10 rad/s^2 of j1, j2"."""
    found = []
    for kind, name in _VALUES.items():
        assumed = [k for k, source in enumerate(arm.limit_sources[kind]) if source == LimitSource.assumed]
        if assumed:
            values = ", ".join(f"{x:g}" for x in dict.fromkeys(getattr(arm, name)[assumed].tolist()))
            every = len(assumed) == arm.joint_count
            joints = "every joint" if every else ", ".join(arm.joint_names[k] for k in assumed)
            found.append(f"{kind} limit {values} {_UNITS[kind]} of {joints}")
    by_density = links_by_density(arm)
    return (*found, f"mass and inertia of {', '.join(by_density)}, from their shapes") if by_density else tuple(found)


def _names(sources: tuple[LimitSource, ...]) -> list[str]:
    return [source.name for source in sources]


def _plain(value: float) -> float | None:
    return value if math.isfinite(value) else None
