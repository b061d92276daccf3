"""Files of named arrays (.npz, HDF5, zarr): which of them are poses of which body, told by their names and shapes.

The number of columns never decides what an array means: names, or the caller, do.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._layout import layout_of
from dmpcpp.recordings._number_table import NumberTable
from dmpcpp.recordings._pose_columns import check_last_row, pose
from dmpcpp.recordings._representation import ANGLES, CELLS, NUMBERED, QUATERNION, SIX, VECTOR
from dmpcpp.recordings._statement import Stated

__all__ = ["Source", "Sources", "nearest", "poses_of", "read_source", "short_names", "sources_in", "stated_source"]

Shape = tuple[int, ...]
Getter = Callable[[str], Array]

_POSITION = re.compile(r"(?P<body>.*?)[_/]?(?:positions?|pos|translations?|trans|xyz|t_xyz|p)", re.IGNORECASE)
_TURN = re.compile(
    r"(?P<body>.*?)[_/]?(?P<what>quat(?:ernions?)?(?:_(?:xyzw|wxyz))?|q_(?:xyzw|wxyz)|(?:rot_?)?axis_?angle|rot_?vec(?:tors?)?|"
    r"rot_?6d|eulers?|rpy|rotations?|rot|rot_?mat(?:rix)?|orientations?|ori|q|R)",
    re.IGNORECASE,
)
_TURN_SHAPES = ((3,), (4,), (6,), (9,), (3, 3))
_ORIGIN = (3, 7, 11)  # of a matrix row by row


@dataclass(frozen=True)
class Source:
    """Where a body's poses stand: an array of matrices (T, 4, 4), or positions (T, 3) and orientations."""

    poses: str
    turn: str = ""


Sources = dict[str, Source]


def sources_in(shapes: Mapping[str, Shape]) -> Sources:
    """Return the bodies whose poses the names tell, by body.

    Poses are arrays (T, 4, 4) or (T, 1, 4, 4), called by their own name; or a position (T, 3) and an orientation of
    the same beginning, `robot0_eef_pos` and `robot0_eef_quat`. Groups are left out of a body's name unless two bodies
    would have one name.
    """
    shapes = {name: _squeezed(shape) for name, shape in shapes.items()}
    found: list[tuple[str, Source]] = []
    for name, shape in shapes.items():
        match = _POSITION.fullmatch(name)
        turn = _turn_of(match["body"], shapes) if match and shape[1:] == (3,) else None
        if match and turn and turn != name and shapes[turn][0] == shape[0]:
            found.append((match["body"], Source(name, turn)))
    found += [(name, Source(name)) for name, shape in shapes.items() if _is_matrices(shape)]
    return _called(found)


def _turn_of(body: str, shapes: Mapping[str, Shape]) -> str | None:
    """Return the array of a body's orientations: of the same beginning, in other capitals where only one is."""
    matches = {name: _TURN.fullmatch(name) for name, shape in shapes.items() if shape[1:] in _TURN_SHAPES}
    turns = [(match["body"], name) for name, match in matches.items() if match]
    same = [name for other, name in turns if other == body]
    alike = {other for other, _ in turns if other.lower() == body.lower()}
    return next(iter(same or [name for other, name in turns if {other} == alike]), None)


def _called(found: Sequence[tuple[str, Source]]) -> Sources:
    """Return sources by the last part of the body's path; by all of it where two end alike, or by their array's."""
    choices = [(_leaf(body) or "pose", body.rstrip("_/") or "pose", source.poses) for body, source in found]
    counts = [Counter(level) for level in zip(*choices, strict=True)]
    names = [
        next(name for name, count in zip(each, counts, strict=True) if count[name] == 1 or name == each[-1])
        for each in choices
    ]
    return {name: source for name, (_, source) in zip(names, found, strict=True)}


def short_names(paths: Sequence[str]) -> dict[str, str]:
    """Return the last part of each path, by path; all of it where two end alike."""
    count = Counter(map(_leaf, paths))
    return {path: _leaf(path) if count[_leaf(path)] == 1 else path for path in paths}


def nearest(paths: Sequence[str], to: str) -> str | None:
    """Return the path that shares most of its groups with another, the first of equals."""

    def shared(path: str) -> int:
        both = zip(path.split("/")[:-1], to.split("/")[:-1], strict=False)
        return len(list(takewhile(lambda groups: groups[0] == groups[1], both)))

    return max(paths, key=shared, default=None)


def stated_source(stated: Stated, shapes: Mapping[str, Shape]) -> Source | None:
    """Return the arrays that were specified, None where none were.

    Raises
    ------
    InvalidArgument
        One is not in the file; the message lists those that are.
    """
    if stated.dataset is None:
        return None
    names = [name.strip().strip("/") for name in str(stated.dataset).split(",")]
    unknown = [name for name in names if name not in shapes]
    if unknown or not 1 <= len(names) <= 2:
        wrong = f"no array {unknown[0]!r}" if unknown else f"{len(names)} arrays, expected one or two"
        raise InvalidArgument(f"dataset: {wrong}. The file holds: {held(shapes)}.")
    return Source(*names)


def held(shapes: Mapping[str, Shape]) -> str:
    """Return the arrays of a file as messages list them."""
    short = [f"{name} {shape}" for name, shape in list(shapes.items())[:24]]
    return ", ".join(short + (["..."] if len(shapes) > len(short) else [])) or "nothing"


def read_source(source: Source, get: Getter, stated: Stated) -> tuple[Array, Array, list[str], dict[str, Array]]:
    """Return position (T, 3), rotation (T, 3, 3), notes and channels of a body's arrays."""
    if not source.turn:
        return poses_of(_without_ones(get(source.poses)), stated, source.poses)
    position, turn = get(source.poses), get(source.turn)
    if position.ndim != 2 or position.shape[1] != 3 or len(turn) != len(position):
        raise InvalidArgument(
            f"dataset: {source.poses} {position.shape} and {source.turn} {turn.shape}, expected positions (T, 3) "
            f"and as many "
            "orientations."
        )
    values = np.concatenate([position, turn.reshape(len(turn), -1)], axis=1)
    kind, stated = _kind(source.turn, values.shape[1] - 3, stated)
    where = {name: column for column, name in enumerate(("x", "y", "z", *kind))}
    found = pose(NumberTable.of(values), where, lambda column: f"column {column}", stated)
    return *found, {}


def poses_of(poses: Array, stated: Stated, name: str) -> tuple[Array, Array, list[str], dict[str, Array]]:
    """Return position, rotation, notes and channels of one array: (T, 4, 4), or (T, n) by its layout."""
    if stated.layout is None and _is_matrices(poses.shape):
        check = poses[:, 3]
        lost = np.isnan(poses).any(axis=(1, 2)) if stated.missing == "nan" else np.zeros(len(poses), dtype=bool)
        check_last_row(np.where(lost[:, None], [0.0, 0.0, 0.0, 1.0], check), lost)
        stated = replace(stated, layout="mat12")
        poses = poses[:, :3].reshape(len(poses), 12)
    flat = poses.reshape(len(poses), -1)
    layout, stated = layout_of(stated if stated.layout is not None else _told(name, poses.shape, stated))
    if layout.width != flat.shape[1]:
        raise InvalidArgument(f"layout: {layout.width} columns, but the array {name} has shape {poses.shape}.")
    position, rotation, notes = pose(NumberTable.of(flat), layout.where, lambda column: f"column {column}", stated)
    return position, rotation, notes, {each: flat[:, column] for each, column in layout.channels.items()}


def _told(name: str, shape: Shape, stated: Stated) -> Stated:
    """Return the layout of an array (T, 7) with a stated order of quaternions; else the error that asks for it."""
    width = int(np.prod(shape[1:]))
    if width == 7 and stated.quat_order is not None:
        return replace(stated, layout="x,y,z,quat", rotation=None)
    suggestions = {
        3: "fixed_orientation=True with layout='x,y,z' holds the orientation fixed",
        6: "layout='x,y,z,rotvec' (rotation vector) or, with euler_order='xyz', layout='x,y,z,rx,ry,rz' (Euler angles)",
        7: "layout='x,y,z,quat_xyzw' or 'x,y,z,quat_wxyz', or layout='x,y,z,rx,ry,rz,gripper' with euler_order='xyz'",
        8: "layout='x,y,z,quat_xyzw,gripper', or layout='time,x,y,z,quat_xyzw'",
        9: "layout='x,y,z,rot6d'",
        10: "layout='x,y,z,rot6d,gripper'",
        12: "layout='mat12' (3 x 4 matrices)",
        16: "layout='mat16' (4 x 4 matrices)",
    }
    suggestion = suggestions.get(width, "layout='x,y,z,quat_xyzw,..,skip' with a word for each column")
    raise NotStated(
        "layout", f"layout: an array {name} of shape {shape} does not tell what its columns are. Specify {suggestion}."
    )


def _kind(name: str, width: int, stated: Stated) -> tuple[tuple[str, ...], Stated]:
    """Return what the numbers of an orientation are by the name of their array, and what was stated with it."""
    match = _TURN.fullmatch(name)
    what = match["what"].lower().replace("_", "") if match else ""
    if width == 9:
        return CELLS, stated
    if width == 6:
        return SIX, stated
    if width == 3:
        vector = what.endswith("axisangle") or what.startswith("rotvec")
        return VECTOR if vector and stated.euler_order in (None, "rotvec") else ANGLES, stated
    if width != 4:
        raise InvalidArgument(f"dataset: {name} holds {width} numbers a sample, expected 3, 4, 6 or 9.")
    if stated.quat_order is None and what.endswith(("xyzw", "wxyz")):
        return (QUATERNION if what.endswith("xyzw") else ("qw", "qx", "qy", "qz")), stated
    return NUMBERED, stated


def _is_matrices(shape: Shape) -> bool:
    return len(shape) == 3 and shape[1:] == (4, 4)


def _squeezed(shape: Shape) -> Shape:
    """Return a shape without axes of length 1 behind the first."""
    return (*shape[:1], *(n for n in shape[1:] if n != 1))


def _without_ones(array: Array) -> Array:
    return array.reshape(_squeezed(array.shape))


def _leaf(name: str) -> str:
    return name.rsplit("/", 1)[-1]
