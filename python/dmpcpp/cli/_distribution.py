"""`dmpcpp fit --distribution` and `dmpcpp plan --given`: takes that differ, and the motions that pass what is given."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._config import save_config
from dmpcpp.cli._group import FAILED
from dmpcpp.cli._set_aside import set_aside
from dmpcpp.cli._tables import note_style, print_checks
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from dmpcpp._typing import Array
    from dmpcpp.recordings import Recording
    from dmpcpp.variation import Variation

_FAR = 3.0  # standard deviations beyond which a person is told that nobody showed that

distribution_option = click.option(
    "--distribution",
    is_flag=True,
    help="Learn how the takes differ as well; writes a picture of the band beside the model file.",
)
given_option = click.option(
    "--given",
    multiple=True,
    metavar="S:X,Y,Z[,QX,QY,QZ,QW]",
    help="Of a distribution: what the motion passes [m] at S of it, 0 to 1; the rest as the takes vary with that.",
)


def require_no_basis_count(basis_count: int | None) -> None:
    """Refuse what says nothing of a distribution."""
    if basis_count is not None:
        raise InvalidArgument("--basis-count: with --distribution it says nothing. Leave it out.")


def learn_distribution(
    takes: Sequence[Recording],
    out: Path,
    *,
    smooth: bool,
    numbers: Sequence[str],
    keep_rests: bool,
    as_json: bool,
) -> None:
    """Learn a distribution and write it with its picture; exits where a take does not belong to the others."""
    from dmpcpp import save, variation

    if len(takes) < 2:
        raise InvalidArgument(
            "--distribution: one take, expected at least 2 of one motion. Name more files, or all takes of one with "
            "--episode all."
        )
    config, picture = out.with_name(f"{out.stem}.config.toml"), out.with_name(f"{out.stem}.png")
    found = variation.vary(takes, smooth=smooth, numbers=numbers, keep_rests=keep_rests)
    if found.ok:
        out.parent.mkdir(parents=True, exist_ok=True)
        save(found.distribution, out)
        variation.picture(found.distribution, found.demonstrations, picture, title=f"{len(takes)} takes")
        save_config(config)
    else:
        set_aside(out, config, picture)
    if as_json:
        click.echo(json.dumps(found.summary(), indent=2, allow_nan=False))
    else:
        _print_variation(found, out if found.ok else None)
    if not found.ok:
        sys.exit(FAILED)


def _print_variation(found: Variation, out: Path | None) -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False)
    for line in (line for recording in found.recordings for line in recording.history):
        console.print(line, style=note_style(line), soft_wrap=True, markup=False)
    table = Table(title="one standard deviation of the takes", title_justify="left")
    for title in ("", "position, mm", "orientation, deg"):
        table.add_column(title, justify="left" if not title else "right", no_wrap=True)
    for name, at in zip(("start", "middle", "end"), found.deviations(), strict=True):
        table.add_row(name, f"{1e3 * at['position']:.2g}", f"{math.degrees(at['angle']):.2g}")
    console.print(table)
    for sentence in dict.fromkeys(each.sentence for each in found.evidence):
        console.print(sentence, soft_wrap=True, markup=False)
    if found.checks:
        print_checks(console, found.checks)
    left_out = " ".join(f"--leave-out {check.name.split('_')[1]}" for check in found.checks if not check.ok)
    console.print(
        f"{len(found.demonstrations)} takes, {found.distribution.control_points} control points, "
        f"{found.distribution.duration:.2f} s; "
        + (
            f"written to {out} and {out.stem}.png"
            if out
            else f"no model written: the takes do not belong together. To learn without: {left_out}"
        ),
        soft_wrap=True,
        markup=False,
    )


@dataclass(frozen=True)
class KnownMotion:
    """The motion to plan, and what it was given.

    Attributes
    ----------
    model
        As loaded, or the mean of a distribution that passes what is given.
    given : tuple of (phase, standard deviations)
    """

    model: Any
    given: tuple[tuple[float, float], ...] = ()

    def summary(self) -> dict[str, Any]:
        """Return what is added to the summary of a plan."""
        return {"given": [{"phase": s, "deviations": far} for s, far in self.given]} if self.given else {}

    def print(self) -> None:
        """Say how far from the demonstrations what is given lies."""
        for phase, far in self.given:
            style = "yellow" if far > _FAR else "dim"
            told = ": no take went there" if far > _FAR else ""
            click.secho(
                f"given at {phase:g}: {far:.1f} standard deviations from what the takes do there{told}",
                fg="yellow" if style == "yellow" else None,
                dim=style == "dim",
            )


def taken_given(loaded: Any, given: Sequence[tuple[float, Array]]) -> KnownMotion:
    """Return the motion to plan of a model file; raises InvalidArgument where --given says nothing of it."""
    from dmpcpp import PoseDistribution, variation

    if not isinstance(loaded, PoseDistribution):
        if given:
            raise InvalidArgument(
                "--given: MODEL is no distribution of poses. Learn one from several takes with `dmpcpp fit "
                "--distribution`; to pass a point with any other model use --via."
            )
        return KnownMotion(loaded)
    try:
        found, far = variation.conditioned(loaded, given)
    except InvalidArgument as error:
        raise InvalidArgument(f"--{error}") from None
    phases = tuple(phase for phase, _ in given)
    return replace(KnownMotion(found.mean()), given=tuple(zip(phases, far, strict=True)))
