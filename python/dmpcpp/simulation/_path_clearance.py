"""The least clearance along a whole path, not at some samples of it.

Between two postures no point of the robot moves farther than the joints' steps times their levers, L. Where the
clearances at both are c and c', none in between is less than (c + c' - L) / 2; where that is not enough, the posture
in the middle is looked at, and so on. A path that keeps clear is proven so with few looks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.simulation._simulator import Clearance, Simulator, kind_of

__all__ = ["CLEAR", "Nearest", "nearest_along"]

CLEAR = 2e-3
"""m that a placed motion keeps: as much as two engines differ in their shapes."""

_FINEST = 0.5e-3  # m; no posture is looked at between two that are nearer to each other than this


@dataclass(frozen=True)
class Nearest:
    """Where a path comes closest: at which sample (a fraction between two), and what to what."""

    sample: float
    clearance: Clearance


def nearest_along(
    engine: Simulator, position: Array, links: frozenset[str], limit: float, *, far: float = 0.05, first: int = 20
) -> dict[str, Nearest]:
    """Return the closest pairs of each kind ("self", "floor", "object") along joints (T, n), nearer than `far` [m].

    Exact where nothing is nearer than `limit` [m]: that is proven for the whole path; what is nearer is found to 0.5 mm
    of motion, and the search ends at the first.
    """
    look = _Look(engine, position, links, far)
    samples = np.unique(np.linspace(0, len(position) - 1, min(first, len(position))).round())
    for sample in _in_doubt(look, samples, limit):
        if look.at(sample) < limit:
            break
    return look.nearest


class _Look:
    """Clearances at samples of a path, each looked up once."""

    def __init__(self, engine: Simulator, position: Array, links: frozenset[str], far: float) -> None:
        self._engine, self._position, self._links, self._far = engine, position, links, far
        steps = np.abs(np.diff(position, axis=0)) @ engine.levers
        self._way = np.concatenate([[0.0], np.cumsum(steps)])  # m
        self._found: dict[float, float] = {}
        self.nearest: dict[str, Nearest] = {}

    def at(self, sample: float) -> float:
        """Return the least clearance at a sample, m."""
        if sample not in self._found:
            near = self._engine.clearances_at(self._joints(sample), self._far)
            self._found[sample] = min((one.distance for one in near), default=self._far)
            for one in near:
                self._keep(sample, one)
        return self._found[sample]

    def way(self, one: float, other: float) -> float:
        """Return how far a point moves between two samples at most, m."""
        places = np.interp([one, other], np.arange(len(self._way)), self._way)
        return float(places[1] - places[0])

    def _joints(self, sample: float) -> Array:
        k = min(int(sample), len(self._position) - 1)
        share = sample - k
        if share == 0.0:
            return np.asarray(self._position[k])
        return np.asarray((1.0 - share) * self._position[k] + share * self._position[k + 1])

    def _keep(self, sample: float, one: Clearance) -> None:
        kind = kind_of(one.other, self._links)
        if kind not in self.nearest or one.distance < self.nearest[kind].clearance.distance:
            self.nearest[kind] = Nearest(sample, one)


def _in_doubt(look: _Look, samples: Array, limit: float) -> Iterator[float]:
    """Yield samples to look at: the first ones, then the middle of each stretch that is not proven to be clear."""
    yield from samples.tolist()
    stretches = list(zip(samples[:-1].tolist(), samples[1:].tolist(), strict=True))
    while stretches:
        one, other = stretches.pop()
        way = look.way(one, other)
        if way <= _FINEST or 0.5 * (look.at(one) + look.at(other) - way) >= limit:
            continue
        middle = 0.5 * (one + other)
        yield middle
        stretches += [(one, middle), (middle, other)]
