"""Files that appear whole or not at all: written beside their place, flushed to the disk, then renamed."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from dmpcpp.errors import FileError

__all__ = ["replacing", "write_text"]


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give the body of a `with` a file to write; it takes the place of `path` when the body ends well.

    Parameters
    ----------
    path : path
        The file to create or replace. Its folder must exist.

    Yields
    ------
    Path
        An empty file in the same folder with the same suffix, for any writer that takes a path. After an
        exception it is gone and `path` is as it was.

    Raises
    ------
    FileError
        The folder is missing, full or not writable, or `path` is a folder.
    """
    target = Path(path)
    beside = target.with_name(f".{target.stem[:100]}.{secrets.token_hex(6)}{target.suffix}")
    try:
        # Opened anew, and not with tempfile, so that the file gets the permissions of any other new file.
        beside.open("xb").close()
        try:
            yield beside
            _flush(beside)
            beside.replace(target)
        finally:
            beside.unlink(missing_ok=True)
        _flush(target.parent)
    except OSError as error:
        raise FileError(f"{target}: cannot be written ({error.strerror or error}).") from error


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write `text` as UTF-8 to `path`, whole or not at all.

    Raises
    ------
    FileError
        See `replacing`.
    """
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8", newline="\n")


def _flush(path: Path) -> None:
    """Wait until the file (or the folder's list of names) is on the disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
