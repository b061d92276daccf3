"""A corpus of people's motions to its end: `python -m benchmarks.corpus [FOLDER] [--jobs N]`.

The clips that ship with PyBullet, both hands: as they are, twice as fast and half as fast by panda and iiwa, as they
are by xarm6; 210 tasks. The clips are not mended: those that are refused are part of what is counted. It goes on where
it was stopped; results lie in FOLDER (build/corpus), with outcomes.csv and index.html. Exit status: 0 every task has
an outcome that is a verdict or a refusal which names its cause, 3 one has not.
"""

from __future__ import annotations

import itertools
import json
import re
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import click
import numpy as np
from dmpcpp import batch, recordings
from dmpcpp._atomic import write_text

TEMPI = {"panda": (0.5, 1.0, 2.0), "iiwa": (0.5, 1.0, 2.0), "xarm6": (1.0,)}
"""Durations over the recorded ones, for each arm."""
HANDS = ("right_hand", "left_hand")


def corpus(folder: Path, clips: Sequence[str], tempi: Mapping[str, Sequence[float]] = TEMPI) -> list[batch.Task]:
    """Write the clips at every tempo, where they are not there yet, and return a task for every file, hand and arm."""
    takes = folder / "takes"
    takes.mkdir(parents=True, exist_ok=True)
    work = []
    for arm, hand in itertools.product(tempi, HANDS):
        for name, tempo in itertools.product(clips, tempi[arm]):
            path = takes / f"{name}_x{tempo:g}.txt"
            if not path.exists():  # a file that is written anew is another recording to a batch
                write_text(path, _stretched(recordings.clip_path(name), tempo))
            work.append(batch.Task(str(path), str(folder / f"{arm}_{hand}" / path.name), arm, reading={"body": hand}))
    return work


def _stretched(clip: Path, tempo: float) -> str:
    """Return a clip whose frames last `tempo` times as long: its first column is their duration."""
    content = json.loads(clip.read_text(encoding="utf-8"))
    for frame in content["Frames"]:
        frame[0] *= tempo
    return json.dumps(content)


def table(outcomes: list[batch.Outcome]) -> str:
    """Return verdicts and times of every arm, then why what did not pass did not, as lines."""
    lines = [f"{'arm':8}{'tasks':>7}{'pass':>7}{'fail':>7}{'error':>7}   seconds a task: median, largest"]
    for arm in dict.fromkeys(outcome.arm for outcome in outcomes):
        found = [outcome for outcome in outcomes if outcome.arm == arm]
        count, seconds = Counter(outcome.verdict for outcome in found), [outcome.seconds for outcome in found]
        numbers = "".join(f"{n:7}" for n in (len(found), *(count[name] for name in ("pass", "fail", "error"))))
        lines.append(f"{arm:8}{numbers}   {np.median(seconds):.1f}, {max(seconds):.1f}")
    reasons = Counter((outcome.verdict, reason(outcome)) for outcome in outcomes if not outcome.ok)
    lines += ["", *(f"{count:4}  {verdict:6} {why}" for (verdict, why), count in reasons.most_common())]
    passed = [outcome for outcome in outcomes if outcome.ok]
    if passed:
        worst = max(1e3 * outcome.errors["ik_to_executed"]["position_rmse"] for outcome in passed)
        lines += ["", f"executed off the plan, of those that passed: at most {worst:.2g} mm RMSE"]
    return "\n".join(lines)


def reason(outcome: batch.Outcome) -> str:
    """Return the checks that failed, or the first words of an error, without its file and its numbers."""
    if outcome.verdict == "fail":
        return outcome.cause
    said = outcome.cause.removeprefix(f"{Path(outcome.file).name}: ")
    return re.split(r";|\. |, expected", re.sub(r"(?<!\w)-?\d+(\.\d+)?", "N", said))[0]


@click.command()
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path), default=Path("build/corpus"))
@click.option("--jobs", default=1, show_default=True, type=click.IntRange(1), help="Processes at a time.")
def main(folder: Path, jobs: int) -> None:
    """Carry the corpus out and print what came of it."""
    work = corpus(folder, recordings.clip_names())
    quiet = not sys.stderr.isatty()

    def tell(done: int, bad: int, total: int) -> None:
        if not quiet or done % 20 == 0:
            click.echo(f"{done} of {total}, {bad} not verified", err=True)

    outcomes = batch.imitate_many(work, jobs=jobs, progress=tell)
    batch.write_tables(outcomes, folder)
    click.echo(table(outcomes))
    passed, seconds = sum(outcome.ok for outcome in outcomes), sum(outcome.seconds for outcome in outcomes)
    click.echo(f"{passed} of {len(outcomes)} verified; {seconds / 60:.1f} minutes of work")
    sys.exit(0 if all(outcome.ok or outcome.cause for outcome in outcomes) else 3)


if __name__ == "__main__":
    main()
