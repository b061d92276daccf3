"""What the names of a table's columns say: time, position or orientation, of which body, in which unit.

Case and the separators blank, `_`, `.`, `:`, `/` and `-` do not matter: `hand_x`, `Hand Position X (mm)`,
`/hand/pose/position/x`, `hand.qw`, `rotation.w`, `roll [deg]`, `time_ms`, `Timestamp [ns]`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from dmpcpp.errors import NotStated
from dmpcpp.recordings._pose_columns import ANGLES, POSITION, QUATERNION

__all__ = ["WHOLE", "Column", "bodies_in", "column", "known_unit", "times_in", "unit_of"]

WHOLE = "pose"
"""What the body of columns without a prefix is called."""

_UNITS = {
    **dict.fromkeys(("m", "meter", "meters", "metre", "metres"), "m"),
    **dict.fromkeys(("cm", "centimeter", "centimeters", "centimetre", "centimetres"), "cm"),
    **dict.fromkeys(("mm", "millimeter", "millimeters", "millimetre", "millimetres"), "mm"),
    **dict.fromkeys(("in", "inch", "inches"), "in"),
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), "s"),
    **dict.fromkeys(("ms", "msec", "millisecond", "milliseconds"), "ms"),
    **dict.fromkeys(("us", "\u00b5s", "\u03bcs", "usec", "microsecond", "microseconds"), "us"),
    **dict.fromkeys(("ns", "nsec", "nanosecond", "nanoseconds"), "ns"),
    **dict.fromkeys(("deg", "degree", "degrees", "\u00b0"), "deg"),
    **dict.fromkeys(("rad", "radian", "radians"), "rad"),
}
_UNIT = re.compile(
    r"(?P<name>.*?)\s*(?:[\[(]\s*(?P<bracketed>[^\])]*?)\s*[\])]|[ _](?P<unit>[a-z\u00b5\u03bc]+))", re.IGNORECASE
)
_TIME = re.compile(r"%?_*(?:t|times?|time_?stamps?|elapsed(?:[ _]time)?)")
_WHAT = re.compile(
    r"(?:(?P<body>.+?)[ _.:/-]+)??"  # without a body if it can be: rot_x is no x of a body rot
    r"(?:(?:(?:position|pos|translation|trans|location|loc|p|t)[ _.:/-]*)?(?P<position>[xyz])"
    r"|(?:quaternion|quat|rotation|rot|orientation|ori|q)[ _.:/-]*(?P<turn>[wxyz])"
    r"|(?P<angle>r[xyz]|roll|pitch|yaw))",
    re.IGNORECASE,
)
_LONGEST = 200  # characters of a name; what is longer is none
_ANGLE = {"roll": "rx", "pitch": "ry", "yaw": "rz"}


@dataclass(frozen=True)
class Column:
    """What a name says: `what` is "time", or x, y, z, qx .. qw, rx, ry, rz of `body`; `unit` is "" without one."""

    what: str
    body: str = WHOLE
    unit: str = ""


def column(name: str) -> Column | None:
    """Return what a column's name says; None of one that is none of a pose's."""
    if len(name) > _LONGEST:
        return None
    name, unit = _parted(name.strip())
    if _TIME.fullmatch(name.lower()):
        return Column("time", unit=unit)
    match = _WHAT.fullmatch(name)
    if match is None:
        return None
    if match["position"]:
        what = match["position"].lower()
    elif match["turn"]:
        what = "q" + match["turn"].lower()
    else:
        what = _ANGLE.get(match["angle"].lower(), match["angle"].lower())
    return Column(what, match["body"] or WHOLE, unit)


def bodies_in(names: Sequence[str], position_only: bool = False) -> dict[str, dict[str, int]]:
    """Return the bodies that have a position and an orientation, or need no more than a position: x, y, z and qx .. qw
    or rx .. rz -> column.
    """
    found: dict[str, dict[str, int]] = {}
    for place, said in enumerate(map(column, names)):
        if said is not None and said.what != "time":
            found.setdefault(said.body, {}).setdefault(said.what, place)
    turns = ((),) if position_only else (QUATERNION, ANGLES)
    wholes = {body: _complete(where, turns) for body, where in found.items()}
    return {body: where for body, where in wholes.items() if where}


def times_in(names: Sequence[str]) -> list[int]:
    """Return the columns of time."""
    return [place for place, said in enumerate(map(column, names)) if said is not None and said.what == "time"]


def known_unit(text: str) -> str:
    """Return the unit that a word is, in brackets or not: "Seconds" and "[s]" are "s"; "" of any other word."""
    return _UNITS.get(text.strip().strip("[]()").strip().lower(), "")


def unit_of(parameter: str, names: Iterable[str], below: Iterable[str] = ()) -> str | None:
    """Return the unit that names of columns agree on, or else the units in the line below them; None without any.

    Raises
    ------
    NotStated
        They say several; `parameter` is what states it.
    """
    named = {said.unit for said in map(column, names) if said is not None} - {""}
    units = named or set(below) - {""}
    if len(units) > 1:
        raise NotStated(parameter, f"{parameter}: the columns say {' and '.join(sorted(units))}. State one of them.")
    return units.pop() if units else None


def _complete(where: Mapping[str, int], turns: Sequence[tuple[str, ...]]) -> dict[str, int]:
    """Return the columns of a position and the first of some kinds of orientation that is there; none without it."""
    for turn in turns:
        if all(what in where for what in (*POSITION, *turn)):
            return {what: where[what] for what in (*POSITION, *turn)}
    return {}


def _parted(name: str) -> tuple[str, str]:
    """Return a name without the unit behind it, and the unit: `x [mm]`, `time_ms`; "" where there is none known."""
    match = _UNIT.fullmatch(name)
    if match is None:
        return name, ""
    if match["bracketed"] is not None:
        return match["name"], known_unit(match["bracketed"])
    unit = known_unit(match["unit"])
    return (match["name"], unit) if unit else (name, "")
