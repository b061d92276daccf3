"""A recording before anything is learned from it: its path and coordinates, gaps, rests and noise."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.show.plot._page import INK, LEGEND, figure, plain, plain_3d

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Spans = Sequence[tuple[float, float]]

_COLOURS, _STROKES = ("#0072B2", "#D55E00", "#009E73"), ("-", "--", "-.")
_GAP, _MOTION = "#E69F00", "#9FCBE8"
_POINTS = 4000  # that a page can show


def recorded(
    time: Array,
    position: Array,
    turn: Array,
    *,
    gaps: Spans = (),
    motions: Spans = (),
    noise: tuple[float, float] = (0.0, 0.0),
    title: str = "",
    note: str = "",
) -> Figure:
    """Return a page with the path in space, and position and orientation over time.

    Parameters
    ----------
    time : array (T,)
        s.
    position : array (T, 3)
        m; NaN where lost.
    turn : array (T, 3)
        Rotation vectors from the first orientation, rad; NaN where lost.
    gaps, motions : sequence of (begin, end)
        s; where samples are missing, and the parts between rests.
    noise : (float, float)
        Standard deviations per axis, m and rad; drawn as bands of two of them where they can be seen.
    """
    page = figure(12.5, 6.2, title=title, note=note)
    every = slice(None, None, max(1, len(time) // _POINTS))
    path = page.add_axes((0.01, 0.08, 0.42, 0.82), projection="3d")
    path.plot(*(1e3 * position[every]).T, color=_COLOURS[0], linewidth=0.9)
    plain_3d(path, ("x [mm]", "y [mm]", "z [mm]"))
    quantities = (
        (1e3 * position, 1e3 * noise[0], "position [mm]"),
        (np.degrees(turn), np.degrees(noise[1]), "turned [deg]"),
    )
    for row, (values, deviation, label) in enumerate(quantities):
        axes = page.add_axes((0.51, 0.54 - 0.42 * row, 0.47, 0.36))
        _spans(axes, motions, _MOTION, "motion between rests", 0.35)
        _spans(axes, gaps, _GAP, "gap", 0.6)
        centred = values - np.nanmean(values, axis=0)
        for k, name in enumerate("xyz"):
            axes.plot(time[every], centred[every, k], _STROKES[k], color=_COLOURS[k], linewidth=1.0, label=name)
            low, high = centred[every, k] - 2 * deviation, centred[every, k] + 2 * deviation
            axes.fill_between(time[every], low, high, color=_COLOURS[k], alpha=0.2, linewidth=0)
        axes.set_ylabel(f"{label}, from its mean", color=INK)
        plain(axes)
    axes.set_xlabel("time [s]", color=INK)
    axes.legend(ncols=5, loc="upper center", bbox_to_anchor=(0.5, -0.14), **LEGEND)
    return page


def _spans(axes: object, spans: Spans, colour: str, label: str, alpha: float) -> None:
    for number, (begin, end) in enumerate(spans):
        axes.axvspan(begin, end, color=colour, alpha=alpha, linewidth=0, label=label if number == 0 else None)  # type: ignore[attr-defined]
