"""Jerk and tool speed: judged only where the maker or a person states a limit, and slowed down to it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Series

__all__ = ["jerk_check", "stated_duration_factor", "tool_speed_check"]


def jerk_check(arm: Arm, time: Array, acceleration: Array, most: float = 1.0) -> Iterator[Check]:
    """Yield jerk_ratio, of the differences of accelerations (T, n) at times (T,); nothing without a limit."""
    known = np.isfinite(arm.jerk_limit)
    if known.any() and len(time) > 1:
        shares = _jerk(time, acceleration)[:, known] / arm.jerk_limit[known]
        names = tuple(name for name, has_limit in zip(arm.joint_names, known, strict=True) if has_limit)
        yield Series(time[1:], shares, names).at_most("jerk_ratio", most, "1")


def tool_speed_check(arm: Arm, time: Array, position: Array) -> Iterator[Check]:
    """Yield tool_speed [m/s], of the tip at joints (T, n) from time to time; nothing without a limit."""
    if np.isfinite(arm.tool_speed_limit) and len(time) > 1:
        yield Series(time[1:], _tool_speed(arm, time, position)).at_most("tool_speed", arm.tool_speed_limit, "m/s")


def stated_duration_factor(arm: Arm, time: Array, position: Array, acceleration: Array) -> float:
    """Return the smallest factor on the duration with which jerk and tool speed hold; 0 where none is stated.

    Speed falls with the factor, jerk with its cube.
    """
    if len(time) < 2:
        return 0.0
    factor = 0.0
    if np.isfinite(arm.tool_speed_limit):
        factor = float(_tool_speed(arm, time, position).max()) / arm.tool_speed_limit
    if np.isfinite(arm.jerk_limit).any():
        factor = max(factor, float((_jerk(time, acceleration) / arm.jerk_limit).max()) ** (1.0 / 3.0))
    return factor


def _jerk(time: Array, acceleration: Array) -> Array:
    return np.abs(np.diff(acceleration, axis=0)) / np.diff(time)[:, None]


def _tool_speed(arm: Arm, time: Array, position: Array) -> Array:
    path = arm.forward_kinematics(position)[:, :3, 3]
    return np.asarray(np.linalg.norm(np.diff(path, axis=0), axis=1) / np.diff(time))
