"""`dmpcpp generality`: random motions, goals, tempi, arms and noise; how many pass, and why the others do not."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._arm_options import (
    arm_choice_options,
    contact_options,
    follow_option,
    taken_choice,
    taken_surroundings,
)
from dmpcpp.cli._config import save_config
from dmpcpp.cli._flags import as_typed
from dmpcpp.cli._group import FAILED, ended_by_sigterm, refuse_file
from dmpcpp.cli._limit_options import accept_option, dynamics_option, names
from dmpcpp.cli._tempo_options import taken_tempo, tempo_options

if TYPE_CHECKING:
    from rich.table import Table

    from dmpcpp.trials.generality import Distribution, Result


@click.command()
@click.option("-k", "--count", default=20, show_default=True, type=click.IntRange(1), help="Number of random motions.")
@click.option("--arm", "arms", multiple=True, metavar="NAME|FILE.urdf", help="Repeatable (default: panda and iiwa).")
@click.option("--noise", "noises", multiple=True, metavar="LEVEL", help="none, low, high; repeatable (default: all).")
@click.option(
    "--seed", default=0, show_default=True, type=click.IntRange(0), help="Random seed of motions, changes and noise."
)
@arm_choice_options
@follow_option
@contact_options
@accept_option
@dynamics_option
@tempo_options
@click.option("--jobs", default=2, show_default=True, type=click.IntRange(1), help="Processes at a time.")
@click.option(
    "--out",
    default="dmpcpp-generality",
    show_default=True,
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder for trials.jsonl and summary.json; trials that it holds are not repeated.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON instead of the table.")
def generality(
    count: int,
    arms: tuple[str, ...],
    noises: tuple[str, ...],
    seed: int,
    accept: tuple[str, ...],
    dynamics: str,
    jobs: int,
    out: Path,
    as_json: bool,
    **options: Any,
) -> None:
    """Learn, change, solve and execute random motions with several arms and levels of noise.

    Each is a sum of three sinusoids spanning 0.2-0.4 m and 30-90 deg, led to a goal up to 0.1 m away in half to
    twice its time. Stop it at any time: the next run goes on.

    Example: dmpcpp generality -k 20 --arm panda --out generality
    """
    from dmpcpp._atomic import write_text
    from dmpcpp.robot import arms as known
    from dmpcpp.robot import following
    from dmpcpp.trials import generality as library

    refuse_file(out)
    choice, around = taken_choice(options), taken_surroundings(options)
    how = {"follow": options["follow"], "dynamics": dynamics, "surroundings": around.to_dict(), **taken_tempo(options)}
    for arm in arms:
        following(known.load(arm, **choice), how["follow"])  # refuses what is none, before anything runs
    wanted = library.trials(
        count, arms or ("panda", "iiwa"), noises or tuple(library.NOISE), seed, names(accept), choice, how
    )
    out.mkdir(parents=True, exist_ok=True)
    with ended_by_sigterm(), _progress(as_json) as progress:
        results = library.run(wanted, out / "trials.jsonl", jobs, progress)
    summary = library.summary(results)
    text = json.dumps(summary, indent=2, allow_nan=False)
    write_text(out / "summary.json", text + "\n")
    save_config(out / "config.toml")
    if as_json:
        click.echo(text)
    else:
        _print(results, summary, out)
    if summary["verdict"] != "pass":
        sys.exit(FAILED)


@contextmanager
def _progress(hidden: bool) -> Iterator[Callable[[int, int, int], None]]:
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    times = (TimeElapsedColumn(), TextColumn("left"), TimeRemainingColumn())
    off = hidden or not sys.stderr.isatty()
    with Progress(*columns, *times, console=Console(stderr=True), transient=True, disable=off) as bar:
        task = bar.add_task("trials")

        def tell(done: int, failed: int, total: int) -> None:
            bar.update(task, completed=done, total=total, description=f"trials, {failed} failed")

        yield tell


def _print(results: list[Result], summary: dict[str, Any], out: Path) -> None:
    from rich.console import Console

    console = Console(highlight=False, width=None if sys.stdout.isatty() else 140)
    console.print(_table(results))
    for failure in summary["failures"]:
        which = f"{failure['arm']}, noise {failure['noise']}, motion {failure['index']}"
        console.print(f"{which}: {as_typed(failure['cause'])}", soft_wrap=True, markup=False)
    passed = summary["verdict"] == "pass"
    console.print("verified" if passed else "not verified", style="bold green" if passed else "bold red", end=": ")
    share, goal = 100 * summary["share_passed"], 100 * summary["goal"]
    console.print(f"{share:.1f} % of {summary['trials']} trials passed, expected {goal:.0f} %")
    console.print(f"written to {out}/", soft_wrap=True, markup=False)


def _table(results: list[Result]) -> Table:
    from rich.table import Table

    from dmpcpp.trials.generality import rows

    table = Table(title="median / 95 % / largest", title_justify="left")
    titles = (
        "arm",
        "noise",
        "passed",
        "as drawn",
        "learned mm",
        "learned deg",
        "goal mm",
        "tracked mm",
        "scale",
        "slowdown",
    )
    for title in titles:
        table.add_column(title, justify="left" if title in ("arm", "noise") else "right")
    for row in rows(results):
        table.add_row(
            row.arm,
            row.noise,
            f"{row.passed} of {row.trials}",
            str(row.as_drawn),
            _shown(row.learned_position, 1e3),
            _shown(row.learned_angle, 57.29577951308232),
            _shown(row.goal_miss, 1e3),
            _shown(row.tracked_position, 1e3),
            _shown(row.scale, 1.0),
            _shown(row.slowdown, 1.0),
        )
    return table


def _shown(found: Distribution | None, scale: float) -> str:
    if found is None:
        return "-"
    return " / ".join(f"{scale * value:.2g}" for value in (found.median, found.p95, found.largest))
