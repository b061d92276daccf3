"""Recordings cleaned and cut: functions that take a Recording and return one that says what was done.

>>> from dmpcpp import motion, recordings
>>> punch = recordings.clip("punch")                              # doctest: +SKIP
>>> motion.crop(motion.resample(punch, rate=100), 0.2, 1.2).history[-1]   # doctest: +SKIP
'cropped to 0.2 .. 1.2 s'
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation, RotationSpline

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings.recording import MIN_SAMPLES, Array, Recording

if TYPE_CHECKING:
    from dmpcpp import PoseDemonstration

__all__ = [
    "continuous",
    "crop",
    "demonstration",
    "low_pass",
    "poses",
    "refine",
    "relative_to",
    "resample",
    "turn_angles",
]

_EVEN = 0.1  # largest deviation of a step from the mean step that a filter for even sampling bears


def poses(recording: Recording) -> Array:
    """Return the recording as poses (T, 4, 4): [R p; 0 1], body -> world, m."""
    pose = np.tile(np.eye(4), (len(recording), 1, 1))
    pose[:, :3, :3] = recording.rotation
    pose[:, :3, 3] = recording.position
    return pose


def demonstration(recording: Recording) -> PoseDemonstration:
    """Return the recording as what `PoseDmp.fit` learns from; times in s, poses (T, 4, 4) in m."""
    from dmpcpp._core import PoseDemonstration

    return PoseDemonstration(recording.time, poses(recording))


def turn_angles(recording: Recording) -> Array:
    """Return the angles (T-1,) in rad, 0 to pi, between consecutive orientations."""
    rotation = Rotation.from_matrix(recording.rotation)
    return (rotation[:-1].inv() * rotation[1:]).magnitude()


def continuous(recording: Recording, limit: float = np.pi / 2) -> Recording:
    """Check that the orientation never jumps: between two samples a half turn can not be told from its
    reverse.

    Parameters
    ----------
    recording : Recording
    limit : float
        Largest angle between consecutive samples [rad], 0 to pi.

    Returns
    -------
    Recording
        The same motion, its history with the largest angle.

    Raises
    ------
    InvalidArgument
        Naming the first sample that turns further from the one before.
    """
    _positive("limit", limit)
    angles = turn_angles(recording)
    if angles.max() > limit:
        k = int(np.argmax(angles > limit)) + 1
        raise InvalidArgument(
            f"rotation[{k}]: turned by {np.degrees(angles[k - 1]):.1f} deg in "
            f"{recording.time[k] - recording.time[k - 1]:.4g} s at {recording.time[k]:.4g} s, expected at "
            f"most {np.degrees(limit):.1f} deg. Record at a higher rate, or cut the jump out."
        )
    return recording.with_(f"orientation continuous: at most {np.degrees(angles.max()):.1f} deg a sample")


def crop(recording: Recording, start: float = 0.0, end: float | None = None) -> Recording:
    """Keep the samples from `start` to `end` [s], both included; time counts from the first of them.

    Raises
    ------
    InvalidArgument
        An empty or reversed span, or fewer than 8 samples in it.
    """
    end = recording.duration if end is None else end
    if not (np.isfinite(start) and np.isfinite(end) and start < end):
        raise InvalidArgument(f"start, end: {start:g} .. {end:g} s, expected a start before the end.")
    slack = 1e-9 * recording.duration  # times are sums of steps: 0.2 s may stand as 0.20000000000000001
    kept = (recording.time >= start - slack) & (recording.time <= end + slack)
    if kept.sum() < MIN_SAMPLES:
        raise InvalidArgument(
            f"start, end: {kept.sum()} samples within {start:g} .. {end:g} s, expected at least "
            f"{MIN_SAMPLES}; the recording lasts {recording.duration:g} s with {len(recording)} samples."
        )
    time = recording.time[kept]
    return recording.with_(
        f"cropped to {start:g} .. {end:g} s",
        time=time - time[0],
        position=recording.position[kept],
        rotation=recording.rotation[kept],
    )


def resample(recording: Recording, rate: float) -> Recording:
    """Evaluate the motion at even steps of 1/rate [Hz] from its start; interpolating C2 splines in between.

    Positions by a cubic spline (not-a-knot), orientations by scipy's RotationSpline, whose angular velocity
    and acceleration are continuous. Nothing is smoothed; a rate below the recording's drops what it can not
    show, so low-pass first.

    Raises
    ------
    InvalidArgument
        A rate that is not positive or leaves fewer than 8 samples; a turn too large to interpolate.
    """
    _positive("rate", rate)
    count = int(np.floor(recording.duration * rate + 1e-6)) + 1
    if not MIN_SAMPLES <= count <= 10_000_000:
        raise InvalidArgument(
            f"rate: {rate:g} Hz gives {count} samples over {recording.duration:g} s, expected at least "
            f"{MIN_SAMPLES} and at most 1e7."
        )
    time = np.minimum(np.arange(count) / rate, recording.duration)
    return _evaluated(recording, time, f"resampled from {recording.rate:.4g} to {rate:g} Hz")


def refine(recording: Recording, distance: float, angle: float) -> Recording:
    """Put samples between those that lie far apart; the recorded ones stay.

    Parameters
    ----------
    recording : Recording
    distance : float
        m, between consecutive samples of the result, about; each gap is cut into equal spans of time.
    angle : float
        rad, likewise.

    Raises
    ------
    InvalidArgument
        A distance or angle that is not positive; a turn too large to interpolate.
    """
    _positive("distance", distance)
    _positive("angle", angle)
    moved = np.linalg.norm(np.diff(recording.position, axis=0), axis=1)
    parts = np.ceil(np.maximum(moved / distance, turn_angles(recording) / angle)).astype(int)
    spans = zip(recording.time[:-1], recording.time[1:], np.maximum(parts, 1), strict=True)
    inner = [np.linspace(a, b, n, endpoint=False) for a, b, n in spans]
    time = np.concatenate([*inner, recording.time[-1:]])
    return _evaluated(recording, time, f"refined from {len(recording)} to {len(time)} samples")


def low_pass(recording: Recording, cutoff: float, order: int = 2) -> Recording:
    """Remove what is faster than `cutoff` [Hz]: a Butterworth filter run forwards and backwards, so without
    delay.

    Orientations are filtered as quaternions of one sign and renormalised, which is accurate while
    neighbouring samples lie close together. The two passes together damp by 6 dB at the cutoff. 6 to 12 Hz
    is the habit of biomechanics (D. A. Winter, Biomechanics and Motor Control of Human Movement); fast
    gestures lose 9 to 30 mm at 6 Hz, which the history tells.

    Raises
    ------
    InvalidArgument
        A cutoff at or above half the rate, uneven sampling (resample first), too few samples, a jump in
        orientation.
    """
    _positive("cutoff", cutoff)
    if cutoff >= recording.rate / 2:
        raise InvalidArgument(f"cutoff: {cutoff:g} Hz, expected less than half the rate of {recording.rate:.4g} Hz.")
    _check_even(recording)
    continuous(recording)
    sections = butter(order, cutoff, fs=recording.rate, output="sos")
    padding = 3 * (2 * len(sections) + 1)  # samples that sosfiltfilt reflects at either end
    if len(recording) <= padding:
        raise InvalidArgument(f"{len(recording)} samples, a filter of order {order} needs more than {padding}.")
    position = sosfiltfilt(sections, recording.position, axis=0, padlen=padding)
    quaternion = sosfiltfilt(sections, _quaternions(recording.rotation), axis=0, padlen=padding)
    rotation = Rotation.from_quat(quaternion)
    moved, turned = _rms_change(recording, position, rotation)
    return recording.with_(
        f"low-pass {cutoff:g} Hz: positions changed by {1e3 * moved:.3g} mm rms, "
        f"orientations by {np.degrees(turned):.3g} deg rms",
        position=position,
        rotation=rotation.as_matrix(),
    )


def relative_to(recording: Recording, reference: Recording) -> Recording:
    """Express the motion in the moving frame of another body of the same recording, the chest for instance.

    Raises
    ------
    InvalidArgument
        The two do not have the same times.
    """
    if recording.time.shape != reference.time.shape or not np.array_equal(recording.time, reference.time):
        raise InvalidArgument("reference: its times are not those of the recording. Resample both alike.")
    inverse = np.swapaxes(reference.rotation, 1, 2)
    offset = recording.position - reference.position
    rotation = Rotation.from_matrix(inverse @ recording.rotation)  # rounding of the product taken out
    return recording.with_(
        f"relative to {reference.body}",
        position=np.einsum("kij,kj->ki", inverse, offset),
        rotation=rotation.as_matrix(),
    )


def _evaluated(recording: Recording, time: Array, note: str) -> Recording:
    continuous(recording, np.radians(179.0))
    turning = RotationSpline(recording.time, Rotation.from_matrix(recording.rotation))
    return recording.with_(
        note,
        time=time,
        position=CubicSpline(recording.time, recording.position)(time),
        rotation=turning(time).as_matrix(),
    )


def _positive(name: str, value: float) -> None:
    if not 0.0 < value < np.inf:
        raise InvalidArgument(f"{name}: {value}, expected a positive number.")


def _check_even(recording: Recording) -> None:
    steps = np.diff(recording.time)
    mean = 1.0 / recording.rate
    off = np.abs(steps - mean)
    if off.max() > _EVEN * mean:
        k = int(np.argmax(off)) + 1
        raise InvalidArgument(
            f"time[{k}]: {1e3 * steps[k - 1]:.4g} ms after the sample before, expected {1e3 * mean:.4g} "
            "ms: a filter needs even steps. Resample first."
        )


def _quaternions(rotation: Array) -> Array:
    """Return quaternions (T, 4), each in the hemisphere of the one before."""
    quaternion = Rotation.from_matrix(rotation).as_quat()
    turns = np.einsum("ij,ij->i", quaternion[1:], quaternion[:-1]) < 0.0
    sign = np.concatenate(([1.0], np.where(np.cumsum(turns) % 2 == 1, -1.0, 1.0)))
    return quaternion * sign[:, None]


def _rms_change(before: Recording, position: Array, rotation: Rotation) -> tuple[float, float]:
    moved = np.linalg.norm(position - before.position, axis=1)
    turned = (Rotation.from_matrix(before.rotation).inv() * rotation).magnitude()
    return float(np.sqrt(np.mean(moved**2))), float(np.sqrt(np.mean(turned**2)))
