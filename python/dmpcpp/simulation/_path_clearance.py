"""The least clearance along a whole path, not at some samples of it.

Between two postures the points of two links move no farther against each other than the steps of the joints between
them, times their levers: L. Where the clearances of the pair at both are c and c', none in between is less than
(c + c' - L) / 2; where that is not enough, the posture in the middle is looked at, and so on. A path that keeps clear
is proven so with few looks.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.simulation._simulator import Clearance, Simulator, kind_of

__all__ = ["CLEAR", "Nearest", "nearest_along"]

CLEAR = 2e-3
"""m that a placed motion keeps: as much as two engines differ in their shapes."""

_FINEST = 0.5e-3  # m; no posture is looked at between two that are nearer to each other than this


Pair = tuple[str, str]


@dataclass(frozen=True)
class Nearest:
    """Where a path comes closest: at which sample (a fraction between two), what to what, and what is asked for."""

    sample: float
    clearance: Clearance
    limit: float = 0.0

    @property
    def margin(self) -> float:
        """How much farther than asked for, m."""
        return self.clearance.distance - self.limit


def nearest_along(
    engine: Simulator,
    position: Array,
    links: frozenset[str],
    limit: float,
    *,
    tight: Collection[Pair] = (),
    of_objects: float | None = None,
    far: float = 0.05,
    first: int = 20,
) -> dict[str, Nearest]:
    """Return the closest pairs of each kind ("self", "floor", "object") along joints (T, n), nearer than `far` [m].

    Exact where nothing is nearer than `limit` [m]: that is proven for the whole path; what is nearer is found to 0.5 mm
    of motion, and the search ends at the first. Of `tight` pairs, which are built close to each other, only contact
    counts. `of_objects` is the limit [m] of what is no link and not the floor, `limit` unless given.
    """
    beside = limit if of_objects is None else of_objects

    def limit_of(pair: Pair) -> float:
        if pair in tight:
            return 0.0
        return beside if kind_of(pair[1], links) == "object" else limit

    limit = max(limit, beside)
    far = max(far, 2.0 * limit)
    look = _Look(engine, position, links, far, limit_of)
    samples = np.unique(np.linspace(0, len(position) - 1, min(first, len(position))).round())
    for sample in _in_doubt(look, samples, limit):
        look.at(sample)
        if any(one.margin < 0.0 for one in look.nearest.values()):
            break
    return look.nearest


class _Look:
    """Clearances at samples of a path, each looked up once."""

    def __init__(
        self,
        engine: Simulator,
        position: Array,
        links: frozenset[str],
        far: float,
        limit_of: Callable[[Pair], float],
    ) -> None:
        self._engine, self._position, self._links, self._far, self._limit_of = engine, position, links, far, limit_of
        self._steps = np.abs(np.diff(position, axis=0))
        self._ways: dict[Pair, Array] = {}
        self._longest = self._summed(engine.levers.all)
        self._found: dict[float, dict[Pair, float]] = {}
        self.nearest: dict[str, Nearest] = {}

    def at(self, sample: float) -> dict[Pair, float]:
        """Return the clearance of each pair nearer than `far` at a sample, m."""
        if sample not in self._found:
            near = self._engine.clearances_at(self._joints(sample), self._far)
            self._found[sample] = {(one.link, one.other): one.distance for one in near}
            for one in near:
                self._keep(Nearest(sample, one, self._limit_of((one.link, one.other))))
        return self._found[sample]

    def proves(self, one: float, other: float, limit: float) -> bool:
        """Whether nothing comes nearer than asked for between two samples, or these are too near to each other."""
        before, after = self.at(one), self.at(other)
        way = _between(self._longest, one, other)
        if way > _FINEST and self._far - 0.5 * way < limit:
            return False
        for pair in before.keys() | after.keys():
            way = _between(self._way_of(pair), one, other)
            least = 0.5 * (before.get(pair, self._far) + after.get(pair, self._far) - way)
            if way > _FINEST and least < self._limit_of(pair):
                return False
        return True

    def _way_of(self, pair: Pair) -> Array:
        if pair not in self._ways:
            self._ways[pair] = self._summed(self._engine.levers.between(*pair))
        return self._ways[pair]

    def _summed(self, levers: Array) -> Array:
        """Return how far a point has moved at each sample at most, m."""
        return np.concatenate([[0.0], np.cumsum(self._steps @ levers)])

    def _joints(self, sample: float) -> Array:
        k = min(int(sample), len(self._position) - 1)
        share = sample - k
        if share == 0.0:
            return np.asarray(self._position[k])
        return np.asarray((1.0 - share) * self._position[k] + share * self._position[k + 1])

    def _keep(self, near: Nearest) -> None:
        kind = kind_of(near.clearance.other, self._links)
        if kind not in self.nearest or near.margin < self.nearest[kind].margin:
            self.nearest[kind] = near


def _between(way: Array, one: float, other: float) -> float:
    """Return how much of a way (T,) lies between two samples."""
    places = np.interp([one, other], np.arange(len(way)), way)
    return float(places[1] - places[0])


def _in_doubt(look: _Look, samples: Array, limit: float) -> Iterator[float]:
    """Yield samples to look at: the first ones, then the middle of each stretch that is not proven to be clear."""
    yield from samples.tolist()
    stretches = list(zip(samples[:-1].tolist(), samples[1:].tolist(), strict=True))
    while stretches:
        one, other = stretches.pop()
        if look.proves(one, other, limit):
            continue
        middle = 0.5 * (one + other)
        yield middle
        stretches += [(one, middle), (middle, other)]
