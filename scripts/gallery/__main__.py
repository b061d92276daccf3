"""Make the pictures: `python -m scripts.gallery [NAME ...] [--out docs/gallery]`; all of them unless named."""

from __future__ import annotations

from pathlib import Path

import click
from dmpcpp import plot
from dmpcpp._atomic import replacing

from scripts.gallery.pictures import PICTURES

DOCS = Path(__file__).resolve().parents[2] / "docs" / "gallery"
_DPI = 90.0


def make(name: str, folder: Path) -> Path:
    """Draw one picture into a folder and return its file."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.png"
    with replacing(path) as beside:
        beside.write_bytes(plot.png(PICTURES[name](), dpi=_DPI))
    return path


@click.command()
@click.argument("names", nargs=-1, type=click.Choice(list(PICTURES)))
@click.option("--out", default=DOCS, type=click.Path(file_okay=False, path_type=Path), help="Where they go.")
def main(names: tuple[str, ...], out: Path) -> None:
    """Make the pictures named, or all."""
    for name in names or tuple(PICTURES):
        path = make(name, out)
        click.echo(f"{path}  {path.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
