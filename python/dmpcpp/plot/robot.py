"""Joints of an arm over time, as shares of what they may do."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dmpcpp.plot.page import FAINT, INK, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

_COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#1A1A1A")
_STROKES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)))
_BINS = 300


def joint_shares(axes: Axes, time: Array, share: Array, names: Sequence[str], label: str) -> Axes:
    """Draw what each joint uses of its limit over time (T,) [s]: (T, n), -1 and 1 are the limits, NaN has none.

    Each short stretch is drawn by its lowest and its highest value, so that no peak is lost.
    """
    for k, name in enumerate(names):
        stroke = {"color": _COLOURS[k % len(_COLOURS)], "linestyle": _STROKES[k // len(_COLOURS) % 3]}
        when, what = _extremes(time, 100.0 * share[:, k])
        axes.plot(when, what, label=name, linewidth=1.2, **stroke)
    for limit in (-100.0, 100.0):
        axes.axhline(limit, color=INK, linewidth=0.9, linestyle=(0, (6, 2)))
    axes.axhline(0.0, color=FAINT, linewidth=0.4)
    largest = float(np.nanmax(np.abs(share), initial=0.0))
    axes.set_ylim(-110.0 * max(1.0, largest), 110.0 * max(1.0, largest))
    axes.set_ylabel(label, color=INK)
    return plain(axes)


def _extremes(time: Array, values: Array) -> tuple[Array, Array]:
    size = -(-len(values) // _BINS)
    if size <= 2:
        return time, values
    starts = np.arange(0, len(values), size)
    lowest, highest = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    return np.repeat(time[starts], 2), np.column_stack([lowest, highest]).ravel()
