"""`dmpcpp example`: small recordings to type along with."""

from __future__ import annotations

from pathlib import Path

import click
from click.shell_completion import CompletionItem

_NEXT = {
    "reach": "dmpcpp imitate reach.bvh --body RightHand --unit cm --arm panda --out reach",
    "takes": "dmpcpp fit takes/reach_1.csv takes/reach_2.csv takes/reach_3.csv --arm panda --out takes.json",
    "session": "dmpcpp imitate session.csv --segment 2 --arm panda --out second",
    "stir": "dmpcpp imitate stir.csv --arm panda --out stir",
    "screw": "dmpcpp imitate screw.csv --arm panda --out screw",
    "phone": "dmpcpp imitate phone.csv --arm panda --out phone",
    "lift": "dmpcpp imitate lift.trc --markers WRIST,STYLr,STYLu --up-axis z --arm panda --out lift",
    "robot": "dmpcpp check-urdf my_robot.urdf",
    "log": "dmpcpp verify reach log.csv --arm panda",
}


class _Name(click.types.StringParamType):
    """The name of an example; completed by the shell, checked where it is written."""

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        from dmpcpp import examples

        return [
            CompletionItem(name, help=example.what)
            for name, example in examples.EXAMPLES.items()
            if name.startswith(incomplete)
        ]


@click.command()
@click.argument("name", type=_Name(), required=False)
@click.option("--out", default=".", metavar="DIR", type=click.Path(path_type=Path), help="Folder to write into.")
@click.option("--run", "run", metavar="DIR", type=click.Path(path_type=Path), help="For log: folder of the run.")
@click.option("--overwrite", is_flag=True, help="Replace files that are there with other contents.")
def example(name: str | None, out: Path, run: Path | None, overwrite: bool) -> None:
    """Write the example recording NAME; without a NAME list them.

    The recordings are generated, a few kB each: reach, takes, session, stir, screw, phone and lift; robot is an arm
    as a URDF, and log what a robot would have recorded of a run.

    Example: dmpcpp example reach
    """
    from dmpcpp import examples

    if name is None:
        for known, entry in examples.EXAMPLES.items():
            click.echo(f"{known:<9}{entry.what}: {', '.join(entry.files)}")
        click.echo("write one: dmpcpp example NAME")
        return
    for path in examples.write(name, out, run=run, overwrite=overwrite):
        click.echo(f"written: {path}")
    click.echo(f"next: {_NEXT[name]}")
