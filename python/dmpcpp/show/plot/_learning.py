"""What a model was learned from, and the phase that drives it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.show.plot._page import INK, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BAND, _MEAN, _ONE = "#9FCBE8", "#0072B2", "#E69F00"
_POINTS = 400


def phase(axes: Axes, time: Array, values: Array) -> Axes:
    """Draw the phase variable x (T,), from 1 at the start, over time (T,) [s]."""
    axes.plot(time, values, color="#D55E00", linewidth=1.6)
    axes.set_ylabel("phase x", color=INK)
    axes.set_ylim(0.0, 1.05)
    return plain(axes)


def spread(
    columns: Sequence[Axes],
    demonstrations: Sequence[tuple[Array, Array]],
    mean: tuple[Array, Array],
    deviation: Array,
    labels: Sequence[str],
) -> Sequence[Axes]:
    """Draw each coordinate of demonstrations over the phase 0 to 1 into axes of its own, in a band of two deviations.

    Parameters
    ----------
    columns : sequence of Axes
        One a coordinate.
    demonstrations : sequence of (phase (T,), values (T, d))
    mean : (phase (K,), values (K, d))
        The middle of the band.
    deviation : (K, d) or (d,)
        Standard deviation of one demonstration about the mean.
    labels : sequence of str
    """
    at, middle = mean
    wide = 2.0 * np.broadcast_to(deviation, middle.shape)
    for k, (axes, label) in enumerate(zip(columns, labels, strict=True)):
        axes.fill_between(at, middle[:, k] - wide[:, k], middle[:, k] + wide[:, k], color=_BAND, alpha=0.6, linewidth=0)
        for number, (when, values) in enumerate(demonstrations):
            every = slice(None, None, max(1, len(when) // _POINTS))
            name = "demonstrated" if number == 0 else None
            axes.plot(when[every], values[every, k], ".", color=_ONE, markersize=2.4, label=name)
        axes.plot(at, middle[:, k], color=_MEAN, linewidth=1.1, label="mean")
        axes.set_ylabel(label, color=INK)
        plain(axes)
    columns[-1].set_xlabel("phase", color=INK)
    return columns
