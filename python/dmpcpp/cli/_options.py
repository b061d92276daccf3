"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Callable

import click


def arm_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add --arm, --base and --tip."""
    options = (
        click.option(
            "--arm",
            default="panda",
            show_default=True,
            metavar="NAME|FILE.urdf",
            help="panda, iiwa, xarm6, or a URDF.",
        ),
        click.option("--base", metavar="LINK", help="Where the arm of a URDF begins; its root unless given."),
        click.option(
            "--tip",
            metavar="LINK",
            help="The link of a URDF that follows the motion; its only leaf unless given.",
        ),
    )
    for option in reversed(options):
        command = option(command)
    return command
