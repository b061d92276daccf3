"""One motion and its reproductions: the path, its coordinates, the entries of its rotation matrix, the kernels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.show.plot._page import INK, plain, plain_3d

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ORIGINAL: dict[str, Any] = {"color": "#56B4E9", "linewidth": 5.0, "solid_capstyle": "round", "zorder": 2}
_STROKES: tuple[dict[str, Any], ...] = (
    {"color": "#D55E00", "linewidth": 1.6, "linestyle": (0, (4, 1.2)), "zorder": 3},
    {"color": "#1A1A1A", "linewidth": 1.1, "zorder": 4},
    {"color": "#009E73", "linewidth": 1.6, "linestyle": (0, (1, 1)), "zorder": 5},
)
_MARKERS = "so^"
_EVERY_KERNEL = 9  # drawn in ink; the others are faint


def activations(axes: Axes, time: Array, values: Array) -> Axes:
    """Draw the kernels' activations (T, N) over time (T,) [s]: all of them faintly, one in nine in ink."""
    axes.plot(time, values, color="#9FCBE8", linewidth=0.7, zorder=2)
    axes.plot(time, values[:, ::_EVERY_KERNEL], color="#0072B2", linewidth=1.2, zorder=3)
    axes.set_xlabel("time [s]", color=INK)
    axes.set_ylim(0.0, 1.08 * float(values.max()))
    return plain(axes)


def path_3d(axes: Any, original: Array, imitated: Mapping[str, Array], labels: Sequence[str] = ("x", "y", "z")) -> Any:
    """Draw a path (T, 3) into 3-D axes as a broad line and its reproductions (T, 3), by name, on top of it.

    Each direction has a scale of its own: the source's helix is two high and wide and four hundred long.
    """
    axes.computed_zorder = False  # matplotlib would sort whole lines by their mean depth
    axes.plot(*original.T, label="original", **_ORIGINAL)
    for name, path in imitated.items():
        axes.plot(*path.T, label=name, **_stroke(name, imitated))
    axes.plot(*original[:1].T, "o", color="white", markeredgecolor=INK, markersize=7, zorder=9, label="start")
    axes.set_box_aspect((1.0, 1.0, 1.15), zoom=0.98)
    return plain_3d(axes, tuple(labels))  # type: ignore[arg-type]


def coordinates(
    columns: Sequence[Axes], time: Array, original: Array, imitated: Mapping[str, Array], labels: Sequence[str]
) -> Sequence[Axes]:
    """Draw each of the d coordinates (T, d) over time (T,) [s] into axes of its own, original and reproductions."""
    for k, (axes, label) in enumerate(zip(columns, labels, strict=True)):
        axes.plot(time, original[:, k], label="original", **_ORIGINAL)
        for name, values in imitated.items():
            axes.plot(time, values[:, k], label=name, **_stroke(name, imitated))
        axes.set_ylabel(label, color=INK)
        plain(axes)
    columns[-1].set_xlabel("time [s]", color=INK)
    return columns


def rotation_entries(
    cells: Sequence[Sequence[Axes]], time: Array, original: Array, imitated: Mapping[str, Array]
) -> Sequence[Sequence[Axes]]:
    """Draw the nine entries of rotations (T, 3, 3) over time (T,) [s] into 3 x 3 axes, row by row."""
    for i, row in enumerate(cells):
        labels = [f"$R_{{{i + 1}{j + 1}}}$" for j in range(3)]
        coordinates(row, time, original[:, i], {k: v[:, i] for k, v in imitated.items()}, labels)
        for axes in row:
            axes.set_ylim(-1.12, 1.12)
            axes.set_yticks((-1.0, 0.0, 1.0))
            axes.set_xlabel("time [s]" if i == 2 else "", color=INK)
            axes.tick_params(labelbottom=i == 2)
    return cells


def series_errors(axes: Axes, time: Array, errors: Mapping[str, Array], label: str) -> Axes:
    """Draw errors (T,) by name over time (T,) [s] on a logarithmic axis; an error of exactly 0 has no place there."""
    for name, values in errors.items():
        axes.plot(time, np.where(values > 0.0, values, np.nan), label=name, **_stroke(name, errors))
    axes.set_yscale("log")
    axes.set_ylabel(label, color=INK)
    plain(axes).minorticks_off()
    return axes


def errors_over_noise(
    axes: Axes,
    noise: Sequence[str],
    mean: Mapping[str, Sequence[float]],
    std: Mapping[str, Sequence[float]],
    worst: Mapping[str, Sequence[float]],
    label: str,
) -> Axes:
    """Draw, for levels of noise named in `noise`, the mean with a bar of one standard deviation, and the worst case.

    `mean`, `std` and `worst` hold a number a level, by the name of what made the errors. The bar ends at the mean
    where it would go below nothing.
    """
    width = 0.7 / len(mean)
    for k, name in enumerate(mean):
        at = np.arange(len(noise)) + width * (k - 0.5 * (len(mean) - 1))
        m, s = np.asarray(mean[name]), np.asarray(std[name])
        colour = _STROKES[k % len(_STROKES)]["color"]
        low = np.where(s < m, s, 0.0)
        look: dict[str, Any] = {"fmt": _MARKERS[k], "color": colour, "markersize": 5, "capsize": 4}
        axes.errorbar(at, m, yerr=(low, s), label=f"{name}, mean", **look)
        axes.plot(at, worst[name], "_", color=colour, markersize=12, markeredgewidth=2.2, label=f"{name}, worst")
    axes.set_yscale("log")
    axes.set_ylabel(label, color=INK)
    axes.set_xticks(np.arange(len(noise)), noise)
    plain(axes).minorticks_off()
    axes.set_xlim(-0.6, len(noise) - 0.4)
    return axes


def _stroke(name: str, among: Mapping[str, Any]) -> dict[str, Any]:
    return _STROKES[list(among).index(name) % len(_STROKES)]
