"""`dmpcpp report`: the page of a run, made anew from its files."""

from __future__ import annotations

import json
from pathlib import Path

import click


@click.command()
@click.argument("folder", type=click.Path(path_type=Path), metavar="DIR")
@click.option("--json", "as_json", is_flag=True, help="Print where the page is, its size and the verdict as JSON.")
def report(folder: Path, as_json: bool) -> None:
    """Make report.html anew in DIR, the folder of a run of `dmpcpp imitate` or `dmpcpp demo`.

    The page is one file that loads nothing: verdict and checks, the moving arm, figures, how to repeat the run.

    Example: dmpcpp report dmpcpp-demo
    """
    from dmpcpp.show import report as library

    path = library.write(folder)
    size = path.stat().st_size
    if as_json:
        verdict = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["verdict"]
        click.echo(json.dumps({"report": str(path), "bytes": size, "verdict": verdict}, indent=2))
    else:
        click.echo(f"written to {path} ({size / 1e6:.1f} MB)")
