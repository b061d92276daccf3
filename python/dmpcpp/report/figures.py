"""The figures of a report, each an SVG element."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from dmpcpp import _core, plot
from dmpcpp.report.run_folder import RunFolder

Array = NDArray[np.float64]

__all__ = ["coordinates", "demonstrations", "errors", "joints", "path", "phase_and_kernels", "rotation"]

_WIDE = 10.5  # inches
_TIMES = 400


def path(run: RunFolder) -> str:
    """Draw the path in 3-D: demonstrated, planned, executed."""
    page = plot.figure(_WIDE, 5.6)
    axes = page.add_axes((0.0, 0.0, 1.0, 0.95), projection="3d")
    record = run.record
    plot.paths(
        axes,
        planned=run.plan.pose[_few(len(run.plan.pose))],
        demonstrated=record.demonstrated_pose,
        executed=record.executed_pose[_few(len(record.executed_pose))],
    )
    _legend(page, axes)
    return plot.svg(page)


def coordinates(run: RunFolder) -> str:
    """Draw x, y and z over time."""
    page = plot.figure(_WIDE, 5.2)
    cells = page.subplots(3, 1, sharex=True, gridspec_kw={"left": 0.08, "right": 0.98, "top": 0.93, "bottom": 0.1})
    time, original, imitated = _motions(run)
    positions = {name: pose[:, :3, 3] for name, pose in imitated.items()}
    plot.coordinates(cells, time, original[:, :3, 3], positions, ("x [m]", "y [m]", "z [m]"))
    _legend(page, cells[0])
    return plot.svg(page)


def rotation(run: RunFolder) -> str:
    """Draw the nine entries of the rotation matrix over time: they have no jump, whatever the motion."""
    page = plot.figure(_WIDE, 5.6)
    spaces = {"left": 0.07, "right": 0.98, "top": 0.93, "bottom": 0.09, "wspace": 0.28}
    cells = page.subplots(3, 3, sharex=True, gridspec_kw=spaces)
    time, original, imitated = _motions(run)
    rotations = {name: pose[:, :3, :3] for name, pose in imitated.items()}
    plot.rotation_entries(cells, time, original[:, :3, :3], rotations)
    _legend(page, cells[0][0])
    return plot.svg(page)


def errors(run: RunFolder) -> str:
    """Draw position and angle errors of every stage over time, on logarithmic axes."""
    page = plot.figure(_WIDE, 5.0)
    above, below = page.subplots(
        2, 1, sharex=True, gridspec_kw={"left": 0.08, "right": 0.98, "top": 0.93, "bottom": 0.1}
    )
    plot.position_error(above, run.record.errors)
    plot.angle_error(below, run.record.errors)
    below.set_xlabel("time [s]")
    _legend(page, above)
    return plot.svg(page)


def joints(run: RunFolder) -> str:
    """Draw position, velocity and torque of every joint as shares of their limits."""
    record, arm = run.record, run.record.arm
    middle, half = 0.5 * (arm.lower + arm.upper), 0.5 * (arm.upper - arm.lower)
    shares = {
        "position [%]": _share(record.position - np.where(np.isfinite(middle), middle, 0.0), half),
        "velocity [%]": _share(record.velocity, arm.velocity_limit),
        "torque [%]": _share(record.torque, arm.effort_limit),
    }
    page = plot.figure(_WIDE, 6.6)
    cells = page.subplots(3, 1, sharex=True, gridspec_kw={"left": 0.08, "right": 0.98, "top": 0.92, "bottom": 0.08})
    for axes, (label, share) in zip(cells, shares.items(), strict=True):
        plot.joint_shares(axes, record.joint_time, share, arm.joint_names, label)
    cells[-1].set_xlabel("time [s]; before 0 the arm runs up from rest")
    _legend(page, cells[0])
    return plot.svg(page)


def phase_and_kernels(run: RunFolder) -> str:
    """Draw the phase variable and the kernels over the motion's time."""
    share = np.linspace(0.0, 1.0, 300)
    time = share * run.plan.time[-1]
    page = plot.figure(_WIDE, 3.8)
    above, below = page.subplots(
        2, 1, sharex=True, gridspec_kw={"left": 0.08, "right": 0.98, "top": 0.97, "bottom": 0.13}
    )
    plot.phase(above, time, np.exp(-run.model.options.alpha_x * share))
    kernels = run.model.activations(share)
    plot.activations(below, time, kernels[:, :: max(1, kernels.shape[1] // 90)])
    below.set_ylabel("kernels")
    return plot.svg(page)


def demonstrations(run: RunFolder) -> str:
    """Draw the demonstration's coordinates over the phase, in a band of two standard deviations of its noise."""
    record, noise = run.record, float(run.summary["recording"]["noise"]["position"])
    demo = _core.Demonstration(record.demonstrated_time, record.demonstrated_pose[:, :3, 3])
    middle = demo.smoothed() if len(record.demonstrated_time) >= 10 else demo
    phase = record.demonstrated_time / record.demonstrated_time[-1]
    shown = np.linspace(0.0, 1.0, _TIMES)
    mean = middle.at(shown * middle.duration).position
    page = plot.figure(_WIDE, 4.6)
    cells = page.subplots(3, 1, sharex=True, gridspec_kw={"left": 0.08, "right": 0.98, "top": 0.92, "bottom": 0.11})
    found = ((phase, record.demonstrated_pose[:, :3, 3]),)
    plot.spread(cells, found, (shown, mean), np.full(3, noise), ("x [m]", "y [m]", "z [m]"))
    _legend(page, cells[0])
    return plot.svg(page)


def _motions(run: RunFolder) -> tuple[Array, Array, dict[str, Array]]:
    """Return time, demonstrated poses, and the plan's and the tool's at those times; time is the executed motion's."""
    record = run.record
    slow = run.plan.time[-1] / record.demonstrated_time[-1]
    chosen = _few(len(record.demonstrated_time))
    time = slow * record.demonstrated_time[chosen]
    planned = run.plan.pose[_nearest(run.plan.time, time)]
    executed = record.executed_pose[_nearest(record.executed_time, time)]
    return time, record.demonstrated_pose[chosen], {"planned": planned, "executed": executed}


def _nearest(times: Array, wanted: Array) -> NDArray[np.intp]:
    right = np.searchsorted(times, wanted).clip(1, len(times) - 1)
    return np.where(wanted - times[right - 1] < times[right] - wanted, right - 1, right)


def _few(count: int) -> NDArray[np.intp]:
    return np.unique(np.linspace(0, count - 1, min(count, _TIMES)).round().astype(np.intp))


def _share(values: Array, limit: Array) -> Array:
    """Return values over limits; NaN for a joint that has none."""
    known = np.isfinite(limit) & (limit > 0.0)
    return np.where(known, values / np.where(known, limit, 1.0), np.nan)


def _legend(page: Any, axes: Any) -> None:
    lines, labels = axes.get_legend_handles_labels()
    page.legend(lines, labels, loc="upper left", ncols=len(lines), frameon=False, fontsize=8.5)
