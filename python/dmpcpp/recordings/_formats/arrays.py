"""NumPy files: poses as (T, 4, 4) matrices, (T, 7) positions and quaternions, or (T, 8) with the time first.

A .npz names its arrays: `pose`, `poses` or the only array of a fitting shape, or bodies by name (`_named_arrays`):
`right_wrist` (T, 4, 4), `robot0_eef_pos` (T, 3) beside `robot0_eef_quat` (T, 4); and `time`, `times` or `t` in s, or
`rate` in Hz. An array (T, 3) holds positions without orientations. A .npy holds one array; its rate is specified by the
caller, and so is the meaning of columns that nothing names. A leading axis (N, T, ...) holds N demonstrations.
"""

from __future__ import annotations

import warnings
import zipfile
from pathlib import Path
from typing import BinaryIO

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument, NotStated
from dmpcpp.recordings._layout import layout_of
from dmpcpp.recordings._named_arrays import Source, held, poses_of, read_source, sources_in, stated_source
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

__all__ = ["READER", "bodies", "read", "read_arrays"]

_BODY = "pose"
_POSE_NAMES = ("pose", "poses")
_TIME_NAMES = ("time", "times", "timestamp", "timestamps", "t")
_LARGEST_ARRAY = 256 * 1024 * 1024  # bytes; a hostile file may claim more than the machine has
_BODY_MODEL = frozenset(("poses", "trans")), frozenset(("root_orient", "pose_body"))
_FEWEST_JOINTS = 20  # three numbers each; no other array called poses is that wide


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies whose arrays have names that tell, or "pose" for the only array."""
    arrays = _numeric(read_arrays(path))
    return tuple(_sources(arrays, stated))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses; `rate` is needed where the file holds no times, `quat_order` for (T, 7) and (T, 8)."""
    arrays = _numeric(read_arrays(path))
    sources = _sources(arrays, stated)
    body = pick_body(body, tuple(sources))
    source = sources[body]
    if source.turn or body != _BODY or stated.layout is not None:
        return _of_source(arrays, source, body, path, stated)
    return _of_poses(arrays, _chosen(arrays[source.poses], stated.index), path, stated)


def _numeric(arrays: dict[str, Array]) -> dict[str, Array]:
    return {name: array for name, array in arrays.items() if array.dtype.kind == "f"}


def _sources(arrays: dict[str, Array], stated: Stated) -> dict[str, Source]:
    """Return the bodies of a file: as specified, by the names of arrays, or the only one that fits.

    Raises
    ------
    InvalidArgument
        There is none.
    """
    shapes = {name: array.shape for name, array in arrays.items()}
    source = stated_source(stated, shapes)
    if source is not None:
        return {_BODY: source}
    _refuse_body_model(shapes)
    named = [name for name in _POSE_NAMES if name in arrays and _fits(arrays[name])]
    if named:
        return {_BODY: Source(named[0])}
    found = sources_in(shapes)
    if len(arrays) == 1 and next(iter(arrays.values())).ndim == 2:
        return {_BODY: Source(next(iter(arrays)))}
    fitting = [name for name, array in arrays.items() if _fits(array) and name not in _TIME_NAMES]
    if found:
        return found
    if len(fitting) != 1:
        raise InvalidArgument(
            "expected one array of poses named 'pose', shaped (T, 4, 4), (T, 7) or (T, 8), or 'position' (T, 3) beside "
            f"'quaternion' (T, 4) or 'rotation' (T, 3, 3); or name them: dataset='POSITION,ORIENTATION'. The file "
            f"holds: "
            f"{held(shapes)}."
        )
    return {_BODY: Source(fitting[0])}


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


def _of_source(arrays: dict[str, Array], source: Source, body: str, path: Path, stated: Stated) -> Recording:
    def get(name: str) -> Array:
        return arrays[name] if stated.index is None else _chosen(arrays[name], stated.index)

    position, rotation, notes, channels = read_source(source, get, stated)
    time = channels.pop("time", None)
    if stated.layout is not None and "time" in layout_of(stated)[0].where:
        time = arrays[source.poses].reshape(len(position), -1)[:, layout_of(stated)[0].where["time"]]
    sampled = _sampling(arrays, len(position), stated, time)
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*sampled.notes, *notes],
        world=World(handedness=None),
        channels=channels,
    )


def _of_poses(arrays: dict[str, Array], poses: Array, path: Path, stated: Stated) -> Recording:
    lost = _lost(poses, stated.missing)
    time, position, rotation, notes = _split(poses, stated, lost)
    sampled = _sampling(arrays, len(poses), stated, time)
    notes = [*sampled.notes, *notes]
    if stated.index is not None:
        notes = [f"demonstration {stated.index} of the file", *notes]
    position = np.where(lost[:, None], np.nan, position)
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=_BODY,
        source=path.name,
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


def _fits(array: Array) -> bool:
    return array.shape[-2:] == (4, 4) or (array.ndim >= 2 and array.shape[-1] in (3, 6, 7, 8, 9, 10, 12, 16))


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


def _sampling(arrays: dict[str, Array], count: int, stated: Stated, column: Array | None) -> Sampling:
    """Return when the samples were taken, by a column of the poses or an array beside them."""
    if column is not None:
        return sampling(count, stated, times=lambda: column)
    named = next((name for name in _TIME_NAMES if name in arrays), None)
    if named is not None:
        return sampling(count, stated, times=lambda: _times(arrays, named, count))
    rate = arrays.get("rate", arrays.get("fps", np.empty(0)))
    return sampling(count, stated, rate=float(rate.reshape(-1)[0]) if rate.size == 1 else None)


def _times(arrays: dict[str, Array], name: str, count: int) -> Array:
    if arrays[name].reshape(-1).shape != (count,):
        raise InvalidArgument(f"{name}: shape {arrays[name].shape}, expected ({count},), one for each pose.")
    return arrays[name].reshape(-1)


def read_arrays(path: Path) -> dict[str, np.ndarray]:
    """Return the arrays of a .npz by name, or of a .npy as "pose"; numbers as float64, text as it is.

    Raises
    ------
    FileError
        The file is missing or cannot be read.
    InvalidArgument
        It is damaged, or holds anything but numbers and text.
    """
    try:
        with path.open("rb") as file:
            return _members(file) if zipfile.is_zipfile(file) else {"pose": _array(file, path.stat().st_size)}
    except InvalidArgument:
        raise
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    # NumPy and zipfile meet a damaged file with a dozen types of exception, SyntaxError and zlib.error too.
    except Exception as error:
        raise InvalidArgument(f"not a readable NumPy file ({type(error).__name__}: {error}).") from None


def _members(file: BinaryIO) -> dict[str, np.ndarray]:
    arrays = {}
    with zipfile.ZipFile(file) as archive:
        for info in archive.infolist():
            with archive.open(info) as member:
                array = _array(member, info.file_size)
            arrays[info.filename.removesuffix(".npy")] = array
    return arrays


def _array(file: BinaryIO, size: int) -> np.ndarray:
    """Return one array as float64, or as text; what its header claims must fit the file."""
    file.seek(0)
    version = np.lib.format.read_magic(file)
    header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a header written by Python 2
        shape, _, dtype = header(file)
        claimed = int(np.prod([int(n) for n in shape], dtype=object)) * dtype.itemsize
        if dtype.hasobject or claimed > min(size, _LARGEST_ARRAY):
            raise InvalidArgument(f"an array of {claimed} bytes of {dtype} in {size} bytes of file.")
        file.seek(0)
        array = np.lib.format.read_array(file, allow_pickle=False)
    return array.astype(np.float64) if array.dtype.kind in "fiu" else array


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
