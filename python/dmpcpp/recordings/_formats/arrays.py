"""NumPy files: poses as (T, 4, 4) matrices, (T, 7) positions and quaternions, or (T, 8) with the time first.

A .npz names its arrays: `pose`, `poses` or the only array of a fitting shape, or `position` (T, 3) beside
`quaternion` (T, 4) or `rotation` (T, 3, 3); and `time`, `times` or `t` in s, or `rate` in Hz. An array (T, 3) holds
positions without orientations. A .npy holds one array; its rate is stated. A leading axis (N, T, ...) holds N
demonstrations.
"""

from __future__ import annotations

import warnings
import zipfile
from pathlib import Path
from typing import BinaryIO

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument, NotStated
from dmpcpp.recordings._orientation import HELD_FIXED, from_matrices, from_quaternions, held_fixed, no_turn
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import Sampling, sampling
from dmpcpp.recordings._statement import Stated
from numpy.typing import NDArray

__all__ = ["READER", "bodies", "read", "read_arrays"]

_BODY = "pose"
_POSE_NAMES = ("pose", "poses")
_POSITION_NAMES = ("position", "positions", "pos", "p", "translation")
_TURN_NAMES = ("quaternion", "quaternions", "quat", "q", "rotation", "rotations", "orientation", "orientations", "R")
_TIME_NAMES = ("time", "times", "timestamp", "timestamps", "t")
_LARGEST_ARRAY = 256 * 1024 * 1024  # bytes; a hostile file may claim more than the machine has


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the one body of an array file, "pose"."""
    read_arrays(path)
    return (_BODY,)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses; `rate` is needed where the file holds no times, `quat_order` for (T, 7) and (T, 8)."""
    body = pick_body(body, (_BODY,))
    arrays = {name: array for name, array in read_arrays(path).items() if array.dtype.kind == "f"}
    poses = _chosen(_poses(arrays), stated.index)
    lost = _lost(poses, stated.missing)
    time, position, rotation, notes = _split(poses, stated, lost)
    sampled = _sampling(arrays, len(poses), stated, time)
    notes = [*sampled.notes, *notes]
    if stated.index is not None:
        notes = [f"demonstration {stated.index} of the file", *notes]
    position = np.where(lost[:, None], np.nan, position)
    return sampled.stated.recording(
        time=sampled.time, position=position, rotation=rotation, body=body, source=path.name, notes=notes
    )


def _lost(poses: Array, missing: str | float | None) -> NDArray[np.bool_]:
    """Return which samples (T,) were lost: any NaN in them."""
    if missing not in (None, "nan"):
        raise InvalidArgument(f"missing: {missing!r}, expected 'nan': in an array, NaN stands for a lost sample.")
    if missing is None:
        return np.zeros(len(poses), dtype=bool)
    time = 1 if poses.ndim == 2 and poses.shape[1] == 8 else 0
    return np.asarray(np.isnan(poses.reshape(len(poses), -1)[:, time:]).any(axis=1))


def _poses(arrays: dict[str, Array]) -> Array:
    """Return the array of poses: by its name, put together of positions and orientations, or the only one that fits."""
    parts = _parts(arrays)
    named = [arrays[name] for name in _POSE_NAMES if name in arrays] or ([] if parts is None else [parts])
    fitting = named or [array for array in arrays.values() if _fits(array)]
    if len(fitting) != 1:
        held = ", ".join(f"{name} {a.shape}" for name, a in arrays.items()) or "nothing"
        raise InvalidArgument(
            "expected one array of poses named 'pose', shaped (T, 4, 4), (T, 7) or (T, 8), or 'position' (T, 3) beside "
            f"'quaternion' (T, 4) or 'rotation' (T, 3, 3). The file holds: {held}."
        )
    return fitting[0]


def _fits(array: Array) -> bool:
    return array.shape[-2:] == (4, 4) or (array.ndim >= 2 and array.shape[-1] in (3, 7, 8))


def _parts(arrays: dict[str, Array]) -> Array | None:
    """Return the poses (..., T, 7) or (..., T, 4, 4) of an array of positions and one of orientations beside it."""
    place, turn = _first(arrays, _POSITION_NAMES), _first(arrays, _TURN_NAMES)
    if place is None or turn is None or place.ndim < 2 or place.shape[-1] != 3:
        return None
    if turn.shape == (*place.shape[:-1], 4):
        return np.concatenate([place, turn], axis=-1)
    if turn.shape != (*place.shape[:-1], 3, 3):
        return None
    poses = np.zeros((*place.shape[:-1], 4, 4))
    poses[..., :3, :3], poses[..., :3, 3], poses[..., 3, 3] = turn, place, 1.0
    return poses


def _first(arrays: dict[str, Array], names: tuple[str, ...]) -> Array | None:
    """Return the array of the first of some names that there is."""
    return next((arrays[name] for name in names if name in arrays), None)


def _chosen(poses: Array, index: int | None) -> Array:
    """Return one demonstration: (T, 4, 4), (T, 3), (T, 7) or (T, 8)."""
    single = 3 if poses.shape[-2:] == (4, 4) else 2
    if poses.ndim == single and index is None:
        return poses
    if poses.ndim == single + 1:
        if isinstance(index, int) and 0 <= index < len(poses):
            return np.asarray(poses[index])
        raise NotStated(
            "index",
            f"index: {index!r}, expected 0 to {len(poses) - 1}: the array {poses.shape} holds "
            f"{len(poses)} demonstrations.",
        )
    raise InvalidArgument(
        f"index {index!r} into an array of shape {poses.shape}: expected (T, 4, 4), (T, 7) or (T, 8) "
        "without an index, or with one axis more and an index."
    )


def _split(poses: Array, stated: Stated, lost: NDArray[np.bool_]) -> tuple[Array | None, Array, Array, list[str]]:
    """Return time if it is among the columns, position, rotation and what was mended."""
    if poses.ndim == 3:
        _check_bottom_row(np.where(lost[:, None, None], np.eye(4), poses))
        rotation, notes = from_matrices(poses[:, :3, :3], "poses", lost)
        return None, poses[:, :3, 3], rotation, notes
    if poses.shape[1] == 3:
        if not stated.fixed_orientation:
            raise no_turn(f"an array of shape {poses.shape}")
        return None, poses, held_fixed(lost), [HELD_FIXED]
    order = stated.quat_order
    if order is None:
        raise NotStated(
            "quat_order",
            f"quat_order: not stated, and an array of shape {poses.shape} does not tell it. "
            "State quat_order='xyzw' or 'wxyz'.",
        )
    if poses.shape[1] not in (7, 8):
        raise InvalidArgument(f"poses: shape {poses.shape}, expected (T, 4, 4), (T, 7) or (T, 8).")
    time = poses[:, 0] if poses.shape[1] == 8 else None
    rotation, notes = from_quaternions(poses[:, -4:], order, missing=lost)
    return time, poses[:, -7:-4], rotation, notes


def _check_bottom_row(poses: Array) -> None:
    wrong = ~(np.abs(poses[:, 3] - [0.0, 0.0, 0.0, 1.0]).max(axis=1) <= 1e-6)
    if wrong.any():
        k = int(np.argmax(wrong))
        raise InvalidArgument(f"poses[{k}]: last row {poses[k, 3]}, expected [0 0 0 1]. Are the matrices transposed?")


def _sampling(arrays: dict[str, Array], count: int, stated: Stated, column: Array | None) -> Sampling:
    """Return when the samples were taken, by a column of the poses or an array beside them."""
    if column is not None:
        return sampling(count, stated, times=lambda: column)
    named = next((name for name in _TIME_NAMES if name in arrays), None)
    if named is not None:
        return sampling(count, stated, times=lambda: _times(arrays, named, count))
    rate = arrays.get("rate", np.empty(0))
    return sampling(count, stated, rate=float(rate.reshape(-1)[0]) if rate.size == 1 else None)


def _times(arrays: dict[str, Array], name: str, count: int) -> Array:
    if arrays[name].shape != (count,):
        raise InvalidArgument(f"{name}: shape {arrays[name].shape}, expected ({count},), one for each pose.")
    return arrays[name]


def read_arrays(path: Path) -> dict[str, np.ndarray]:
    """Return the arrays of a .npz by name, or of a .npy as "pose"; numbers as float64, text as it is.

    Raises
    ------
    FileError
        The file is missing or can not be read.
    InvalidArgument
        It is damaged, or holds anything but numbers and text.
    """
    try:
        with path.open("rb") as file:
            return _members(file) if zipfile.is_zipfile(file) else {"pose": _array(file, path.stat().st_size)}
    except InvalidArgument:
        raise
    except OSError as error:
        raise FileError(f"{path}: can not be read ({error.strerror or error}).") from None
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
    takes=("rate", "quat_order", "index", "time_unit", "missing", "fixed_orientation", *COMMON),
    recognises=lambda path, head: head.startswith(b"\x93NUMPY") or path.suffix.lower() in (".npy", ".npz"),
    bodies=bodies,
    read=read,
)
