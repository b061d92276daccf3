"""Lengths and angles as a person types them: 190mm, 0.19m, 69deg."""

from __future__ import annotations

import re

import numpy as np

from dmpcpp.errors import InvalidArgument

__all__ = ["angle", "length"]

_LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}
_ANGLES = {"deg": np.pi / 180.0, "°": np.pi / 180.0, "rad": 1.0}


def length(name: str, said: str | float) -> float:
    """Return a length [m]; a number is one in m.

    Raises
    ------
    InvalidArgument
        No positive length with a unit.
    """
    return _value(name, said, _LENGTHS, "190mm")


def angle(name: str, said: str | float) -> float:
    """Return an angle [rad]; a number is one in rad.

    Raises
    ------
    InvalidArgument
        No angle with a unit.
    """
    return _value(name, said, _ANGLES, "69deg", least=-np.inf)


def _value(name: str, said: str | float, units: dict[str, float], like: str, least: float = 0.0) -> float:
    if isinstance(said, str):
        found = re.fullmatch(r"\s*([-+]?\d*\.?\d+(?:e[-+]?\d+)?)\s*([a-z°]+)\s*", said)
        if found is None or found[2] not in units:
            raise InvalidArgument(f"{name}: {said!r}, expected a number with its unit ({', '.join(units)}): {like}.")
        value = float(found[1]) * units[found[2]]
    elif isinstance(said, bool) or not isinstance(said, int | float | np.number):
        raise InvalidArgument(f"{name}: {said!r}, expected a number with its unit: {like}.")
    else:
        value = float(said)
    if not (np.isfinite(value) and value > least):
        raise InvalidArgument(f"{name}: {said!r}, expected more than 0: {like}.")
    return value
