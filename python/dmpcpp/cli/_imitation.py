"""`dmpcpp demo` and `dmpcpp imitate`: a recorded motion, carried out by an arm under physics."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._add_options import add_options
from dmpcpp.cli._arm_options import arm_options, contact_options, follow_option, taken_arm, taken_surroundings
from dmpcpp.cli._choices import engines
from dmpcpp.cli._config import save_config
from dmpcpp.cli._flags import as_typed, flag
from dmpcpp.cli._group import FAILED, refuse_file
from dmpcpp.cli._limit_options import accept_option, dynamics_option, names
from dmpcpp.cli._options import (
    DEFAULT_ENGINE,
    SHOWN_ENGINE,
    placing_options,
    preparation_options,
    taken_placing,
    taken_preparation,
)
from dmpcpp.cli._recording_options import recording_options, taken_recording
from dmpcpp.cli._robot_files import export_option, print_written
from dmpcpp.cli._tables import arm_line, note_style, print_checks, print_figures, way
from dmpcpp.cli._tempo_options import taken_tempo, tempo_options
from dmpcpp.cli._verdict import print_verdict
from dmpcpp.errors import InvalidArgument, MissingDependency

if TYPE_CHECKING:
    from dmpcpp._core import Arm
    from dmpcpp.imitation import Imitation, Progress
    from dmpcpp.recordings import Recording


_DEMO = {"clip": "dance_b", "body": "right_hand", "arm": "panda"}


def _run_options(
    default_out: str | None, shown: str | bool = True
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    def decorate(command: Callable[..., None]) -> Callable[..., None]:
        options = (
            click.option(
                "--out",
                default=default_out,
                show_default=shown,
                type=click.Path(file_okay=False, path_type=Path),
                help="Folder for the model, plan, joints, execution, picture, summary, config and report.",
            ),
            click.option(
                "--seed",
                default=0,
                show_default=True,
                type=click.IntRange(0),
                help="Random seed of the placement search.",
            ),
            click.option(
                "--basis-count",
                type=click.IntRange(1, 100000),
                help="Number of kernels (default: as many as the motion needs).",
            ),
            click.option(
                "--simulator",
                default=DEFAULT_ENGINE,
                show_default=SHOWN_ENGINE,
                type=engines("both"),
                help="Physics engine; both: run and compare the two.",
            ),
            export_option,
            accept_option,
            dynamics_option,
            tempo_options,
            click.option("--no-report", is_flag=True, help="Skip report.html; `dmpcpp report` makes it later."),
            click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON instead of the table."),
        )
        return add_options(command, options)

    return decorate


@click.command()
@click.option("--clip", default=_DEMO["clip"], show_default=True, help="One of the clips that ship with PyBullet.")
@click.option("--body", default=_DEMO["body"], show_default=True, help="Body whose motion is used.")
@arm_options
@follow_option
@contact_options
@_run_options(None, "dmpcpp-demo[-CLIP][-BODY][-ARM][-BASE][-TIP], non-default values only")
def demo(clip: str, body: str, **run: Any) -> None:
    """Run `dmpcpp imitate` on a human motion that ships with PyBullet.

    Example: dmpcpp demo --clip dance_b --arm iiwa --out dance
    """
    from dmpcpp import recordings

    if run["out"] is None:
        run["out"] = _demo_folder({"clip": clip, "body": body, "arm": run["arm"]}, run["base"], run["tip"])
        click.get_current_context().params["out"] = run["out"]  # which config.toml shall hold
    arm, surroundings = taken_arm(run), taken_surroundings(run)
    _carry_out(recordings.clip(clip, body), arm, surroundings=surroundings, **taken_tempo(run), **run)


def _demo_folder(chosen: dict[str, str], base: str | None, tip: str | None) -> Path:
    """Return a folder of its own for every clip, body and arm; dmpcpp-demo for what is shown unless stated."""
    other = [Path(value).name for name, value in chosen.items() if value != _DEMO[name]]
    return Path("-".join(["dmpcpp-demo", *other, *filter(None, (base, tip))]))


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.argument("second", required=False, type=click.Path(path_type=Path))
@recording_options
@preparation_options
@placing_options
@arm_options
@follow_option
@contact_options
@click.option(
    "--rhythmic", is_flag=True, help="FILE repeats: learn one cycle of it, found by itself, and execute --cycles."
)
@click.option("--cycles", default=5, show_default=True, type=click.IntRange(2, 1000), help="Cycles of --rhythmic.")
@click.option(
    "--minimum-period",
    default=0.0,
    type=click.FloatRange(0),
    metavar="S",
    help="Shortest period [s] of --rhythmic, where half of it would pass for one.",
)
@_run_options("dmpcpp-imitation")
def imitate(file: Path, **options: Any) -> None:
    """Execute the motion in FILE, a recording in any format that `dmpcpp inspect` reads.

    FILE may be a video of a hand, and SECOND another of the same motion from the side (extra cameras).

    Example: dmpcpp imitate reach.bvh --body RightHand --unit cm --arm panda --out reach
    """
    from dmpcpp import motion, recordings

    preparation, smooth = taken_preparation(options)
    placing = taken_placing(options)
    rhythm = _taken_rhythm(options)
    how = {"surroundings": taken_surroundings(options), "follow": options.pop("follow"), **taken_tempo(options)}
    if callable(placing["place"]):
        placing["place"] = partial(placing["place"], follow=how["follow"])
    taken = (
        "out",
        "seed",
        "basis_count",
        "simulator",
        "formats",
        "accept",
        "dynamics",
        "no_report",
        "as_json",
        "keep_rests",
    )
    run = {name: options.pop(name) for name in taken}
    loaded = recordings.load_all(file, **taken_recording(options))
    recording, *others = [part for each in loaded for part in motion.prepare_all(each, preparation)]
    _carry_out(recording, taken_arm(options), smooth=smooth, others=others, **placing, **how, **rhythm, **run)


def _taken_rhythm(options: dict[str, Any]) -> dict[str, Any]:
    """Take what --rhythmic states out of the options."""
    rhythmic, cycles, period = (options.pop(name) for name in ("rhythmic", "cycles", "minimum_period"))
    source = click.get_current_context().get_parameter_source
    for name in ("cycles", "minimum_period"):
        if not rhythmic and source(name) == click.core.ParameterSource.COMMANDLINE:
            raise InvalidArgument(f"{flag(name)}: without --rhythmic it says nothing. State --rhythmic too.")
    return {"cycles": cycles, "minimum_period": period} if rhythmic else {}


def _carry_out(
    recording: Recording,
    arm: Arm,
    *,
    out: Path,
    seed: int,
    basis_count: int | None,
    simulator: str,
    formats: tuple[str, ...],
    accept: tuple[str, ...],
    dynamics: str,
    no_report: bool,
    as_json: bool,
    **how: Any,
) -> None:
    from dmpcpp import export, imitation

    refuse_file(out)
    accepted = names(accept)
    export.chosen(formats, arm)  # what cannot be written is refused before anything runs
    with _progress(as_json) as progress:
        run = imitation.imitate(
            recording,
            arm,
            seed=seed,
            basis_count=basis_count,
            simulator=simulator,
            accept=accepted,
            dynamics=dynamics,
            progress=progress,
            **how,
        )
    sent = imitation.write(run, out, formats)
    save_config(out / "config.toml")
    missing = None if no_report else _report(out)
    if as_json:
        click.echo(json.dumps(run.summary(), indent=2, allow_nan=False))
    else:
        _print(run, out)
    whole = print_written(sent, run.ok, "not verified", quiet=as_json)
    if missing:
        click.echo(f"dmpcpp: no report: {missing}", err=True)
    if not (run.ok and whole):
        sys.exit(FAILED)


def _report(out: Path) -> str | None:
    """Make the report; return what is missing for it, if something is: the run itself is good without."""
    from dmpcpp.show import report

    try:
        report.write(out)
    except MissingDependency as error:
        (out / "report.html").unlink(missing_ok=True)  # an older one describes another run
        return str(error)
    return None


@contextmanager
def _progress(hidden: bool) -> Iterator[Progress]:
    """Show a bar on stderr while the flow runs."""
    from rich.console import Console
    from rich.progress import BarColumn, SpinnerColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    from dmpcpp.imitation import STAGES

    titles = {
        "place": "placing the motion in the arm's workspace",
        "learn": "learning the motion",
        "solve": "solving the inverse kinematics",
        "execute": "executing under physics",
    }
    columns = (SpinnerColumn(), TextColumn("{task.description:<42}"), BarColumn(), TimeElapsedColumn())
    with Bar(*columns, console=Console(stderr=True), transient=True, disable=hidden or not sys.stderr.isatty()) as bar:
        task = bar.add_task(titles[STAGES[0]], total=len(STAGES))

        def tell(stage: str, done: float) -> None:
            bar.update(task, description=titles[stage], completed=STAGES.index(stage) + done)

        yield tell


def _print(run: Imitation, out: Path) -> None:
    from rich.console import Console
    from rich.table import Table

    from dmpcpp.robot import assumptions

    console = Console(highlight=False)
    for line in run.recording.history:
        console.print(line, style=note_style(line), soft_wrap=True, markup=False)
    console.print(run.evidence.sentence, soft_wrap=True, markup=False)
    console.print(f"arm: {arm_line(run.log.arm)}", soft_wrap=True, markup=False)
    if run.contacts:
        style = "yellow" if run.contacts.unjudged else "dim"
        console.print(f"contacts: {run.contacts.describe()}", style=style, soft_wrap=True, markup=False)
    for line in run.log.arm.warnings:
        console.print(f"arm: {line}", style="yellow", soft_wrap=True, markup=False)
    console.print(
        f"{run.model.options.basis_count} kernels; {run.plan.time[-1]:.2f} s, "
        f"{run.slowdown:.2f} x the recorded duration; {way(run.model)} m in the frame of '{run.log.arm.base}'",
        soft_wrap=True,
        markup=False,
    )
    if run.calmer:
        console.print(as_typed(run.calmer.describe()), style="yellow", soft_wrap=True, markup=False)
    console.print(_errors_table(run, Table))
    print_figures(console, run.summary())
    print_checks(console, run.checks)
    assumed, changed = assumptions(run.log.arm), run.changed
    print_verdict(console, run, _how(run), assumed=assumed, changed=changed, advice=_advice(run))
    if run.sent.note():
        console.print(run.sent.note(), style="yellow", soft_wrap=True, markup=False)
    console.print(f"written to {out}/", soft_wrap=True, markup=False)


_ADVICE = {
    "self_collision": "The arm touches itself: move the path away from its base, or let it be placed.",
    "ik_position_residual": "The path leaves what the arm can reach: let it be placed, or crop it.",
    "reproduction_position_rmse": "The recording is noisy or fast for its rate: --smooth, --low-pass or --end help.",
}


def _advice(run: Imitation) -> str:
    """What to do about the likely cause of a failure."""
    failed = {check.name for check in run.failed}
    return next((advice for name, advice in _ADVICE.items() if name in failed), "")


def _how(run: Imitation) -> str:
    """Tempo, engine, control mode and caveats."""
    engines = " and ".join(log.simulator for log in (run.log, run.second_log) if log is not None)
    followed = run.log.follow.describe()
    asked = f"{followed[0].upper()}{followed[1:]}. " if followed else ""
    tempo = f"{run.tempo.describe(run.log.arm.joint_names)} " if run.tempo else ""
    return f"{tempo}{asked}{run.log.arm.name}, {engines}, {run.log.mode} ({run.log.caveat})."


def _errors_table(run: Imitation, table_type: type) -> Any:
    from rich.markup import escape

    names = {
        "demonstration_to_dmp": "demonstration → DMP",
        "recording_to_fitted": "recording → fitted",
        "dmp_to_fitted": "DMP → fitted",
        "dmp_to_ik": "DMP → FK(IK)",
        "ik_to_executed": "FK(IK) → executed",
    }
    table = table_type(title="errors", title_justify="left")
    table.add_column("stage")
    for title in ("position RMSE [mm]", "max [mm]", "angle RMSE [deg]", "max [deg]"):
        table.add_column(escape(title), justify="right")
    for stage, errors in run.stages.items():
        lengths = (1e3 * errors.position_rmse, 1e3 * errors.position_max)
        turns = (57.29577951308232 * errors.angle_rmse, 57.29577951308232 * errors.angle_max)
        table.add_row(
            names[stage],
            *(f"{value:.2g}" if value < 0.01 else f"{value:.3f}" for value in (*lengths, *turns)),
        )
    return table
