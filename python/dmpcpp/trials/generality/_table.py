"""What many trials come to: pass rates, distributions of errors, and the causes of failures."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from dmpcpp.trials.generality._trial import Result

__all__ = ["GOAL", "Distribution", "Row", "rows", "summary"]

GOAL = 0.99
"""Share of the trials that must pass."""


@dataclass(frozen=True)
class Distribution:
    """Median, 95th percentile and largest of some errors."""

    median: float
    p95: float
    largest: float

    @staticmethod
    def of(values: Iterable[float | None]) -> Distribution | None:
        """Of the numbers among `values`; None if there are none."""
        known = np.array([value for value in values if value is not None], dtype=np.float64)
        if known.size == 0:
            return None
        return Distribution(float(np.median(known)), float(np.percentile(known, 95)), float(known.max()))


@dataclass(frozen=True)
class Row:
    """The trials of an arm at a level of noise.

    Attributes
    ----------
    arm, noise : str
    trials, passed : int
    as_drawn : int
        Passed where they were drawn; the others after a place was searched.
    learned_position, learned_angle, goal_miss, tracked_position, tracked_angle : Distribution or None
        m and rad; see `Result`.
    scale, slowdown : Distribution or None
    causes : dict of str to int
        How many failed for what: the name of the first check or step that did not hold.
    """

    arm: str
    noise: str
    trials: int
    passed: int
    as_drawn: int
    learned_position: Distribution | None
    learned_angle: Distribution | None
    goal_miss: Distribution | None
    tracked_position: Distribution | None
    tracked_angle: Distribution | None
    scale: Distribution | None
    slowdown: Distribution | None
    causes: dict[str, int]


_MEASURED = (
    "learned_position",
    "learned_angle",
    "goal_miss",
    "tracked_position",
    "tracked_angle",
    "scale",
    "slowdown",
)


def rows(results: Iterable[Result]) -> list[Row]:
    """Return one row for every arm and level of noise, in the order in which they come."""
    groups: dict[tuple[str, str], list[Result]] = {}
    for result in results:
        groups.setdefault((result.trial.arm, result.trial.noise), []).append(result)
    return [_row(arm, noise, group) for (arm, noise), group in groups.items()]


def summary(results: list[Result]) -> dict[str, Any]:
    """Return what `summary.json` holds: the rows, the share that passed and every failure with its cause."""
    share = sum(result.ok for result in results) / len(results)
    return {
        "verdict": "pass" if share >= GOAL else "fail",
        "trials": len(results),
        "share_passed": share,
        "goal": GOAL,
        "rows": [asdict(row) for row in rows(results)],
        "failures": [{**asdict(result.trial), "cause": result.cause} for result in results if not result.ok],
    }


def _row(arm: str, noise: str, group: list[Result]) -> Row:
    measured = {name: Distribution.of(getattr(result, name) for result in group) for name in _MEASURED}
    return Row(
        arm=arm,
        noise=noise,
        trials=len(group),
        passed=sum(result.ok for result in group),
        as_drawn=sum(result.ok and result.places == 0 for result in group),
        causes=dict(Counter(result.cause.replace(":", " ").split()[0] for result in group if not result.ok)),
        **measured,
    )
