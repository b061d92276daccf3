"""A key that has to be held while a robot moves; a terminal reports no release, so a silence of 0.7 s is one."""

from __future__ import annotations

import os
import select
import sys
import termios
import time
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager

__all__ = ["held_key", "wait_for_key"]

_SILENCE = 0.7  # s; keys repeat 10 to 30 times a second, the first time after 0.25 to 0.5 s
_LOOK = 0.05  # s
_EVERY = 10  # cycles of a robot between two looks at the terminal


@contextmanager
def _single_keys() -> Iterator[int]:
    """Keys without a line end and without an echo; Ctrl-C goes on to be a signal."""
    terminal = sys.stdin.fileno()
    before = termios.tcgetattr(terminal)
    tty.setcbreak(terminal)
    try:
        yield terminal
    finally:
        termios.tcsetattr(terminal, termios.TCSADRAIN, before)


def _pressed(terminal: int, wait: float) -> bool | None:
    """Whether space came within a time; None where the terminal is gone."""
    if not select.select([terminal], [], [], wait)[0]:
        return False
    try:
        keys = os.read(terminal, 64)
    except OSError:
        return None
    return b" " in keys if keys else None


def wait_for_key() -> bool:
    """Wait until space is pressed; False where the terminal is gone."""
    with _single_keys() as terminal:
        while True:
            pressed = _pressed(terminal, _LOOK)
            if pressed is not False:
                return bool(pressed)


@contextmanager
def held_key() -> Iterator[Callable[[], bool]]:
    """Give what tells in every cycle of a robot whether space was let go, or the terminal lost."""
    with _single_keys() as terminal:
        yield _Released(terminal)


class _Released:
    """Looks at the terminal every ten calls, without waiting."""

    def __init__(self, terminal: int) -> None:
        """Take the key as pressed now."""
        self._terminal, self._calls, self._last = terminal, 0, time.monotonic()

    def __call__(self) -> bool:
        """Whether it was let go."""
        self._calls += 1
        if self._calls % _EVERY:
            return False
        pressed = _pressed(self._terminal, 0.0)
        if pressed:
            self._last = time.monotonic()
        return pressed is None or time.monotonic() - self._last > _SILENCE
