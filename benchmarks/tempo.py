"""`python -m benchmarks.tempo`: how fast two arms carry out the motions of a person's hand, and what would bound it.

Twelve clips of a person (`recordings.clip`, the right hand, seed 0) on the panda and the iiwa. Duration factors of the
motion itself: without the reserve of 2 %, lead-in and lead-out. *Exact* follows the learned path as `--tempo uniform
--tolerance 0` does; *fitted* within the tolerance; *local* is slowed down only where limits bind. Limits of velocity,
acceleration, jerk and torque. The bound is what the arm's tip can turn and move at all (`fastest_tip`), the first and
last 1 % of the motion left out; *ends* is by how much the total changes without the first and last 2 % of the samples.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass

import click
import numpy as np
from dmpcpp import (
    Arm,
    JointTrajectory,
    arms,
    imitation,
    largest_demand,
    motion,
    paced,
    planning,
    recordings,
)
from dmpcpp._core import PoseDmp
from dmpcpp.learning import learn
from dmpcpp.planning import Tolerance, taken_tolerance
from dmpcpp.robot import POSE
from dmpcpp.simulation import default_simulator

CLIPS = (
    "cartwheel",
    "crawl",
    "dance_a",
    "dance_b",
    "getup_facedown",
    "getup_faceup",
    "jump",
    "kick",
    "punch",
    "run",
    "spinkick",
    "walk",
)
ARMS = ("panda", "iiwa")
_SHARE = 0.95  # of the effort limits, as planning takes it
_ENDS = 0.02


@dataclass(frozen=True)
class Row:
    """One motion on one arm; factors on the recorded duration."""

    clip: str
    arm: str
    scale: float
    bound: tuple[float, float]
    exact: float
    exact_local: float
    fitted: float
    fitted_local: float
    ends: float
    seconds: tuple[float, float, float]  # CPU of placing, fitting, pacing


def measured(clip: str, name: str, tolerance: Tolerance) -> Row:
    """Place and learn one clip, follow it exactly and fitted, and time both evenly and locally."""
    arm = arms.find(name)
    recording = motion.plausible(motion.continuous(recordings.clip(clip)))
    begun = time.process_time()
    clear = planning.clear_of_itself(arm, default_simulator)
    placement = planning.place(recording, arm, accept=clear)
    placed_in = time.process_time() - begun
    model = learn(motion.demonstration(placement.apply_to(recording)))
    exact = planning.solve(model, arm, start=placement.start, accept=clear, slow_down=False)
    begun = time.process_time()
    fit = planning.fitted(arm, exact.motion, exact.joints, tolerance, POSE, clear, _SHARE)
    fitted_in = time.process_time() - begun
    joints = fit.joints if fit else exact.joints
    begun = time.process_time()
    local = _local(arm, joints)
    paced_in = time.process_time() - begun
    return Row(
        clip,
        name,
        placement.scale,
        bound(model, arm),
        _even(arm, exact.joints),
        _local(arm, exact.joints),
        _even(arm, joints),
        local,
        abs(_local(arm, _without_ends(joints)) / local - 1.0),
        (placed_in, fitted_in, paced_in),
    )


def bound(model: PoseDmp, arm: Arm) -> tuple[float, float]:
    """Return the factors below which no method comes that follows the path exactly: evenly, and locally."""
    found = planning.arm_bound(arm, model.rollout(dt=model.duration / 2000), POSE)
    return found.uniform, found.local


def _limits(arm: Arm) -> dict[str, object]:
    return {
        "velocity_limit": arm.velocity_limit,
        "acceleration_limit": arm.acceleration_limit,
        "jerk_limit": arm.jerk_limit,
        "effort_limit": _SHARE * arm.effort_limit,
        "arm": arm,
    }


def _even(arm: Arm, joints: JointTrajectory) -> float:
    return largest_demand(joints, **_limits(arm)).factor


def _local(arm: Arm, joints: JointTrajectory) -> float:
    pace = paced(joints, **_limits(arm)).pace
    return float((pace.time[-1] - pace.time[0]) / (joints.time[-1] - joints.time[0]))


def _without_ends(joints: JointTrajectory) -> JointTrajectory:
    left_out = round(_ENDS * len(joints.time))
    kept = slice(left_out, len(joints.time) - left_out)
    return JointTrajectory.through(joints.time[kept], joints.position[kept])


def rows(clips: tuple[str, ...], names: tuple[str, ...], tolerance: Tolerance) -> Iterator[Row]:
    """Yield every clip on every arm."""
    for clip in clips:
        for name in names:
            yield measured(clip, name, tolerance)


def _line(row: Row) -> str:
    uniform, local = row.bound
    place, fit, pace = row.seconds
    return (
        f"| {row.clip} {row.arm} | {row.scale:.2f} | {uniform:.2f}; {local:.2f} "
        f"| {row.exact:.2f} | {row.exact_local:.2f} "
        f"| {row.fitted:.2f} | {row.fitted_local:.2f} | {row.fitted_local / local:.2f} | {100 * row.ends:.1f} "
        f"| {place:.2f} | {fit:.2f} | {pace:.3f} |"
    )


def _summary(found: list[Row]) -> Iterator[str]:
    for name in ("exact", "exact_local", "fitted", "fitted_local"):
        values = [getattr(row, name) for row in found]
        yield f"{name}: median {np.median(values):.2f}, worst {max(values):.2f}"
    evenly, locally = np.median([row.bound for row in found], axis=0)
    yield f"bound: median {evenly:.2f} evenly, {locally:.2f} locally"
    ends = sum(row.ends > _ENDS for row in found)
    yield f"the ends change the total by more than 2 %: {ends} of {len(found)}"
    for k, what in enumerate(("placing", "fitting", "pacing")):
        spent = [row.seconds[k] for row in found]
        yield f"CPU of {what}: median {np.median(spent):.2f} s, worst {max(spent):.2f} s"


@click.command()
@click.option("--clip", "clips", multiple=True, default=CLIPS, type=click.Choice(CLIPS), help="Repeatable.")
@click.option("--arm", "names", multiple=True, default=ARMS, help="Repeatable.")
@click.option("--tolerance", default="1mm,0.5deg", show_default=True, help="Of the fitted motion.")
@click.option("--execute", is_flag=True, help="Carry each out in both engines with every check; takes ten minutes.")
def main(clips: tuple[str, ...], names: tuple[str, ...], tolerance: str, execute: bool) -> None:
    """Print a table of the motions on the arms."""
    within = taken_tolerance(tolerance) or Tolerance(1e-9, 1e-9)
    print(
        "| motion | scale | bound | exact | local | fitted | local | to the bound | ends % | place s | fit s | pace s |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    found = []
    for row in rows(clips, names, within):
        found.append(row)
        print(_line(row), flush=True)
    print("\n".join(_summary(found)))
    if execute:
        _execute(clips, names, tolerance)


def _execute(clips: tuple[str, ...], names: tuple[str, ...], tolerance: str) -> None:
    for clip in clips:
        for name in names:
            run = imitation.imitate(recordings.clip(clip), arms.find(name), simulator="both", tolerance=tolerance)
            failed = ", ".join(check.name for check in run.failed)
            print(f"{clip} {name}: {run.verdict_word}, {run.slowdown:.2f} x {failed}", flush=True)


if __name__ == "__main__":
    main()
