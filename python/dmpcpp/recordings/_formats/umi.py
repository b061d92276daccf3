"""Zarr replay buffers of UMI and other sets with the same layout: arrays of all episodes below each other.

Source: UMI (C. Chi et al., RSS 2024), documentation of its data: data/robotK_eef_pos (m), robotK_eef_rot_axis_angle
(rotation vector, rad), meta/episode_ends (row ends). The rate is that of the video and not in the file. Images are
never opened. Folders and .zip files, zarr formats 2 and 3, read by zarr.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._datasets import chosen_episode
from dmpcpp.recordings._formats.zarr_arrays import ZarrFile, is_folder
from dmpcpp.recordings._named_arrays import (
    Sources,
    held,
    nearest,
    read_source,
    short_names,
    sources_in,
    stated_source,
)
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "is_folder"]

_ENDS = ("meta/episode_ends", "episode_ends")
_NOT_POSES = ("demo_start_pose", "demo_end_pose")  # one pose of each episode, repeated
_TIMES = ("timestamp", "timestamps", "time")
_VIDEO_RATE = 59.94  # Hz, of UMI's camera


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies whose poses the arrays' names tell."""
    file = ZarrFile(path)
    _episode(file, stated)
    return tuple(_sources(file, stated))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses of one body in one episode."""
    file = ZarrFile(path)
    rows, note = _episode(file, stated)
    sources = _sources(file, stated)
    body = pick_body(body, tuple(sources))

    def get(name: str) -> Array:
        return file.get(name)[rows]

    stated = stated.without("episode")
    position, rotation, notes, channels = read_source(sources[body], get, stated)
    clocks = [name for name in file.shapes if name.rsplit("/", 1)[-1] in _TIMES]
    times = nearest(clocks, sources[body].poses)
    if times is None and stated.rate is None:
        raise NotStated(
            "rate",
            f"rate: the file holds no rate and no times. Specify it: that of the video, UMI's is rate={_VIDEO_RATE:g}.",
        )
    sampled = sampling(len(position), stated, times=None if times is None else lambda: get(times).reshape(-1))
    return sampled.stated.recording(
        time=sampled.time,
        position=position,
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*note, *sampled.notes, *notes],
        world=World(),
        channels={**channels, **_grippers(file, sources[body].poses, get, len(position))},
    )


def _grippers(file: ZarrFile, poses: str, get: Callable[[str], Array], count: int) -> dict[str, Array]:
    """Return the widths of the gripper that belongs to the poses robotK_eef_pos."""
    robot = poses.rsplit("/", 1)[-1].split("_")[0]
    named = short_names([name for name in file.shapes if name.endswith(f"{robot}_gripper_width")])
    widths = {short: get(name).reshape(-1) for name, short in named.items()}
    return {name: values for name, values in widths.items() if len(values) == count}


def _episode(file: ZarrFile, stated: Stated) -> tuple[slice, list[str]]:
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


def _sources(file: ZarrFile, stated: Stated) -> Sources:
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
