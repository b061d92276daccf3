"""HDF5 files of poses: robomimic and LIBERO, EgoDex, DROID, and any other layout with named arrays.

Sources: the data sets' own documentation. robomimic, LIBERO: data/demo_K/obs/robot0_eef_pos (m) and robot0_eef_quat
(x y z w), z up, no rate but perhaps control_freq in env_args. EgoDex: transforms/JOINT (T, 4, 4) in ARKit's world, y
up, 30 Hz that the file does not state. DROID: observation/robot_state/cartesian_position (m and Euler angles xyz, rad),
read at read_start (ms). ALOHA and RoboSet hold joints only. Read by h5py; links out of the file, references and object
types are never followed.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument, NotStated
from dmpcpp.recordings._datasets import Allowance, chosen_episode, needed
from dmpcpp.recordings._formats.hdf5_arrays import arrays_in, read_array
from dmpcpp.recordings._named_arrays import (
    Source,
    Sources,
    held,
    nearest,
    read_source,
    short_names,
    sources_in,
    stated_source,
)
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Axis, Recording
from dmpcpp.recordings._sampling import Sampling, sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER"]

_MAGIC = b"\x89HDF\r\n\x1a\n"
_EPISODE = re.compile(
    r"(?P<before>.*?)(?P<name>(?:demo|episode|ep|trial|traj|trajectory|demonstration)[_-]?)(?P<number>\d+)"
)
_DROID = "observation/robot_state/cartesian_position"
_DROID_TIME = "observation/timestamp/robot_state/read_start"
_TIMES = re.compile(r"(?:.*/)?(?:time|times|timestamps?|t)")
_ACTION = re.compile(r"(?:.*/)?(?:actions?(?:/.*|$)|next_obs/.*)")  # commands, and observations one step later
_LOW_CONFIDENCE = 0.1
_MOST_CHANNELS = 32


@dataclass(frozen=True)
class _Known:
    """A layout that is known by its groups."""

    name: str
    up_axis: Axis | None = None
    quat_order: str | None = None
    note: str = ""
    handedness: str | None = "right"


_ROBOMIMIC = _Known(
    "robomimic",
    "z",
    "xyzw",
    "robomimic: the position is the grip site's, the quaternion (x y z w) the hand's body, 90 deg about z apart",
)
_EGODEX = _Known("EgoDex", "y", None, "EgoDex: ARKit's world, y up; origin and heading are new in each episode")
_DROID_SET = _Known("DROID", "z", None, "DROID: the robot's wrist in its base frame, Euler angles xyz about fixed axes")
_OTHER = _Known("HDF5", handedness=None)


@dataclass(frozen=True)
class _File:
    """The arrays of an open file by path, of one episode where there are several."""

    file: Any
    shapes: dict[str, tuple[int, ...]]
    prefix: str  # of the episode
    known: _Known
    notes: tuple[str, ...] = ()
    allowance: Allowance = field(default_factory=Allowance)

    def get(self, name: str) -> Array:
        """Return an array; all that are read take at most 256 MB."""
        data = self.file[self.prefix + name]
        self.allowance.take(name, data.shape, data.dtype)
        return read_array(name, data)


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the bodies whose poses the file holds."""
    with _opened(path, stated) as file:
        return tuple(_sources(file, stated))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses of one body in one episode."""
    with _opened(path, stated) as file:
        sources = _sources(file, stated)
        body = pick_body(body, tuple(sources))
        source, stated = sources[body], stated.without("episode")
        if source.poses == _DROID and stated.layout is None:
            stated = replace(stated, layout="x,y,z,rx,ry,rz", euler_order="xyz", angle_unit="rad", rotation=None)
        elif stated.quat_order is None and file.known.quat_order and source.turn:
            stated = replace(stated, quat_order=file.known.quat_order)  # type: ignore[arg-type]
        position, rotation, notes, channels = read_source(source, file.get, stated)
        lost, doubts = _unsure(file, source, len(position))
        position, rotation = position.copy(), rotation.copy()
        position[lost], rotation[lost] = np.nan, np.nan
        sampled = _sampling(file, source, len(position), stated)
        known = file.known
        told = (
            [Note("assumed", f"taken: up_axis: {known.up_axis}, as {known.name} has it", about="up_axis")]
            if known.up_axis and not stated.up_axis
            else []
        )
        return sampled.stated.recording(
            time=sampled.time,
            position=position,
            rotation=rotation,
            body=body,
            source=path.name,
            notes=[*file.notes, *([known.note] if known.note else []), *sampled.notes, *notes, *doubts, *told],
            world=World(
                unit=None if known is _OTHER else "m",
                time_unit=None if stated.time_unit is not None else _clock(file),
                up_axis=known.up_axis,
                handedness=known.handedness,  # type: ignore[arg-type]
            ),
            channels={**channels, **_grippers(file, len(position))},
        )


def _clock(file: _File) -> str | None:
    return "ms" if file.known is _DROID_SET else None


def _sources(file: _File, stated: Stated) -> Sources:
    """Return the bodies of an episode.

    Raises
    ------
    NotStated
        No names of poses; the message lists the arrays.
    """
    source = stated_source(stated, file.shapes)
    if source is not None:
        return {source.poses.rsplit("/", 1)[-1]: source}
    if _DROID in file.shapes:
        return {"cartesian_position": Source(_DROID)}
    states = {name: shape for name, shape in file.shapes.items() if not _ACTION.fullmatch(name)}
    found = sources_in(states)
    if found:
        return found
    joints = (
        " qpos and qp_arm are joints, not the pose of a hand."
        if any("qpos" in n or "qp_arm" in n for n in states)
        else ""
    )
    raise NotStated(
        "dataset",
        f"dataset: no array whose name tells a pose.{joints} Specify those that hold it: dataset='PATH' or "
        f"dataset='POSITION,ORIENTATION'. The file holds: {held(file.shapes)}.",
    )


def _sampling(file: _File, source: Source, count: int, stated: Stated) -> Sampling:
    """Return when the samples were taken: at the specified rate, by the nearest array of times, or control_freq."""
    if _DROID_TIME in file.shapes and file.shapes[_DROID_TIME] == (count,):
        return sampling(count, stated, times=lambda: file.get(_DROID_TIME), unit="ms")
    times = [n for n, shape in file.shapes.items() if _TIMES.fullmatch(n) and shape in ((count,), (count, 1))]
    named = nearest(times, source.poses)
    if named is not None:
        return sampling(count, stated, times=lambda: file.get(named).reshape(-1))
    rate = _control_freq(file.file)
    if stated.rate is None and rate is None:
        propose = 30 if file.known is _EGODEX else 20
        raise NotStated(
            "rate", f"rate: {file.known.name}: the file holds no rate and no times. Specify it, usually rate={propose}."
        )
    return sampling(count, stated, rate=rate)


def _control_freq(file: Any) -> float | None:
    """Return the rate [Hz] in the settings of a robomimic environment, if it is there."""
    if type(file.get("data", getlink=True)).__name__ != "HardLink":  # it may lead to another file
        return None
    try:
        settings = json.loads(str(file["data"].attrs["env_args"])[: 1 << 20])
        rate = settings.get("env_kwargs", {}).get("control_freq", settings.get("control_freq"))
        return float(rate) if 0.0 < float(rate) < 1e6 else None
    except (KeyError, TypeError, ValueError, AttributeError, RecursionError):
        return None


def _unsure(file: _File, source: Source, count: int) -> tuple[np.ndarray, list[str]]:
    """Return which samples (T,) of a joint have a confidence below 0.1, and a note."""
    name = source.poses.replace("transforms/", "confidences/", 1)
    if not source.poses.startswith("transforms/") or file.shapes.get(name) != (count,):
        return np.zeros(count, dtype=bool), []
    lost = ~(file.get(name) >= _LOW_CONFIDENCE)
    note = f"{int(lost.sum())} samples with a confidence below {_LOW_CONFIDENCE:g} taken as lost"
    return lost, [note] if lost.any() else []


def _grippers(file: _File, count: int) -> dict[str, Array]:
    fitting = [name for name, shape in file.shapes.items() if shape in ((count,), (count, 1))]
    named = [name for name in fitting if "gripper" in name.lower() and not _ACTION.fullmatch(name)]
    return {short: file.get(name).reshape(-1) for name, short in short_names(named[:_MOST_CHANNELS]).items()}


@contextmanager
def _opened(path: Path, stated: Stated) -> Iterator[_File]:
    """Open a file at the episode that was chosen; whatever h5py raises at a damaged one becomes InvalidArgument."""
    h5py = needed("h5py", "HDF5 files")
    try:
        with h5py.File(path, "r") as file:
            yield _at_episode(file, arrays_in(h5py, file), stated)
    except (InvalidArgument, FileError):
        raise
    except OSError as error:
        raise InvalidArgument(f"not a readable HDF5 file ({str(error)[:120]}).") from None
    except Exception as error:  # of a damaged file h5py raises RuntimeError, KeyError, ValueError, MemoryError ..
        raise InvalidArgument(f"not a readable HDF5 file ({type(error).__name__}: {str(error)[:120]}).") from None


def _at_episode(file: Any, shapes: dict[str, tuple[int, ...]], stated: Stated) -> _File:
    """Return the arrays of one episode where the names of groups count episodes, else all of them."""
    groups = _episodes(shapes)
    if not groups:
        if stated.episode not in (None, 0):
            raise InvalidArgument(f"episode: {stated.episode}, but the file holds no groups of episodes.")
        return _File(file, shapes, "", _known(shapes))
    inner = _known(_within(shapes, next(iter(groups.values()))))
    number = chosen_episode(stated.episode, sorted(groups), f"a {inner.name} file")
    prefix = groups[number]
    return _File(
        file, _within(shapes, prefix), prefix, inner, (f"{inner.name}: episode {number}, {prefix.rstrip('/')}",)
    )


def _episodes(shapes: dict[str, tuple[int, ...]]) -> dict[int, str]:
    """Return the groups of episodes by number; none where two have one number, as of a left and a right hand."""
    groups: dict[int, str] = {}
    for name in shapes:
        match = _EPISODE.match(name)
        if match and match.end() < len(name) and name[match.end()] == "/":
            prefix = name[: match.end() + 1]
            if groups.setdefault(int(match["number"]), prefix) != prefix:
                return {}
    return groups


def _within(shapes: dict[str, tuple[int, ...]], prefix: str) -> dict[str, tuple[int, ...]]:
    return {name.removeprefix(prefix): shape for name, shape in shapes.items() if name.startswith(prefix)}


def _known(shapes: dict[str, tuple[int, ...]]) -> _Known:
    if _DROID in shapes:
        return _DROID_SET
    if any(name.startswith("transforms/") for name in shapes):
        return _EGODEX
    if any(re.fullmatch(r"obs/(?:robot\d+_eef_(?:pos|quat)|ee_(?:pos|states))", name) for name in shapes):
        return _ROBOMIMIC
    return _OTHER


READER = Reader(
    name="hdf5",
    summary="an HDF5 file of poses (robomimic, LIBERO, EgoDex, DROID or other)",
    takes=("dataset", "layout", "rotation", "quat_order", "euler_order", "angle_unit", "fixed_orientation", *COMMON),
    recognises=lambda path, head: head.startswith(_MAGIC),
    bodies=bodies,
    read=read,
)
