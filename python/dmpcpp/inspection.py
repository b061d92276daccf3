"""What a recording holds, before anything is learned from it: bodies, rate, gaps, jumps, noise, and what to state.

>>> from dmpcpp import inspection
>>> found = inspection.inspect("reach.bvh")                       # doctest: +SKIP
>>> found.needed                                                  # doctest: +SKIP
{'unit': "reach.bvh: unit: a BVH file does not say its unit of length. State unit='cm', ..."}
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp import motion
from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.motion import LONGEST_GAP
from dmpcpp.recordings import (
    Markers,
    Reader,
    Recording,
    Stated,
    of_markers,
    prepared,
    too_many,
    usual_step,
)

__all__ = ["BodyReport", "Inspection", "MarkerReport", "inspect"]

_T = TypeVar("_T")
_How = motion.Preparation | None

_STAND_INS: dict[str, Any] = {
    "unit": 1.0,
    "rate": 100.0,
    "up_axis": "z",
    "quat_order": "xyzw",
    "euler_order": "ZYX",
    "angle_unit": "rad",
    "index": 0,
    "episode": 0,
    "times": "received",
    "fixed_orientation": True,
}
"""What is taken for granted to see what else is to be stated; nothing else comes of it."""

_JUMP = np.pi / 2  # rad between samples; no hand turns that far, and a half turn cannot be recognised from its reverse


@dataclass(frozen=True)
class BodyReport:
    """What one body's recording is like; lengths in m, times in s, angles in rad.

    `noise_position` and `noise_angle` are standard deviations along and about one axis, see `motion.noise`; `extent` is
    the range along x, y and z; `missing` counts samples that the file marks as lost, `skipped` those that were never
    written, see `motion.skipped`; `allowed_gap` is the longest that is filled; `jumps` counts turns of more than 90 deg
    between neighbouring samples; `steps` are the least, the usual and the largest time from one sample to the next.
    `cycles` and `segments` are the parts (begin, end) that `--repetition` and `--segment` choose from; `made_up` says
    why its gaps cannot be filled. `implausible` says why this cannot be the motion of a hand, see
    `motion.implausible`. `refused` says why the body cannot be read, and then nothing else is known.
    """

    name: str
    samples: int = 0
    duration: float = 0.0
    rate: float = 0.0
    missing: int = 0
    skipped: int = 0
    longest_gap: float = 0.0
    allowed_gap: float = LONGEST_GAP
    jumps: int = 0
    noise_position: float = 0.0
    noise_angle: float = 0.0
    extent: tuple[float, float, float] = (0.0, 0.0, 0.0)
    steps: tuple[float, float, float] = (0.0, 0.0, 0.0)
    peak_speed: float = 0.0
    peak_turning: float = 0.0
    history: tuple[str, ...] = ()
    implausible: str = ""
    refused: str = ""
    cycles: tuple[tuple[float, float], ...] = ()
    segments: tuple[tuple[float, float], ...] = ()
    made_up: str = ""


@dataclass(frozen=True)
class MarkerReport:
    """What one marker's recording is like; m and s."""

    name: str
    missing: int
    longest_gap: float
    noise_position: float
    extent: tuple[float, float, float]


@dataclass(frozen=True)
class Inspection:
    """What a file holds.

    Parameters
    ----------
    source, format : str
        The file's name and format.
    held : tuple of str
        All bodies of the file.
    bodies : tuple of BodyReport
        Of the bodies that were looked at.
    markers : tuple of MarkerReport
    markers_held : tuple of str
        Names of the markers that the file holds beside bodies.
    samples : int, duration : float, rate : float
        Of the markers, where the file holds markers only.
    needed : dict
        What must be stated before a motion can be read, with the reason.
    assumed : dict
        What was taken for granted, with what it was taken as.
    """

    source: str
    format: str
    held: tuple[str, ...] = ()
    bodies: tuple[BodyReport, ...] = ()
    markers: tuple[MarkerReport, ...] = ()
    samples: int = 0
    duration: float = 0.0
    rate: float = 0.0
    markers_held: tuple[str, ...] = ()
    needed: dict[str, str] = field(default_factory=dict)
    assumed: dict[str, str] = field(default_factory=dict)

    @property
    def problems(self) -> tuple[str, ...]:
        """What keeps the bodies looked at from being learned as they are, one sentence each."""
        return tuple(problem for body in self.bodies for problem in _problems(body))

    @property
    def ok(self) -> bool:
        """True if a body was read, nothing must be supplied and there is no problem."""
        return len(self.bodies) > 0 and not self.needed and not self.problems

    def summary(self) -> dict[str, Any]:
        """Return all of it as plain values, for JSON."""
        return {**asdict(self), "problems": list(self.problems), "ok": self.ok}


def inspect(
    path: str | PathLike[str],
    body: str | None = None,
    format: str | None = None,
    *,
    markers: Sequence[str] | None = None,
    preparation: motion.Preparation | None = None,
    **stated: object,
) -> Inspection:
    """Look into a file; what it does not say is reported rather than refused.

    Parameters and errors are those of `recordings.load`, but for what must be stated: without it, the report says so,
    of all at once that can be known. Without `body` all bodies are looked at. With a `preparation` a body is looked at
    as it will be learned: the part that is chosen, and gaps up to `longest_gap` are no problem.
    """
    path = Path(path)
    try:
        reader, said = prepared(path, format, stated)
    except NotStated as error:
        return Inspection(path.name, "unknown", needed=dict.fromkeys(error.names, str(error)))
    if markers is not None and reader.markers is not None:
        return _of_markers(reader, path, said, body, markers, preparation)
    held = _attempt(lambda said: reader.call(reader.bodies, path, said), said)
    if held.result is None:
        return Inspection(path.name, reader.name, needed=held.needed)
    if markers is not None or (not held.result and reader.markers is not None):
        return _of_markers(reader, path, said, body, markers, preparation)
    found = _of_bodies(reader, path, said, held.result, body, preparation)
    return replace(found, markers_held=_beside(reader, path, said))


def _beside(reader: Reader, path: Path, said: Stated) -> tuple[str, ...]:
    """Return the markers that a file holds beside its bodies."""
    if reader.markers is None or reader.name == "table":
        return ()  # of a table every position would be one
    try:
        found = _attempt(partial(reader.call, reader.markers, path), said).result
    except InvalidArgument:
        return ()
    return () if found is None else found.names


@dataclass(frozen=True)
class _Attempt(Generic[_T]):
    """Result of a trial read; missing facts get placeholders so that all of them are found at once.

    `result` is None where nothing can stand in, or where it is `refused`.
    """

    result: _T | None
    needed: dict[str, str]
    refused: str = ""


def _attempt(read: Callable[[Stated], _T], said: Stated) -> _Attempt[_T]:
    needed: dict[str, str] = {}
    while True:
        try:
            return _Attempt(read(said), needed)
        except NotStated as error:
            needed |= dict.fromkeys(error.names, str(error))
            name = next((name for name in error.names if name in _STAND_INS), None)
            if name is None or getattr(said, name) == _STAND_INS[name]:
                return _Attempt(None, needed)
            said = replace(said, **{name: _STAND_INS[name]})
        except InvalidArgument as error:
            if not needed:
                raise
            return _Attempt(None, needed, str(error))


def _of_bodies(
    reader: Reader, path: Path, said: Stated, held: tuple[str, ...], body: str | None, how: _How
) -> Inspection:
    reports: list[BodyReport] = []
    needed: dict[str, str] = {}
    assumed: dict[str, str] = {}
    names = held if body is None else (body,)
    for name in names:
        found = _of_body(reader, path, said, name, alone=len(names) == 1)
        needed |= found.needed
        if found.refused:
            reports.append(BodyReport(name, refused=found.refused))
        elif found.result is not None:
            assumed = _assumed(found.result, needed)
            if not found.needed:  # with a stand-in for a unit, say, its figures would be wrong
                reports.append(_report(found.result, how))
        if found.needed:
            break  # the other bodies of the file lack the same
    if len(names) > 1:
        needed["body"] = f"the file holds several: {', '.join(held)}. Specify one: body={held[0]!r}"
    return Inspection(path.name, reader.name, held, tuple(reports), needed=needed, assumed=assumed)


def _of_body(reader: Reader, path: Path, said: Stated, name: str, *, alone: bool) -> _Attempt[Recording]:
    """Return what was read of a body; one that is refused is an error where it is looked at alone."""
    try:
        return _attempt(partial(_recording, reader, path, name), said)
    except InvalidArgument as error:
        if alone:
            raise
        return _Attempt(None, {}, str(error))


def _recording(reader: Reader, path: Path, name: str, said: Stated) -> Recording:
    return reader.call(reader.read, path, name, said)


def _of_markers(
    reader: Reader, path: Path, said: Stated, body: str | None, names: Sequence[str] | None, how: _How
) -> Inspection:
    if reader.markers is None:
        raise InvalidArgument(f"{path.name}: markers: the format {reader.name!r} holds none.")
    attempt = _attempt(partial(reader.call, reader.markers, path), said)
    found, needed = attempt.result, attempt.needed
    if found is None:
        refused = (BodyReport(path.name, refused=attempt.refused),) if attempt.refused else ()
        return Inspection(path.name, reader.name, bodies=refused, needed=needed)
    assumed = _assumed(found, needed)
    if needed:  # with a stand-in for a unit, say, their figures would be wrong
        if names is None:
            needed["markers"] = f"three or more that sit on one rigid body, of: {', '.join(found.names)}"
        return Inspection(path.name, reader.name, needed=needed, assumed=assumed)
    reports = tuple(_marker(found, k) for k in range(len(found.names)))
    bodies: tuple[BodyReport, ...] = ()
    if names is None:
        needed["markers"] = "three or more that sit on one rigid body"
    else:
        bodies = (_report(reader.call(lambda _: of_markers(found, names, body, said.fixed_orientation), path), how),)
    return Inspection(
        source=path.name,
        format=reader.name,
        bodies=bodies,
        markers=reports,
        samples=len(found),
        duration=found.duration,
        rate=found.rate,
        needed=needed,
        assumed=assumed,
    )


def _assumed(found: Recording | Markers, needed: dict[str, str]) -> dict[str, str]:
    """Return what was taken for granted, but for what is to be stated."""
    assumed = {}
    if "up_axis" not in needed and found.up_axis is None:
        assumed["up_axis"] = "z"
    for note in map(Note.of, found.history):
        if note.kind == "assumed" and note.about not in needed:
            assumed[note.about] = "m" if note.about == "unit" else note.removeprefix(f"taken: {note.about}: ")
    return assumed


def _report(recording: Recording, how: _How = None) -> BodyReport:
    try:
        recording = _part_of(recording, how)
    except InvalidArgument as error:
        return BodyReport(recording.body, refused=str(error))
    there = ~recording.missing
    time, position = recording.time[there], recording.position[there]
    steps = np.diff(time)
    turned = _turns(recording.rotation[there])
    noise = motion.noise(recording)
    return BodyReport(
        name=recording.body,
        samples=len(recording),
        duration=recording.duration,
        rate=recording.rate,
        missing=int((~there).sum()),
        skipped=motion.skipped(recording.time),
        made_up=_made_up(recording),
        **_parts(recording),
        longest_gap=_longest_gap(recording.time, there),
        allowed_gap=LONGEST_GAP if how is None else how.longest_gap,
        jumps=int((turned > _JUMP).sum()),
        noise_position=noise.position,
        noise_angle=noise.angle,
        extent=_extent(position),
        steps=_steps(recording.time),
        peak_speed=float((np.linalg.norm(np.diff(position, axis=0), axis=1) / steps).max()),
        peak_turning=float((turned / steps).max()),
        history=recording.history,
        implausible=motion.implausible(recording),
    )


def _marker(markers: Markers, k: int) -> MarkerReport:
    there = ~markers.missing[:, k]
    position = markers.position[:, k]
    return MarkerReport(
        name=markers.names[k],
        missing=int((~there).sum()),
        longest_gap=_longest_gap(markers.time, there),
        noise_position=motion.white_noise(markers.time, position),
        extent=_extent(position[there]),
    )


def _steps(time: Array) -> tuple[float, float, float]:
    steps = np.diff(time)
    return float(steps.min()), usual_step(time), float(steps.max())


def _turns(rotation: Array) -> Array:
    turning = Rotation.from_matrix(rotation)
    return np.asarray((turning[:-1].inv() * turning[1:]).magnitude())


def _extent(position: Array) -> tuple[float, float, float]:
    if not len(position):
        return 0.0, 0.0, 0.0
    x, y, z = np.ptp(position, axis=0).tolist()
    return x, y, z


def _longest_gap(time: Array, there: NDArray[np.bool_]) -> float:
    """Return the longest time [s] without a sample between two that are there; all of it where none is."""
    if not there.any():
        return float(time[-1])
    return max((gap.duration for gap in motion.gaps_in(time, there)), default=0.0)


def _part_of(recording: Recording, how: _How) -> Recording:
    """Return the part of a recording that a preparation chooses."""
    if how is None:
        return recording
    if how.segment is not None or how.repetition is not None:
        return motion.prepare(recording, how)
    return motion.crop(recording, how.start, how.end) if how.start or how.end is not None else recording


def _made_up(recording: Recording) -> str:
    """Return why a recording needs more samples than it carries, "" of one that does not."""
    there = int((~recording.missing).sum())
    room = int(recording.missing.sum()) + motion.skipped(recording.time)
    if not too_many(room, there):
        return ""
    return f"{room} samples would be made up from {there}. Check the times: specify the rate=... of the device."


def _parts(recording: Recording) -> dict[str, Any]:
    """Return the segments and cycles of a recording that is whole enough to look for them."""
    try:
        whole = motion.fill(motion.thinned(recording), longest=max(recording.duration, LONGEST_GAP))
    except InvalidArgument:
        return {}
    return {"cycles": motion.spans_of_cycles(whole), "segments": motion.spans_of_segments(whole)}


def _problems(body: BodyReport) -> list[str]:
    if body.refused:
        return [f"{body.name}: {body.refused}"]
    problems = [f"{body.name}: {body.implausible}"] if body.implausible else []
    if body.made_up:
        problems.append(f"{body.name}: {body.made_up}")
    if body.longest_gap > body.allowed_gap:
        allowed = float(np.ceil(100.0 * body.longest_gap) / 100.0)
        problems.append(
            f"{body.name}: a gap of {body.longest_gap:.3g} s, more than {body.allowed_gap:g} s. "
            f"longest_gap={allowed:g} fills it; or use one side of it: `fit` and `imitate` take start, end and segment."
        )
    if body.jumps:
        problems.append(
            f"{body.name}: the orientation jumps by more than 90 deg {body.jumps} times. Check the quaternion order "
            "and the rate, or crop the jumps out."
        )
    return problems
