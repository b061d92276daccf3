"""Files of an earlier run."""

from __future__ import annotations

from pathlib import Path

import click


def set_aside(*paths: Path) -> None:
    """Rename the files of an earlier run, which nobody shall take for those of this one."""
    for path in paths:
        if path.exists():
            older = path.with_name(f"{path.name}.old")
            path.replace(older)
            click.echo(f"dmpcpp: {path} is of an earlier run; renamed to {older.name}.", err=True)
