"""Checks in the words and units of people: what each asks, in which group it stands, and a run's four figures."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

__all__ = ["GROUPS", "OTHERS", "Figure", "figure", "figures_of", "group_of", "words_of"]

GROUPS = {
    "The learned motion": {
        "reproduction_position_rmse": "path off the recording, RMS",
        "reproduction_angle_rmse": "orientation off the recording, RMS",
    },
    "The arm's path": {
        "fitted_position_max": "path fitted to the arm off the learned one, largest",
        "fitted_angle_max": "orientation fitted to the arm off the learned one, largest",
        "ik_position_residual": "inverse kinematics off the path, largest",
        "ik_angle_residual": "inverse kinematics off the orientation, largest",
        "path_self_clearance": "room between the arm's links, least",
        "path_floor_clearance": "room above the floor, least",
        "path_object_clearance": "room to obstacles, least",
    },
    "Limits": {
        "joint_margin": "joint from the end of its range, least",
        "velocity_ratio": "joint speed, share of its limit",
        "acceleration_ratio": "joint acceleration, share of its limit",
        "jerk_ratio": "joint jerk, share of its limit",
        "torque_ratio": "joint torque, share of its limit",
        "torque_clipped": "steps at which a torque was cut to its limit",
        "tool_speed": "speed of the tool",
        "slowdown": "duration, times the wanted one",
    },
    "Carried out": {
        "finite": "steps with numbers that are not finite",
        "tracking_position_rmse": "tool off the plan, RMS",
        "tracking_position_max": "tool off the plan, largest",
        "tracking_angle_rmse": "tool's orientation off the plan, RMS",
        "tracking_angle_max": "tool's orientation off the plan, largest",
        "settle_error": "tool off the goal at the end",
        "log_coverage": "share of the plan that the log covers",
        "log_gap": "longest gap in the log",
    },
    "For the robot": {
        "goal_position": "tool off the last goal at the end",
        "goal_angle": "tool's orientation off the last goal at the end",
        "robot_ready": "largest share of a limit in what a robot gets",
        "robot_start": "robot's joints off the first sample",
        "robot_end_velocity": "speed at the first and last sample",
        "robot_end_acceleration": "acceleration at the first and last sample",
        "robot_spacing": "longest step beside its neighbours",
        "robot_joint_margin": "joint from the end of its range, least",
        "robot_velocity": "joint speed as sent, share of its limit",
        "robot_velocity_at_position": "joint speed where its limit depends on the joint, share of it",
        "robot_acceleration": "joint acceleration as sent, share of its limit",
        "robot_jerk": "joint jerk as sent, share of its limit",
        "robot_torque": "joint torque as sent, share of its limit",
        "robot_tool_speed": "speed of the tool as sent",
    },
    "Contacts": {
        "self_collision": "steps at which the arm touched itself",
        "floor_contact": "steps at which the arm touched the floor",
        "object_contact": "steps at which the arm touched an object",
    },
    "The model of the arm": {
        "inertia": "inertias that no body can have, largest change",
        "dimensions": "dimensions",
        "kinematics_mismatch": "engine off KDL: place of the tool",
        "dynamics_mismatch": "engine off KDL: masses and gravity torques",
    },
}
"""Name of a check to what it asks, by group; a check that is not here stands in "Others" under its own name."""

OTHERS = "Others"
_SHARES = ("_ready", "_velocity", "_at_position", "_acceleration", "_jerk", "_torque")  # of what a robot gets
_RATIOS = ("_ratio", "inertia", "log_coverage", *(f"robot{name}" for name in _SHARES))
_UNITS = {"m": (1e3, "mm"), "rad": (math.degrees(1.0), "deg"), "s": (1.0, "s"), "m/s": (1.0, "m/s")}
_STAGES = {
    "demonstration_to_dmp": "learning",
    "dmp_to_fitted": "fitting to the arm",
    "dmp_to_ik": "inverse kinematics",
    "ik_to_executed": "execution",
}
_OF_SEVERAL = "recording_to_fitted"  # learning and fitting together, which would be counted twice


class Figure(NamedTuple):
    """One number that a person wants: its title, the number with its unit, and a line that says what it is."""

    title: str
    number: str
    line: str


def group_of(name: str) -> str:
    """Return the group of a check."""
    return next((group for group, names in GROUPS.items() if name in names), OTHERS)


def words_of(name: str) -> str:
    """Return what a check asks."""
    return GROUPS.get(group_of(name), {}).get(name, name.replace("_", " "))


def figure(value: float | None, unit: str, name: str = "") -> str:
    """Return a check's number in mm, deg or %, with its unit; a dash where there is none."""
    if value is None or not math.isfinite(value):
        return "-"
    if unit == "1" and name.endswith(_RATIOS):
        return f"{_short(100 * value)} %"
    scale, shown = _UNITS.get(unit, (1.0, "" if unit in ("1", "steps") else unit))
    return f"{_short(scale * value)} {shown}".strip()


def figures_of(summary: Mapping[str, Any]) -> list[Figure]:
    """Return how close, how fast and how near to limits a run was, and what was changed, from its summary.json.

    Of a recording that says how accurate it is, that comes second.
    """
    close, rest = _closeness(summary["stages"]), (_speed(summary), _nearness(summary["checks"]), _changes(summary))
    return [close, *_truth(summary["recording"].get("accuracy")), *rest]


def _truth(accuracy: Mapping[str, float] | None) -> list[Figure]:
    if not accuracy:
        return []
    number = f"{_short(1e3 * accuracy['position'])} mm, {_short(math.degrees(accuracy['angle']))}°"
    return [Figure("How true", number, "the recording itself against the person, rms, as its reader estimates")]


def _closeness(stages: Mapping[str, Mapping[str, float]]) -> Figure:
    stages = {name: stage for name, stage in stages.items() if name != _OF_SEVERAL}
    length = _short(1e3 * sum(stage["position_max"] for stage in stages.values()))
    turn = _short(math.degrees(sum(stage["angle_max"] for stage in stages.values())))
    parts = ", ".join(_STAGES.get(name, name) for name in stages)
    return Figure("How close", f"{length} mm, {turn}°", f"tool off the recorded hand at most: {parts} together")


def _speed(summary: Mapping[str, Any]) -> Figure:
    line = f"{summary['recording']['duration']:.2f} s recorded, {summary['duration']:.2f} s carried out"
    return Figure("How fast", f"{summary['slowdown']:.2f} x the time", line)


def _nearness(checks: Sequence[Mapping[str, Any]]) -> Figure:
    judged = [check for check in checks if check["name"].endswith("_ratio") and check["value"] is not None]
    if not judged:
        return Figure("How near to limits", "-", "no limit of speed, acceleration or torque was judged")
    worst = max(judged, key=lambda check: check["value"])
    what = words_of(worst["name"]).split(",")[0].removeprefix("joint ")
    return Figure("How near to limits", figure(worst["value"], "1", worst["name"]), f"{what} of {worst['detail']}")


def _changes(summary: Mapping[str, Any]) -> Figure:
    said = [*summary.get("changed", ())]
    if summary["recording"].get("evidence", {}).get("smoothed"):
        said.insert(0, "noise smoothed out")
    if summary.get("fitted"):
        said.append(f"fitted to the arm within {1e3 * summary['fitted']['tolerance_position']:.3g} mm")
    if summary["slowdown"] > 1.005:
        said.append("slowed for the arm's limits")
    return Figure(
        "What was changed", str(len(said)) if said else "nothing", "; ".join(said) or "the motion is as recorded"
    )


def _short(number: float) -> str:
    """Return a number in three digits without an exponent; what is smaller than a thousandth says so."""
    if number == 0:
        return "0"
    if abs(number) < 1e-3:
        return "< 0.001" if number > 0 else "> -0.001"
    return f"{number:.0f}" if abs(number) >= 100 else f"{number:.3g}" if abs(number) >= 0.1 else f"{number:.3f}"
