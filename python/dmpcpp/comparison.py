"""All measures of one motion against another in one value: none is enough alone (``metrics`` says why)."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp import metrics
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.metrics import PoseError, StageErrors

_PATH_SAMPLES = 1000  # DTW and Frechet cost the square of it


@dataclass(frozen=True)
class MotionComparison:
    """A motion against a reference that was sampled at the same times.

    Attributes
    ----------
    errors : StageErrors
        Position [m] and angle [rad], root mean square and largest, at equal times.
    final : PoseError
        Of the last poses.
    lag : float
        How late the motion is [s]: ``metrics.best_lag`` of the positions, within half a second.
    dtw : float
        Of the positions per sample [m], at no more than 1000 samples evenly picked.
    frechet : float
        Of the positions [m], at the same samples.
    sparc, log_dimensionless_jerk : float or None
        Smoothness of the motion minus that of the reference: negative where it is rougher. None where one of
        them does not move at all.
    """

    errors: StageErrors
    final: PoseError
    lag: float
    dtw: float
    frechet: float
    sparc: float | None
    log_dimensionless_jerk: float | None

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        return asdict(self)


def compare_motions(reference: ArrayLike, poses: ArrayLike, rate: float) -> MotionComparison:
    """Measure ``poses`` (T, 4, 4) against ``reference`` (T, 4, 4), both sampled at ``rate`` [Hz], T >= 3.

    Raises
    ------
    InvalidArgument
        The shapes differ or are not (T, 4, 4), T < 3, a number is not finite, or the rate is not positive.
    """
    errors = metrics.compare(reference, poses)
    a, b = (np.asarray(each, dtype=np.float64)[:, :3, 3] for each in (reference, poses))
    if len(a) < 3:
        raise InvalidArgument(f"poses: {len(a)} sample(s), expected at least 3.")
    picked = np.unique(np.linspace(0, len(a) - 1, min(len(a), _PATH_SAMPLES)).round().astype(int))
    return MotionComparison(
        errors=errors,
        final=metrics.final_error(reference, poses),
        lag=metrics.best_lag(a, b, 1.0 / rate),
        dtw=metrics.dtw(a[picked], b[picked]),
        frechet=metrics.frechet(a[picked], b[picked]),
        **_smoothness(a, b, rate),
    )


def _smoothness(a: Array, b: Array, rate: float) -> dict[str, float | None]:
    """Differences of both measures; a motion that stands still has neither."""
    velocities = [np.gradient(positions, 1.0 / rate, axis=0) for positions in (a, b)]
    if not all(velocity.any() for velocity in velocities):
        return {"sparc": None, "log_dimensionless_jerk": None}
    of_reference, of_motion = (
        (metrics.sparc(np.linalg.norm(v, axis=1), rate), metrics.log_dimensionless_jerk(v, rate)) for v in velocities
    )
    jerk = of_motion[1] - of_reference[1]
    return {
        "sparc": of_motion[0] - of_reference[0],
        "log_dimensionless_jerk": jerk if np.isfinite(jerk) else None,
    }
