"""Single samples that do not belong to the motion."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import complete, positive
from dmpcpp.recordings._recording import Array, Recording

__all__ = ["outliers"]


def outliers(
    recording: Recording, *, half_width: int = 5, threshold: float = 5.0, distance: float = 5e-3, angle: float = 0.05
) -> Recording:
    """Mark samples as missing that lie far from where their neighbours say they should: `fill` replaces them.

    A Hampel identifier (Hampel, "The influence curve and its role in robust estimation", 1974) that goes with the
    motion: the neighbours are carried along the median velocity of the window to the sample's time; an outlier lies
    further from their median than `threshold` times the median of their own distances from it. So up to
    `half_width` - 1 bad samples in a row are found while the motion itself, however fast, is no outlier.

    Parameters
    ----------
    half_width : int
        Neighbours on either side, 2 or more. As many samples at either end are not judged: seen from one side only,
        a motion that starts to move is an outlier too.
    threshold : float
        Above 0; 5 is about eight standard deviations of white noise.
    distance, angle : float
        m, rad; what lies closer is never an outlier, however quiet its neighbours: 5 mm and 3 deg, well above the
        noise of recordings.

    Returns
    -------
    Recording
        Its history names how many there were and the largest; the recording itself where there were none.

    Raises
    ------
    InvalidArgument
        Missing samples, fewer than 2 half_width + 1, or a parameter outside its range.
    """
    for name, value in (("threshold", threshold), ("distance", distance), ("angle", angle)):
        positive(name, value)
    width = 2 * half_width + 1
    if half_width < 2 or len(complete(recording)) < width:
        raise InvalidArgument(
            f"half_width: {half_width}, expected 2 or more and a window of {width} within {len(recording)} samples."
        )
    window = sliding_window_view(np.arange(len(recording)), width)
    middle = window[:, half_width]
    away, usual = _deviation(recording.time[window], recording.position[window] - recording.position[middle, None])
    turned, usual_turn = _deviation(recording.time[window], _turns(recording.rotation, window, middle))
    off = (away > np.maximum(threshold * usual, distance)) | (turned > np.maximum(threshold * usual_turn, angle))
    return _marked(recording, middle[off], away[off], turned[off]) if off.any() else recording


def _turns(rotation: Array, window: NDArray[np.int_], middle: NDArray[np.int_]) -> Array:
    """Return the rotation vectors (K, W, 3) from the middle of each window to its samples."""
    relative = np.swapaxes(rotation[middle], 1, 2)[:, None] @ rotation[window]
    return Rotation.from_matrix(relative.reshape(-1, 3, 3)).as_rotvec().reshape(*window.shape, 3)


def _deviation(time: Array, offset: Array) -> tuple[Array, Array]:
    """Return how far the middle of each window lies from the median of its samples, carried along to its time, and
    the median of their own distances from that; of times (K, W) and offsets from the middle (K, W, 3).
    """
    velocity = np.median(np.diff(offset, axis=1) / np.diff(time, axis=1)[..., None], axis=1, keepdims=True)
    carried = offset - velocity * (time - time[:, [time.shape[1] // 2]])[..., None]
    expected = np.median(carried, axis=1, keepdims=True)
    usual = np.median(np.linalg.norm(carried - expected, axis=2), axis=1)
    return np.linalg.norm(expected[:, 0], axis=1), usual


def _marked(recording: Recording, off: NDArray[np.int_], away: Array, turned: Array) -> Recording:
    worst = int(np.argmax(away))
    position, rotation = recording.position.copy(), recording.rotation.copy()
    position[off], rotation[off] = np.nan, np.nan
    return recording.with_(
        f"{len(off)} outliers taken out, the first at {recording.time[off[0]]:.4g} s; the furthest by "
        f"{1e3 * away[worst]:.3g} mm and {np.degrees(turned[worst]):.3g} deg at {recording.time[off[worst]]:.4g} s",
        position=position,
        rotation=rotation,
    )
