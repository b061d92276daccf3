"""A measured value compared with a limit: holds, fails or not judged; and what results with such checks share."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np

from dmpcpp._core import InvalidArgument
from dmpcpp._typing import Array

__all__ = ["ACCEPTABLE", "SUMMARY_VERSION", "Check", "Checked", "Series", "accepted_names"]

SUMMARY_VERSION = 2
"""Of what summary.json holds; one without a version is of 0.1, in which every check was judged."""

ACCEPTABLE = ("joint_margin", "velocity_ratio", "acceleration_ratio", "torque_ratio", "inertia", "dimensions")
"""Checks that may be left unjudged for want of a limit, and be accepted so."""

ROUNDING = 1e-6
"""What a limit forgives: a motion scaled to exactly a limit meets it only to rounding and tracking."""


@dataclass(frozen=True)
class Check:
    """One measured value and its limit.

    Attributes
    ----------
    name : str
    ok : bool
        True if the limit holds; False if it fails or was not judged.
    value : float
        Measured value; NaN if none.
    limit : float
        Largest allowed value (smallest for margins, clearances, coverage); NaN if unknown.
    unit : str
        "m", "rad", "s", "1" (a ratio), "steps", "links", "checks".
    time : float or None
        Where in the execution the worst is [s].
    detail : str
        The joint or the links concerned; for a check that was not judged, why and what to state.
    judged : bool
        Whether there was a limit to judge by. A check that was not judged holds no more than one that failed, but a
        person may accept it.
    """

    name: str
    ok: bool
    value: float
    limit: float
    unit: str
    time: float | None = None
    detail: str = ""
    judged: bool = True

    def __post_init__(self) -> None:
        """Refuse a contradiction."""
        if self.ok and not self.judged:
            raise ValueError(f"check '{self.name}': it cannot hold and not be judged.")

    @staticmethod
    def not_judged(name: str, unit: str, why: str, value: float = math.nan) -> Check:
        """Return a check that nobody can judge; `why` says what is missing and what to state."""
        return Check(name, False, value, math.nan, unit, None, why, judged=False)

    @property
    def result(self) -> Literal["holds", "fails", "not judged"]:
        """One of the three results."""
        if not self.judged:
            return "not judged"
        return "holds" if self.ok else "fails"

    def to_dict(self) -> dict[str, Any]:
        """For JSON: numbers of Python's own kinds, None for one that is not finite."""
        plain = {k: v.item() if isinstance(v, np.generic) else v for k, v in asdict(self).items()}
        del plain["judged"]
        plain = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in plain.items()}
        return {**plain, "result": self.result}


class Checked:
    """What a result with ``checks`` can be asked: whether all held, which did not, one by its name.

    ``accepted`` names the checks that a person takes although they were not judged; one that failed stays failed.
    """

    checks: tuple[Check, ...]
    accepted: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether every check held, or was not judged and is accepted."""
        return not self.failed and not self.open

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks that were judged and did not hold."""
        return tuple(check for check in self.checks if check.judged and not check.ok)

    @property
    def not_judged(self) -> tuple[Check, ...]:
        """The checks that nobody could judge, accepted or not."""
        return tuple(check for check in self.checks if not check.judged)

    @property
    def open(self) -> tuple[Check, ...]:
        """The checks that were not judged and that nobody accepted."""
        return tuple(check for check in self.not_judged if check.name not in self.accepted)

    @property
    def verdict_word(self) -> str:
        """How a person is told: "verified", "verified, not judged: ..." or "not verified"."""
        if not self.ok:
            return "not verified"
        left = ", ".join(dict.fromkeys(check.name for check in self.not_judged))
        return f"verified, not judged: {left}" if left else "verified"

    def __getitem__(self, name: str) -> Check:
        """The check of that name; KeyError lists those that there are."""
        for check in self.checks:
            if check.name == name:
                return check
        raise KeyError(f"'{name}'; the checks are {', '.join(check.name for check in self.checks)}")

    def judged(self) -> dict[str, Any]:
        """For JSON: the verdict ("pass", "fail" or "not judged"), what was not judged, what of it a person accepts,
        and the checks.
        """
        names = list(dict.fromkeys(check.name for check in self.not_judged))
        return {
            "version": SUMMARY_VERSION,
            "verdict": "pass" if self.ok else "fail" if self.failed else "not judged",
            "not_judged": names,
            "accepted": [name for name in names if name in self.accepted],
            "checks": [check.to_dict() for check in self.checks],
        }


def accepted_names(names: Iterable[str]) -> tuple[str, ...]:
    """Return names of checks that a person accepts unjudged, each once.

    Raises
    ------
    InvalidArgument
        One is not in ``ACCEPTABLE``: it is judged in every run.
    """
    found = tuple(dict.fromkeys(names))
    for name in found:
        if name not in ACCEPTABLE:
            raise InvalidArgument(
                f"accept: '{name}', expected checks that may be left unjudged: {', '.join(ACCEPTABLE)}. "
                "A check that failed is never accepted."
            )
    return found


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
