"""What every file format offers, and how one body is picked out of those a file holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings.recording import Recording

__all__ = ["Reader", "pick_body"]


@dataclass(frozen=True)
class Reader:
    """One file format.

    Parameters
    ----------
    name : str
        What the caller writes in `format=`.
    summary : str
        A few words for the error that lists the formats.
    recognises : (path, first bytes of the file) -> bool
        True only when no other reader could be meant.
    bodies : (path, **stated) -> tuple of str
        The bodies that the file holds.
    read : (path, body or None, **stated) -> Recording
        Keyword-only parameters are what the caller may state about the file.
    """

    name: str
    summary: str
    recognises: Callable[[Path, bytes], bool]
    bodies: Callable[..., tuple[str, ...]]
    read: Callable[..., Recording]


def pick_body(body: str | None, available: Sequence[str]) -> str:
    """Return `body` if the file holds it, or the only one there is.

    Raises
    ------
    InvalidArgument
        The body is not there, or none was named and there are several; the message lists them.
    """
    if body is None and len(available) == 1:
        return available[0]
    if body in available:
        return str(body)
    asked = "no body named and the file holds several" if body is None else f"no body {body!r} in the file"
    raise InvalidArgument(f"body: {asked}. It holds: {', '.join(available) or 'none'}.")
