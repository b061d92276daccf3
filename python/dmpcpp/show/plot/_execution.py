"""What was shown, what was planned, what the arm did, and how far apart they are."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.show.plot._page import FAINT, INK, LEGEND, figure, plain, plain_3d, save

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_STAGE_COLOURS = ("#E69F00", "#009E73", "#0072B2", "#CC79A7")
_STAGE_STROKES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1.5, 1, 1.5)))
_PATHS: dict[str, dict[str, Any]] = {
    "planned": {"color": "#56B4E9", "linewidth": 6.0, "solid_capstyle": "round", "zorder": 2},
    "demonstrated": {"color": "#E69F00", "linestyle": "none", "marker": "o", "markersize": 3.6, "zorder": 4},
    "executed": {"color": "#1A1A1A", "linewidth": 1.2, "zorder": 5},
}
_DOTS = 70  # demonstrated samples drawn: more would hide the lines below
_AXES_DRAWN = 14  # tool axes drawn along the planned path
_BINS = 400  # points of an error curve
_FLOOR_OF_LOG = 1e-9  # m or rad: an error of exactly 0 has no place on a logarithmic axis


@dataclass(frozen=True)
class ErrorCurve:
    """How far apart two motions are, over time.

    Attributes
    ----------
    label : str
        Which two, e.g. "demonstration → DMP".
    time : (T,) s
    position : (T,) m
    angle : (T,) rad
    """

    label: str
    time: Array
    position: Array
    angle: Array


def paths(axes: Any, **poses: Array) -> Any:
    """Draw ``demonstrated=``, ``planned=`` and ``executed=`` into 3-D axes, each (T, 4, 4) or (T, 3) [m].

    The plan is a broad line with short strokes along the tool's z axis, the demonstration is dots on it, the
    execution a thin line on top. Grey below is the plan's shadow.
    """
    axes.computed_zorder = False  # matplotlib would sort whole lines by their mean depth
    positions = {name: _positions(name, values) for name, values in poses.items()}
    for name, position in positions.items():
        if name not in _PATHS:
            raise InvalidArgument(f"{name}: not a path. Known are {', '.join(_PATHS)}.")
        shown = position[:: max(1, len(position) // _DOTS)] if name == "demonstrated" else position
        axes.plot(*shown.T, label=name, **_PATHS[name])
    _frame_3d(axes, np.concatenate(list(positions.values())))
    if "planned" in poses:
        start = positions["planned"][:1]
        axes.plot(*start.T, "o", color="white", markeredgecolor=INK, markersize=8, zorder=6, label="start")
        _tool_axes(axes, np.asarray(poses["planned"]))
        _shadow(axes, positions["planned"])
    return axes


def position_error(axes: Axes, curves: Sequence[ErrorCurve], limit: float | None = None) -> Axes:
    """Draw distances [mm], the worst of each short stretch, over time; ``limit`` [m] is a line."""
    return _errors(axes, curves, "position", 1e3, "position error [mm]", limit)


def angle_error(axes: Axes, curves: Sequence[ErrorCurve], limit: float | None = None) -> Axes:
    """Draw angles [deg], the worst of each short stretch, over time; ``limit`` [rad] is a line."""
    return _errors(axes, curves, "angle", np.degrees(1.0), "angle error [deg]", limit)


def picture(
    path: str | os.PathLike[str],
    *,
    demonstrated: Array,
    planned: Array,
    executed: Array,
    errors: Sequence[ErrorCurve],
    title: str = "",
    note: str = "",
) -> Path:
    """Write a PNG: the three paths in 3-D beside the errors over time.

    Parameters
    ----------
    path : str or path-like
        The file; it appears whole or not at all.
    demonstrated, planned, executed : (T, 4, 4) or (T, 3)
        In the frame of the arm's base [m].
    errors : sequence of ErrorCurve
    title, note : str
        Above and below the picture.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    MissingDependency
        matplotlib is not installed.
    FileError
        The file cannot be written.
    """
    page = figure(title=title, note=note)
    grid = page.add_gridspec(2, 2, width_ratios=(1.35, 1.0), left=0.02, right=0.975, top=0.9, bottom=0.13)
    space = page.add_subplot(grid[:, 0], projection="3d")
    paths(space, planned=planned, demonstrated=demonstrated, executed=executed)
    lines, labels = space.get_legend_handles_labels()
    page.legend(lines, labels, loc="center left", bbox_to_anchor=(0.022, 0.915), ncols=len(lines), **LEGEND)
    above, below = page.add_subplot(grid[0, 1]), page.add_subplot(grid[1, 1])
    position_error(above, errors)
    angle_error(below, errors)
    below.set_xlabel("time [s]", color=INK)
    above.tick_params(labelbottom=False)
    above.legend(loc="lower left", bbox_to_anchor=(-0.01, 1.0), ncols=len(errors), handlelength=2.2, **LEGEND)
    return save(page, path)


def _positions(name: str, values: Array) -> Array:
    array = np.asarray(values, dtype=np.float64)
    if array.ndim == 3 and array.shape[1:] == (4, 4):
        array = array[:, :3, 3]
    if array.ndim != 2 or array.shape[1] != 3 or len(array) == 0:
        raise InvalidArgument(f"{name}: shape {np.shape(values)}, expected (T, 4, 4) or (T, 3) with T >= 1.")
    return array


def _tool_axes(axes: Any, poses: Array) -> None:
    """Short strokes along the tool's z axis, evenly over the path."""
    if poses.ndim != 3:
        return
    length = 0.1 * float(np.max(np.ptp(poses[:, :3, 3], axis=0)))
    chosen = poses[np.linspace(0, len(poses) - 1, min(_AXES_DRAWN, len(poses))).astype(int)]
    for k, pose in enumerate(chosen):
        ends = np.stack([pose[:3, 3], pose[:3, 3] + length * pose[:3, 2]])
        axes.plot(*ends.T, color="#0072B2", linewidth=1.3, zorder=3, label="tool z axis" if k == 0 else None)


def _frame_3d(axes: Any, points: Array) -> None:
    """One scale for x, y and z; a flat path still gets a box that can be read."""
    lowest, highest = points.min(axis=0), points.max(axis=0)
    span = np.maximum(highest - lowest, 1e-3)
    half = 0.55 * np.maximum(span, 0.6 * span.max())
    middle = 0.5 * (lowest + highest)
    axes.set(**{f"{name}lim": (m - h, m + h) for name, m, h in zip("xyz", middle, half, strict=True)})
    axes.set_box_aspect(half, zoom=1.12)
    plain_3d(axes, ("x [m]", "y [m]", "z [m]"))


def _shadow(axes: Any, position: Array) -> None:
    floor = np.full(len(position), axes.get_zlim()[0])
    axes.plot(position[:, 0], position[:, 1], floor, color="#C8C8C8", linewidth=1.0, zorder=1)


def _errors(
    axes: Axes, curves: Sequence[ErrorCurve], field: str, scale: float, label: str, limit: float | None
) -> Axes:
    shown = [np.maximum(getattr(curve, field), _FLOOR_OF_LOG) for curve in curves]
    axes.set_yscale("log")
    if limit is None and len({float(value) for values in shown for value in values}) == 1:
        lowest = scale * float(shown[0][0])
        axes.set_ylim(0.1 * lowest, 10.0 * lowest)  # before anything is drawn: one value alone has no height
    for k, curve in enumerate(curves):
        time, values = _envelope(curve.time, shown[k])
        stroke = {"color": _STAGE_COLOURS[k % 4], "linestyle": _STAGE_STROKES[k % 4], "linewidth": 1.5}
        axes.plot(time, values * scale, label=curve.label, **stroke)
    if limit is not None:
        axes.axhline(limit * scale, color=INK, linewidth=0.8)
    if any((getattr(curve, field) < _FLOOR_OF_LOG).any() for curve in curves):
        note = f"the lowest line is {_FLOOR_OF_LOG * scale:.0e} or less"
        axes.text(0.995, 0.065, note, transform=axes.transAxes, ha="right", va="bottom", fontsize=7, color=FAINT)
    axes.set_ylabel(label, color=INK)
    plain(axes).minorticks_off()
    return axes


def _envelope(time: Array, values: Array) -> tuple[Array, Array]:
    """The largest value of each of _BINS stretches: what is drawn never looks better than it was."""
    size = -(-len(values) // _BINS)
    if size <= 1:
        return time, values
    starts = np.arange(0, len(values), size)
    return time[starts], np.maximum.reduceat(values, starts)
