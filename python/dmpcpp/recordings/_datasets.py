"""What data sets of many episodes share: choosing an episode, the extra that reads them, limits on sizes."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from types import ModuleType

import numpy as np

from dmpcpp.errors import InvalidArgument, MissingDependency, NotStated

__all__ = ["LARGEST", "Allowance", "chosen_episode", "needed"]

LARGEST = 256 * 1024 * 1024
"""Bytes in memory of all arrays of one recording; a hand's motion needs no more, and a hostile file may claim any."""


class Allowance:
    """The bytes that the arrays of one file may still take in memory, all together: `LARGEST` at first."""

    def __init__(self) -> None:
        """Begin with all of it."""
        self.left = LARGEST
        self._counted: set[str] = set()

    def take(self, name: str, shape: Sequence[int], kind: np.dtype) -> None:
        """Count an array that is about to be read, once; numbers become float64, whatever they are in the file.

        Raises
        ------
        InvalidArgument
            The array, with those before, needs more than is left.
        """
        if name in self._counted:
            return
        size = int(np.prod([int(n) for n in shape], dtype=object)) * max(kind.itemsize, 8)
        if size > self.left:
            raise InvalidArgument(
                f"{name}: {size} bytes in memory, expected at most {LARGEST} with the other arrays of the recording. "
                "Cut the file into shorter recordings."
            )
        self.left -= size
        self._counted.add(name)


def needed(module: str, what: str) -> ModuleType:
    """Return a module of the extra `datasets`.

    Raises
    ------
    MissingDependency
        It is not installed; the message names the extra.
    """
    try:
        return import_module(module)
    except ImportError:
        package = module.split(".")[0]
        raise MissingDependency(f'{what} are read by {package}. Install it: pip install "dmpcpp[datasets]".') from None


def chosen_episode(episode: int | None, available: Sequence[int], what: str) -> int:
    """Return the episode that was specified, or the only one.

    Raises
    ------
    NotStated
        None was specified and there are several.
    InvalidArgument
        It is not there.
    """
    count = len(available)
    if episode is None and count == 1:
        return available[0]
    span = f"{available[0]} to {available[-1]}" if count else "none"
    if episode is None:
        raise NotStated(
            "episode",
            f"episode: {what} of {count} episodes, {span}. Specify one: episode={available[-1]} (or learn them "
            "together: episode='all').",
            [{"episode": number} for number in available],
        )
    if isinstance(episode, bool) or episode not in available:
        raise InvalidArgument(f"episode: {episode!r}, but {what} holds {count} episodes, {span}.")
    return episode
