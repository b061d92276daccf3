"""The files for a robot, as commands offer and report them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import click

from dmpcpp.cli._choices import exports

if TYPE_CHECKING:
    from dmpcpp.export import Written

__all__ = ["export_option", "print_written"]


def export_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --export."""
    return click.option(
        "--export",
        "formats",
        multiple=True,
        type=exports(),
        help="Also write a file for a robot if verified: joints.yaml, joints_goal.yaml, joints_bag, joints.script, "
        "joints.npz. Repeatable.",
    )(command)


def print_written(written: Written, ok: bool, why: str, *, quiet: bool = False) -> bool:
    """Print what a robot may get and what was refused; whether nothing was."""
    if not quiet:
        click.echo(f"for the robot: {', '.join(written)}" if ok else f"for the robot: nothing, as it is {why}")
    for file, reason in written.refused.items():
        click.echo(f"dmpcpp: {file} was not written: {reason}", err=True)
    return not written.refused
