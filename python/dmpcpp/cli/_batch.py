"""`dmpcpp batch`: every recording of a folder, carried out by an arm."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._arm_options import arm_options, contact_options, follow_option, taken_choice, taken_surroundings
from dmpcpp.cli._choices import engines
from dmpcpp.cli._config import save_config
from dmpcpp.cli._flags import as_typed
from dmpcpp.cli._group import FAILED, ended_by_sigterm, refuse_file
from dmpcpp.cli._limit_options import accept_option, dynamics_option, names
from dmpcpp.cli._options import (
    DEFAULT_ENGINE,
    SHOWN_ENGINE,
    preparation_options,
    scale_range,
    taken_preparation,
)
from dmpcpp.cli._recording_options import recording_options, taken_recording
from dmpcpp.cli._tempo_options import taken_tempo, tempo_options

if TYPE_CHECKING:
    from dmpcpp.trials.batch import Outcome


@click.command()
@click.argument("folder", type=click.Path(path_type=Path), metavar="FOLDER")
@recording_options
@preparation_options
@arm_options
@follow_option
@contact_options
@click.option("--pattern", default="*", show_default=True, metavar="GLOB", help="Which files, such as **/*.bvh.")
@click.option(
    "--scale",
    metavar="S|MIN:MAX",
    help="Scale of positions, or its range (default: 0.25:1; smaller if none is feasible).",
)
@click.option("--no-place", is_flag=True, help="Skip placement: poses are already tip poses in the base frame.")
@click.option("--basis-count", type=click.IntRange(1, 100000), help="Number of kernels (default: as many as needed).")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="Random seed of the placement.")
@click.option(
    "--simulator",
    default=DEFAULT_ENGINE,
    show_default=SHOWN_ENGINE,
    type=engines("both"),
    help="Physics engine.",
)
@accept_option
@dynamics_option
@tempo_options
@click.option("--jobs", default=1, show_default=True, type=click.IntRange(1), help="Processes at a time.")
@click.option("--reports", is_flag=True, help="Also write each run's report.html.")
@click.option(
    "--out",
    default="dmpcpp-batch",
    show_default=True,
    type=click.Path(file_okay=False, path_type=Path),
    help="Output folder: one subfolder per recording, outcomes.csv, index.html and config.toml.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON instead of the table.")
def batch(
    folder: Path,
    arm: str,
    pattern: str,
    scale: str | None,
    no_place: bool,
    basis_count: int | None,
    seed: int,
    simulator: str,
    accept: tuple[str, ...],
    dynamics: str,
    jobs: int,
    reports: bool,
    out: Path,
    as_json: bool,
    **options: Any,
) -> None:
    """Carry out every recording in FOLDER as `dmpcpp imitate` does; one bad file does not stop the others.

    Stop it at any time: the next run goes on. Exit status: 0 all verified, 3 some not.

    Example: dmpcpp batch takes --pattern '*.csv' --arm panda --jobs 2 --out results
    """
    from dmpcpp.robot import arms
    from dmpcpp.trials import batch as library

    refuse_file(out)
    choice = taken_choice(options)
    arms.load(arm, **choice)  # refuses a name or file that is none, before anything runs
    preparation, smooth = taken_preparation(options)
    how = {
        "seed": seed,
        "place": not no_place,
        "scale": scale_range(scale),
        "smooth": smooth,
        "keep_rests": options.pop("keep_rests"),
        "basis_count": basis_count,
        "simulator": simulator,
        "accept": list(names(accept)),
        "dynamics": dynamics,
        "follow": options.pop("follow"),
        "surroundings": taken_surroundings(options).to_dict(),
        "report": reports,
        **taken_tempo(options),
    }
    reading = taken_recording(options)
    work = library.tasks(
        folder,
        out,
        pattern=pattern,
        arm=arm,
        **choice,
        reading=reading,
        preparation=asdict(preparation),
        options=how,
    )
    out.mkdir(parents=True, exist_ok=True)
    save_config(out / "config.toml")
    with ended_by_sigterm(), _progress(as_json) as progress:
        outcomes = library.imitate_many(work, jobs=jobs, progress=progress)
    library.write_tables(outcomes, out)
    if as_json:
        click.echo(json.dumps(library.summary(outcomes), indent=2, allow_nan=False))
    else:
        _print(outcomes, out)
    if not all(outcome.ok for outcome in outcomes):
        sys.exit(FAILED)


@contextmanager
def _progress(hidden: bool) -> Iterator[Callable[[int, int, int], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    off = hidden or not sys.stderr.isatty()
    with Progress(*columns, console=Console(stderr=True), transient=True, disable=off) as bar:
        task = bar.add_task("recordings")

        def tell(done: int, bad: int, total: int) -> None:
            bar.update(task, completed=done, total=total, description=f"recordings, {bad} not verified")

        yield tell


def _print(outcomes: list[Outcome], out: Path) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from dmpcpp.trials.batch import first_line

    console = Console(highlight=False)
    table = Table(title="recordings", title_justify="left")
    for title in ("", "recording", "learned mm", "executed mm", "slowdown", "cause"):
        table.add_column(title)
    marks = {
        "pass": "[green]pass[/]",
        "not judged": "[yellow]not judged[/]",
        "fail": "[bold red]fail[/]",
        "error": "[bold red]error[/]",
    }
    for outcome in outcomes:
        stages = ("demonstration_to_dmp", "ik_to_executed")
        numbers = [f"{1e3 * outcome.errors[s]['position_rmse']:.3g}" if outcome.errors else "-" for s in stages]
        slow = f"{outcome.slowdown:.2f}" if outcome.errors else "-"
        table.add_row(
            marks[outcome.verdict],
            escape(Path(outcome.file).name),
            *numbers,
            slow,
            escape(as_typed(first_line(outcome.cause))),
        )
    console.print(table)
    passed = sum(outcome.ok for outcome in outcomes)
    console.print(f"{passed} of {len(outcomes)} verified; written to {out}/", markup=False, soft_wrap=True)
