"""What the columns of an array or of a table without names hold, as the caller says: `--layout "
"x,y,z,rotvec,gripper`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._representation import ANGLES, CELLS, NUMBERED, SIX, VECTOR
from dmpcpp.recordings._statement import Stated

__all__ = ["Layout", "layout_of"]

_MATRIX_12 = ("m00", "m01", "m02", "x", "m10", "m11", "m12", "y", "m20", "m21", "m22", "z")
_BLOCKS: dict[str, tuple[str, ...]] = {
    "xyz": ("x", "y", "z"),
    "quat_xyzw": ("qx", "qy", "qz", "qw"),
    "quat_wxyz": ("qw", "qx", "qy", "qz"),
    "quat": NUMBERED,
    "rotvec": VECTOR,
    "euler": ANGLES,
    "rpy": ANGLES,
    "rot6d": SIX,
    "rot6d_columns": SIX,
    "mat9": CELLS,
    "mat12": _MATRIX_12,
    "mat16": (*_MATRIX_12, "m30", "m31", "m32", "m33"),
}
_ALIASES = {"roll": "rx", "pitch": "ry", "yaw": "rz", "t": "time"}
_SINGLE = ("time", "x", "y", "z", "qx", "qy", "qz", "qw", "rx", "ry", "rz")


@dataclass(frozen=True)
class Layout:
    """Columns by what they hold, and those of other quantities by name."""

    where: dict[str, int]
    channels: dict[str, int]
    width: int


def layout_of(stated: Stated) -> tuple[Layout, Stated]:
    """Return the layout that was specified, and what was stated with the representation that it says.

    Raises
    ------
    InvalidArgument
        An unknown word, one that stands twice, or no position.
    """
    said = stated.layout
    words = said.split(",") if isinstance(said, str) else list(said or ())
    where: dict[str, int] = {}
    channels: dict[str, int] = {}
    at = 0
    for word in (str(word).strip() for word in words):
        for name in _names(word):
            held = channels if name not in (*_SINGLE, *CELLS, *SIX, *VECTOR, *NUMBERED, *_MATRIX_ROW) else where
            if name in held:
                raise InvalidArgument(f"layout: {name!r} stands twice in {', '.join(words)}.")
            if name != "skip":
                held[name] = at
            at += 1
        if word in ("rot6d", "rot6d_columns"):
            stated = replace(stated, rotation=word)
    if not all(axis in where for axis in "xyz"):
        raise InvalidArgument(f"layout: {', '.join(words)}, expected x, y and z among them. It knows: {_known()}.")
    return Layout(where, channels, at), stated


_MATRIX_ROW = ("m30", "m31", "m32", "m33")


def _names(word: str) -> Sequence[str]:
    """Return what each column of a word holds."""
    if word in _BLOCKS:
        return _BLOCKS[word]
    name = _ALIASES.get(word, word)
    if name in (*_SINGLE, "skip") or name.replace("_", "").isalnum():
        return (name,)
    raise InvalidArgument(f"layout: {word!r}, expected one of {_known()}, or the name of another quantity.")


def _known() -> str:
    return ", ".join((*_SINGLE, *_BLOCKS, "gripper", "skip"))
