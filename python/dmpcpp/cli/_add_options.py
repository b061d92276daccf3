"""Options that several commands share, put on a command together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

__all__ = ["add_options"]

_Command = Callable[..., Any]


def add_options(command: _Command, options: Sequence[Callable[[_Command], _Command]]) -> _Command:
    """Put options on a command so that its help lists them in this order."""
    for option in reversed(options):
        command = option(command)
    return command
