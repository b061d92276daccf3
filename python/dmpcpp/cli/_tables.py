"""Tables that several commands print."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from dmpcpp._notes import Note

if TYPE_CHECKING:
    from rich.table import Table

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
    """Where a model's motion begins and ends, as --goal takes it."""
    start, goal = (",".join(f"{x:.3f}" for x in pose[:3, 3]) for pose in (model.start, model.goal))
    return f"from {start} to {goal}"


def checks_table(checks: Iterable[Check]) -> Table:
    """One row a check: whether it held, its number and limit, and where."""
    from rich.markup import escape
    from rich.table import Table

    table = Table(title="checks", title_justify="left")
    for title in ("", "check", "value", "limit", "unit", "where"):
        side = "right" if title in ("value", "limit") else "left"
        table.add_column(
            title, justify=side, no_wrap=title in ("", "check"), overflow="fold"
        )  # a joint's name stays whole
    for check in checks:
        where = f"{check.time:.2f} s " if check.time is not None else ""
        numbers = (number(check.value), number(check.limit))
        table.add_row(
            mark(check),
            check.name,
            *numbers,
            check.unit,
            escape(where + (check.detail if check.judged else "see below")),
        )
    return table


def mark(check: Check) -> str:
    """The result of a check in a table."""
    return {"holds": "[green]ok[/]", "fails": "[bold red]FAIL[/]", "not judged": "[yellow]not judged[/]"}[check.result]


def number(value: float, scale: float = 1.0) -> str:
    """A figure of a table; a dash where there is none."""
    return f"{scale * value:.3g}" if math.isfinite(value) else "-"
