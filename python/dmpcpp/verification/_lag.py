"""When in a log a plan was carried out, found from the joints alone: the two clocks need not agree."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from dmpcpp._core import JointTrajectory
from dmpcpp.errors import InvalidArgument
from dmpcpp.sending import states_at
from dmpcpp.verification._joint_log import JointLog

_GRID = 400  # times of the plan that are compared
_STEP = 0.02  # s between the lags that are tried first: short beside any motion of an arm
_RESOLUTION = 1e-7  # s


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
    best = lags[np.argmin([cost(lag) for lag in lags])]
    step = lags[1] - lags[0]
    found = minimize_scalar(cost, bounds=(best - step, best + step), options={"xatol": _RESOLUTION})
    return float(log.time[0] + (found.x if found.fun <= cost(best) else best))
