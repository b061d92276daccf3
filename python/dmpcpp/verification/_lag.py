"""When in a log a plan was carried out, found from the joints alone: the two clocks need not agree."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from dmpcpp._core import JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.sending import states_at
from dmpcpp.verification._joint_log import JointLog

_GRID = 400  # times of the plan that are compared
_STEP = 0.02  # s between the lags that are tried first: short beside any motion of an arm
_RESOLUTION = 1e-7  # s
_STILL = 0.01  # of the plan's variance: a log that moves less within the plan's duration stands still


def estimate_lag(joints: JointTrajectory, log: JointLog) -> float:
    """The time on the log's clock [s] at which the plan began; where both have one clock, the lag of the arm.

    The one with the least mean squared distance of the joints, over all that leave at least half of the plan in
    the log: tried every 20 ms and refined between the samples by Brent's method on the cubic spline through the
    log. Where the log has no samples the plan counts as missed by its own standard deviation: of the cycles of a
    repeated motion the lag that covers all is taken. A constant offset of a joint does not move it.

    Parameters
    ----------
    joints : JointTrajectory
        The plan, (T, n).
    log : JointLog
        Of the same joints in the same order (``JointLog.of``).

    Raises
    ------
    InvalidArgument
        The log is shorter than half of the plan, or the plan does not move.
    """
    time = np.linspace(0.0, float(joints.time[-1] - joints.time[0]), _GRID)
    plan = states_at(joints, time)[0]
    spread = float(np.mean(np.var(plan, axis=0)))
    if spread < 1e-12:
        raise InvalidArgument("joints: the plan does not move; no time of the log fits better than another.")
    clock = log.time - log.time[0]  # a clock that counts from 1970 has no digits left for the search
    last, half = float(clock[-1]), 0.5 * time[-1]
    if last < half:
        raise InvalidArgument(f"{log.source}: {last:.3g} s, expected at least half of the plan's {time[-1]:.3g} s.")
    spline = CubicSpline(clock, log.position)

    def cost(lag: float) -> float:
        inside = (time + lag >= -1e-9) & (time + lag <= last + 1e-9)
        if not inside.any():
            return spread
        error = spline(time[inside] + lag) - plan[inside]
        share = np.mean(inside)
        return float(share * np.mean(np.var(error, axis=0)) + (1.0 - share) * spread)

    lags = np.linspace(-half, last - half, 2 + int(last / _STEP))
    moves = _variance_within(clock, log.position, lags, float(time[-1])) >= _STILL * spread
    costs = np.full(len(lags), np.inf)
    costs[moves] = [cost(lag) for lag in lags[moves]]
    if costs.min() >= (1.0 - _STILL**0.5) ** 2 * spread:  # else no lag at which the log stands still can be better
        costs[~moves] = [cost(lag) for lag in lags[~moves]]
    best = lags[np.argmin(costs)]
    step = lags[1] - lags[0]
    found = minimize_scalar(cost, bounds=(best - step, best + step), options={"xatol": _RESOLUTION})
    return float(log.time[0] + (found.x if found.fun <= cost(best) else best))


def _variance_within(clock: Array, position: Array, lags: Array, duration: float) -> Array:
    """Mean variance of the joints over the samples of each window of the log; inf where one reaches beyond the log."""
    first, last = np.searchsorted(clock, lags), np.searchsorted(clock, lags + duration)
    count = np.maximum(last - first, 1)[:, None]
    centred = position - position.mean(axis=0)
    zero = np.zeros((1, position.shape[1]))
    sums, squares = (np.vstack([zero, np.cumsum(centred**power, axis=0)]) for power in (1, 2))
    mean = (sums[last] - sums[first]) / count
    variance = np.mean((squares[last] - squares[first]) / count - mean**2, axis=1)
    beyond = (lags < 0.0) | (lags + duration > clock[-1])
    return np.where(beyond, np.inf, variance)
