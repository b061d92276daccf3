"""Keep what a C++ library prints off the terminal."""

from __future__ import annotations

import contextlib
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
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(1), os.dup(2)]
    with tempfile.TemporaryFile() as sink:
        os.dup2(sink.fileno(), 1)
        os.dup2(sink.fileno(), 2)

        def heard() -> str:
            sink.seek(0)
            return sink.read().decode(errors="replace")

        try:
            yield heard
        finally:
            for descriptor, copy in zip((1, 2), kept, strict=True):
                os.dup2(copy, descriptor)
                os.close(copy)
