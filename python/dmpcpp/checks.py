"""A promise that held or not, and what a value that made some has in common with all that do."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from dmpcpp._typing import Array

__all__ = ["Check", "Checked", "Series"]

ROUNDING = 1e-6
"""What a limit forgives: a motion scaled to exactly a limit meets it only to rounding and tracking."""


@dataclass(frozen=True)
class Check:
    """One promise.

    Attributes
    ----------
    name : str
    ok : bool
    value : float
        What was found.
    limit : float
        What was allowed: the most, for a margin the least.
    unit : str
        "m", "rad", "s", "1" (a ratio), "steps", "links", "checks".
    time : float or None
        Where in the execution the worst is [s].
    detail : str
        The joint or the links concerned.
    """

    name: str
    ok: bool
    value: float
    limit: float
    unit: str
    time: float | None = None
    detail: str = ""

    def to_dict(self) -> dict[str, Any]:
        """For JSON: numbers of Python's own kinds, None for one that is not finite."""
        plain = {k: v.item() if isinstance(v, np.generic) else v for k, v in asdict(self).items()}
        return {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in plain.items()}


class Checked:
    """What a result with ``checks`` can be asked: whether all held, which did not, one by its name."""

    checks: tuple[Check, ...]

    @property
    def ok(self) -> bool:
        """Whether every check held."""
        return all(check.ok for check in self.checks)

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks that did not hold."""
        return tuple(check for check in self.checks if not check.ok)

    def __getitem__(self, name: str) -> Check:
        """The check of that name; KeyError lists those that there are."""
        for check in self.checks:
            if check.name == name:
                return check
        raise KeyError(f"'{name}'; the checks are {', '.join(check.name for check in self.checks)}")

    def judged(self) -> dict[str, Any]:
        """For JSON: the verdict, "pass" or "fail", and the checks."""
        return {"verdict": "pass" if self.ok else "fail", "checks": [check.to_dict() for check in self.checks]}


@dataclass(frozen=True, eq=False)
class Series:
    """A quantity over time, held against a limit where it comes closest; limits forgive ROUNDING.

    Attributes
    ----------
    time : (N,)
        s
    values : (N,) or (N, n)
    where : tuple of str
        What the columns are, for the detail of the check.
    """

    time: Array
    values: Array
    where: tuple[str, ...] = ("",)

    def worst(self, pick: Callable[[Array], Any]) -> tuple[float, float | None, str]:
        """Return the value that `pick` (np.argmax, np.argmin) chooses, its time and its column."""
        if self.values.size == 0:
            return math.nan, None, "nothing was executed"
        values = self.values.reshape(len(self.time), -1)
        step, column = np.unravel_index(pick(values), values.shape)
        return float(values[step, column]), float(self.time[step]), self.where[int(column)]

    def at_most(self, name: str, limit: float, unit: str) -> Check:
        """Return the check that no value exceeds the limit."""
        value, time, detail = self.worst(np.argmax)
        return Check(name, value <= limit + ROUNDING * abs(limit), value, limit, unit, time, detail)

    def at_least(self, name: str, limit: float, unit: str) -> Check:
        """Return the check that no value falls below the limit."""
        value, time, detail = self.worst(np.argmin)
        return Check(name, value >= limit - ROUNDING, value, limit, unit, time, detail)
