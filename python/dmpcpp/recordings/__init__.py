"""Recorded human motion in: one reader per file format, one kind of value out.

>>> from dmpcpp import recordings
>>> recordings.bodies("session.csv")                              # doctest: +SKIP
('hand', 'object')
>>> recordings.load("session.csv", body="hand", unit="mm")        # doctest: +SKIP
Recording('hand', 812 samples, 8.110 s, 100.0 Hz, source='session.csv')
>>> recordings.load("lift.c3d", body="hand", markers=["WRIST", "STYLr", "STYLu"])   # doctest: +SKIP
Recording('hand', 580 samples, 5.790 s, 100.0 Hz, source='lift.c3d')

Length unit, quaternion order, sampling rate and up axis are stated by the format or by the caller and never
guessed; what was taken as a default stands in the recording's history.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path

from dmpcpp._notes import Note
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._formats.clips import clip_names, clip_path
from dmpcpp.recordings._markers import Markers
from dmpcpp.recordings._numpy_files import read_arrays as read_arrays
from dmpcpp.recordings._reader import Reader
from dmpcpp.recordings._recording import MIN_SAMPLES as MIN_SAMPLES
from dmpcpp.recordings._recording import Axis as Axis
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._recording import SourceKind as SourceKind
from dmpcpp.recordings._registry import prepared, reader_of, summaries
from dmpcpp.recordings._rigid_body import of_markers, rigid_body
from dmpcpp.recordings._several import each_take
from dmpcpp.recordings._soundness import jumps as jumps
from dmpcpp.recordings._stamps import MADE_UP_EACH as MADE_UP_EACH
from dmpcpp.recordings._stamps import MADE_UP_IN_ALL as MADE_UP_IN_ALL
from dmpcpp.recordings._stamps import too_many as too_many
from dmpcpp.recordings._stamps import usual_step as usual_step
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._table_lines import VIDEO_HEADER

__all__ = [
    "Markers",
    "Note",
    "Recording",
    "Stated",
    "bodies",
    "clip",
    "clip_names",
    "clip_path",
    "format_of",
    "formats",
    "load",
    "load_all",
    "markers",
    "rigid_body",
]


def formats() -> dict[str, str]:
    """Return the names of the formats, as `format=` takes them, with a few words on each."""
    return summaries()


def format_of(path: str | PathLike[str]) -> str:
    """Return the name of a file's format, recognised from its name and first bytes.

    Raises
    ------
    FileError, InvalidArgument
        See `load`.
    """
    return reader_of(path).name


def bodies(path: str | PathLike[str], format: str | None = None, **stated: object) -> tuple[str, ...]:
    """Return the bodies that a file holds; none where it holds markers only.

    Parameters and errors are those of `load`.
    """
    reader, said = prepared(path, format, stated)
    return reader.call(reader.bodies, Path(path), said)


def markers(path: str | PathLike[str], format: str | None = None, **stated: object) -> Markers:
    """Read all markers of a file: positions without orientations.

    Parameters and errors are those of `load`; a format without markers is an error, too.
    """
    reader, said = prepared(path, format, stated)
    if reader.markers is None:
        raise InvalidArgument(f"{Path(path).name}: markers: the format {reader.name!r} holds none.")
    return reader.call(reader.markers, Path(path), said)


def load(
    path: str | PathLike[str],
    body: str | None = None,
    format: str | None = None,
    *,
    markers: Sequence[str] | None = None,
    **stated: object,
) -> Recording:
    """Read one body's motion from a file.

    Parameters
    ----------
    path : path
        The file; of a ROS 2 bag the folder.
    body : str, optional
        Which body; may be left out when the file holds one. With `markers`, what the body is to be called.
    format : str, optional
        One of `formats()`; left out, the file's name and first bytes decide; where they do not, an error.
    markers : sequence of str, optional
        Three or more markers that sit on one rigid body, for formats that hold markers; see `rigid_body`. Or one,
        with `fixed_orientation=True`.
    **stated
        What the file does not say: the fields of `Stated`. Each format takes those that it leaves open.

    Returns
    -------
    Recording
        In s from 0 and m, checked; its history lists every correction. Samples that the file marks as lost are NaN.

    Raises
    ------
    FileError
        The file is missing or cannot be read.
    InvalidArgument
        The format cannot be recognised, the body is not in the file (the message lists those that are), the
        content is damaged (the message names line, frame or index), or what must be stated was not (`NotStated`).
    MissingDependency
        The format needs a package that is not installed; the message says which extra brings it.
    """
    reader, said = prepared(path, format, stated)
    if markers is None:
        return _of_kind(reader.call(reader.read, Path(path), body, said), reader)
    if reader.markers is None:
        raise InvalidArgument(f"{Path(path).name}: markers: the format {reader.name!r} holds none.")
    return _of_kind(reader.call(_rigid_body, Path(path), reader, markers, body, said), reader)


def _of_kind(recording: Recording, reader: Reader) -> Recording:
    """Return the recording with what it was recorded by, where its format or its header says so."""
    video = any(line.startswith(VIDEO_HEADER) for line in recording.history)
    kind = "video" if video else reader.kind
    return replace(recording, kind=kind) if kind else recording


def load_all(
    path: str | PathLike[str],
    body: str | None = None,
    format: str | None = None,
    *,
    markers: Sequence[str] | None = None,
    **stated: object,
) -> list[Recording]:
    """Read every take of one body: with `episode="all"` each episode, with `where="COLUMN=all"` each of its values.

    Without either the list has one recording, that of `load`. Parameters and errors are those of `load`.
    """

    def one(**said: object) -> Recording:
        return load(path, body, format, markers=markers, **said)

    return each_take(one, stated)


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


def _rigid_body(path: Path, reader: Reader, names: Sequence[str], body: str | None, said: Stated) -> Recording:
    assert reader.markers is not None
    return of_markers(reader.markers(path, said), names, body, said.fixed_orientation)
