"""At what tempo a motion is carried out, for commands."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from dmpcpp.cli._add_options import add_options

__all__ = ["taken_tempo", "tempo_option", "tempo_options"]

_POLICIES = ["person", "uniform", "fastest"]


def tempo_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --tempo."""
    return click.option(
        "--tempo",
        default="person",
        show_default=True,
        type=click.Choice(_POLICIES),
        help="person: the recorded timing, slower only where the arm's limits bind; uniform: slower by one factor; "
        "fastest: as fast as the limits allow, from rest to rest.",
    )(command)


def tempo_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add --tempo, --slowest and --tolerance; `taken_tempo` takes them out of a command's arguments."""
    slowest = click.option(
        "--slowest",
        type=click.FloatRange(1.0),
        metavar="FACTOR",
        help="Fail where the motion takes more than FACTOR times its recorded duration (default: 10).",
    )
    tolerance = click.option(
        "--tolerance",
        default="1mm,0.5deg",
        show_default=True,
        metavar="LENGTH,ANGLE|0",
        help="How far the tip may be from the learned path at most where the limits then ask for less time; 0: the "
        "learned path itself.",
    )
    return add_options(command, (tempo_option, slowest, tolerance))


def taken_tempo(options: dict[str, Any]) -> dict[str, Any]:
    """Take the options out of a command's arguments, as keywords of `imitate` and `plan`."""
    return {name: options.pop(name) for name in ("tempo", "slowest", "tolerance")}
