"""NumPy files: poses as (T, 4, 4) matrices, (T, 7) positions and quaternions, or (T, 8) with the time first.

A .npz names its arrays: `pose`, `poses` or the only array of a fitting shape, or bodies by name (`_named_arrays`):
`right_wrist` (T, 4, 4), `robot0_eef_pos` (T, 3) beside `robot0_eef_quat` (T, 4); and `time`, `times` or `t` in s, or
`rate` in Hz. An array (T, 3) holds positions without orientations. A .npy holds one array; its rate is specified by the
caller, and so is the meaning of columns that nothing names. A leading axis (N, T, ...) holds N demonstrations.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._layout import layout_of
from dmpcpp.recordings._named_arrays import Source, Sources, held, poses_of, read_source, sources_in, stated_source
from dmpcpp.recordings._numpy_files import NumpyFile
from dmpcpp.recordings._orientation import HELD_FIXED, from_matrices, from_quaternions, held_fixed, no_turn
from dmpcpp.recordings._pose_columns import check_last_row
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._representation import check_norm
from dmpcpp.recordings._sampling import Sampling, sampling
from dmpcpp.recordings._soundness import lost_zeros, zero_note
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World
from numpy.typing import NDArray

__all__ = ["READER", "bodies", "read"]

_BODY = "pose"
_POSE_NAMES = ("pose", "poses")
_TIME_NAMES = ("time", "times", "timestamp", "timestamps", "t")
_BODY_MODEL = frozenset(("poses", "trans")), frozenset(("root_orient", "pose_body"))
_FEWEST_JOINTS = 20  # three numbers each; no other array called poses is that wide


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies whose arrays have names that tell, or "pose" for the only array."""
    return tuple(_sources(NumpyFile(path), stated))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses; `rate` is needed where the file holds no times, `quat_order` for (T, 7) and (T, 8)."""
    file = NumpyFile(path)
    sources = _sources(file, stated)
    body = pick_body(body, tuple(sources))
    source = sources[body]
    if source.turn or body != _BODY or stated.layout is not None:
        return _of_source(file, source, body, stated)
    return _of_poses(file, _chosen(file.get(source.poses), stated.index), stated)


def _sources(file: NumpyFile, stated: Stated) -> Sources:
    """Return the bodies of a file: as specified, by the names of arrays, or the only one that fits.

    Raises
    ------
    InvalidArgument
        There is none.
    """
    shapes = file.shapes
    source = stated_source(stated, shapes)
    if source is not None:
        return {_BODY: source}
    _refuse_body_model(shapes)
    named = [name for name in _POSE_NAMES if name in shapes and _fits(shapes[name])]
    if named:
        return {_BODY: Source(named[0])}
    found = sources_in(shapes)
    if len(shapes) == 1 and len(next(iter(shapes.values()))) == 2:
        return {_BODY: Source(next(iter(shapes)))}
    fitting = [name for name, shape in shapes.items() if _fits(shape) and name not in _TIME_NAMES]
    if found:
        return found
    if len(fitting) != 1:
        raise _no_poses(file)
    return {_BODY: Source(fitting[0])}


def _no_poses(file: NumpyFile) -> InvalidArgument:
    """Return the error for a file of which no array tells that it holds poses."""
    pickles = f" Pickles, never opened: {', '.join(file.pickles[:24])}." if file.pickles else ""
    return InvalidArgument(
        "expected one array of poses named 'pose', shaped (T, 4, 4), (T, 7) or (T, 8), or 'position' (T, 3) beside "
        "'quaternion' (T, 4) or 'rotation' (T, 3, 3); or name them: dataset='POSITION,ORIENTATION'. The file holds: "
        f"{held(file.shapes)}.{pickles}"
    )


def _refuse_body_model(shapes: dict[str, tuple[int, ...]]) -> None:
    """Refuse AMASS and SMPL files: joint rotations without the lengths of bones."""
    model = any(names <= set(shapes) for names in _BODY_MODEL)
    wide = max((shape[-1] for name, shape in shapes.items() if name in ("poses", "pose_body")), default=0)
    if model and wide >= 3 * _FEWEST_JOINTS:
        raise InvalidArgument(
            "AMASS (SMPL) poses: rotations of joints. The position of a wrist needs the body model's rest joints, "
            "which "
            "are not in the file. Export the joints' positions with the body model, then read them as a table or an "
            "array."
        )


def _of_source(file: NumpyFile, source: Source, body: str, stated: Stated) -> Recording:
    def get(name: str) -> Array:
        return file.get(name) if stated.index is None else _chosen(file.get(name), stated.index)

    position, rotation, notes, channels = read_source(source, get, stated)
    time = channels.pop("time", None)
    if stated.layout is not None and "time" in layout_of(stated)[0].where:
        time = get(source.poses).reshape(len(position), -1)[:, layout_of(stated)[0].where["time"]]
    sampled = _sampling(file, len(position), stated, time)
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=file.path.name,
        notes=[*sampled.notes, *notes],
        world=World(handedness=None),
        channels=channels,
    )


def _of_poses(file: NumpyFile, poses: Array, stated: Stated) -> Recording:
    lost = _lost(poses, stated.missing)
    time, position, rotation, notes = _split(poses, stated, lost)
    sampled = _sampling(file, len(poses), stated, time)
    notes = [*sampled.notes, *notes]
    if stated.index is not None:
        notes = [f"demonstration {stated.index} of the file", *notes]
    position = np.where(lost[:, None], np.nan, position)
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=_BODY,
        source=file.path.name,
        notes=notes,
        world=World(handedness=None),
    )


def _lost(poses: Array, missing: str | float | None) -> NDArray[np.bool_]:
    """Return which samples (T,) were lost: any NaN in them, or zeros in place of a position."""
    if missing not in (None, "nan", 0):
        raise InvalidArgument(f"missing: {missing!r}, expected 'nan': in an array, NaN stands for a lost sample.")
    if missing == "nan":
        time = 1 if poses.ndim == 2 and poses.shape[1] == 8 else 0
        return np.asarray(np.isnan(poses.reshape(len(poses), -1)[:, time:]).any(axis=1))
    position = poses[:, :3, 3] if poses.ndim == 3 else poses[:, -7:-4] if poses.shape[1] in (7, 8) else poses[:, :3]
    return lost_zeros(position) if np.isfinite(position).all() else np.zeros(len(poses), dtype=bool)


def _fits(shape: tuple[int, ...]) -> bool:
    return shape[-2:] == (4, 4) or (len(shape) >= 2 and shape[-1] in (3, 6, 7, 8, 9, 10, 12, 16))


def _chosen(poses: Array, index: int | None) -> Array:
    """Return one demonstration: (T, 4, 4) or (T, n). Axes of length 1 behind the first are dropped."""
    poses = poses if index is not None else _without_ones(poses)
    single = 3 if poses.shape[-2:] == (4, 4) else 2
    if poses.ndim == single and index is None:
        return poses
    if poses.ndim == single + 1:
        if isinstance(index, int) and 0 <= index < len(poses):
            return np.asarray(poses[index])
        raise NotStated(
            "index",
            f"index: {index!r}, expected 0 to {len(poses) - 1}: the array {poses.shape} holds "
            f"{len(poses)} demonstrations. Specify one: index=0.",
        )
    raise InvalidArgument(
        f"index {index!r} into an array of shape {poses.shape}: expected (T, 4, 4), (T, 7) or (T, 8) "
        "without an index, or with one axis more and an index."
    )


def _without_ones(poses: Array) -> Array:
    if poses.ndim < 3 or (poses.ndim == 3 and poses.shape[-2:] == (4, 4)):
        return poses
    kept = poses.shape[-2:] if poses.shape[-2:] == (4, 4) else poses.shape[-1:]
    middle = poses.shape[1 : poses.ndim - len(kept)]
    return poses.reshape(len(poses), *(n for n in middle if n != 1), *kept)


def _split(poses: Array, stated: Stated, lost: NDArray[np.bool_]) -> tuple[Array | None, Array, Array, list[str]]:
    """Return time if it is among the columns, position, rotation and the corrections made."""
    if poses.ndim == 3:
        check_last_row(np.where(lost[:, None], [0.0, 0.0, 0.0, 1.0], poses[:, 3]), lost)
        rotation, notes = from_matrices(poses[:, :3, :3], "poses", lost)
        return None, poses[:, :3, 3], rotation, [*_zeros_note(lost, stated), *notes]
    if poses.shape[1] == 3:
        if not stated.fixed_orientation:
            raise no_turn(f"an array of shape {poses.shape}")
        return None, poses, held_fixed(lost), [HELD_FIXED]
    if poses.shape[1] not in (7, 8):
        position, rotation, notes, _ = poses_of(poses, stated, _BODY)
        return None, position, rotation, notes
    order = stated.quat_order
    if order is None:
        raise NotStated(
            "quat_order",
            f"quat_order: not stated, and an array of shape {poses.shape} does not show it. "
            "State quat_order='xyzw' or 'wxyz'; or, where these are no quaternions, what the columns hold: "
            "layout='x,y,z,rx,ry,rz,gripper' for instance.",
        )
    time = _time_column(poses)
    check_norm(poses[:, -4:], lost)
    rotation, notes = from_quaternions(poses[:, -4:], order, missing=lost)
    return time, poses[:, -7:-4], rotation, [*_zeros_note(lost, stated), *notes]


def _zeros_note(lost: NDArray[np.bool_], stated: Stated) -> list[str]:
    return [] if stated.missing == "nan" else zero_note(lost)


def _time_column(poses: Array) -> Array | None:
    """Return the first of eight columns, which can be times: they increase, most in even steps.

    Raises
    ------
    NotStated
        They cannot; then nothing says what the eight columns are.
    """
    if poses.shape[1] == 7:
        return None
    steps = np.diff(poses[:, 0])
    if not np.isfinite(poses[:, 0]).all() or ((steps > 0.0).all() and _mostly_even(steps)):
        return np.asarray(poses[:, 0])
    raise NotStated(
        "layout",
        f"layout: the first column of an array {poses.shape} does not increase in even steps, so it is no time. "
        f"Specify what "
        "each column holds: layout='x,y,z,quat_xyzw,gripper' for instance.",
    )


def _mostly_even(steps: Array) -> bool:
    low, middle, high = np.percentile(steps, [5, 50, 95])
    return bool(high - low <= middle)


def _sampling(file: NumpyFile, count: int, stated: Stated, column: Array | None) -> Sampling:
    """Return when the samples were taken, by a column of the poses or an array beside them."""
    if column is not None:
        return sampling(count, stated, times=lambda: column)
    shapes = file.shapes
    named = next((name for name in _TIME_NAMES if name in shapes), None)
    if named is not None:
        return sampling(count, stated, times=lambda: _times(file, named, count))
    rate = next((name for name in ("rate", "fps") if name in shapes and np.prod(shapes[name]) == 1), None)
    return sampling(count, stated, rate=None if rate is None else float(file.get(rate).reshape(-1)[0]))


def _times(file: NumpyFile, name: str, count: int) -> Array:
    if np.prod(file.shapes[name]) != count:
        raise InvalidArgument(f"{name}: shape {file.shapes[name]}, expected ({count},), one for each pose.")
    return file.get(name).reshape(-1)


READER = Reader(
    name="arrays",
    summary="a NumPy .npy or .npz of poses: (T, 4, 4), (T, 7) or (T, 8)",
    takes=(
        "rotation",
        "quat_order",
        "euler_order",
        "angle_unit",
        "layout",
        "dataset",
        "index",
        "fixed_orientation",
        *COMMON,
    ),
    recognises=lambda path, head: head.startswith(b"\x93NUMPY") or path.suffix.lower() in (".npy", ".npz"),
    bodies=bodies,
    read=read,
)
