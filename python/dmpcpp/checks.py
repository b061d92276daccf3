"""A promise that held or not, and what a value that made some has in common with all that do."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np


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
