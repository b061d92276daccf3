"""The outcomes of a batch as tables: CSV for programs, HTML for people."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

from dmpcpp._atomic import write_text
from dmpcpp.trials.batch._task import Outcome

__all__ = ["summary", "write_tables"]

_STAGES = ("demonstration_to_dmp", "dmp_to_ik", "ik_to_executed")
_MEASURES = ("position_rmse", "position_max", "angle_rmse", "angle_max")
_COUNTED = {"not judged": "not judged", "fail": "failed", "error": "could not be carried out"}
_STYLE = """body { font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; margin: 2rem; color: #1d2329; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .9rem; }
th, td { text-align: left; padding: .25rem .9rem .25rem 0; border-bottom: 1px solid #dde2e7; vertical-align: top; }
.pass { color: #00664a; } .not.judged { color: #8a6100; } .fail, .error { color: #a62b00; font-weight: 600; }"""


def summary(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """Return how many passed, were not judged, failed and could not be carried out, and each outcome; m, rad, s."""
    verdicts = [outcome.verdict for outcome in outcomes]
    return {
        "verdict": "pass" if all(outcome.ok for outcome in outcomes) else "fail",
        **{name: verdicts.count(name) for name in ("pass", "not judged", "fail", "error")},
        "outcomes": [
            {
                "file": o.file,
                "arm": o.arm,
                "verdict": o.verdict,
                "cause": o.cause,
                "errors": o.errors,
                "folder": o.folder,
            }
            for o in outcomes
        ],
    }


def write_tables(outcomes: Sequence[Outcome], folder: str | PathLike[str]) -> None:
    """Write outcomes.csv (m, rad, s) and index.html (mm, deg) into a folder, each whole or not at all.

    Raises
    ------
    FileError
        The folder or a file cannot be written.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    write_text(folder / "outcomes.csv", _csv(outcomes))
    write_text(folder / "index.html", _html(outcomes, folder))


def first_line(cause: str) -> str:
    """Return what fits into the cell of a table for people: some errors list what there is, a line each."""
    return cause.partition("\n")[0]


def _csv(outcomes: Sequence[Outcome]) -> str:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    columns = [f"{stage}_{measure}" for stage in _STAGES for measure in _MEASURES]
    writer.writerow(["file", "arm", "verdict", "cause", "slowdown", "seconds", *columns])
    for outcome in outcomes:
        numbers = [outcome.errors.get(stage, {}).get(measure, "") for stage in _STAGES for measure in _MEASURES]
        known = [outcome.slowdown if outcome.errors else "", round(outcome.seconds, 3)]
        writer.writerow([outcome.file, outcome.arm, outcome.verdict, outcome.cause, *known, *numbers])
    return text.getvalue()


def _html(outcomes: Sequence[Outcome], folder: Path) -> str:
    found = summary(outcomes)
    titles = ("recording", "arm", "verdict", "learned [mm]", "[deg]", "executed [mm]", "[deg]", "slowdown", "cause")
    head = "".join(f"<th>{title}</th>" for title in titles)
    rows = "\n".join(_row(outcome, folder) for outcome in outcomes)
    counts = ", ".join(f"{found[name]} {word}" for name, word in _COUNTED.items())
    said = f"{found['pass']} of {len(outcomes)} passed, {counts}."
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><link rel="icon" href="data:,">'
        f"<title>Batch</title><style>{_STYLE}</style></head><body><h1>{said}</h1>\n"
        f"<table><thead><tr>{head}</tr></thead><tbody>\n{rows}\n</tbody></table></body></html>\n"
    )


def _row(outcome: Outcome, folder: Path) -> str:
    report = Path(outcome.folder) / "report.html"
    name = escape(Path(outcome.file).name)
    inside = report.is_file() and report.is_relative_to(folder)
    link = f'<a href="{escape(report.relative_to(folder).as_posix())}">{name}</a>' if inside else name
    numbers = [
        f"{scale * outcome.errors[stage][measure]:.3g}" if outcome.errors else "-"
        for stage in ("demonstration_to_dmp", "ik_to_executed")
        for measure, scale in (("position_rmse", 1e3), ("angle_rmse", math.degrees(1.0)))
    ]
    cells = [*numbers, f"{outcome.slowdown:.2f}" if outcome.errors else "-", escape(first_line(outcome.cause))]
    rest = "".join(f"<td>{cell}</td>" for cell in cells)
    verdict = f'<td class="{outcome.verdict}">{outcome.verdict}</td>'
    return f"<tr><td>{link}</td><td>{escape(outcome.arm)}</td>{verdict}{rest}</tr>"
