"""C3D: markers of a motion capture system, with rate and unit.

Source: The C3D File Format User Guide (Motion Lab Systems, 2008). Read here rather than by a library, because those
that exist crash, hang or stop at an assertion on damaged or unusual files; every size is held against the file's before
anything is taken for it. Analog channels are skipped. A residual below 0 marks a marker that was not seen.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from dmpcpp._text import read_bytes
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._formats.c3d_parameters import ByteOrder, Parameters, byte_order, read_parameters
from dmpcpp.recordings._markers import Markers, distinct
from dmpcpp.recordings._reader import COMMON, marker_reader
from dmpcpp.recordings._recording import Axis
from dmpcpp.recordings._sampling import sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import LENGTH_UNITS, World

__all__ = ["READER"]

_BLOCK = 512  # bytes
_MAGIC = 0x50


@dataclass(frozen=True)
class _Layout:
    """Where the points stand in the file."""

    points: int
    analog: int  # values a frame
    frames: int
    scale: float  # below 0: stored as floating point numbers, already scaled
    start: int  # bytes
    rate: float  # Hz


def markers(path: Path, stated: Stated) -> Markers:
    """Return the markers."""
    content = read_bytes(path)
    if len(content) < 2 * _BLOCK or content[1] != _MAGIC:
        raise InvalidArgument("not a C3D file: the header is missing or does not begin as one.")
    order = byte_order(content)
    parameters = read_parameters(content, order)
    layout = _layout(content, order, parameters)
    known = 0.0 < layout.rate < 1e6
    if not known and stated.rate is None:
        raise NotStated("rate", f"rate: {layout.rate!r} Hz, expected more than 0. State rate=...")
    sampled = sampling(layout.frames, stated, rate=layout.rate if known else None)
    return sampled.stated.marker_set(
        time=sampled.time,
        position=_positions(content, order, layout),
        names=_names(parameters, layout.points),
        source=path.name,
        notes=sampled.notes,
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
    start = (parameters.integer("POINT", "DATA_START", int(words[8])) - 1) * _BLOCK
    layout = _Layout(
        points=points,
        analog=int(words[2]),
        frames=_frames(parameters, frames),
        scale=float(order.floats(content[12:16])[0]),
        start=start,
        rate=parameters.number("POINT", "RATE", float(order.floats(content[20:24])[0])),
    )
    size = 4 if layout.scale < 0.0 else 2
    needed = start + layout.frames * (4 * points + layout.analog) * size
    if min(points, layout.frames) < 1 or start < _BLOCK or needed > len(content) or not np.isfinite(layout.scale):
        raise InvalidArgument(
            f"{layout.frames} frames of {points} points from byte {start} on need {needed} bytes, the file has "
            f"{len(content)}. It is cut off or damaged."
        )
    return layout


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


READER = marker_reader(
    name="c3d",
    summary="a C3D file of markers",
    recognises=lambda path, head: path.suffix.lower() == ".c3d",
    markers=markers,
    takes=("fixed_orientation", *COMMON),
)
