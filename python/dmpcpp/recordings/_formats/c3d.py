"""C3D: markers of a motion capture system, or poses of segments, with rate and unit.

Source: The C3D File Format User Guide (Motion Lab Systems, 2008). Read here rather than by a library, because those
that exist crash, hang or stop at an assertion on damaged or unusual files; every size is held against the file's before
anything is taken for it. Analog channels are skipped. A residual below 0 marks a marker that was not seen.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from dmpcpp._text import read_bytes
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._formats.c3d_parameters import ByteOrder, Parameters, byte_order, read_parameters
from dmpcpp.recordings._formats.c3d_rotation import read_segment, segments
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._reader import COMMON, Reader, no_orientation
from dmpcpp.recordings._recording import Axis, Recording
from dmpcpp.recordings._sampling import sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import LENGTH_UNITS, World

__all__ = ["READER"]

_BLOCK = 512  # bytes
_MAGIC = 0x50
_OUTPUTS = ("ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS")  # parameters that list points which are no markers


@dataclass(frozen=True)
class _Layout:
    """Where the points stand in the file."""

    points: int
    analog: int  # values a frame
    frames: int
    scale: float  # below 0: stored as floating point numbers, already scaled
    start: int  # bytes
    rate: float  # Hz
    notes: tuple[str, ...] = ()

    @property
    def end(self) -> int:
        """Return the first byte behind the data."""
        return self.start + self.frames * (4 * self.points + self.analog) * (4 if self.scale < 0.0 else 2)


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the segments whose rotation matrices the file holds; none of a file of markers."""
    return segments(*_opened(path))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the pose of one segment of a ROTATION group."""
    content, order, parameters = _opened(path)
    if not segments(content, order, parameters):
        raise no_orientation(markers(path, stated).names)
    world = World(
        unit=None if stated.unit is not None else _unit(parameters), time_unit="s", up_axis=_up_axis(parameters)
    )
    return read_segment(content, order, parameters, body, path.name, stated, world)


def _opened(path: Path) -> tuple[bytes, ByteOrder, Parameters]:
    content = read_bytes(path)
    if len(content) < 2 * _BLOCK or content[1] != _MAGIC:
        raise InvalidArgument("not a C3D file: the header is missing or does not begin as one.")
    order = byte_order(content)
    return content, order, read_parameters(content, order)


def markers(path: Path, stated: Stated) -> Markers:
    """Return the markers; angles, forces and other model outputs among the points are left out."""
    content, order, parameters = _opened(path)
    layout = _layout(content, order, parameters)
    names, kept, notes = _without_outputs(parameters, _names(parameters, layout.points))
    known = 0.0 < layout.rate < 1e6
    if not known and stated.rate is None:
        raise NotStated("rate", f"rate: {layout.rate!r} Hz, expected more than 0. State rate=...")
    sampled = sampling(layout.frames, stated, rate=layout.rate if known else None)
    return sampled.stated.marker_set(
        time=sampled.time,
        position=_positions(content, order, layout)[:, kept],
        names=names,
        source=path.name,
        notes=[*sampled.notes, *parameters.notes, *layout.notes, *notes],
        world=World(
            unit=None if stated.unit is not None else _unit(parameters), time_unit="s", up_axis=_up_axis(parameters)
        ),
    )


def _layout(content: bytes, order: ByteOrder, parameters: Parameters) -> _Layout:
    words = order.integers(content[:_BLOCK])
    first, last = int(words[3]), int(words[4])
    points = parameters.integer("POINT", "USED", int(words[1]))
    frames = parameters.integer("POINT", "FRAMES", last - first + 1)
    if frames in (0xFFFF, last - first + 1) and last >= first:
        frames = last - first + 1
    if points < 1:
        raise InvalidArgument(
            f"the file holds no points, only {parameters.integer('ANALOG', 'USED', 0)} analog channels."
        )
    block = parameters.integer("POINT", "DATA_START", int(words[8])) or int(words[8])
    layout = _Layout(
        points=points,
        analog=int(words[2]),
        frames=_frames(parameters, frames),
        scale=float(order.floats(content[12:16])[0]),
        start=(block - 1) * _BLOCK,
        rate=parameters.number("POINT", "RATE", float(order.floats(content[20:24])[0])),
    )
    layout = _with_analog(layout, parameters, len(content))
    if layout.frames < 1 or layout.start < _BLOCK or layout.end > len(content) or not np.isfinite(layout.scale):
        raise InvalidArgument(
            f"{layout.frames} frames of {points} points from byte {layout.start} on need {layout.end} bytes, the "
            f"file has "
            f"{len(content)}. It is cut off or damaged."
        )
    return layout


def _with_analog(layout: _Layout, parameters: Parameters, size: int) -> _Layout:
    """Return the layout with the count of analog values that fits the file's size, where header and parameters differ.

    Raises
    ------
    InvalidArgument
        They differ and both or none fit.
    """
    used, rate = parameters.integer("ANALOG", "USED", -1), parameters.number("ANALOG", "RATE", 0.0)
    by_rate = used * rate / layout.rate if used >= 0 and layout.rate > 0.0 else -1.0
    if not 0.0 <= by_rate < 1e6 or round(by_rate) == layout.analog or (rate == 0.0 and used > 0):
        return layout
    other = replace(layout, analog=round(by_rate))
    fitting = [each for each in (layout, other) if each.end <= size < each.end + _BLOCK]
    said = f"analog values a frame: {layout.analog} by the header, {other.analog} by ANALOG:USED and its rate"
    if len(fitting) == 1:
        return replace(fitting[0], notes=(f"{said}; {fitting[0].analog} fits the file's size",))
    if layout.end <= size < other.end:
        return layout  # what follows the data is no reason for doubt
    raise InvalidArgument(
        f"{said}; {'both fit' if fitting else 'neither fits'} its size of {size} bytes. Export it again."
    )


def _frames(parameters: Parameters, frames: int) -> int:
    """Return the number of frames; files with more than 65535 keep it among the parameters of the trial."""
    if parameters.has("TRIAL", "ACTUAL_START_FIELD") and parameters.has("TRIAL", "ACTUAL_END_FIELD"):
        first, last = (parameters.long("TRIAL", f"ACTUAL_{end}_FIELD") for end in ("START", "END"))
        if last - first + 1 > frames:
            return last - first + 1
    return frames


def _positions(content: bytes, order: ByteOrder, layout: _Layout) -> Array:
    width = 4 * layout.points + layout.analog
    floating = layout.scale < 0.0
    size = layout.frames * width * (4 if floating else 2)
    raw = content[layout.start : layout.start + size]
    values = (order.floats(raw) if floating else order.signed(raw)).reshape(layout.frames, width)
    points = values[:, : 4 * layout.points].reshape(layout.frames, layout.points, 4).astype(np.float64)
    position = points[:, :, :3] if floating else points[:, :, :3] * layout.scale
    lost = ~(points[:, :, 3] >= 0.0) | ~np.isfinite(position).all(axis=2)
    return np.where(lost[:, :, None], np.nan, position)


def _names(parameters: Parameters, count: int) -> tuple[str, ...]:
    """Return the labels; from the 256th on they stand in LABELS2, LABELS3, .."""
    labels = list(parameters.texts("POINT", "LABELS"))
    k = 2
    while len(labels) < count and parameters.has("POINT", f"LABELS{k}"):
        labels += parameters.texts("POINT", f"LABELS{k}")
        k += 1
    labels += [f"point {k + 1}" for k in range(len(labels), count)]
    return distinct(labels[:count])


def _without_outputs(parameters: Parameters, names: tuple[str, ...]) -> tuple[tuple[str, ...], list[int], list[str]]:
    """Return the names of the markers, their numbers, and a note on the points that are model outputs."""
    outputs = {name for kind in _OUTPUTS for name in parameters.texts("POINT", kind) if name}
    kept = [k for k, name in enumerate(names) if name not in outputs]
    if len(kept) == len(names) or not kept:
        return names, list(range(len(names))), []
    left_out = [name for name in names if name in outputs]
    shown = ", ".join(left_out[:8]) + (", ..." if len(left_out) > 8 else "")
    return tuple(names[k] for k in kept), kept, [f"{len(left_out)} model outputs among the points left out: {shown}"]


def _unit(parameters: Parameters) -> str:
    units = parameters.texts("POINT", "UNITS")
    unit = units[0].strip().lower() if units else ""
    if unit not in LENGTH_UNITS:
        raise NotStated(
            "unit", f"unit: POINT:UNITS is {unit[:20]!r}, expected one of {', '.join(LENGTH_UNITS)}. State it."
        )
    return unit


def _up_axis(parameters: Parameters) -> Axis | None:
    """Return the axis that points up on the screen, if the file says so and it points up, not down."""
    screen = parameters.texts("POINT", "Y_SCREEN")
    axes: dict[str, Axis] = {"+X": "x", "+Y": "y", "+Z": "z"}
    return axes.get(screen[0].strip().upper()) if screen else None


READER = Reader(
    name="c3d",
    summary="a C3D file of markers, or of segments' rotations",
    takes=("fixed_orientation", *COMMON),
    recognises=lambda path, head: path.suffix.lower() == ".c3d",
    bodies=bodies,
    read=read,
    markers=markers,
)
