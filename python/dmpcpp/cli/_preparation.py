"""The options that say what shall be done to a recording before it is learned."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from dmpcpp.motion import Preparation


def preparation_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options to a command; `taken_preparation` takes them out of its arguments."""
    options = (
        click.option("--start", type=float, default=0.0, metavar="S", help="Use the motion from here [s]."),
        click.option("--end", type=float, metavar="S", help="Use the motion up to here [s]."),
        click.option(
            "--longest-gap",
            type=click.FloatRange(0, min_open=True),
            default=0.2,
            show_default=True,
            metavar="S",
            help="Fill gaps in the recording up to this long [s]; refuse longer ones.",
        ),
        click.option("--keep-outliers", is_flag=True, help="Do not replace samples far from where they should be."),
        click.option(
            "--segment",
            type=click.IntRange(1),
            metavar="K",
            help="Use the K-th part between rests only, counted from 1.",
        ),
        click.option(
            "--repetition",
            type=click.IntRange(1),
            metavar="K",
            help="Use the K-th whole cycle (away from where the hand starts and back) only, counted from 1.",
        ),
        click.option(
            "--resample", type=click.FloatRange(0, min_open=True), metavar="HZ", help="Sample at this even rate."
        ),
        click.option(
            "--low-pass",
            type=click.FloatRange(0, min_open=True),
            metavar="HZ",
            help="Remove what is faster (zero-phase Butterworth).",
        ),
        click.option(
            "--smooth/--no-smooth",
            default=None,
            help="Take the noise out that is found in the recording, or never do; by default where it is learned and "
            "needs it.",
        ),
    )
    for option in reversed(options):
        command = option(command)
    return command


def taken_preparation(options: dict[str, Any]) -> tuple[Preparation, bool]:
    """Take the options out of a command's arguments: the preparation, and whether learning may smooth."""
    from dmpcpp.motion import Preparation

    smooth: bool | None = options.pop("smooth")
    taken = {name: options.pop(name) for name in _FIELDS}
    keep_outliers: bool = options.pop("keep_outliers")
    return Preparation(**taken, outliers=not keep_outliers, smooth=smooth is True), smooth is not False


_FIELDS = ("start", "end", "longest_gap", "segment", "repetition", "resample", "low_pass")
