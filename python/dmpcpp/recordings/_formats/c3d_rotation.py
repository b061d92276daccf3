"""The ROTATION group of C3D files: a 4 x 4 matrix and a reliability for each segment, as Theia writes them.

Source: C3D.org, "The ROTATION group"; checked against ezc3d. A frame holds USED x RATIO x 17 floating point numbers,
whatever the points are stored as: the matrix column by column, segment to world, its translation in POINT:UNITS, then
the reliability, which is negative where the segment was not seen.
"""

from __future__ import annotations

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._formats.c3d_parameters import ByteOrder, Parameters
from dmpcpp.recordings._orientation import from_matrices
from dmpcpp.recordings._reader import pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._sampling import sampling
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["read_segment", "segments"]

_BLOCK = 512  # bytes
_NUMBERS = 17  # of a segment: the matrix and its reliability
_ENDING = "_4X4"


def segments(content: bytes, order: ByteOrder, parameters: Parameters) -> tuple[str, ...]:
    """Return the names of the segments; none of a file without a ROTATION group."""
    used = parameters.integer("ROTATION", "USED", 0)
    labels = [label.removesuffix(_ENDING) for label in parameters.texts("ROTATION", "LABELS")[:used]]
    return tuple(labels + [f"segment {k + 1}" for k in range(len(labels), used)]) if used else ()


def read_segment(
    content: bytes,
    order: ByteOrder,
    parameters: Parameters,
    body: str | None,
    source: str,
    stated: Stated,
    world: World,
) -> Recording:
    """Return the pose of one segment.

    Raises
    ------
    InvalidArgument
        The file is too short for what it claims, or there is no such segment.
    """
    names = segments(content, order, parameters)
    body = pick_body(body, names)
    values = _values(content, order, parameters, len(names))[:, names.index(body)]
    matrices = np.swapaxes(values[:, :16].reshape(-1, 4, 4), 1, 2)
    lost = ~(values[:, 16] >= 0.0) | ~np.isfinite(values).all(axis=1)
    rotation, notes = from_matrices(np.where(lost[:, None, None], np.eye(3), matrices[:, :3, :3]), missing=lost)
    rate = parameters.number("ROTATION", "RATE", 0.0)
    sampled = sampling(len(values), stated, rate=rate if 0.0 < rate < 1e6 else None)
    return sampled.stated.recording(
        time=sampled.time,
        position=np.where(lost[:, None], np.nan, matrices[:, :3, 3]),
        rotation=rotation,
        body=body,
        source=source,
        notes=[*sampled.notes, *notes],
        world=world,
    )


def _values(content: bytes, order: ByteOrder, parameters: Parameters, count: int) -> Array:
    """Return the numbers (T, segments, 17)."""
    words = order.integers(content[:_BLOCK])
    points = parameters.integer("POINT", "FRAMES", int(words[4]) - int(words[3]) + 1)
    ratio = max(1, parameters.integer("ROTATION", "RATIO", 1))
    start = (parameters.integer("ROTATION", "DATA_START", 0) - 1) * _BLOCK
    size = points * ratio * count * _NUMBERS * 4
    if start < _BLOCK or start + size > len(content) or points < 1:
        raise InvalidArgument(
            f"{points * ratio} samples of {count} segments from byte {start} on need {start + size} bytes, the file "
            f"has "
            f"{len(content)}. It is cut off or damaged."
        )
    raw = order.floats(content[start : start + size])
    return raw.reshape(points * ratio, count, _NUMBERS)
