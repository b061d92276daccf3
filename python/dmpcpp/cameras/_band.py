"""From poses at a video's frames to poses at even times without what is faster than the motion.

Landmarks wobble at 3 to 8 Hz, where the noise estimate of learning does not see it; so what leaves the cameras is
band-limited here, at the true times of the frames.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import solveh_banded
from scipy.signal import periodogram
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array

__all__ = ["band_of", "even_times", "smoothed"]

_LOWEST, _HIGHEST = 3.0, 6.0  # Hz, that a cutoff may have
_CLEAR = 4.0  # times the noise's power: what lies above it is motion
_PER_BAND = 4.0  # samples a period of the cutoff, at least


def band_of(time: Array, position: Array, noise: Array, highest: float = _HIGHEST) -> float:
    """Return the cutoff [Hz], from 3 to 6: where the spectrum of the motion falls to that of the noise.

    Parameters
    ----------
    time : array (T,)
        s.
    position : array (T, 3)
        m.
    noise : array (T, N)
        Independent samples of what is noise in a position [m].
    highest : float
        Hz, in place of 6.
    """
    rate = (len(time) - 1) / (time[-1] - time[0])
    even = np.linspace(time[0], time[-1], len(time))
    spectra = []
    for values in (position, noise):
        sampled = np.stack([np.interp(even, time, column) for column in values.T], axis=1)
        frequency, power = periodogram(sampled, fs=rate, window="hann", detrend="linear", axis=0)
        spectra.append(np.convolve(power.mean(axis=1), np.ones(5) / 5.0, mode="same"))
    above = frequency[spectra[0] > _CLEAR * spectra[1]]
    return float(np.clip(above.max(initial=0.0), _LOWEST, highest))


def even_times(time: Array, cutoff: float) -> Array:
    """Return even times [s] over the same span, as often as the frames come and 4 times the cutoff at least."""
    span = time[-1] - time[0]
    rate = max(1.0 / float(np.median(np.diff(time))), _PER_BAND * cutoff)
    return np.asarray(time[0] + np.arange(int(span * rate + 1e-6) + 1) / rate)


def smoothed(time: Array, rotation: Array, position: Array, cutoff: float, wanted: Array) -> tuple[Array, Array]:
    """Return the poses at wanted times, without what is faster than the cutoff [Hz].

    The smoother is Whittaker's with third differences at the true times: it damps by half at the cutoff, by
    1 / (1 + (f / cutoff)^6) elsewhere, and leaves parabolas as they are.
    """
    quaternion = Rotation.from_matrix(rotation).as_quat()
    sign = np.cumprod(np.r_[1.0, np.where(np.sum(quaternion[1:] * quaternion[:-1], axis=1) < 0.0, -1.0, 1.0)])
    values = _whittaker(time, np.concatenate([position, sign[:, None] * quaternion], axis=1), cutoff)
    at = CubicSpline(time, values)(wanted)
    return Rotation.from_quat(at[:, 3:]).as_matrix(), at[:, :3]


def _whittaker(time: Array, values: Array, cutoff: float) -> Array:
    """Return the values (T, d) that minimise their squared changes plus those of the third divided difference."""
    step = np.diff(time)
    even = float(np.median(step))
    weights = np.stack([1.0 / np.prod([time[i] - time[j] for j in others], axis=0) for i, others in _thirds(len(time))])
    scale = 6.0 * weights / (2.0 * np.pi * cutoff) ** 3
    band = np.zeros((4, len(time)))
    band[0] = 1.0
    width = np.sqrt((time[3:] - time[:-3]) / 3.0 / even)  # a rare sample stands for a longer time
    scale = scale * width
    count = len(time) - 3
    for a in range(4):
        for b in range(a, 4):
            band[b - a, a : a + count] += scale[a] * scale[b]
    return np.asarray(solveh_banded(band, values, lower=True))


def _thirds(count: int):  # type: ignore[no-untyped-def]
    """Yield the index ranges of four neighbours in a row: one of them, and the three others."""
    ranges = [slice(k, count - 3 + k) for k in range(4)]
    for k in range(4):
        yield ranges[k], [ranges[j] for j in range(4) if j != k]
