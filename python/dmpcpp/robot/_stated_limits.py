"""Limits and a payload that a person states: in place of those of a description, and strongest of all.

>>> from dmpcpp import arms
>>> arm = arms.load("my_robot.urdf")                                             # doctest: +SKIP
>>> arm = arms.with_stated(arm, velocity=2.0, effort={"j1": 80, "j2": 80})       # doctest: +SKIP
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp._core import Arm, LimitSource
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency
from dmpcpp.robot._body_inertia import with_density
from dmpcpp.robot._payload import with_payload

__all__ = ["KINDS", "Stated", "with_limits_file", "with_stated"]

Stated = float | Sequence[float] | Mapping[str, float]
"""One value for all joints, one for each, or some by the names of the joints."""

KINDS = ("velocity", "acceleration", "jerk", "effort")
_UNITS = {"velocity": "rad/s", "acceleration": "rad/s^2", "jerk": "rad/s^3", "effort": "Nm"}


def with_stated(
    arm: Arm,
    *,
    file: str | PathLike[str] | None = None,
    payload: Sequence[float] | None = None,
    density: float | None = None,
    tool_speed: float | None = None,
    **limits: Stated | None,
) -> Arm:
    """Return the arm with the limits that a person states; what is None stays.

    Parameters
    ----------
    arm : Arm
    file : path, optional
        See `with_limits_file`; what is stated beside it wins.
    payload : (1,) or (4,), optional
        Mass [kg] and where its centre lies in the frame of the arm's tip link [m]; see `with_payload`.
    density : float, optional
        kg/m^3, > 0, of the links that state no mass; see `with_density`.
    tool_speed : float, optional
        m/s, > 0.
    velocity, acceleration, jerk, effort : float, (n,) or mapping of joint to float, optional
        rad/s, rad/s^2, rad/s^3, Nm (m and N of a sliding joint), > 0.

    Raises
    ------
    InvalidArgument
        Names the limit, what came and what was expected.
    FileError
        The file cannot be read.
    """
    if file is not None:
        arm = with_limits_file(arm, file)
    for kind, stated in limits.items():
        if kind not in KINDS:
            raise InvalidArgument(f"limits: '{kind}', expected some of {', '.join(KINDS)}.")
        if stated is not None:
            arm = _with_kind(arm, kind, stated)
    if tool_speed is not None:
        if not 0.0 < tool_speed < math.inf:
            raise InvalidArgument(f"tool_speed: {tool_speed}, expected a positive number of m/s.")
        arm = arm.with_limits(tool_speed=tool_speed)
    if density is not None:
        arm = with_density(arm, density)
    return arm if payload is None else with_payload(arm, payload[0], tuple(payload[1:]) or (0.0, 0.0, 0.0))


def with_limits_file(arm: Arm, path: str | PathLike[str]) -> Arm:
    """Return the arm with the limits of a file: MoveIt's joint_limits.yaml, or the same tables as .toml or .json.

    Under ``joint_limits`` stand joints with ``max_velocity``, ``max_acceleration``, ``max_jerk``, ``max_effort``,
    ``min_position`` and ``max_position``, of which those count whose ``has_.._limits`` is not false. Joints that the
    arm has not are passed over. ``cartesian_limits`` may state ``max_trans_vel`` [m/s], the tool's speed.
    """
    path = Path(path)
    found = _read(path)
    joints = found.get("joint_limits", {})
    if not isinstance(joints, Mapping) or not any(name in joints for name in arm.joint_names):
        raise InvalidArgument(
            f"limits: '{path}' states limits of none of the joints {', '.join(arm.joint_names)}, expected "
            "`joint_limits:` with these names, as MoveIt's joint_limits.yaml has it."
        )
    for kind in KINDS:
        values = {name: _value(path, joints[name], kind, name) for name in arm.joint_names if name in joints}
        stated = {name: value for name, value in values.items() if value is not None}
        arm = _with_kind(arm, kind, stated) if stated else arm
    arm = _with_range(arm, path, joints)
    speed = (found.get("cartesian_limits") or {}).get("max_trans_vel")
    return arm if speed is None else with_stated(arm, tool_speed=float(speed))


def _with_kind(arm: Arm, kind: str, stated: Stated) -> Arm:
    old: Array = getattr(arm, f"{kind}_limit")
    values, sources = old.copy(), list(arm.limit_sources[kind])
    for k, value in _by_joint(arm, kind, stated).items():
        if not (value > 0.0 and math.isfinite(value)):
            unit = _UNITS[kind]
            raise InvalidArgument(f"{kind}: {value} of joint '{arm.joint_names[k]}', expected a positive {unit}.")
        values[k], sources[k] = value, LimitSource.user
    return arm.with_limits(**{kind: values}, source={kind: tuple(sources)})


def _by_joint(arm: Arm, kind: str, stated: Stated) -> dict[int, float]:
    """Values by the number of the joint."""
    if isinstance(stated, Mapping):
        unknown = [name for name in stated if name not in arm.joint_names]
        if unknown:
            raise InvalidArgument(f"{kind}: no joint '{unknown[0]}', expected some of {', '.join(arm.joint_names)}.")
        return {arm.joint_names.index(name): float(value) for name, value in stated.items()}
    values = np.atleast_1d(np.asarray(stated, dtype=np.float64))
    if values.shape not in ((1,), (arm.joint_count,)):
        raise InvalidArgument(
            f"{kind}: {len(values)} values, expected one for all joints or {arm.joint_count}, one for each of "
            f"{', '.join(arm.joint_names)}."
        )
    return dict(enumerate(np.broadcast_to(values, arm.joint_count).tolist()))


def _with_range(arm: Arm, path: Path, joints: Mapping[str, Any]) -> Arm:
    """Narrow the ranges of positions; a file does not widen those of the description."""
    lower, upper, sources = arm.lower.copy(), arm.upper.copy(), list(arm.limit_sources["position"])
    for k, name in enumerate(arm.joint_names):
        stated = joints.get(name)
        if not isinstance(stated, Mapping) or not stated.get("has_position_limits", "min_position" in stated):
            continue
        low, high = (_number(path, name, f"{end}_position", stated.get(f"{end}_position")) for end in ("min", "max"))
        lower[k], upper[k] = max(lower[k], low), min(upper[k], high)
        sources[k] = LimitSource.user
    return arm.with_limits(lower=lower, upper=upper, source={"position": tuple(sources)})


def _value(path: Path, stated: Any, kind: str, name: str) -> float | None:
    if not isinstance(stated, Mapping):
        raise InvalidArgument(f"limits: '{path}': joint '{name}' is {stated!r}, expected a table of its limits.")
    value = stated.get(f"max_{kind}")
    if value is None or not stated.get(f"has_{kind}_limits", True):
        return None
    return _number(path, name, f"max_{kind}", value)


def _number(path: Path, joint: str, what: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InvalidArgument(f"limits: '{path}': {what} of '{joint}' is {value!r}, expected a number.") from None


def _read(path: Path) -> Mapping[str, Any]:
    import json
    import tomllib

    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(f"{path}: cannot be read ({getattr(error, 'strerror', None) or error}).") from None
    readers = {".toml": tomllib.loads, ".json": json.loads}
    try:
        found = readers.get(path.suffix.lower(), _yaml)(text)
    except ValueError as error:
        raise InvalidArgument(f"limits: '{path}' cannot be read ({' '.join(str(error).split())}).") from None
    if not isinstance(found, Mapping):
        raise InvalidArgument(f"limits: '{path}' holds no table, expected `joint_limits:` as in MoveIt.")
    return found


def _yaml(text: str) -> Any:
    try:
        import yaml
    except ImportError:
        raise MissingDependency(
            'PyYAML, which reads .yaml, is not installed. Run pip install "dmpcpp[yaml]", or write the same tables as '
            ".toml or .json."
        ) from None
    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from None
