"""Keep what a C++ library prints off the terminal."""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
import tempfile
from collections.abc import Callable, Iterator


@contextlib.contextmanager
def quiet() -> Iterator[Callable[[], str]]:
    """Turn standard output and error away; yields a function that returns what was said.

    C++ writes past ``sys.stdout``, so the file descriptors themselves are turned: nothing else of the process
    reaches the terminal meanwhile. For short calls only.
    """
    _flush()
    kept = [os.dup(1), os.dup(2)]
    with tempfile.TemporaryFile() as sink:
        os.dup2(sink.fileno(), 1)
        os.dup2(sink.fileno(), 2)

        def heard() -> str:
            _flush()
            sink.seek(0)
            return sink.read().decode(errors="replace")

        try:
            yield heard
        finally:
            _flush()
            for descriptor, copy in zip((1, 2), kept, strict=True):
                os.dup2(copy, descriptor)
                os.close(copy)


def _flush() -> None:
    """Empty the buffers of Python and of C: into a pipe or a file the latter is written only when it is full."""
    sys.stdout.flush()
    sys.stderr.flush()
    ctypes.CDLL(None).fflush(None)
