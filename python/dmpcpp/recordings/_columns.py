"""What the names of a table's columns say: time, position or orientation, of which body, in which unit.

Case and the separators blank, `_`, `.`, `:`, `/` and `-` do not matter: `hand_x`, `Hand Position X (mm)`,
`/hand/pose/position/x`, `hand.qw`, `rotation.w`, `roll [deg]`, `time_ms`, `Timestamp [ns]`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from dmpcpp.errors import NotStated
from dmpcpp.recordings._representation import CELLS, turn_in

__all__ = ["POSITION", "WHOLE", "Column", "bodies_in", "column", "known_unit", "repeated", "times_in", "unit_of"]

POSITION = ("x", "y", "z")
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
_TIME = re.compile(
    r"%?_*(?:t|times?|(?:time_?)?stamps?|ts|elapsed(?:[ _]time)?|seconds|(?:unix|epoch|sys|device)_?time(?:stamp)?|"
    r"date_?time|file_?time)"
)
_WHAT = re.compile(
    r"(?:(?P<body>.+?)[ _.:/-]+)??"  # without a body if it can be: rot_x is no x of a body rot
    r"(?:(?:(?:position|pos|translation|trans|location|loc|p|t)[ _.:/-]*)?(?P<position>[xyz])"
    r"|(?:quaternion|quat|rotation|rot|orientation|orient|ori|q)[ _.:/-]*(?P<turn>[wxyz])"
    r"|(?P<angle>r[xyz]|roll|pitch|yaw)"
    r"|q_?(?P<numbered>[0-3])"
    r"|(?:axis_?angle|rot_?vec|rotation_?vector)[ _.:/-]*(?:(?P<vector>[xyz])|(?P<part>[0-2]))"
    r"|(?:rot6d|r6d|rotation_?6d|ortho6d)[ _.:/-]*(?P<six>[0-5])"
    r"|(?:m|mat|r|rot)[ _]?\[?(?P<row>[0-3])\]?[ _,]?\[?(?P<cell>[0-3])\]?)",
    re.IGNORECASE,
)
_WORLD_TO = re.compile(r"(?P<what>[tq])_w\w{1,2}_(?P<axis>[wxyz])")  # t_wo_x, q_wo_w: of an object in the world
_TCP_POSE = re.compile(r"(?P<body>(?:actual|target)_TCP_pose)_?\[?(?P<part>[0-5])\]?", re.IGNORECASE)  # UR controllers
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
        return Column("time", unit=unit or ("s" if name.lower() == "seconds" else ""))
    if special := _special(name):
        return Column(*special, unit)
    match = _WHAT.fullmatch(name)
    if match is None:
        return None
    if match["row"]:
        what = f"cell{match['row']}{match['cell']}"
    elif match["six"]:
        what = "s" + match["six"]
    elif match["vector"] or match["part"]:
        what = "v" + (match["part"] or str("xyz".index(match["vector"].lower())))
    elif match["numbered"]:
        what = "q" + match["numbered"]
    elif match["position"]:
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
    wholes = {body: _complete(where, position_only) for body, where in _by_body(names).items()}
    return {body: where for body, where in wholes.items() if where}


def _by_body(names: Sequence[str]) -> dict[str, dict[str, int]]:
    """Return all columns that say what they are: body -> what -> column, the first of each."""
    found: dict[str, dict[str, int]] = {}
    for place, said in enumerate(map(column, names)):
        if said is not None and said.what != "time":
            found.setdefault(said.body, {}).setdefault(said.what, place)
    return {body: _with_cells(where) for body, where in found.items()}


def _with_cells(where: dict[str, int]) -> dict[str, int]:
    """Return the columns with the cells of a 3 x 3 or 4 x 4 matrix named from m00 on; x, y, z are its last column."""
    cells = {what.removeprefix("cell"): place for what, place in where.items() if what.startswith("cell")}
    if not cells:
        return where
    first = 0 if any("0" in indices for indices in cells) else 1
    named = {
        f"m{int(i) - first}{int(j) - first}": place
        for (i, j), place in ((tuple(key), where) for key, where in cells.items())
    }
    last = {axis: named[f"m{k}3"] for k, axis in enumerate("xyz") if f"m{k}3" in named}
    plain = {what: place for what, place in where.items() if not what.startswith("cell")}
    return {**last, **plain, **{name: place for name, place in named.items() if name in CELLS or name[1] == "3"}}


def _special(name: str) -> tuple[str, str] | None:
    """Return what and body of a name that a producer defines."""
    if match := _WORLD_TO.fullmatch(name):
        return (match["axis"] if match["what"] == "t" else "q" + match["axis"]), WHOLE
    if match := _TCP_POSE.fullmatch(name):
        part = int(match["part"])
        return ("xyz"[part] if part < 3 else f"v{part - 3}"), match["body"]
    return None


def repeated(names: Sequence[str]) -> tuple[str, int, int] | None:
    """Return a name of a pose or time that stands twice, with both columns; None without one."""
    seen: dict[str, int] = {}
    for place, name in enumerate(names):
        if name.strip() and column(name) is not None and seen.setdefault(name.strip().lower(), place) != place:
            return name.strip(), seen[name.strip().lower()], place
    return None


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


def _complete(where: Mapping[str, int], position_only: bool) -> dict[str, int]:
    """Return the columns of a position and its orientation, or of the position alone if that is enough; else none."""
    turn = turn_in(where)
    if not all(axis in where for axis in POSITION) or not (turn or position_only):
        return {}
    last_row = tuple(name for name in ("m30", "m31", "m32", "m33") if name in where) if turn == CELLS else ()
    return {what: where[what] for what in (*POSITION, *(() if position_only else turn), *last_row)}


def _parted(name: str) -> tuple[str, str]:
    """Return a name without the unit behind it, and the unit: `x [mm]`, `time_ms`; "" where there is none known."""
    match = _UNIT.fullmatch(name)
    if match is None:
        return name, ""
    if match["bracketed"] is not None:
        return match["name"], known_unit(match["bracketed"])
    unit = known_unit(match["unit"])
    return (match["name"], unit) if unit else (name, "")
