"""Tables that several commands print."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from dmpcpp._check_words import figure, figures_of, group_of, words_of
from dmpcpp._notes import Note

if TYPE_CHECKING:
    from rich.console import Console

    from dmpcpp._core import Arm, PoseDmp
    from dmpcpp.checks import Check


def note_style(note: str) -> str:
    """How a line of a recording's history is printed: what warns is not to be overlooked."""
    return {"warning": "bold yellow", "assumed": "yellow", "changed": "dim"}[Note.of(note).kind]


def arm_line(arm: Arm) -> str:
    """Which frame of an arm follows the hand, in which frame, and how the two were chosen."""
    how = f"chosen: {arm.choice}" if arm.choice else f"{arm.joint_count} joints"
    return f"'{arm.tip}' follows the hand, in the frame of '{arm.base}' ({how})"


def way(model: PoseDmp) -> str:
    """Where a model's motion begins and ends, or what it goes round, as --goal takes it."""
    start, goal = (",".join(f"{x:.3f}" for x in pose[:3, 3]) for pose in (model.start, model.goal))
    return f"round {goal}" if model.options.motion.name == "rhythmic" else f"from {start} to {goal}"


def print_checks(console: Console, checks: Iterable[Check]) -> None:
    """Print how many checks hold, by group, and a row for each that does not."""
    from rich.markup import escape
    from rich.table import Table

    all_of_them = tuple(checks)
    held = Counter(group_of(check.name) for check in all_of_them if check.result == "holds")
    groups = ", ".join(f"{group.removeprefix('The ').lower()} {count}" for group, count in held.items())
    console.print(
        f"checks: {held.total()} of {len(all_of_them)} hold" + (f" ({groups})" if groups else ""),
        soft_wrap=True,
        markup=False,
    )
    others = [check for check in all_of_them if check.result != "holds"]
    if not others:
        return
    table = Table()
    for title in ("", "check", "what", "found", "allowed", "where"):
        side = "right" if title in ("found", "allowed") else "left"
        table.add_column(title, justify=side, no_wrap=title in ("", "check"), overflow="fold")
    for check in others:
        where = f"{check.time:.2f} s " if check.time is not None else ""
        numbers = (figure(value, check.unit, check.name) for value in (check.value, check.limit))
        detail = check.detail if check.judged else "see below"
        table.add_row(mark(check), check.name, words_of(check.name), *numbers, escape(where + detail))
    console.print(table)


def print_figures(console: Console, summary: Mapping[str, Any]) -> None:
    """Print the four figures of a run: how close, how fast, how near to limits, what was changed."""
    for each in figures_of(summary):
        console.print(f"{each.title.lower():<19}{each.number}  ({each.line})", soft_wrap=True, markup=False)


def mark(check: Check) -> str:
    """The result of a check in a table."""
    return {"holds": "[green]ok[/]", "fails": "[bold red]FAIL[/]", "not judged": "[yellow]not judged[/]"}[check.result]


def number(value: float, scale: float = 1.0) -> str:
    """A figure of a table; a dash where there is none."""
    return f"{scale * value:.3g}" if math.isfinite(value) else "-"
