"""How far one motion is from another, and how smooth it is: each measure with its definition.

None is enough alone: a lag of 0.1 s looks bad in RMSE and invisible in the Frechet distance; an offset looks
the other way round in SPARC. Poses are (T, 4, 4) homogeneous matrices with positions in m, angles in rad.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import trapezoid

from dmpcpp import _core
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument


@dataclass(frozen=True)
class StageErrors:
    """Errors of one stage of the flow (such as DMP -> FK(IK), or FK(IK) -> executed), at equal times.

    Attributes
    ----------
    position_rmse, position_max : float
        Root of the mean square, and largest, distance of the two origins [m].
    angle_rmse, angle_max : float
        The same of the geodesic angle between the two orientations [rad].
    """

    position_rmse: float
    position_max: float
    angle_rmse: float
    angle_max: float

    def to_dict(self) -> dict[str, float]:
        """For JSON: the four fields."""
        return asdict(self)


@dataclass(frozen=True)
class PoseError:
    """Distance of two poses: ``position`` [m] and ``angle`` [rad]."""

    position: float
    angle: float


def compare(reference: ArrayLike, poses: ArrayLike) -> StageErrors:
    """Errors of ``poses`` (T, 4, 4) against ``reference`` (T, 4, 4), sample by sample.

    Raises
    ------
    InvalidArgument
        The shapes differ, are not (T, 4, 4), or T = 0.
    """
    distance, angle = position_errors(reference, poses), angle_errors(reference, poses)
    if len(distance) == 0:
        raise InvalidArgument("poses: no samples, expected at least 1.")
    return StageErrors(_rms(distance), float(distance.max()), _rms(angle), float(angle.max()))


def position_errors(reference: ArrayLike, poses: ArrayLike) -> Array:
    """Distances (T,) of the origins [m] of two series of poses (T, 4, 4)."""
    a, b = _pose_pair(reference, poses)
    return np.asarray(np.linalg.norm(b[:, :3, 3] - a[:, :3, 3], axis=1))


def angle_errors(reference: ArrayLike, poses: ArrayLike) -> Array:
    """Geodesic angles (T,) [rad], 0 to pi: |log(Ra^T Rb)| of two series of poses (T, 4, 4)."""
    a, b = _pose_pair(reference, poses)
    return _angles(a[:, :3, :3], b[:, :3, :3])


def rotation_angles(reference: ArrayLike, rotations: ArrayLike) -> Array:
    """Geodesic angles (T,) [rad], 0 to pi, between rotations (T, 3, 3)."""
    a, b = _rotations("reference", reference), _rotations("rotations", rotations)
    _same_shape(a, b)
    return _angles(a, b)


def final_error(reference: ArrayLike, poses: ArrayLike) -> PoseError:
    """Distance of the two last poses; the series (T, 4, 4) and (S, 4, 4) may differ in length."""
    a, b = _poses("reference", reference)[-1:], _poses("poses", poses)[-1:]
    return PoseError(float(position_errors(a, b)[0]), float(angle_errors(a, b)[0]))


def best_lag(reference: ArrayLike, signal: ArrayLike, dt: float, max_lag: float = 0.5) -> float:
    """Delay [s] of ``signal`` (T, d) behind ``reference`` (T, d) that makes the two most alike.

    The lag within +-``max_lag`` whose overlapping samples have the least mean squared distance, refined
    between samples by the parabola through the three lowest. Positive: the signal comes late.

    Raises
    ------
    InvalidArgument
        Empty, non-finite or mismatched series, fewer than 2 samples, or dt <= 0.
    """
    a, b = _series("reference", reference), _series("signal", signal)
    _same_shape(a, b)
    _positive("dt", dt)
    reach = min(round(max_lag / dt), len(a) - 2)
    if reach < 0:
        raise InvalidArgument(f"signal: {len(b)} sample(s), expected at least 2.")
    shifts = np.arange(-reach, reach + 1)
    cost = np.array([_shifted_cost(a, b, int(shift)) for shift in shifts])
    best = int(np.argmin(cost))
    return float((shifts[best] + _vertex(cost, best)) * dt)


def sparc(speed: ArrayLike, rate: float, *, cutoff: float = 10.0, threshold: float = 0.05, padding: int = 4) -> float:
    """Spectral arc length of a speed (T,) sampled at ``rate`` [Hz]: <= 0, the nearer to 0 the smoother.

    The negative length of the curve of the magnitude spectrum, scaled to 1 in height (by its value at 0 Hz)
    and in width, from 0 Hz to the last frequency below ``cutoff`` [Hz] whose magnitude reaches
    ``threshold``; the signal is padded with zeros to 2^(ceil(log2 T) + padding) samples. Independent of
    amplitude and of duration. Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet, "On the analysis of
    movement smoothness", JNER 2015.

    Raises
    ------
    InvalidArgument
        An empty or non-finite series, no motion, or rate <= 0.
    """
    v = _series("speed", speed)[:, 0]
    _positive("rate", rate)
    count = int(2 ** (np.ceil(np.log2(len(v))) + padding))
    magnitude = np.abs(np.fft.fft(v, count))
    if magnitude.max() == 0.0:
        raise InvalidArgument("speed: all zero. SPARC is defined for a motion.")
    frequency = np.arange(count) * rate / count
    inside = frequency <= cutoff
    frequency, magnitude = frequency[inside], magnitude[inside] / magnitude.max()
    strong = np.flatnonzero(magnitude >= threshold)
    frequency, magnitude = frequency[strong[0] : strong[-1] + 1], magnitude[strong[0] : strong[-1] + 1]
    if len(frequency) < 2:
        return 0.0
    width = np.diff(frequency) / (frequency[-1] - frequency[0])
    return float(-np.sum(np.hypot(width, np.diff(magnitude))))


def log_dimensionless_jerk(velocity: ArrayLike, rate: float) -> float:
    """Smoothness of a velocity (T,) or (T, d) sampled at ``rate`` [Hz]: the larger, the smoother.

    -ln( T^3 / v_peak^2 * integral |d^2 v / dt^2|^2 dt ), with T the duration, v_peak the largest |v| and the
    derivative by second differences. A minimum-jerk reach has -ln(204.8) = -5.32. Sensitive to noise: filter
    first. Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet, "On the analysis of movement
    smoothness", JNER 2015.

    Raises
    ------
    InvalidArgument
        A non-finite series, fewer than 3 samples, no motion, or rate <= 0.
    """
    v = _series("velocity", velocity)
    _positive("rate", rate)
    if len(v) < 3:
        raise InvalidArgument(f"velocity: {len(v)} sample(s), expected at least 3.")
    peak = float(np.max(np.linalg.norm(v, axis=1)))
    if peak == 0.0:
        raise InvalidArgument("velocity: all zero. Smoothness is defined for a motion.")
    duration = (len(v) - 1) / rate
    jerk_squared = np.sum(np.diff(v, n=2, axis=0) ** 2, axis=1) * rate**4
    integral = float(trapezoid(np.pad(jerk_squared, 1, mode="edge"), dx=1.0 / rate))  # the ends have no difference
    return float(-np.log(duration**3 / peak**2 * integral)) if integral > 0.0 else float("inf")


def frechet(a: ArrayLike, b: ArrayLike) -> float:
    """Discrete Frechet distance [unit of the points] of two paths (T, d) and (S, d).

    The shortest leash that lets a walker on each path reach the end, both going forward only from sample to
    sample. Eiter and Mannila, "Computing discrete Frechet distance", TU Wien CD-TR 94/64, 1994. Time T * S.
    """
    return _core.frechet(_series("a", a), _series("b", b))


def dtw(a: ArrayLike, b: ArrayLike) -> float:
    """Dynamic time warping distance per sample [unit of the points] of two paths (T, d) and (S, d).

    The distance of ``dmpcpp.align``, the least sum of distances over all ways to pair samples going forward only,
    each step of weight 1, first with first and last with last, divided by max(T, S). Packages differ: this is
    ``similaritymeasures.dtw`` and ``dtaidistance`` with ``inner_dist="euclidean"``, over max(T, S). Sakoe and
    Chiba, "Dynamic programming algorithm optimization for spoken word recognition", IEEE TASSP 1978. Blind to a
    lag and to the tempo. Time and memory (a byte a pair) grow with T S.

    Raises
    ------
    InvalidArgument
        Empty or non-finite series, or different numbers of columns.
    """
    p, q = _series("a", a), _series("b", b)
    if p.shape[1] != q.shape[1]:
        raise InvalidArgument(f"b: {q.shape[1]} columns, expected {p.shape[1]} as in a.")
    return _core.align(p, q).distance / max(len(p), len(q))


def margin(values: ArrayLike, limit: ArrayLike) -> float:
    """Smallest relative margin [1]: 1 - max |values| / limit; values (T, n), limit (n,) or scalar, > 0.

    1 at rest, 0 at a limit, negative beyond.

    Raises
    ------
    InvalidArgument
        An empty or non-finite series, or limits that are not positive or do not match it.
    """
    array, most = _series("values", values), np.asarray(limit, dtype=np.float64)
    if most.shape not in ((), (array.shape[1],)) or not (most > 0.0).all():
        raise InvalidArgument(f"limit: {limit}, expected {array.shape[1]} positive number(s), or one.")
    return float(1.0 - np.max(np.abs(array) / most))


# ---- what comes in ---------------------------------------------------------------------------------


def _pose_pair(reference: ArrayLike, poses: ArrayLike) -> tuple[Array, Array]:
    a, b = _poses("reference", reference), _poses("poses", poses)
    _same_shape(a, b)
    return a, b


def _poses(name: str, poses: ArrayLike) -> Array:
    array = np.asarray(poses, dtype=np.float64)
    if array.ndim != 3 or array.shape[1:] != (4, 4):
        raise InvalidArgument(f"{name}: shape {array.shape}, expected (T, 4, 4) homogeneous matrices.")
    return array


def _rotations(name: str, rotations: ArrayLike) -> Array:
    array = np.asarray(rotations, dtype=np.float64)
    if array.ndim != 3 or array.shape[1:] != (3, 3):
        raise InvalidArgument(f"{name}: shape {array.shape}, expected (T, 3, 3) rotation matrices.")
    return array


def _series(name: str, values: ArrayLike) -> Array:
    array = np.asarray(values, dtype=np.float64)
    array = array[:, None] if array.ndim == 1 else array
    if array.ndim != 2 or len(array) == 0:
        raise InvalidArgument(f"{name}: shape {np.shape(values)}, expected (T,) or (T, d) with T >= 1.")
    bad = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(bad):
        raise InvalidArgument(f"{name}[{bad[0]}]: not finite, expected numbers. Cut or fill the gap first.")
    return array


def _same_shape(a: Array, b: Array) -> None:
    if a.shape != b.shape:
        raise InvalidArgument(f"shapes {a.shape} and {b.shape} differ. Sample both at the same times.")


def _positive(name: str, value: float) -> None:
    if not (np.isfinite(value) and value > 0.0):
        raise InvalidArgument(f"{name}: {value}, expected a positive number.")


def _angles(a: Array, b: Array) -> Array:
    """|log(Ra^T Rb)| as 2 atan2(|Ra - Rb|, sqrt(8 - |Ra - Rb|^2)).

    The Frobenius norm is 2 sqrt(2) sin(angle / 2): exact near 0, where the arccosine of the trace loses half of
    the digits.
    """
    chord_squared = np.sum((b - a) ** 2, axis=(1, 2))
    return np.asarray(2.0 * np.arctan2(np.sqrt(chord_squared), np.sqrt(np.maximum(8.0 - chord_squared, 0.0))))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _shifted_cost(a: Array, b: Array, shift: int) -> float:
    """Mean squared distance of b, moved ``shift`` samples earlier, over what overlaps."""
    late, early = (b[shift:], a[: len(a) - shift]) if shift >= 0 else (b[:shift], a[-shift:])
    return float(np.mean(np.sum((late - early) ** 2, axis=1)))


def _vertex(cost: Array, best: int) -> float:
    """Offset in samples of the minimum of the parabola through ``cost`` around ``best``; 0 at the border."""
    if not 0 < best < len(cost) - 1:
        return 0.0
    left, middle, right = cost[best - 1 : best + 2]
    curvature = left - 2.0 * middle + right
    return float(0.5 * (left - right) / curvature) if curvature > 0.0 else 0.0
