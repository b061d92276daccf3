"""`dmpcpp fit` and `dmpcpp plan`: recordings to a model file, and a model file to joints of an arm."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._arm_options import (
    arm_options,
    contact_options,
    follow_option,
    optional_arm_options,
    taken_arm,
    taken_surroundings,
)
from dmpcpp.cli._choices import engines, scaling_option
from dmpcpp.cli._config import save_config
from dmpcpp.cli._distribution import (
    distribution_option,
    given_option,
    learn_distribution,
    require_no_basis_count,
    taken_given,
)
from dmpcpp.cli._flags import as_typed, flag
from dmpcpp.cli._group import FAILED, refuse_file
from dmpcpp.cli._limit_options import accept_option, names, taken_limits
from dmpcpp.cli._numbers import numbers
from dmpcpp.cli._options import (
    DEFAULT_ENGINE,
    SHOWN_ENGINE,
    preparation_options,
    scale_range,
    taken_preparation,
)
from dmpcpp.cli._recording_options import recording_options, taken_recording
from dmpcpp.cli._robot_files import export_option, print_written
from dmpcpp.cli._set_aside import set_aside
from dmpcpp.cli._tables import arm_line, note_style, print_checks, way
from dmpcpp.cli._tempo_options import taken_tempo, tempo_options
from dmpcpp.cli._verdict import print_verdict
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from dmpcpp._typing import Array
    from dmpcpp.learning import Lesson
    from dmpcpp.motion import Preparation
    from dmpcpp.planning import JointPlan
    from dmpcpp.recordings import Recording


@click.command()
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="FILE...")
@recording_options
@preparation_options
@optional_arm_options("Place the first recording in this arm's workspace, the others with it.")
@follow_option
@contact_options
@click.option(
    "--scale",
    metavar="S|MIN:MAX",
    help="Scale of positions, or its range (default: 0.25:1; smaller if none is feasible).",
)
@click.option(
    "--seed", default=0, show_default=True, type=click.IntRange(0), help="Random seed of the placement search."
)
@click.option(
    "--basis-count", type=click.IntRange(1, 100000), help="Number of kernels (default: as many as the motion needs)."
)
@distribution_option
@click.option(
    "--leave-out",
    multiple=True,
    metavar="N[.K]",
    help="Learn without the N-th FILE, from 1, or without its K-th take.",
)
@click.option(
    "--out",
    default="model.json",
    show_default=True,
    type=click.Path(dir_okay=False, path_type=Path),
    help="The model file; its options are written beside it, into NAME.config.toml.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the fit report as JSON instead of the tables.")
def fit(
    files: tuple[Path, ...],
    scale: str | None,
    seed: int,
    basis_count: int | None,
    distribution: bool,
    leave_out: tuple[str, ...],
    out: Path,
    as_json: bool,
    **options: Any,
) -> None:
    """Learn the motion in FILE, or in several FILEs of one motion together, and write a model file.

    A FILE with several takes gives all of them with --episode all, --where COLUMN=all or --repetition all. If a take
    does not match the others, no model is written (exit status 3) and an earlier model file is renamed to NAME.old.

    Without --arm the model is one of the recorded poses, z up; with it, of poses of the arm's tip in its base frame,
    ready for `dmpcpp plan`.

    With --distribution takes that differ are learned with how they differ, for `dmpcpp plan --given`.

    Example: dmpcpp fit reach.bvh --body RightHand --unit cm --arm panda --out reach.json
    """
    from dmpcpp import planning, save, simulation
    from dmpcpp.learning import teach

    refuse_file(out.parent)
    preparation, smooth = taken_preparation(options)
    numbers, found = _takes(files, taken_recording(options), preparation, leave_out)
    if options["arm"] is not None:
        around = taken_surroundings(options)
        engine = around.in_world(simulation.default_simulator)
        found = planning.placed(
            found, taken_arm(options), scale=scale_range(scale), seed=seed, engine=engine, follow=options["follow"]
        )
    else:
        _require_no_arm({**options, "scale": scale})
    keep_rests = options.pop("keep_rests")
    if distribution:
        require_no_basis_count(basis_count)
        learn_distribution(found, out, smooth=smooth, numbers=numbers, keep_rests=keep_rests, as_json=as_json)
        return
    lesson = teach(found, basis_count=basis_count, smooth=smooth, numbers=numbers, keep_rests=keep_rests)
    written = lesson.ok or len(found) == 1  # takes that do not belong together make no model
    config = out.with_name(f"{out.stem}.config.toml")
    if written:
        out.parent.mkdir(parents=True, exist_ok=True)
        save(lesson.model, out)
        save_config(config)
    else:
        set_aside(out, config)
    if as_json:
        click.echo(json.dumps(lesson.summary(), indent=2, allow_nan=False))
    else:
        _print_lesson(lesson, out if written else None)
    if not lesson.ok:
        sys.exit(FAILED)


def _require_no_arm(options: dict[str, Any]) -> None:
    for name in ("base", "tip", "tool", "scale", "follow", "floor", "ignored", "package_path"):
        if options[name]:
            option = "--ignore-contact" if name == "ignored" else "--" + name.replace("_", "-")
            raise InvalidArgument(f"{option}: without --arm it says nothing. State --arm too.")
    for name in taken_limits(dict(options)):
        raise InvalidArgument(f"{flag(name)}: without --arm it says nothing. State --arm too.")


def _takes(
    files: tuple[Path, ...], stated: dict[str, Any], preparation: Preparation, leave_out: tuple[str, ...]
) -> tuple[list[str], list[Recording]]:
    """Return the takes of all files with their numbers: "2" of the second file, "2.3" of its third take."""
    from dmpcpp import motion, recordings

    takes: dict[str, Recording] = {}
    known: list[str] = []
    for k, file in enumerate(files, 1):
        known.append(str(k))
        if str(k) in leave_out:  # it may be one that cannot be read
            continue
        loaded = recordings.load_all(file, **stated)
        parts = [part for recording in loaded for part in motion.prepare_all(recording, preparation)]
        numbers = [f"{k}.{j}" for j in range(1, len(parts) + 1)] if len(parts) > 1 else [str(k)]
        known += numbers if len(parts) > 1 else []
        takes |= {number: part for number, part in zip(numbers, parts, strict=True) if number not in leave_out}
    if unknown := [number for number in leave_out if number not in known]:
        raise InvalidArgument(f"--leave-out: {unknown[0]}, expected one of {', '.join(known)}.")
    if not takes:
        raise InvalidArgument("--leave-out: leaves nothing to learn from.")
    return list(takes), list(takes.values())


def _to_leave_out(lesson: Lesson) -> str:
    """Return the options that learn without the takes that do not belong to the others."""
    numbers = dict.fromkeys(check.name.removeprefix("take_").split("_")[0] for check in lesson.checks if not check.ok)
    return " ".join(f"--leave-out {number}" for number in numbers)


def _print_lesson(lesson: Lesson, out: Path | None) -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False)
    for line in (line for recording in lesson.recordings for line in recording.history):
        console.print(line, style=note_style(line), soft_wrap=True, markup=False)
    table = Table(title="the model against what it was learned from", title_justify="left")
    for title in ("mm, deg", "x", "y", "z", "rot x", "rot y", "rot z"):
        table.add_column(title, justify="left" if title == "mm, deg" else "right", no_wrap=True)
    for name, values in (("RMSE", lesson.fit.rmse), ("largest", lesson.fit.largest), ("noise found", lesson.fit.noise)):
        shown = (*(1e3 * values[:3]), *(math.degrees(value) for value in values[3:]))
        table.add_row(name, *(f"{value:.2g}" for value in shown))
    console.print(table)
    for sentence in dict.fromkeys(each.sentence for each in lesson.evidence):
        console.print(sentence, soft_wrap=True, markup=False)
    for warning in lesson.fit.warnings:
        console.print(warning, style="yellow", soft_wrap=True, markup=False)
    if lesson.checks:
        print_checks(console, lesson.checks)
    console.print(
        f"{lesson.model.options.basis_count} kernels, {lesson.model.duration:.2f} s, {way(lesson.model)} m; "
        + (
            f"written to {out}"
            if out
            else f"no model written: the takes do not belong together. To learn without: {_to_leave_out(lesson)}"
        ),
        soft_wrap=True,
        markup=False,
    )


@click.command()
@click.argument("model", type=click.Path(path_type=Path), metavar="MODEL")
@arm_options
@follow_option
@contact_options
@click.option(
    "--goal",
    metavar="X,Y,Z[,QX,QY,QZ,QW]",
    help="End point [m] in the arm's base frame (default: as demonstrated).",
)
@click.option(
    "--via",
    multiple=True,
    metavar="S:X,Y,Z[,QX,QY,QZ,QW]",
    help="Pass this point [m], or pose, at S of the motion, 0.01 to 0.99; may be given several times.",
)
@given_option
@click.option(
    "--cycles", default=5, show_default=True, type=click.IntRange(2, 1000), help="Cycles of a rhythmic MODEL."
)
@click.option(
    "--duration",
    type=float,
    metavar="S",
    help="Duration [s] (default: as demonstrated); extended if joint limits require it.",
)
@click.option(
    "--exact-duration", is_flag=True, help="Never extend the duration; a check fails if joint limits are exceeded."
)
@scaling_option
@tempo_options
@click.option("--from-joints", metavar="Q1,Q2,..", help="Start joints [rad] (default: searched).")
@click.option(
    "--simulator",
    default=DEFAULT_ENGINE,
    show_default=SHOWN_ENGINE,
    type=engines("none"),
    help="Physics engine that checks the path for contacts; none: no contact check.",
)
@accept_option
@export_option
@click.option(
    "--out",
    default="dmpcpp-plan",
    show_default=True,
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder for plan.npz, summary.json, config.toml and, of a plan that is feasible, joints.csv.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON instead of the table.")
def plan(
    model: Path,
    goal: str | None,
    via: tuple[str, ...],
    given: tuple[str, ...],
    cycles: int,
    duration: float | None,
    exact_duration: bool,
    scaling: str,
    from_joints: str | None,
    simulator: str,
    accept: tuple[str, ...],
    formats: tuple[str, ...],
    out: Path,
    as_json: bool,
    **arm: Any,
) -> None:
    """Plan the motion in MODEL, a model file, to a goal and duration, and write joints for an arm.

    Checked are inverse kinematics, joint limits and contacts of the arm with itself and the floor; `dmpcpp imitate`
    executes under physics as well. Where a check fails or is not judged there is no joints.csv.

    Example: dmpcpp plan reach/model.json --arm panda --duration 3 --out plan
    """
    from dmpcpp import export, load, planning, simulation

    refuse_file(out)
    known = taken_given(load(model), [_at_phase("--given", text, 0.0, 1.0) for text in given])
    learned, engine, around = known.model, simulation.ENGINES.get(simulator), taken_surroundings(arm)
    end = _goal(goal, learned)
    chosen = taken_arm(arm)
    export.chosen(formats, chosen)  # what cannot be written is refused before anything runs
    found = planning.plan(
        planning.Cycles(learned, cycles) if _is_rhythmic(learned) else learned,
        chosen,
        goal=end,
        duration=duration,
        start=numbers("--from-joints", from_joints) if from_joints else None,
        slow_down=not exact_duration,
        **taken_tempo(arm),
        simulator=engine,
        surroundings=around,
        follow=arm["follow"],
        accept=names(accept),
        via=planning.at_phases(learned, (_at_phase("--via", text, 0.01, 0.99) for text in via), end) if via else (),
        scaling=scaling,
    )
    sent = planning.write(found, out, formats)
    save_config(out / "config.toml")
    if as_json:
        click.echo(json.dumps(found.summary() | known.summary(), indent=2, allow_nan=False))
    else:
        known.print()
        _print_plan(found, out)
    whole = print_written(sent, found.ok, "not feasible", quiet=as_json)
    if not (found.ok and whole):
        sys.exit(FAILED)


def _print_plan(found: JointPlan, out: Path) -> None:
    from rich.console import Console

    from dmpcpp.robot import assumptions

    console = Console(highlight=False)
    console.print(f"arm: {arm_line(found.arm)}", soft_wrap=True, markup=False)
    if found.contacts:
        console.print(f"contacts: {found.contacts.describe()}", style="dim", soft_wrap=True, markup=False)
    if found.scaling:
        console.print(as_typed(found.scaling.describe()), style="dim", soft_wrap=True, markup=False)
        for note in found.scaling.notes:
            console.print(note, style="yellow", soft_wrap=True, markup=False)
    if found.detour:
        console.print(found.detour.describe(), style="yellow", soft_wrap=True, markup=False)
    print_checks(console, found.checks)
    duration = f"{found.joints.time[-1]:.2f} s, {found.slowdown:.2f} x the requested duration"
    if found.tempo:
        duration = f"{found.tempo.describe(found.arm.joint_names, 'the requested')} {duration}"
    how = f"{duration}; written to {out}/" + (
        "" if found.ok else ", without joints.csv: do not run this plan on a robot"
    )
    if found.sent.note():
        how += f". {found.sent.note()}."
    if found.follow.describe():
        how += f". {found.follow.describe()}."
    print_verdict(console, found, how, assumed=assumptions(found.arm), words=("planned", "not feasible"))


def _goal(text: str | None, model: Any) -> Array | None:
    """Return the pose (4, 4): three numbers keep the demonstrated rotation."""
    if text is None:
        return None
    import numpy as np

    pose = np.array(model.goal, dtype=np.float64)
    if pose.shape != (4, 4):
        raise InvalidArgument(
            f"--goal: the model's goal has shape {pose.shape}, expected a model of poses. Learn one with `dmpcpp fit`."
        )
    place = _place("--goal", text)
    if place.shape == (4, 4):
        return place
    pose[:3, 3] = place
    return pose


def _is_rhythmic(model: Any) -> bool:
    from dmpcpp import Motion, PoseDmp

    return isinstance(model, PoseDmp) and model.options.motion == Motion.rhythmic


def _at_phase(option: str, text: str, first: float, last: float) -> tuple[float, Array]:
    """Return the phase, and the point (3,) or pose (4, 4)."""
    phase, colon, place = text.partition(":")
    if not colon:
        raise InvalidArgument(
            f"{option}: '{text}', expected S:X,Y,Z with S from {first:g} to {last:g}, such as 0.5:0.4,0.1,0.3."
        )
    return numbers(option, phase, 1)[0], _place(option, place)


def _place(option: str, text: str) -> Array:
    """Return a point (3,), or with a quaternion a pose (4, 4)."""
    import numpy as np
    from scipy.spatial.transform import Rotation

    values = numbers(option, text)
    if len(values) not in (3, 7):
        raise InvalidArgument(f"{option}: {len(values)} number(s) in '{text}', expected x,y,z or x,y,z,qx,qy,qz,qw.")
    if len(values) == 3:
        return np.array(values)
    length = math.hypot(*values[3:])
    if not abs(length - 1.0) < 1e-2:
        raise InvalidArgument(
            f"{option}: the quaternion in '{text}' has length {length:.3f}, expected 1. Its order is x, y, z, w."
        )
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_quat(values[3:]).as_matrix()
    pose[:3, 3] = values[:3]
    return pose
