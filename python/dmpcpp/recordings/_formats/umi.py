"""Zarr replay buffers of UMI and other sets with the same layout: arrays of all episodes below each other.

Source: UMI (C. Chi et al., RSS 2024), documentation of its data: data/robotK_eef_pos (m), robotK_eef_rot_axis_angle
(rotation vector, rad), meta/episode_ends (row ends). The rate is that of the video and not in the file. Images are
never opened. Folders and .zip files, zarr formats 2 and 3, read by zarr.
"""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument, NotStated
from dmpcpp.recordings._datasets import LARGEST, chosen_episode, needed
from dmpcpp.recordings._named_arrays import Sources, held, read_source, sources_in, stated_source
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "is_folder"]

_ENDS = ("meta/episode_ends", "episode_ends")
_MARKS = (".zgroup", "zarr.json", ".zattrs", ".zmetadata")
_LONGEST = 1024 * 1024  # bytes of one file of metadata
_MOST_ARRAYS = 10_000
_NOT_POSES = ("demo_start_pose", "demo_end_pose")  # one pose of each episode, repeated
_VIDEO_RATE = 59.94  # Hz, of UMI's camera


@dataclass(frozen=True)
class _File:
    """Shapes and sizes [bytes] of the arrays of numbers in a file by path."""

    path: Path
    shapes: dict[str, tuple[int, ...]]
    sizes: dict[str, int]

    def get(self, name: str) -> Array:
        """Return an array; at most 256 MB.

        Raises
        ------
        InvalidArgument
            It is larger, damaged, or packed by a codec that is not installed.
        """
        if self.sizes[name] > LARGEST:
            raise InvalidArgument(f"{name}: {self.sizes[name]} bytes, expected at most {LARGEST}.")
        zarr = needed("zarr", "Zarr files")
        try:
            if self.path.is_dir():
                return np.asarray(zarr.open_array(str(self.path), path=name, mode="r")[...], dtype=np.float64)
            with zarr.storage.ZipStore(str(self.path), mode="r") as store:
                return np.asarray(zarr.open_array(store, path=name, mode="r")[...], dtype=np.float64)
        except Exception as error:  # of a damaged file zarr and its codecs raise anything
            raise InvalidArgument(f"{name}: not readable ({type(error).__name__}: {str(error)[:120]}).") from None


def is_folder(path: Path) -> bool:
    """Return whether a path is the folder of a zarr file."""
    return path.is_dir() and any((path / mark).is_file() for mark in _MARKS)


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies whose poses the arrays' names tell."""
    file = _opened(path)
    _episode(file, stated)
    return tuple(_sources(file, stated))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses of one body in one episode."""
    file = _opened(path)
    rows, note = _episode(file, stated)
    sources = _sources(file, stated)
    body = pick_body(body, tuple(sources))

    def get(name: str) -> Array:
        return file.get(name)[rows]

    stated = stated.without("episode")
    position, rotation, notes, channels = read_source(sources[body], get, stated)
    times = next((name for name in file.shapes if name.rsplit("/", 1)[-1] in ("timestamp", "timestamps", "time")), None)
    if times is None and stated.rate is None:
        raise NotStated(
            "rate",
            f"rate: the file holds no rate and no times. Specify it: that of the video, UMI's is rate={_VIDEO_RATE:g}.",
        )
    sampled = sampling(len(position), stated, times=None if times is None else lambda: get(times).reshape(-1))
    grippers = {
        n.rsplit("/", 1)[-1]: get(n).reshape(-1) for n in file.shapes if n.endswith(f"{body[:6]}_gripper_width")
    }
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*note, *sampled.notes, *notes],
        world=World(),
        channels={**channels, **{name: values for name, values in grippers.items() if len(values) == len(position)}},
    )


def _episode(file: _File, stated: Stated) -> tuple[slice, list[str]]:
    """Return the rows of the episode that was chosen, and a note; all rows where the file has no episodes."""
    name = next((name for name in _ENDS if name in file.shapes), None)
    if name is None:
        if stated.episode not in (None, 0):
            raise InvalidArgument(f"episode: {stated.episode}, but the file holds no episode_ends.")
        return slice(None), []
    ends = file.get(name).reshape(-1)
    begins = np.concatenate(([0.0], ends[:-1]))
    if not len(ends) or not np.isfinite(ends).all() or not (ends > begins).all() or ends[-1] > 1e12:
        raise InvalidArgument(f"{name}: expected increasing row numbers.")
    episode = chosen_episode(stated.episode, range(len(ends)), "a zarr replay buffer")
    return slice(int(begins[episode]), int(ends[episode])), [f"episode {episode} of {len(ends)}"]


def _sources(file: _File, stated: Stated) -> Sources:
    source = stated_source(stated, file.shapes)
    if source is not None:
        return {source.poses.rsplit("/", 1)[-1]: source}
    found = sources_in(
        {name: s for name, s in file.shapes.items() if not name.endswith(_NOT_POSES) and "action" not in name}
    )
    if found:
        return found
    raise NotStated(
        "dataset",
        "dataset: no array whose name tells a pose. Specify those that hold it: dataset='PATH' or "
        f"dataset='POSITION,ORIENTATION'. The file holds: {held(file.shapes)}.",
    )


def _opened(path: Path) -> _File:
    """Return what a file's metadata say; no array is opened."""
    shapes: dict[str, tuple[int, ...]] = {}
    sizes: dict[str, int] = {}
    for name, text in _metadata(path).items():
        found = _shape(name, text)
        if found is not None:
            shapes[name], sizes[name] = found
    if not shapes:
        raise InvalidArgument("a zarr file without arrays of numbers.")
    return _File(path, dict(sorted(shapes.items())), sizes)


def _metadata(path: Path) -> dict[str, bytes]:
    """Return the metadata of all arrays, by the arrays' paths."""
    try:
        if path.is_dir():
            return {f.parent.relative_to(path).as_posix(): f.read_bytes() for f in _array_files(path)}
        with zipfile.ZipFile(path) as archive:
            infos = [i for i in archive.infolist() if i.filename.endswith((".zarray", "zarr.json"))][:_MOST_ARRAYS]
            return {
                i.filename.rsplit("/", 1)[0] if "/" in i.filename else "": archive.read(i)
                for i in infos
                if i.file_size <= _LONGEST
            }
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    except Exception as error:  # zipfile meets a damaged file with half a dozen types
        raise InvalidArgument(f"not a readable zarr file ({type(error).__name__}: {str(error)[:120]}).") from None


def _array_files(folder: Path) -> list[Path]:
    """Return the metadata files of arrays below a folder; the folders of chunks are not entered."""
    found: list[Path] = []
    for root, folders, files in os.walk(folder):
        marks = [Path(root) / name for name in (".zarray", "zarr.json") if name in files]
        found += [mark for mark in marks if mark.stat().st_size <= _LONGEST]
        is_array = ".zarray" in files or (marks and b'"array"' in marks[0].read_bytes()[:_LONGEST])
        folders[:] = [] if is_array or len(found) >= _MOST_ARRAYS else sorted(folders)
    return found


def _shape(name: str, text: bytes) -> tuple[tuple[int, ...], int] | None:
    """Return shape and size [bytes] of an array of numbers by its metadata; the larger of array and chunk."""
    try:
        content: Mapping[str, Any] = json.loads(text)
        shape = tuple(int(n) for n in content["shape"])
        kind = np.dtype(str(content.get("dtype", content.get("data_type"))))
        grid = content.get("chunks") or content["chunk_grid"]["configuration"]["chunk_shape"]
        chunk = int(np.prod([int(n) for n in grid], dtype=object))
    except (KeyError, TypeError, ValueError, RecursionError):
        return None
    if kind.kind not in "fiu" or not shape or min(shape) < 0 or len(shape) > 4:
        return None
    return shape, max(int(np.prod(shape, dtype=object)), chunk) * kind.itemsize


def _recognises(path: Path, head: bytes) -> bool:
    return is_folder(path) or path.name.lower().endswith((".zarr.zip", ".zarr"))


READER = Reader(
    name="zarr",
    summary="a zarr replay buffer of poses (UMI), folder or .zarr.zip",
    takes=("dataset", "layout", "rotation", "quat_order", "euler_order", "angle_unit", "fixed_orientation", *COMMON),
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
