"""How commands print a verdict: the word, what failed, what was not judged and by what, what was assumed."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from dmpcpp.cli._flags import as_typed

if TYPE_CHECKING:
    from rich.console import Console

    from dmpcpp.checks import Check, Checked

__all__ = ["print_verdict", "reason"]


def print_verdict(
    console: Console,
    result: Checked,
    how: str,
    *,
    assumed: Iterable[str] = (),
    changed: Iterable[str] = (),
    advice: str = "",
    words: tuple[str, str] = ("verified", "not verified"),
) -> None:
    """Print the verdict, a line for each check that was not judged, what was assumed and what was changed.

    `how` says by what was judged; `words` are those of a good and a bad verdict.
    """
    said = words[0] + result.verdict_word.removeprefix("verified") if result.ok else words[1]
    style = "bold red" if not result.ok else "bold yellow" if result.not_judged else "bold green"
    console.print(said, style=style, markup=False, end=": ", soft_wrap=True)
    console.print(" ".join(filter(None, (reason(result), advice, how))), soft_wrap=True, markup=False)
    for check in result.not_judged:
        console.print(_not_judged(check, result), style="yellow", soft_wrap=True, markup=False)
    for kind, lines in (("assumed", assumed), ("changed", changed)):
        for line in lines:
            console.print(f"{kind}: {line}", style="yellow", soft_wrap=True, markup=False)


def reason(result: Checked) -> str:
    """Return why a result is not verified; nothing where it is."""
    parts = []
    if result.failed:
        numbers = ", ".join(map(_failed, result.failed))
        parts.append(f"{len(result.failed)} of {len(result.checks)} checks failed: {numbers}")
    if result.open:
        parts.append(f"not judged: {', '.join(check.name for check in result.open)}")
    return "; ".join(parts) + "." if parts else ""


def _failed(check: Check) -> str:
    if math.isnan(check.value) and check.detail:
        return f"{check.name} ({check.detail})"
    return f"{check.name} {check.value:.3g} (limit {check.limit:.3g} {check.unit})"


def _not_judged(check: Check, result: Checked) -> str:
    end = " Accepted." if check.name in result.accepted else f" Or accept it unjudged: --accept {check.name}."
    return f"not judged: {check.name}: {as_typed(check.detail)}{end}"
