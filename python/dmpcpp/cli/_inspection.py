"""`dmpcpp inspect`: what a recording holds and what is still to be stated about it."""

from __future__ import annotations

import json
import math
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from dmpcpp._notes import Note
from dmpcpp.cli._flags import flag, in_flags
from dmpcpp.cli._group import FAILED
from dmpcpp.cli._options import preparation_options, taken_preparation
from dmpcpp.cli._recording_options import NAMES, PREPARATION, recording_options, taken_recording
from dmpcpp.cli._tables import note_style

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from dmpcpp.inspection import BodyReport, Inspection

_MOST_OF_IT = 0.9  # of the duration; a part that long is no news
_SHOWN = 12  # parts whose times are listed
_JITTER = 0.5  # of the usual step; a shorter one is worth a word


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.argument("second", required=False, type=click.Path(path_type=Path))
@recording_options
@preparation_options
@click.option(
    "--plot", metavar="FILE.png|show", help="Draw path, coordinates, gaps, rests and noise into a file, or a window."
)
@click.option("--json", "as_json", is_flag=True, help="Print the report as JSON (m, s, rad) instead of the tables.")
def inspect(file: Path, plot: str | None, as_json: bool, **options: Any) -> None:
    """Show what FILE holds: bodies or markers, rate, gaps, jumps, noise, extent, and what is missing.

    FILE is a recording: BVH, C3D, TRC, MOT, ROS bag or MCAP, Qualisys TSV, Motive, Vicon, EuRoC or Aria CSV, TUM, a
    table, .npy or .npz, a DeepMimic clip, a video of a hand or a tag (SECOND: another of the same motion). Exit
    status: 0 ready to be learned, 2 unreadable, 3 something must be specified or fixed first.

    Example: dmpcpp inspect lift.trc --markers WRIST,STYLr,STYLu --up-axis z
    """
    from dmpcpp import inspection

    preparation, _ = taken_preparation(options)
    options.pop("keep_rests")  # of what is learned
    stated = taken_recording(options)
    found = inspection.inspect(file, preparation=preparation, **stated)
    if as_json:
        click.echo(json.dumps(found.summary(), indent=2, allow_nan=False))
    else:
        _print(found)
    if plot is not None:
        _draw(file, found, plot, stated)
    if not found.ok:
        sys.exit(FAILED)
    if not as_json:
        click.echo(f"next: {_next_command(file)}")


def _next_command(file: Path) -> str:
    """Return the command that carries the recording out, with what was stated here."""
    context = click.get_current_context()
    second = context.params.get("second")
    words = ["dmpcpp", "imitate", str(file), *([str(second)] if second else [])]
    for option in context.command.params:
        name = option.name or ""
        typed = context.get_parameter_source(name) is ParameterSource.COMMANDLINE
        if isinstance(option, click.Option) and typed and name not in ("plot", "as_json"):
            values = context.params[name]
            for value in values if isinstance(values, tuple) else (values,):
                words += [option.opts[0]] if option.is_flag else [option.opts[0], str(value)]
    return shlex.join([*words, "--arm", "panda", "--out", file.stem])


def _draw(file: Path, found: Inspection, plot: str, stated: dict[str, Any]) -> None:
    """Draw the only body that was read into a PNG, or show it."""
    import tempfile

    import numpy as np
    from scipy.spatial.transform import Rotation

    from dmpcpp import motion, recordings
    from dmpcpp.errors import InvalidArgument
    from dmpcpp.show import plot as drawing

    read = [body for body in found.bodies if not body.refused]
    if len(read) != 1:
        raise InvalidArgument(
            f"--plot: {len(read)} bodies were read, expected one. Specify what is asked above, then draw."
        )
    recording = recordings.load(file, **stated)
    there = ~recording.missing
    turn = np.full((len(recording), 3), np.nan)
    turns = Rotation.from_matrix(recording.rotation[there])
    turn[there] = (turns[0].inv() * turns).as_rotvec()
    page = drawing.recorded(
        recording.time,
        recording.position,
        turn,
        gaps=[(gap.start, gap.end) for gap in motion.gaps(recording)],
        motions=read[0].segments,
        noise=(read[0].noise_position, read[0].noise_angle),
        title=f"{found.source}: {recording.body}",
        note=f"{read[0].samples} samples, {read[0].rate:.4g} Hz; bands: two standard deviations of the noise",
    )
    shown = plot == "show"
    path = drawing.save(page, Path(tempfile.mkdtemp()) / "recording.png" if shown else plot)
    click.echo(f"drawn into {path}", err=True)
    if shown:
        click.launch(str(path))


def _print(found: Inspection) -> None:
    from rich.console import Console

    console = Console(highlight=False)
    console.print(f"{found.source}: {found.format}", markup=False, soft_wrap=True)
    if found.bodies:
        console.print(_bodies_table(found))
        _print_extents(console, found.bodies)
        _print_uneven(console, found.bodies)
        _print_history(console, found.bodies)
        _print_parts(console, found.bodies)
    if found.markers:
        console.print(_markers_table(found))
    if found.held and not found.bodies:
        console.print(f"bodies: {', '.join(found.held)}", markup=False, soft_wrap=True)
    if found.markers_held:
        held = ", ".join(found.markers_held)
        console.print(f"markers beside the bodies (--markers A,B,C): {held}", markup=False, soft_wrap=True)
    for title, entries in (("to state", found.needed), ("taken", found.assumed)):
        for name, text in entries.items():
            # The file stands in the first line, the flag before its text.
            said = _in_flags(text).removeprefix(f"{found.source}: ").removeprefix(f"{flag(name)}: ")
            console.print(f"{title}: {flag(name)}: {said}", markup=False, soft_wrap=True)
    for problem in found.problems:
        console.print(_in_flags(problem), style="bold red", markup=False, soft_wrap=True)
    verdict = "ready to be learned" if found.ok else "not ready to be learned"
    console.print(verdict, style="bold green" if found.ok else "bold red")


def _print_history(console: Console, bodies: tuple[BodyReport, ...]) -> None:
    """Print what was done while reading; what all bodies share once."""
    shared = [note for note in _told(bodies[0]) if all(note in body.history for body in bodies)]
    for note in shared:
        console.print(f"  {_in_flags(note)}", style=note_style(note), markup=False, soft_wrap=True)
    for body in bodies:
        for note in _told(body):
            if note not in shared:
                console.print(f"  {body.name}: {_in_flags(note)}", style=note_style(note), markup=False, soft_wrap=True)


def _in_flags(message: str) -> str:
    return in_flags(message, (*NAMES, *PREPARATION))


def _told(body: BodyReport) -> list[str]:
    """Return the notes on a body; assumptions have lines of their own."""
    return [note for note in body.history if Note.of(note).kind != "assumed"]


def _print_parts(console: Console, bodies: tuple[BodyReport, ...]) -> None:
    """Print the cycles and the parts between rests, with the option that chooses one."""
    for body in bodies:
        for parts, one, several, option in (
            (body.cycles, "cycle", "cycles", "--repetition"),
            (body.segments, "motion between rests", "motions between rests", "--segment"),
        ):
            whole = len(parts) == 1 and parts[0][1] - parts[0][0] > _MOST_OF_IT * body.duration
            if not parts or whole:
                continue
            times = ", ".join(f"{begin:.2f}-{end:.2f}" for begin, end in parts[:_SHOWN])
            more = ", ..." if len(parts) > _SHOWN else ""
            console.print(
                f"  {body.name}: {len(parts)} {one if len(parts) == 1 else several} ({option} K uses one): "
                f"{times}{more} s",
                markup=False,
                soft_wrap=True,
            )


def _table(title: str, *columns: str) -> Table:
    from rich import box
    from rich.markup import escape
    from rich.table import Table

    table = Table(title=escape(title), title_justify="left", box=box.SIMPLE, padding=(0, 1, 0, 0))
    for k, column in enumerate(columns):
        table.add_column(escape(column), justify="left" if k == 0 else "right")
    return table


def _bodies_table(found: Inspection) -> Table:
    from rich.markup import escape

    table = _table("bodies", "", "samples", "s", "Hz", "lost", "gap [s]", "jumps", "noise [mm]", "[deg]", "peak [m/s]")
    for body in found.bodies:
        if body.refused:
            table.add_row(escape(body.name), "refused")
            continue
        table.add_row(
            escape(body.name),
            str(body.samples),
            f"{body.duration:.2f}",
            f"{body.rate:.1f}",
            str(body.missing + body.skipped),
            f"{body.longest_gap:.2f}",
            str(body.jumps),
            f"{1e3 * body.noise_position:.2g}",
            f"{math.degrees(body.noise_angle):.2g}",
            f"{body.peak_speed:.2f}",
        )
    return table


def _print_extents(console: Console, bodies: tuple[BodyReport, ...]) -> None:
    for body in bodies:
        if not body.refused:
            console.print(
                f"  {body.name}: moves over {_millimetres(body.extent)} mm in x, y, z; turns at most at "
                f"{math.degrees(body.peak_turning):.0f} deg/s",
                markup=False,
                soft_wrap=True,
            )


def _print_uneven(console: Console, bodies: tuple[BodyReport, ...]) -> None:
    """Print where samples follow each other much faster than they usually do: stamps that jitter are noise too."""
    for body in bodies:
        least, usual, largest = (1e3 * step for step in body.steps)
        if not body.refused and least < _JITTER * usual:
            console.print(
                f"  {body.name}: steps of {least:.3g} to {largest:.3g} ms, usually {usual:.3g} ms; where only the "
                f"stamps jitter, a table is better read at an even --rate {body.rate:.4g}",
                markup=False,
                soft_wrap=True,
            )


def _markers_table(found: Inspection) -> Table:
    from rich.markup import escape

    title = f"markers: {found.samples} samples, {found.duration:.2f} s, {found.rate:.1f} Hz"
    table = _table(title, "", "missing", "longest gap [s]", "noise [mm]", "extent x y z [mm]")
    for marker in found.markers:
        table.add_row(
            escape(marker.name),
            f"{100 * marker.missing / found.samples:.1f} %",
            f"{marker.longest_gap:.2f}",
            f"{1e3 * marker.noise_position:.2g}",
            _millimetres(marker.extent),
        )
    return table


def _millimetres(extent: tuple[float, float, float]) -> str:
    return " ".join(f"{1e3 * length:.0f}" for length in extent)
