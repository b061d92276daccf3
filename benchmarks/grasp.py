"""`python -m benchmarks.grasp [--json]`: the bottle, 200 times at random and 50 times with little friction.

Every grasp is one line of a file, so that a benchmark that was stopped goes on where it was; grasps already in the
file are not made again. Placement i of a seed is the same whatever their number. Exit status: 0 every goal reached,
3 one missed.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import numpy as np
from dmpcpp import arms, grasp
from dmpcpp.errors import InvalidArgument
from dmpcpp.simulation import Cylinder, Friction, ParallelGripper
from dmpcpp.simulation._objects import PANDA_HAND

_SLIPPERY = Cylinder(friction=Friction(0.3, spinning=1e-3, rolling=1e-4))
_SMOOTH_HAND = ParallelGripper(
    PANDA_HAND.joints, PANDA_HAND.links, PANDA_HAND.opening, PANDA_HAND.depth, PANDA_HAND.force, Friction(0.5)
)
SETS = {"as it is": (Cylinder(), PANDA_HAND), "friction 0.3 x 0.5": (_SLIPPERY, _SMOOTH_HAND)}
"""Object and gripper by the name of the set; frictions multiply."""


def attempt(planner: grasp.Planner, bottle: grasp.Bottle) -> dict[str, Any]:
    """Grasp once; numbers in m, rad and s."""
    begun = time.perf_counter(), time.process_time()
    try:
        plan = planner.plan(bottle)
    except InvalidArgument as error:
        return {"ok": False, "failed": [str(error)]}
    planned = time.perf_counter(), time.process_time()
    log = grasp.carry_out(plan, planner.arm, planner.gripper)
    done = time.perf_counter(), time.process_time()
    checks = grasp.judge(log, planner.arm)
    simulated = log.steps / log.rate
    return {
        "ok": all(check.ok for check in checks),
        "failed": [check.name for check in checks if not check.ok],
        **{check.name: check.value for check in checks},
        "pitch": plan.pitch,
        "slowdown": plan.slowdown,
        "planning": planned[0] - begun[0],
        "wall_per_second": (done[0] - planned[0]) / simulated,
        "cpu_per_second": (done[1] - planned[1]) / simulated,
    }


def run(name: str, count: int, seed: int, kept: Path) -> Iterator[dict[str, Any]]:
    """Every grasp of a set, from the file or made now."""
    known = {(r["set"], r["seed"], r["index"]): r for r in map(json.loads, kept.read_text().splitlines())}
    cylinder, hand = SETS[name]
    planner = grasp.Planner(grasp.default_reach(), arms.find("panda"), hand)
    for index in range(count):
        result = known.get((name, seed, index))
        if result is None:
            bottle = grasp.random_bottle(np.random.default_rng([seed, index]), cylinder)
            result = {"set": name, "seed": seed, "index": index, **attempt(planner, bottle)}
            with kept.open("a", encoding="utf-8") as file:
                file.write(json.dumps(result) + "\n")
        yield result


def figures(name: str, results: list[dict[str, Any]]) -> dict[str, Any]:
    """What the results of a set come to."""
    done = [result for result in results if "slip" in result]
    slips = [result["slip"] for result in done]
    return {
        "set": name,
        "grasps": len(results),
        "passed": sum(result["ok"] for result in results),
        "slip_median": float(np.median(slips)),
        "slip_p95": float(np.percentile(slips, 95)),
        "slip_max": max(slips),
        "rise_min": min(result["rise"] for result in done),
        "tilt_max": max(result["tilt"] for result in done),
        "clipped_steps": sum(result["torque_clipped"] for result in done),
        "torque_ratio_max": max(result["torque_ratio"] for result in done),
        "planning_median": float(np.median([result["planning"] for result in done])),
        "wall_per_second_median": float(np.median([result["wall_per_second"] for result in done])),
        "cpu_per_second_median": float(np.median([result["cpu_per_second"] for result in done])),
        "failures": {str(r["index"]): r["failed"] for r in results if not r["ok"]},
    }


def goals(normal: dict[str, Any], slippery: dict[str, Any]) -> dict[str, bool]:
    """Which goals are reached."""
    return {
        "all pass": normal["passed"] == normal["grasps"],
        "slip p95 <= 0.2 mm": normal["slip_p95"] <= 0.2e-3,
        "no torque clipped": normal["clipped_steps"] == 0,
        "friction 0.3 x 0.5: 98 %": slippery["passed"] >= 0.98 * slippery["grasps"],
        "wall time per simulated second <= 0.15 s": normal["wall_per_second_median"] <= 0.15,
    }


@click.command()
@click.option("--count", default=200, show_default=True, type=click.IntRange(4), help="Placements; a quarter slippery.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0))
@click.option("--keep", default="benchmark-grasp.jsonl", show_default=True, type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def main(count: int, seed: int, keep: Path, as_json: bool) -> None:
    """Grasp bottles at random places and say how that went, beside the goals."""
    keep.touch()
    normal, slippery = (
        figures(name, list(run(name, number, seed, keep)))
        for name, number in zip(SETS, (count, count // 4), strict=True)
    )
    reached = goals(normal, slippery)
    if as_json:
        click.echo(json.dumps({"seed": seed, "sets": [normal, slippery], "goals": reached}, indent=2))
    else:
        for one in (normal, slippery):
            click.echo(
                "\n".join(
                    f"{key}: {value:.4g}" if isinstance(value, float) else f"{key}: {value}"
                    for key, value in one.items()
                )
                + "\n"
            )
        click.echo("\n".join(f"{'reached' if ok else 'MISSED'}: {goal}" for goal, ok in reached.items()))
    sys.exit(0 if all(reached.values()) else 3)


if __name__ == "__main__":
    main()
