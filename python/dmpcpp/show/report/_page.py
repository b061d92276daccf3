"""The page around a report's parts: one file, nothing loaded from elsewhere, on the screen and on paper."""

from __future__ import annotations

from html import escape

from dmpcpp.show.report import _sections as sections
from dmpcpp.show.report._run_folder import RunFolder

__all__ = ["html"]

_STYLE = """
:root { color-scheme: light; --ink: #1d2329; --faint: #5d6873; --line: #dde2e7; --good: #00664a; --bad: #a62b00;
  --doubt: #7a5600; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 70rem; padding: 1.5rem 2rem 4rem; color: var(--ink); background: #fff;
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.55rem; line-height: 1.25; margin: 0 0 .8rem; }
h2 { font-size: 1.12rem; margin: 2.4rem 0 .6rem; padding-top: .5rem; border-top: 1px solid var(--line); }
p, ul, ol { margin: .5rem 0; max-width: 52rem; }
.verdict { font-size: 1.12rem; padding: .7rem 1rem; border-left: .45rem solid; max-width: none;
  overflow-wrap: anywhere; }
.good { color: var(--good); border-color: var(--good); background: #eef8f4; }
.bad { color: var(--bad); border-color: var(--bad); background: #fdf1ec; }
.doubtful { color: var(--doubt); border-color: var(--doubt); background: #fdf7e6; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .87rem; margin: .7rem 0; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .2rem .8rem .2rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
.checks td:nth-child(3), .checks td:nth-child(4), .numbers td { white-space: nowrap; }
th { color: var(--faint); font-weight: 600; }
table.numbers th:not(:first-child), table.numbers td:not(:first-child), table.checks td:nth-child(3),
table.checks td:nth-child(4), table.checks th:nth-child(3), table.checks th:nth-child(4) { text-align: right; }
tr.failed td { color: var(--bad); font-weight: 600; }
tr.unjudged td { color: var(--doubt); font-weight: 600; }
figure { margin: 0; }
figure svg { width: 100%; height: auto; display: block; }
figcaption { color: var(--faint); font-size: .87rem; }
.first { display: grid; grid-template-columns: minmax(0, 1fr) 17rem; gap: 1rem; margin-top: .8rem; }
.first p { color: var(--faint); font-size: .87rem; }
.stage { position: relative; height: min(33rem, calc(100vh - 14rem)); min-height: 20rem; }
.stage iframe, .poster { position: absolute; inset: 0; width: 100%; height: 100%; border: 1px solid var(--line);
  border-radius: .4rem; background: #fff; }
.poster { display: flex; align-items: center; justify-content: center; z-index: 1; pointer-events: none; }
.poster img { max-width: 100%; max-height: 100%; }
.drawn .poster { display: none; }
.tiles { display: flex; flex-direction: column; gap: .7rem; }
.tile { border: 1px solid var(--line); border-radius: .4rem; padding: .55rem .8rem; }
.tile span, .tile small { display: block; color: var(--faint); font-size: .82rem; line-height: 1.3; }
.tile b { font-size: 1.25rem; overflow-wrap: anywhere; }
details { margin: .3rem 0; }
summary { cursor: pointer; }
summary.failed { color: var(--bad); }
summary.unjudged { color: var(--doubt); }
.command { display: flex; gap: .6rem; align-items: start; }
.command pre { flex: 1; margin: 0; }
@media (max-width: 55rem) { .first { grid-template-columns: minmax(0, 1fr); } }
pre { background: #f4f6f8; padding: .8rem 1rem; overflow-x: auto; font-size: .84rem; border-radius: .4rem; }
figure img { width: 100%; height: auto; display: block; }
.paper { display: none; }
@media print {
  @page { size: A4; margin: 14mm 15mm; }
  html { font-size: 9.5pt; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  body { max-width: none; padding: 0; font-size: 9.5pt; }
  h2 { margin-top: 1.4rem; break-after: avoid; }
  tr, figure { break-inside: avoid; }
  .wide { overflow: visible; }
  .screen, button { display: none; }
  .paper { display: block; }
  .first { display: block; }
  .tiles { flex-flow: row wrap; }
  .tile { flex: 1 1 40%; }
  section { break-inside: avoid; }
  #checks, #repeat, #history { break-inside: auto; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; }
}
"""


# The poster goes once the frame has drawn: viser draws into a canvas, and says nothing of it.
_SCRIPT = """
const stage = document.querySelector(".stage"), started = Date.now();
const watch = setInterval(() => {
  const canvas = stage.querySelector("iframe").contentDocument?.querySelector("canvas");
  if (canvas && canvas.clientWidth) { setTimeout(() => stage.classList.add("drawn"), 1500); clearInterval(watch); }
  if (Date.now() - started > 20000) { stage.classList.add("drawn"); clearInterval(watch); }
}, 200);
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(each => each.open = true));
"""


def html(run: RunFolder) -> str:
    """Return the report of a run, the verdict first."""
    recording = run.summary["recording"]
    title = f"{recording['source']} ({recording['body']}) on {run.summary['arm']}"
    parts = (
        sections.first_screen,
        sections.checks,
        sections.stages,
        sections.pictures,
        sections.history,
        sections.fitting,
        sections.repeat,
    )
    body = "\n".join(part(run) for part in parts)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="data:,">'
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head>\n"
        f"<body><h1>{escape(title)}</h1>\n{body}\n<script>{_SCRIPT}</script></body></html>\n"
    )
