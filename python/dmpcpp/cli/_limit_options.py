"""Options of the limits by which a run is judged, and of what is accepted unjudged."""

from __future__ import annotations

from collections.abc import Callable

import click

__all__ = ["accept_option", "names"]


def accept_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --accept."""
    return click.option(
        "--accept",
        metavar="CHECK[,CHECK]",
        multiple=True,
        help="Accept checks that cannot be judged, e.g. torque_ratio for an arm without effort limits; never one "
        "that failed.",
    )(command)


def names(stated: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names in values such as "a,b" of an option that may be repeated; InvalidArgument for unknown ones."""
    from dmpcpp.checks import accepted_names

    return accepted_names(name.strip() for text in stated for name in text.split(",") if name.strip())
