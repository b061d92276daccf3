"""Noise removal and noise estimates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import continuous, demonstration, known_quaternions, positive, quaternions
from dmpcpp.recordings import Recording

__all__ = ["Noise", "evenly_sampled", "low_pass", "noise", "smooth", "white_noise"]

_DIFFERENCED = 7  # samples in a row
_BLOCK = 50_000  # samples looked at together
_EVEN = 0.1  # largest deviation of a step from the mean step that a filter for even sampling bears


@dataclass(frozen=True)
class Noise:
    """Standard deviation of the noise found in a recording: `position` [m] along an axis, `angle` [rad] about one.

    Expected of noise in three axes together: sqrt(3) times as much.
    """

    position: float
    angle: float

    def describe(self) -> str:
        """Return it in mm and deg, for reports."""
        return f"{1e3 * self.position:.2g} mm and {np.degrees(self.angle):.2g} deg per axis"


def noise(recording: Recording) -> Noise:
    """Estimate the noise from the data alone, by what seven samples in a row deviate from any quintic polynomial.

    Of samples with independent noise that deviation, weighted by divided differences of sixth order whose weights have
    length 1, has the standard deviation of the noise (Gasser, Sroka and Jennen-Steinmetz, "Residual variance and
    residual pattern in nonlinear regression", 1986, with a higher order). Slow noise such as drift is not seen; a
    motion too fast for its rate looks like noise. Samples may be missing: what counts is where seven known ones stand
    in a row, and 0 is found where none do.
    """
    turn = 2.0 * known_quaternions(recording)  # a turn by v changes a quaternion by v / 2, in three directions of four
    return Noise(white_noise(recording.time, recording.position), white_noise(recording.time, turn))


def white_noise(time: Array, values: Array) -> float:
    """Standard deviation per axis of white noise in values (T, d) at times (T,) [s], assuming 3 degrees of freedom.

    NaN: missing. 0 if no seven consecutive samples are known. See `noise`.
    """
    ends = range(0, max(1, len(time) - _DIFFERENCED + 1), _BLOCK)  # in blocks, so that memory stays small
    parts = [slice(k, k + _BLOCK + _DIFFERENCED - 1) for k in ends]
    left = np.concatenate([_deviations(time[part], values[part]) for part in parts])
    return float(np.sqrt(np.sum(left**2) / (3 * len(left)))) if len(left) else 0.0


def _deviations(time: Array, values: Array) -> Array:
    """Return the weighted deviations (K, d) of seven samples in a row, where seven known ones stand in a row."""
    window = sliding_window_view(values, _DIFFERENCED, axis=0)
    there = np.isfinite(window).all(axis=(1, 2))
    return np.asarray(np.einsum("kj,kdj->kd", _difference_weights(time)[there], window[there]))


def smooth(recording: Recording) -> Recording:
    """Take the noise out: smoothing splines whose stiffness generalised cross-validation finds in the data (Craven and
    Wahba, "Smoothing noisy data with spline functions", 1979).

    Needs no even steps and no parameter; the history says the noise that was found and how far the samples were
    moved.
    """
    smoothed = demonstration(recording).smoothed()
    position, rotation = smoothed.pose[:, :3, 3], Rotation.from_matrix(smoothed.pose[:, :3, :3])
    moved, turned = _rms_change(recording, position, rotation)
    return recording.with_(
        f"smoothed: noise of {noise(recording).describe()} found; positions changed by {1e3 * moved:.3g} mm rms, "
        f"orientations by {np.degrees(turned):.3g} deg rms",
        position=position,
        rotation=rotation.as_matrix(),
    )


def low_pass(recording: Recording, cutoff: float, order: int = 2) -> Recording:
    """Remove what is faster than `cutoff` [Hz]: a Butterworth filter run forwards and backwards, so without
    delay.

    Orientations are filtered as quaternions of one sign and renormalised, which is accurate while
    neighbouring samples lie close together. The two passes together damp by 6 dB at the cutoff. 6 to 12 Hz
    is the habit of biomechanics (D. A. Winter, Biomechanics and Motor Control of Human Movement); fast
    gestures lose 9 to 30 mm at 6 Hz, which the history says.

    Raises
    ------
    InvalidArgument
        A cutoff at or above half the rate, uneven sampling (resample first), too few samples, a jump in
        orientation.
    """
    positive("cutoff", cutoff)
    if cutoff >= recording.rate / 2:
        raise InvalidArgument(f"cutoff: {cutoff:g} Hz, expected less than half the rate of {recording.rate:.4g} Hz.")
    _check_even(recording)
    continuous(recording)
    sections = butter(order, cutoff, fs=recording.rate, output="sos")
    padding = 3 * (2 * len(sections) + 1)  # samples that sosfiltfilt reflects at either end
    if len(recording) <= padding:
        raise InvalidArgument(f"{len(recording)} samples, a filter of order {order} needs more than {padding}.")
    position = sosfiltfilt(sections, recording.position, axis=0, padlen=padding)
    quaternion = sosfiltfilt(sections, quaternions(recording)[0], axis=0, padlen=padding)
    rotation = Rotation.from_quat(quaternion)
    moved, turned = _rms_change(recording, position, rotation)
    return recording.with_(
        f"low-pass {cutoff:g} Hz: positions changed by {1e3 * moved:.3g} mm rms, "
        f"orientations by {np.degrees(turned):.3g} deg rms",
        position=position,
        rotation=rotation.as_matrix(),
    )


def evenly_sampled(recording: Recording) -> bool:
    """Whether every step is within 10 % of the mean one, which a filter can bear."""
    mean = 1.0 / recording.rate
    return bool(np.abs(np.diff(recording.time) - mean).max() <= _EVEN * mean)


def _difference_weights(time: Array) -> Array:
    """Return the weights (T-6, 7), each of length 1, of the divided differences of sixth order."""
    window = sliding_window_view(time, _DIFFERENCED)
    apart = window[:, :, None] - window[:, None, :] + np.eye(_DIFFERENCED)
    weights = 1.0 / np.prod(apart / np.diff(time).mean(), axis=2)
    return np.asarray(weights / np.linalg.norm(weights, axis=1, keepdims=True))


def _check_even(recording: Recording) -> None:
    if not evenly_sampled(recording):
        steps, mean = np.diff(recording.time), 1.0 / recording.rate
        k = int(np.argmax(np.abs(steps - mean))) + 1
        raise InvalidArgument(
            f"time[{k}]: {1e3 * steps[k - 1]:.4g} ms after the sample before, expected {1e3 * mean:.4g} "
            "ms: a filter needs even steps. Resample first."
        )


def _rms_change(before: Recording, position: Array, rotation: Rotation) -> tuple[float, float]:
    moved = np.linalg.norm(position - before.position, axis=1)
    turned = (Rotation.from_matrix(before.rotation).inv() * rotation).magnitude()
    return float(np.sqrt(np.mean(moved**2))), float(np.sqrt(np.mean(turned**2)))
