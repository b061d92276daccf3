"""What every file format offers, and how one body is picked out of those a file holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from dmpcpp.errors import InvalidArgument, NotStated, within
from dmpcpp.recordings._markers import Markers
from dmpcpp.recordings._recording import Recording, SourceKind
from dmpcpp.recordings._statement import Stated

__all__ = ["COMMON", "Reader", "marker_reader", "no_orientation", "pick_body"]

COMMON = ("unit", "up_axis", "handedness", "sort_times", "rate", "time_unit", "missing", "episode")
"""What every format of measured motion lets the caller specify."""

_T = TypeVar("_T")


@dataclass(frozen=True)
class Reader:
    """One file format.

    Parameters
    ----------
    name : str
        What the caller writes in `format=`.
    summary : str
        A few words for the error that lists the formats.
    takes : tuple of str
        The fields of `Stated` that the format leaves to the caller.
    recognises : (path, first bytes of the file; none of a folder) -> bool
        Whether the file is of this format, unless a reader listed before says so of itself.
    bodies : (path, stated) -> tuple of str
        The bodies with an orientation that the file holds.
    read : (path, body or None, stated) -> Recording
    markers : (path, stated) -> Markers, or None
        For formats that hold markers.
    kind : SourceKind
        What records files of this format, where that is always the same.
    """

    name: str
    summary: str
    takes: tuple[str, ...]
    recognises: Callable[[Path, bytes], bool]
    bodies: Callable[[Path, Stated], tuple[str, ...]]
    read: Callable[[Path, str | None, Stated], Recording]
    markers: Callable[[Path, Stated], Markers] | None = None
    kind: SourceKind = ""

    def check(self, stated: Stated) -> None:
        """Refuse what was stated although the format does not take it."""
        for name in stated.names():
            if name not in self.takes:
                raise self.not_taken(name)

    def not_taken(self, name: str) -> InvalidArgument:
        """Return the error for a statement that the format does not take."""
        takes = ", ".join(f"{taken}=..." for taken in self.takes) or "nothing"
        return InvalidArgument(f"{name}: the format {self.name!r} does not take it; it takes {takes}.")

    def call(self, function: Callable[..., _T], path: Path, *arguments: object) -> _T:
        """Call one of the reader's functions so that its complaints begin with the file's name."""
        try:
            return function(path, *arguments)
        except InvalidArgument as error:
            raise within(path.name, error) from None


def marker_reader(
    name: str,
    summary: str,
    recognises: Callable[[Path, bytes], bool],
    markers: Callable[[Path, Stated], Markers],
    takes: tuple[str, ...] = ("fixed_orientation", *COMMON),
) -> Reader:
    """Return the reader of a format that holds markers and no bodies."""

    def read(path: Path, body: str | None, stated: Stated) -> Recording:
        raise no_orientation(markers(path, stated).names)

    def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
        markers(path, stated)
        return ()

    return Reader(name, summary, takes, recognises, bodies, read, markers)


def no_orientation(names: Sequence[str]) -> NotStated:
    """Return the error for a body asked of a file that holds markers only."""
    return NotStated(
        "markers",
        "markers: the file holds markers, which have no orientation. Name three or more that sit on one rigid body, "
        f"markers=[...]. It holds: {', '.join(names) or 'none'}.",
    )


def pick_body(body: str | None, available: Sequence[str]) -> str:
    """Return `body` if the file holds it, or the only one there is.

    Raises
    ------
    InvalidArgument
        The body is not there, or none was named and there are several (`NotStated`); the message lists them.
    """
    if body is None and len(available) == 1:
        return available[0]
    if body in available:
        return str(body)
    held = f"It holds: {', '.join(available) or 'none'}."
    if body is None and available:
        one = f"Specify one: body={available[0]!r}."
        raise NotStated("body", f"body: no body named and the file holds several. {held} {one}")
    raise InvalidArgument(f"body: no body {body!r} in the file. {held}")
