"""Recorded human motion in: one reader per file format, one kind of value out.

>>> from dmpcpp import recordings
>>> recordings.bodies("session.csv")                              # doctest: +SKIP
('hand', 'object')
>>> recordings.load("session.csv", body="hand", unit="mm")        # doctest: +SKIP
Recording('hand', 812 samples, 8.110 s, 100.0 Hz, source='session.csv')

Length unit, quaternion order, sampling rate and up axis are stated by the format or by the caller and never
guessed; what was taken as a default stands in the recording's history.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from os import PathLike
from pathlib import Path

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings import arrays, deepmimic, table, tum
from dmpcpp.recordings.clips import clip_names, clip_path
from dmpcpp.recordings.reader import Reader
from dmpcpp.recordings.recording import Recording
from dmpcpp.recordings.text import read_bytes

__all__ = ["Recording", "bodies", "clip", "clip_names", "clip_path", "formats", "load"]

_READERS: dict[str, Reader] = {r.name: r for r in (deepmimic.READER, tum.READER, table.READER, arrays.READER)}
_HEAD = 4096  # bytes that decide the format


def formats() -> dict[str, str]:
    """Return the names of the formats, as `format=` takes them, with a few words on each."""
    return {name: reader.summary for name, reader in _READERS.items()}


def bodies(path: str | PathLike[str], format: str | None = None, **stated: object) -> tuple[str, ...]:
    """Return the bodies that a file holds.

    Parameters and errors are those of `load`.
    """
    path = Path(path)
    reader = _reader(path, format, stated)
    return _call(reader, reader.bodies, path, stated)


def load(path: str | PathLike[str], body: str | None = None, format: str | None = None, **stated: object) -> Recording:
    """Read one body's motion from a file.

    Parameters
    ----------
    path : path
        The file.
    body : str, optional
        Which body; may be left out when the file holds one.
    format : str, optional
        One of `formats()`; left out, the file's name and first bytes decide; where they do not, an error.
    **stated
        What the file does not say. By format:

        - deepmimic: nothing, the format says it all.
        - tum: `unit`, `up_axis`.
        - table: `columns`, `delimiter`, `rate`, `unit`, `time_unit`, `up_axis`.
        - arrays: `rate`, `quat_order`, `index`, `unit`, `time_unit`, `up_axis`.

        `unit` is "m", "cm", "mm" or metres per unit, `rate` is in Hz, `quat_order` is "xyzw" or "wxyz",
        `up_axis` is "x", "y" or "z".

    Returns
    -------
    Recording
        In s from 0 and m, checked; its history says what was mended.

    Raises
    ------
    FileError
        The file is missing or can not be read.
    InvalidArgument
        The format can not be told, the body is not in the file (the message lists those that are), the
        content is damaged (the message names line, frame or index), or what must be stated was not.
    """
    path = Path(path)
    reader = _reader(path, format, stated)
    recording: Recording = _call(reader, reader.read, path, stated, body)
    return recording


def clip(name: str, body: str = "right_hand") -> Recording:
    """Return a body's motion from a clip that ships with the installed pybullet package.

    Raises
    ------
    MissingDependency
        PyBullet is not installed.
    InvalidArgument
        There is no such clip or body (the message lists those that exist), or the clip's data are refused.
    """
    return load(clip_path(name), body=body, format="deepmimic")


def _call(reader: Reader, function: Callable, path: Path, stated: dict[str, object], *args: object):
    """Call a reader so that its complaints begin with the file's name."""
    try:
        return function(path, *args, **stated)
    except InvalidArgument as error:
        raise InvalidArgument(f"{path.name}: {error}") from None


def _reader(path: Path, format: str | None, stated: dict[str, object]) -> Reader:
    if format is None:
        head = read_bytes(path, _HEAD)
        able = [reader for reader in _READERS.values() if reader.recognises(path, head)]
        if len(able) != 1:
            raise InvalidArgument(f"{path.name}: the format can not be told. State format=...: {_listed()}.")
        reader = able[0]
    elif format in _READERS:
        reader = _READERS[format]
    else:
        raise InvalidArgument(f"format: {format!r}, expected one of: {_listed()}.")
    _check_stated(reader, stated)
    return reader


def _check_stated(reader: Reader, stated: dict[str, object]) -> None:
    taken = [p.name for p in inspect.signature(reader.read).parameters.values() if p.kind is p.KEYWORD_ONLY]
    for name in stated:
        if name not in taken:
            takes = ", ".join(taken) or "nothing"
            raise InvalidArgument(f"{name}: the format {reader.name!r} does not take it; it takes: {takes}.")


def _listed() -> str:
    return "; ".join(f"{name!r} ({summary})" for name, summary in formats().items())
