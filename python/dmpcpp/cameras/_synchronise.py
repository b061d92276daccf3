"""When the second camera's clock shows what: found from the hand that both saw, without a clap or a flash.

At the right shift the rays of both cameras meet; at a wrong one they do not, wherever the cameras stand. The whole
range is searched with the eight-point algorithm, among shifts at which both see most of the motion; the lowest valleys
are looked at with the full relation, and the best is refined.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.cameras._landmarks import Landmarks
from dmpcpp.cameras._relation import Relation, cross_matrix, essential, relate, sampson

__all__ = ["Shift", "paired_rays", "synchronise"]

_GRID = 1.0 / 30.0  # s, of the coarse search
_OVERLAP = 0.5  # of the way that the hand goes in either picture, which both must show
_LONG = 20.0  # s; shorter videos do not show that clocks run at different rates
_COARSE = (0, 1, 5, 9, 13, 17, 8, 12, 20)  # landmarks of the coarse search
_MOST_DRIFT = 2e-3
_VALLEYS, _THINNED = 16, 600  # of the coarse cost that are looked at closely; rays for that
_GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0


@dataclass(frozen=True)
class Shift:
    """The second clock shows (1 + drift) tau + shift [s] when the first shows tau.

    `error` is left at it, in deviations of a landmark.
    """

    shift: float
    drift: float = 0.0
    error: float = 0.0

    def second(self, time: Array) -> Array:
        """Return what the second clock shows."""
        return (1.0 + self.drift) * time + self.shift

    def first(self, time: Array) -> Array:
        """Return what the first clock shows when the second shows `time`."""
        return (time - self.shift) / (1.0 + self.drift)


def paired_rays(
    first: Landmarks, second: Landmarks, shift: Shift, landmarks: tuple[int, ...] | None = None
) -> tuple[Array, Array]:
    """Return rays (N, 2) of the same landmarks at the same time in both cameras, frames that both saw."""
    other = second.at(shift.second(first.time))
    both = first.found & other.found
    chosen = list(landmarks) if landmarks else slice(None)
    return first.rays[both][:, chosen].reshape(-1, 2), other.rays[both][:, chosen].reshape(-1, 2)


def synchronise(
    first: Landmarks, second: Landmarks, relation: Relation | None = None, longest: float = 10.0
) -> Shift | None:
    """Return the shift between two cameras' clocks, None where no shift explains both videos.

    Parameters
    ----------
    first, second : Landmarks
    relation : Relation, optional
        How the cameras stand, where that is known.
    longest : float
        s; shifts are searched up to here either way.
    """
    costs = {}
    for shift in _plausible(first, second, longest):
        costs[shift] = _coarse(first, second, shift, relation)
    costs = {shift: cost for shift, cost in costs.items() if np.isfinite(cost)}
    if not costs:
        return None
    fine = {shift: _fine(first, second, shift, relation, _THINNED) for shift in _lowest(costs)}
    start = min(fine, key=lambda shift: fine[shift])
    best = _refined(_Fine(first, second, relation), start)
    if not np.isfinite(best[1]):
        return None
    found = Shift(best[0], 0.0, best[1])
    return _with_drift(first, second, found, relation)


def _lowest(costs: dict[float, float]) -> list[float]:
    """Return the shifts of the lowest valleys of the coarse cost: eight points alone often prefer a wrong one."""
    shifts, values = list(costs), [np.inf, *costs.values(), np.inf]
    valleys = [shift for k, shift in enumerate(shifts) if values[k + 1] <= min(values[k], values[k + 2])]
    return sorted(valleys, key=lambda shift: costs[shift])[:_VALLEYS]


def _plausible(first: Landmarks, second: Landmarks, longest: float) -> list[float]:
    """Return the shifts at which both cameras see most of how far the hand moved.

    What a hand at rest shows fits any two videos.
    """
    grid = np.arange(-longest, longest + _GRID / 2, _GRID) + (second.time[0] - first.time[0])
    ways = [_way(view) for view in (first, second)]
    shares = [np.minimum(_seen(ways[0], second.time - shift), _seen(ways[1], first.time + shift)) for shift in grid]
    return [float(shift) for shift, share in zip(grid, shares, strict=True) if share >= _OVERLAP]


def _way(view: Landmarks) -> tuple[Array, Array]:
    """Return times and how far the hand has come in the picture by then, as a share of all."""
    there = view.found
    middle, time = view.pixels[there][:, (0, 5, 17)].mean(axis=1), view.time[there]
    steps = np.linalg.norm(np.diff(middle[:: max(1, len(middle) // 150)], axis=0), axis=1)  # without its jitter
    way = np.r_[0.0, np.cumsum(steps)]
    return time[:: max(1, len(middle) // 150)], way / max(way[-1], 1e-9)


def _seen(way: tuple[Array, Array], time: Array) -> float:
    """Return the share of the way that lies between the first and the last of some times."""
    begin, end = np.interp(time[[0, -1]], *way, left=0.0, right=1.0)
    return float(end - begin)


def _coarse(first: Landmarks, second: Landmarks, shift: float, relation: Relation | None) -> float:
    a, b = paired_rays(first, second, Shift(shift), _COARSE)
    thin = max(1, len(a) // 1500)
    a, b = a[::thin], b[::thin]
    if len(a) < 40:
        return np.inf
    matrix = essential(a, b) if relation is None else cross_matrix(relation.translation) @ relation.rotation
    return _mean_error(sampson(matrix, a, b), second.deviation)


def _fine(first: Landmarks, second: Landmarks, shift: float, relation: Relation | None, most: int = 4000) -> float:
    a, b = paired_rays(first, second, Shift(shift))
    thin = max(1, len(a) // most)
    a, b = a[::thin], b[::thin]
    if relation is None:
        relation = relate(a, b, second.deviation)
    if relation is None or len(a) < 40:
        return np.inf
    return _cost_of(a, b, relation, second.deviation)


class _Fine:
    """The cost of a shift: each search for the relation starts at eight points and at the best one so far."""

    def __init__(self, first: Landmarks, second: Landmarks, known: Relation | None) -> None:
        self.views, self.known = (first, second), known
        self.best: tuple[float, Relation] | None = None

    def __call__(self, shift: float) -> float:
        first, second = self.views
        if self.known is not None:
            return _fine(first, second, shift, self.known)
        a, b = paired_rays(first, second, Shift(shift))
        thin = max(1, len(a) // 2000)
        a, b = a[::thin], b[::thin]
        found = [relate(a, b, second.deviation)]
        found += [relate(a, b, second.deviation, self.best[1])] if self.best else []
        costs = [(_cost_of(a, b, each, second.deviation), each) for each in found if each is not None]
        if not costs:
            return float("inf")
        lowest = min(costs, key=lambda pair: pair[0])
        self.best = lowest if self.best is None or lowest[0] < self.best[0] else self.best
        return lowest[0]


def _cost_of(first: Array, second: Array, relation: Relation, deviation: float) -> float:
    matrix = cross_matrix(relation.translation) @ relation.rotation
    return _mean_error(sampson(matrix, first, second), deviation)


def _mean_error(error: Array, deviation: float) -> float:
    """Return the pseudo-Huber mean, in deviations, of distances: outliers count by their size, not its square."""
    return float(np.sqrt(np.mean(2.0 * (np.sqrt(1.0 + (error / deviation) ** 2) - 1.0))))


def _refined(cost, start: float, reach: float = 2.0 * _GRID, further: int = 4):  # type: ignore[no-untyped-def]
    """Return the shift of the least cost about a start, and that cost: a grid that may move on, then golden section."""
    grid = start + np.linspace(-reach, reach, 9)
    costs = [cost(shift) for shift in grid]
    costs = [min(before, cost(shift)) for before, shift in zip(costs, grid, strict=True)]  # from the best relation
    k = int(np.argmin(costs))
    if k in (0, len(grid) - 1) and further:
        return _refined(cost, float(grid[k]), reach, further - 1)
    low, high = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
    while high - low > 0.002:
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        low, high = (low, b) if cost(a) < cost(b) else (a, high)
    best = float((low + high) / 2.0)
    return best, cost(best)


def _with_drift(first: Landmarks, second: Landmarks, found: Shift, relation: Relation | None) -> Shift:
    """Return the shift with the drift that a long video shows: the shift of its two halves."""
    span = first.time[-1] - first.time[0]
    if span < _LONG:
        return found
    known = relation or relate(*paired_rays(first, second, found), second.deviation)
    middle = first.time[0] + span / 2.0
    halves = [first.part(first.time < middle), first.part(first.time >= middle)]
    shifts = [_refined(lambda shift, half=half: _fine(half, second, shift, known), found.shift) for half in halves]
    drift = (shifts[1][0] - shifts[0][0]) / (span / 2.0)
    if not np.isfinite([shifts[0][1], shifts[1][1]]).all() or abs(drift) > _MOST_DRIFT:
        return found
    return Shift((shifts[0][0] + shifts[1][0]) / 2.0 - drift * middle, drift, found.error)
