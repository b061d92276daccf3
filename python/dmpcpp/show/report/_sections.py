"""The parts of a report, each a piece of HTML."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from dmpcpp import _core
from dmpcpp._check_words import GROUPS, OTHERS, figure, figures_of, group_of, words_of
from dmpcpp.show.report import _figures as figures
from dmpcpp.show.report._run_folder import RunFolder, result_of
from dmpcpp.show.scene import replay_page

__all__ = ["checks", "first_screen", "fitting", "history", "pictures", "repeat", "stages"]

_COPY = '<button onclick="navigator.clipboard.writeText(this.previousElementSibling.textContent)">copy</button>'
_CHECK_TITLES = ("", "what", "found", "allowed", "where", "check")

_STAGES = {
    "demonstration_to_dmp": "demonstration → DMP",
    "recording_to_fitted": "recording → fitted",
    "dmp_to_fitted": "DMP → fitted",
    "dmp_to_ik": "DMP → FK(IK)",
    "ik_to_executed": "FK(IK) → executed",
}
_CAPTIONS = (
    ("Path", figures.path, "Dots: the demonstrated hand. Blue: the plan. Black: the tool, as executed."),
    (
        "Position over time",
        figures.coordinates,
        "Over the executed motion's time; the demonstration is stretched to it.",
    ),
    (
        "Orientation over time",
        figures.orientation,
        "Above: how far hand and tool have turned since the start, whole turns counted. Below: how far the z axis of "
        "both leans from upright.",
    ),
    ("Errors of every stage", figures.errors, "The largest of each short stretch, on logarithmic axes."),
    (
        "Joints against their limits",
        figures.joints,
        "100 % is a limit. A position is counted from the middle of its range; a joint without a limit is not drawn.",
    ),
    (
        "Phase and kernels",
        figures.phase_and_kernels,
        "What drives the motion, and the kernels that shape it; some drawn.",
    ),
    (
        "Demonstration and its spread",
        figures.demonstrations,
        "Dots: the samples. Band: two standard deviations of the noise that was found, about the smoothed motion.",
    ),
)


def first_screen(run: RunFolder) -> str:
    """Say what came of it, show the arm moving, and give the four figures that a person wants."""
    word, kind = _word(run)
    tiles = "".join(
        f'<div class="tile"><span>{escape(each.title)}</span><b>{escape(each.number)}</b>'
        f"<small>{escape(each.line)}</small></div>"
        for each in figures_of(run.summary)
    )
    return (
        f'<section id="verdict"><p class="verdict {kind}"><b>{word}</b>: {escape(_said(run))}.</p></section>'
        f'<div class="first">{_scene(run)}<div class="tiles">{tiles}</div></div>'
    )


def checks(run: RunFolder) -> str:
    """List what was checked: a line a group, what did not hold in the open, all of it folded behind."""
    summary = run.summary
    how = f"{summary['arm']}, {summary['simulator']}, {summary['mode']} ({summary['caveat']})."
    open_ones = [check for check in summary["checks"] if result_of(check) != "holds"]
    parts = [_table(_CHECK_TITLES, map(_check_row, open_ones), "checks")] if open_ones else []
    groups: dict[str, list[dict[str, Any]]] = {}
    for check in summary["checks"]:
        groups.setdefault(group_of(check["name"]), []).append(check)
    parts += [_group(name, groups[name]) for name in (*GROUPS, OTHERS) if name in groups]
    return (
        f'<section id="checks"><h2>What was checked</h2><p>{escape(_figures_of(summary))}</p>'
        f"<p>{escape(how)}</p>{_caveats(summary)}{''.join(parts)}</section>"
    )


def _group(name: str, checks: Sequence[dict[str, Any]]) -> str:
    held = sum(result_of(check) == "holds" for check in checks)
    kind = "held" if held == len(checks) else "failed" if "fails" in map(result_of, checks) else "unjudged"
    rows = sorted(map(_check_row, checks), key=lambda row: row[0] == "ok")
    return (
        f'<details><summary class="{kind}"><b>{escape(name)}</b>: {held} of {len(checks)} hold</summary>'
        f"{_table(_CHECK_TITLES, rows, 'checks')}</details>"
    )


def _word(run: RunFolder) -> tuple[str, str]:
    """The verdict and the colour it is printed in."""
    if not run.ok:
        return "Not verified", "bad"
    left = run.named("not judged")
    word = "Verified, approximate" if run.summary.get("approximate") else "Verified"
    if left:
        return f"{word}, not judged: {', '.join(left)}", "doubtful"
    return word, "doubtful" if run.summary.get("approximate") else "good"


def _said(run: RunFolder) -> str:
    count, failed, unjudged = len(run.summary["checks"]), run.named("fails"), run.named("not judged")
    if not failed and not unjudged:
        return f"all {count} checks held"
    parts = [f"{len(failed)} of {count} checks failed: {', '.join(failed)}"] if failed else []
    parts += [f"not judged: {', '.join(unjudged)}"] if unjudged and not run.ok else []
    return "; ".join(parts) or f"{count - len(unjudged)} of {count} checks held, the others were accepted unjudged"


def _caveats(summary: dict[str, Any]) -> str:
    """What was not judged, and which limits were assumed."""
    unjudged = [check for check in summary["checks"] if result_of(check) == "not judged"]
    lines = [f"Not judged: {check['name']}: {check['detail']}" for check in unjudged]
    lines += [f"{said[0].upper()}{said[1:]}." for said in (summary.get("approximate"),) if said]
    lines += [f"Assumed: {what}." for what in summary.get("assumed", ())]
    lines += [f"Changed: {what}." for what in summary.get("changed", ())]
    return f"<ul>{''.join(f'<li>{escape(line)}</li>' for line in lines)}</ul>" if lines else ""


def _figures_of(summary: dict[str, Any]) -> str:
    return (
        f"{summary['recording']['samples']} samples over {summary['recording']['duration']:.2f} s; "
        f"{summary['basis_count']} kernels; executed in {summary['duration']:.2f} s, "
        f"{summary['slowdown']:.2f} x the recorded duration.{_tempo(summary.get('tempo'))}"
    )


def _tempo(tempo: dict[str, Any] | None) -> str:
    """How the person's tempo was kept; nothing for runs of before 0.2."""
    if not tempo:
        return ""
    slowest = f" At most {tempo['peak']:.2f} x slower than the person, at {tempo['peak_time']:.2f} s of the recording;"
    kept = f" {100 * tempo['kept']:.0f} % of the recording at the person's tempo."
    shown = slowest if tempo["policy"] == "person" else ""
    return f" Tempo: {tempo['policy']}.{shown}{kept}{_decides(tempo)}{_bound(tempo)}"


def _bound(tempo: dict[str, Any]) -> str:
    found = tempo.get("bound")
    return f" With this arm no method takes less than {found['local']:.2f} x." if found else ""


def _decides(tempo: dict[str, Any]) -> str:
    found = tempo["decided_by"]
    if not found:
        return ""
    joint = f" of {found['joint']}" if found["joint"] else ""
    return f" Asked most, at {found['time']:.2f} s: {found['limit'].replace('_', ' ')}{joint}."


def _check_row(check: dict[str, Any]) -> tuple[str, ...]:
    when = "" if check.get("time") is None else f"{check['time']:.2f} s "
    mark = {"holds": "ok", "fails": "FAIL"}.get(result_of(check), "not judged")
    value, limit = (figure(check[which], check["unit"], check["name"]) for which in ("value", "limit"))
    return mark, words_of(check["name"]), value, limit, when + check["detail"], check["name"]


def stages(run: RunFolder) -> str:
    """Tabulate the errors of the three stages in mm and deg."""
    rows = []
    for name, found in run.summary["stages"].items():
        lengths = (1e3 * found["position_rmse"], 1e3 * found["position_max"])
        turns = (math.degrees(found["angle_rmse"]), math.degrees(found["angle_max"]))
        rows.append((_STAGES.get(name, name), *map(_number, (*lengths, *turns))))
    titles = ("stage", "position RMSE [mm]", "max [mm]", "angle RMSE [deg]", "max [deg]")
    return f'<section id="stages"><h2>Errors</h2>{_table(titles, rows, "numbers")}</section>'


def _scene(run: RunFolder) -> str:
    """Play the motion: the arm beside the demonstrated hand path; a picture stands there until the first frame."""
    record = run.record
    page = replay_page(
        record.arm,
        record.executed_time,
        record.executed_joints,
        executed=record.executed_pose,
        demonstrated_time=record.demonstrated_time,
        demonstrated=record.demonstrated_pose,
    )
    return (
        f'<section id="scene"><div class="stage screen"><div class="poster">{figures.poster(run)}</div>'
        f'<iframe title="The arm replays the motion" srcdoc="{escape(page)}"></iframe></div>'
        f'<figure class="paper">{figures.still(run)}</figure>'
        "<p>Orange: the demonstrated hand and its path. Black: the path of the tool, as executed. "
        '<span class="screen">Drag to turn, scroll to come nearer. </span>'
        "The arm is drawn by the shapes that it collides with.</p></section>"
    )


def pictures(run: RunFolder) -> str:
    """Draw all figures."""
    return "".join(
        f'<section class="picture"><h2>{title}</h2><figure>{draw(run)}<figcaption>{escape(caption)}</figcaption>'
        "</figure></section>"
        for title, draw, caption in _CAPTIONS
    )


def history(run: RunFolder) -> str:
    """List what was done to the recording."""
    recording = run.summary["recording"]
    steps = "".join(f"<li>{escape(step)}</li>" for step in recording["history"])
    noise = recording["noise"]
    return (
        f'<section id="history"><h2>The recording</h2><p>{escape(recording["source"])} ({escape(recording["body"])}); '
        f"noise found: {_number(1e3 * noise['position'])} mm, {_number(math.degrees(noise['angle']))} deg per axis.</p>"
        f"<ol>{steps}</ol></section>"
    )


def fitting(run: RunFolder) -> str:
    """Tabulate how the model reproduces the demonstration, by axis."""
    record = run.record
    found = _core.assess(run.model, [_core.PoseDemonstration(record.demonstrated_time, record.demonstrated_pose)])
    scale = [1e3] * 3 + [math.degrees(1.0)] * 3
    rows = [
        (name, *(_number(k * value) for k, value in zip(scale, values, strict=True)))
        for name, values in (
            ("RMSE", found.rmse),
            ("largest", found.largest),
            ("noise found", found.noise),
            ("taken out by smoothing", found.removed),
        )
    ]
    titles = ("", "x [mm]", "y [mm]", "z [mm]", "about x [deg]", "about y [deg]", "about z [deg]")
    count = found.suggested_basis_count
    enough = (
        f"{count} kernels would reach 1 mm and 0.5 deg" if count else "no number of kernels reaches 1 mm and 0.5 deg"
    )
    notes = "".join(f"<li>{escape(warning)}</li>" for warning in found.warnings)
    return (
        f'<section id="fit"><h2>The model</h2>{_table(titles, rows, "numbers")}<p>{run.model.options.basis_count} '
        f"kernels; {enough}. Condition of the regression: {_number(found.condition)}.</p><ul>{notes}</ul></section>"
    )


def repeat(run: RunFolder) -> str:
    """Say how to repeat the run."""
    version = escape(_core.__version__)
    if not run.config:
        said = "<p>This run was made from Python; the files beside this page hold its results.</p>"
    else:
        command = next(iter(re.findall(r"To repeat: (.+)", run.config)), "")
        said = (
            f'<div class="command"><pre>{escape(command)}</pre>{_COPY}</div>'
            f"<p>config.toml, beside this page:</p><pre>{escape(run.config)}</pre>"
        )
    return (
        f'<section id="repeat"><h2>How to repeat</h2>{said}<p>dmpcpp {version}. This page is made anew from the files '
        "beside it by <code>dmpcpp report</code>.</p></section>"
    )


def _table(titles: Sequence[str], rows: Iterable[Sequence[str]], kind: str) -> str:
    head = "".join(f"<th>{escape(title)}</th>" for title in titles)
    body = "".join(
        f'<tr class="{_row_kind(row)}">' + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f'<div class="wide"><table class="{kind}"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def _row_kind(row: Sequence[str]) -> str:
    return {"FAIL": "failed", "not judged": "unjudged"}.get(row[0], "held")


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.3g}"
