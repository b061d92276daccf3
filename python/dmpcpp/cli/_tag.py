"""`dmpcpp tag`: tags and boards to print."""

from __future__ import annotations

from pathlib import Path

import click

from dmpcpp.errors import InvalidArgument


@click.command()
@click.option(
    "--print",
    "print_",
    required=True,
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE.svg|FILE.pdf",
    help="Where the A4 pages are written.",
)
@click.option(
    "--tag",
    default="0:60mm",
    show_default=True,
    metavar="ID:SIZE",
    help="Tags of the family 36h11 and their black side: 0:60mm, or 0-4:40mm,cube:50mm for the faces of a cube.",
)
@click.option("--board", metavar="5x7:30mm", help="A board for two cameras in place of tags: squares and their side.")
def tag(print_: Path, tag: str, board: str | None) -> None:
    """Write tags, or a board, to print: what `dmpcpp imitate VIDEO --tag` and `--board` look for.

    Example: dmpcpp tag --tag 0:60mm --print tag.pdf
    """
    from dmpcpp import cameras

    source = click.get_current_context().get_parameter_source("tag")
    if board is not None and source is click.core.ParameterSource.COMMANDLINE:
        raise InvalidArgument("--tag, --board: both are stated, expected one of them.")
    if board is not None:
        cameras.print_board(print_, cameras.board_of(board))
    else:
        cameras.print_tags(print_, cameras.body_of_tags(tag))
    click.echo(f"written to {print_}: print at 100 %, and measure the ruler")
