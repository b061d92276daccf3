"""`dmpcpp view`: a model in the browser."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from dmpcpp.cli._arm_options import arm_options, follow_option, taken_arm
from dmpcpp.cli._choices import scaling_option
from dmpcpp.cli._flags import as_typed


@click.command()
@click.argument("model", type=click.Path(path_type=Path), metavar="MODEL")
@arm_options
@follow_option
@scaling_option
@click.option("--host", default="127.0.0.1", show_default=True, help="Address to listen on (0.0.0.0: every interface).")
@click.option(
    "--port",
    default=8080,
    show_default=True,
    type=click.IntRange(1, 65535),
    help="Port; the next free one if it is taken.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the page's address as JSON.")
def view(model: Path, scaling: str, host: str, port: int, as_json: bool, **arm: Any) -> None:
    """Show MODEL, a model file, in the browser: drag its goal and start, change time, gain and kernels.

    The motion, the arm's joints and how near they come to their limits follow at once. Ctrl-C ends it.

    Example: dmpcpp view reach/model.json --arm panda
    """
    from dmpcpp import load, planning
    from dmpcpp.show import view as library

    led, chosen = planning.with_scaling(load(model), scaling)

    def ready(address: str) -> None:
        said = {"address": address, "scaling": chosen.to_dict()}
        lines = [as_typed(chosen.describe()), *chosen.notes, f"open {address} (Ctrl-C ends it)"]
        click.echo(json.dumps(said) if as_json else "\n".join(lines))

    library.serve(led, taken_arm(arm), follow=arm["follow"], host=host, port=port, ready=ready)


@click.command()
@click.argument("folder", type=click.Path(path_type=Path), metavar="DIR")
@click.option("--json", "as_json", is_flag=True, help="Print where the page is, its size and the verdict as JSON.")
def report(folder: Path, as_json: bool) -> None:
    """Write report.html again in DIR, the folder of a run of `dmpcpp imitate` or `dmpcpp demo`.

    The page is one file that loads nothing: verdict and checks, the moving arm, figures, how to repeat the run.

    Example: dmpcpp report reach
    """
    from dmpcpp.show import report as library

    path = library.write(folder)
    size = path.stat().st_size
    if as_json:
        verdict = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["verdict"]
        click.echo(json.dumps({"report": str(path), "bytes": size, "verdict": verdict}, indent=2))
    else:
        click.echo(f"written to {path} ({size / 1e6:.1f} MB)")
