"""LeRobot data sets v2.1 and v3.0: episodes in parquet files, what their columns hold in meta/info.json.

Source: Hugging Face LeRobot, data set formats v2.1 and v3.0. Rate, names and episodes are the data set's; a frame, a
unit (m is taken) and the meaning of rx, ry, rz or roll, pitch, yaw are not: converters write rotation vectors and Euler
angles under both names. Images are never opened. Read by pyarrow.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp._text import read_text
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument, NotStated
from dmpcpp.recordings._columns import bodies_in
from dmpcpp.recordings._datasets import LARGEST, chosen_episode, needed
from dmpcpp.recordings._layout import layout_of
from dmpcpp.recordings._number_table import NumberTable
from dmpcpp.recordings._pose_columns import pose
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "is_folder"]

_INFO = Path("meta") / "info.json"
_FEATURES = (
    "observation.state",
    "observation.ee_pose",
    "observation.eef_pose",
)  # no action: a command
_SIDES = {"_l": "left", "_r": "right", "_left": "left", "_right": "right"}
_LONGEST_INFO = 4 * 1024 * 1024  # characters of meta/info.json
_MOST_FILES = 100_000
_MOST_ROWS = 10_000_000  # of one file
_BATCH = 1024  # rows read at once


@dataclass(frozen=True)
class _Set:
    """A data set, or one of its files that was given alone."""

    folder: Path
    info: Mapping[str, Any]
    file: Path | None = None

    @property
    def rate(self) -> float | None:
        fps = self.info.get("fps")
        return float(fps) if isinstance(fps, int | float) and not isinstance(fps, bool) and 0.0 < fps < 1e6 else None

    def names(self, feature: str) -> list[str]:
        """Return the names of a feature's numbers: a flat or nested list, {"motors": [..]} or {name: index}."""
        features = self.info.get("features")
        entry = features.get(feature) if isinstance(features, dict) else None
        return _flat(entry.get("names")) if isinstance(entry, dict) else []

    def files(self) -> Iterator[Path]:
        """Yield the parquet files of the data, in order."""
        if self.file is not None:
            yield self.file
            return
        found = sorted((self.folder / "data").glob("chunk-*/*.parquet"))[:_MOST_FILES]
        yield from found


def is_folder(path: Path) -> bool:
    """Return whether a path is the folder of a data set."""
    return (path / _INFO).is_file()


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the end effectors whose poses the names of the columns tell."""
    data = _opened(path)
    _episodes(data, stated)
    return tuple(_bodies(data, stated))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses of one end effector in one episode."""
    data = _opened(path)
    episode = _episodes(data, stated)
    held = _bodies(data, stated)
    body = pick_body(body, tuple(held))
    feature, where = held[body]
    rows = _rows(data, feature, episode)
    names = data.names(feature)
    if stated.layout is not None:
        stated = layout_of(stated)[1]
    position, rotation, notes = pose(NumberTable.of(rows), where, lambda column: _called(names, column), stated)
    sampled = sampling(len(rows), stated.without("episode"), rate=data.rate)
    channels = {name: rows[:, k] for k, name in enumerate(names) if "gripper" in name.lower() and k < rows.shape[1]}
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[f"LeRobot: episode {episode}, {feature}", *sampled.notes, *notes],
        world=World(time_unit=None if stated.time_unit is not None else "s", handedness=None),
        channels=channels,
    )


def _opened(path: Path) -> _Set:
    if path.is_dir():
        return _Set(path, _info(path / _INFO))
    for folder in path.absolute().parents[:4]:
        if is_folder(folder):
            return _Set(folder, _info(folder / _INFO), path)
    return _Set(path.parent, _from_schema(path), path)


def _info(path: Path) -> dict[str, Any]:
    text = read_text(path)
    try:
        if len(text) > _LONGEST_INFO:
            raise ValueError(f"{len(text)} characters")
        info = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InvalidArgument(f"{_INFO}: not readable JSON ({str(error)[:80]}).") from None
    if not isinstance(info, dict):
        raise InvalidArgument(f"{_INFO}: expected an object with fps and features.")
    return info


def _from_schema(path: Path) -> dict[str, Any]:
    """Return what the schema of a file without its data set tells: the names that a converter left there."""
    parquet = needed("pyarrow.parquet", "Parquet files")
    try:
        metadata = parquet.read_schema(path).metadata or {}
        content = json.loads(metadata.get(b"huggingface", b"{}"))
    except Exception as error:  # of a damaged file pyarrow raises a dozen types
        raise InvalidArgument(f"not a readable parquet file ({type(error).__name__}: {str(error)[:120]}).") from None
    features = content.get("info", {}).get("features", {}) if isinstance(content, dict) else {}
    return {"features": {name: {"names": None} for name in features}} if isinstance(features, dict) else {}


def _episodes(data: _Set, stated: Stated) -> int:
    """Return the episode that was chosen.

    Raises
    ------
    NotStated
        There are several and none was specified.
    """
    numbers: set[int] = set()
    for file in data.files():
        numbers |= set(_column(file, "episode_index").astype(int).tolist())
    if not numbers:
        raise InvalidArgument("LeRobot: the data set holds no rows with an episode_index.")
    return chosen_episode(stated.episode, sorted(numbers), "a LeRobot data set")


def _rows(data: _Set, feature: str, episode: int) -> Array:
    """Return the numbers (T, n) of a feature in one episode."""
    parts = []
    for file in data.files():
        mine = _column(file, "episode_index") == episode
        numbers = _column(file, feature)
        if len(numbers) != len(mine):
            raise InvalidArgument(
                f"{file.name}: {len(numbers)} rows of {feature}, {len(mine)} of episode_index. It is damaged."
            )
        if mine.any():
            parts.append(numbers[mine])
    rows = np.concatenate(parts)
    return rows.reshape(len(rows), -1)


def _column(file: Path, name: str) -> Array:
    """Return one column of a file as numbers (T,) or (T, n)."""
    parquet = needed("pyarrow.parquet", "LeRobot data sets")
    try:
        opened = parquet.ParquetFile(file)
        _check_size(opened, file, name)
        batches = opened.iter_batches(_BATCH, columns=[name])
        return np.concatenate([_numbers(batch.column(0)) for batch in _bounded(batches, file, name)])
    except InvalidArgument:
        raise
    except OSError as error:
        raise FileError(f"{file}: cannot be read ({str(error)[:120]}).") from None
    except Exception as error:  # of a damaged file pyarrow raises a dozen types
        raise InvalidArgument(f"{file.name}: not readable ({type(error).__name__}: {str(error)[:120]}).") from None


def _check_size(opened: Any, file: Path, name: str) -> None:
    """Refuse a column that is not there or larger than a recording; repeated values take no space in the file."""
    if name not in opened.schema_arrow.names:
        raise InvalidArgument(
            f"{file.name}: no column {name!r}. It holds: {', '.join(opened.schema_arrow.names)[:300]}."
        )
    rows, width = opened.metadata.num_rows, getattr(opened.schema_arrow.field(name).type, "list_size", 1)
    if rows > _MOST_ROWS or 8 * rows * width > LARGEST:
        raise InvalidArgument(
            f"{file.name}: {rows} rows of {width} numbers, expected at most {_MOST_ROWS} rows and {LARGEST} bytes."
        )
    size = sum(opened.metadata.row_group(k).total_byte_size for k in range(opened.num_row_groups))
    if size > 64 * LARGEST:
        raise InvalidArgument(f"{file.name}: {size} bytes, expected at most {64 * LARGEST}.")


def _bounded(batches: Iterator[Any], file: Path, name: str) -> Iterator[Any]:
    """Yield batches of rows until they are larger than a recording; lists of any length are known when they are read.

    The lengths that the file's metadata state are not asked for: pyarrow ends the process where they are damaged.
    """
    size = 0
    for batch in batches:
        size += 2 * batch.nbytes  # float32 becomes float64
        if size > LARGEST:
            raise InvalidArgument(f"{file.name}: {name} has more than {LARGEST} bytes.")
        yield batch


def _numbers(column: Any) -> Array:
    """Return a column of numbers, or of lists of equal length, as (T,) or (T, n); null becomes NaN."""
    rows = len(column)
    nested = False
    while hasattr(column, "flatten") and hasattr(column, "value_lengths"):
        lengths = set(column.value_lengths().unique().to_pylist())
        if column.null_count or len(lengths) > 1:
            raise ValueError("lists of different lengths")
        column, nested = column.flatten(), True
    flat = np.asarray(column.to_numpy(zero_copy_only=False), dtype=np.float64)
    return flat.reshape(rows, -1) if nested else flat


def _bodies(data: _Set, stated: Stated) -> dict[str, tuple[str, dict[str, int]]]:
    """Return the end effectors with the feature and columns that hold them.

    Raises
    ------
    NotStated
        No names of a pose; the message says what there is.
    """
    features = (stated.dataset,) if stated.dataset is not None else _FEATURES
    if stated.layout is not None:
        return {"pose": (features[0], layout_of(stated)[0].where)}
    for feature in features:
        names = [_plain(name) for name in data.names(feature)]
        found = bodies_in(names) or (bodies_in(names, position_only=True) if stated.fixed_orientation else {})
        if found:
            return {body: (feature, where) for body, where in found.items()}
    raise _no_pose(data)


def _no_pose(data: _Set) -> NotStated:
    features = data.info.get("features")
    known = (
        [name for name in features if not str(name).startswith("observation.image")]
        if isinstance(features, dict)
        else []
    )
    names = data.names("observation.state")
    shown = ", ".join(names[:16]) or "no names"
    joints = any(name.endswith(".pos") or "shoulder" in name.lower() or "joint" in name.lower() for name in names)
    what = (
        " These look like joints, not the pose of a hand; their arm's forward kinematics would give that."
        if joints
        else ""
    )
    return NotStated(
        ("layout", "dataset"),
        f"layout: LeRobot: observation.state holds {shown}, no x, y, z with an orientation.{what} If another "
        f"feature holds "
        "poses, specify it and what its columns hold: dataset='observation.state' with "
        "layout='x,y,z,rotvec,gripper' for "
        f"instance. Features: {', '.join(map(str, known))[:300] or 'not told'}.",
    )


def _plain(name: str) -> str:
    """Return a name as tables have it: the side in front, `ee_x_l` as left_ee_x; tcp_pose.position.x stays."""
    stem, side = name, ""
    for ending, called in _SIDES.items():
        if name.endswith(ending) and len(name) > len(ending) + 1:
            stem, side = name.removesuffix(ending), called
    for prefix in ("ee_", "eef_"):
        stem = stem.removeprefix(prefix)
    return f"{side}.{stem}" if side else stem


def _flat(names: Any) -> list[str]:
    if isinstance(names, str):
        return [names]
    if isinstance(names, list):
        return [name for each in names for name in _flat(each)]
    if isinstance(names, dict):
        values = list(names.values())
        if values and all(isinstance(value, int) for value in values):
            return sorted(map(str, names), key=lambda name: int(names[name]))
        return [name for each in values for name in _flat(each)]
    return []


def _called(names: list[str], column: int) -> str:
    return repr(names[column]) if column < len(names) else f"column {column}"


def _recognises(path: Path, head: bytes) -> bool:
    return is_folder(path) or head.startswith(b"PAR1")


READER = Reader(
    name="lerobot",
    summary="a LeRobot data set (folder, or one of its parquet files)",
    takes=(
        "dataset",
        "layout",
        "rotation",
        "quat_order",
        "euler_order",
        "angle_unit",
        "fixed_orientation",
        *COMMON,
    ),
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
