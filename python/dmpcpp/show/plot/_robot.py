"""An arm: its shape in space, and its joints over time as shares of what they may do."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.show.plot._page import FAINT, INK, plain, plain_3d

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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


def shape(axes: Any, triangles: Array, around: Array | None = None) -> Any:
    """Draw a body of triangles (F, 3, 3) [m] into 3-D axes, lit from above; paths that follow lie on top of it.

    `around` (K, 3) [m] are points that shall be in the picture; by default those of the body.
    """
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    axes.computed_zorder = False  # matplotlib would sort whole lines by their mean depth
    points = triangles.reshape(-1, 3) if around is None else around
    lowest, highest = np.minimum(points.min(axis=0), [np.inf, np.inf, 0.0]), points.max(axis=0)
    axes.set(**{f"{name}lim": ends for name, ends in zip("xyz", np.c_[lowest, highest], strict=True)})
    axes.set_box_aspect(highest - lowest)
    plain_3d(axes, ("x [m]", "y [m]", "z [m]"))
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    size = np.linalg.norm(normal, axis=1)
    normal = normal[size > 0.0] / size[size > 0.0, None]
    front = normal @ _towards(axes.azim, axes.elev) > 0.0
    light = 0.62 + 0.3 * np.clip(normal[front] @ _towards(axes.azim - 35.0, 50.0), 0.0, 1.0)
    colours = light[:, None] * np.array([0.97, 0.985, 1.0])
    corners = triangles[size > 0.0][front]
    axes.add_collection3d(Poly3DCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.3, zorder=1))
    return axes


def _towards(azimuth: float, elevation: float) -> Array:
    """Return the direction (3,) from the middle to who looks from there [deg]."""
    a, e = np.radians([azimuth, elevation])
    return np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])


def _extremes(time: Array, values: Array) -> tuple[Array, Array]:
    size = -(-len(values) // _BINS)
    if size <= 2:
        return time, values
    starts = np.arange(0, len(values), size)
    lowest, highest = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    return np.repeat(time[starts], 2), np.column_stack([lowest, highest]).ravel()
