"""The figures of a report, each an element of HTML: SVG, and an image where there are thousands of faces."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp import _core
from dmpcpp._typing import Array
from dmpcpp.show import plot
from dmpcpp.show.report._run_folder import RunFolder
from dmpcpp.show.scene import triangles

__all__ = [
    "coordinates",
    "demonstrations",
    "errors",
    "joints",
    "orientation",
    "path",
    "phase_and_kernels",
    "poster",
    "still",
]

_WIDE = 9.0  # inches: text is then as large as the page's, on the screen and on paper
_TIMES = 400
_LETTERS = 70  # of a legend's names in one row


def path(run: RunFolder) -> str:
    """Draw the path in 3-D: demonstrated, planned, executed."""
    page = plot.figure(_WIDE, 4.9)
    axes = page.add_axes((0.0, 0.09, 1.0, 0.85), projection="3d")
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
    page = plot.figure(_WIDE, 4.7)
    cells = page.subplots(3, 1, sharex=True, gridspec_kw={"left": 0.09, "right": 0.985, "top": 0.93, "bottom": 0.1})
    time, original, imitated = _motions(run)
    positions = {name: pose[:, :3, 3] for name, pose in imitated.items()}
    plot.coordinates(cells, time, original[:, :3, 3], positions, ("x [m]", "y [m]", "z [m]"))
    _legend(page, cells[0])
    return plot.svg(page)


def orientation(run: RunFolder) -> str:
    """Draw the angle turned since the start, whole turns counted, and the lean of the tool's z axis."""
    page = plot.figure(_WIDE, 4.0)
    spaces = {"left": 0.09, "right": 0.985, "top": 0.92, "bottom": 0.12}
    above, below = page.subplots(2, 1, sharex=True, gridspec_kw=spaces)
    time, original, imitated = _motions(run)
    turned, lean = (
        (shown(original), {name: shown(pose) for name, pose in imitated.items()}) for shown in (_turned, _lean)
    )
    plot.coordinates((above,), time, turned[0], turned[1], ("turned [deg]",))
    plot.coordinates((below,), time, lean[0], lean[1], ("z from upright [deg]",))
    above.set_xlabel("")
    _legend(page, above)
    return plot.svg(page)


def _turned(pose: Array) -> Array:
    """Return how far the poses (T, 4, 4) have turned since the first, (T, 1) deg; the small steps decide on turns."""
    since = Rotation.from_matrix(np.swapaxes(pose[:1, :3, :3], 1, 2) @ pose[:, :3, :3]).as_rotvec()
    vectors = [since[0]]
    for vector in since[1:]:
        angle = float(np.linalg.norm(vector))
        axis = vector / angle if angle > 1e-9 else vector
        turns = np.round((vectors[-1] @ axis - angle) / (2 * np.pi)) if angle > 1e-9 else 0.0
        vectors.append(vector + 2 * np.pi * turns * axis)
    return np.degrees(np.linalg.norm(vectors, axis=1))[:, None]


def _lean(pose: Array) -> Array:
    return np.degrees(np.arccos(np.clip(pose[:, 2, 2], -1.0, 1.0)))[:, None]


def errors(run: RunFolder) -> str:
    """Draw position and angle errors of every stage over time, on logarithmic axes."""
    page = plot.figure(_WIDE, 4.6)
    above, below = page.subplots(
        2, 1, sharex=True, gridspec_kw={"left": 0.09, "right": 0.985, "top": 0.93, "bottom": 0.1}
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
    page = plot.figure(_WIDE, 6.2)
    cells = page.subplots(3, 1, sharex=True, gridspec_kw={"left": 0.09, "right": 0.985, "top": 0.9, "bottom": 0.08})
    for axes, (label, share) in zip(cells, shares.items(), strict=True):
        plot.joint_shares(axes, record.joint_time, share, arm.joint_names, label)
    cells[-1].set_xlabel("time [s]; before 0 the arm runs up from rest")
    _legend(page, cells[0])
    return plot.svg(page)


def phase_and_kernels(run: RunFolder) -> str:
    """Draw the phase variable and the kernels over the motion's time."""
    share = np.linspace(0.0, 1.0, 300)
    time = share * run.plan.time[-1]
    page = plot.figure(_WIDE, 3.5)
    above, below = page.subplots(
        2, 1, sharex=True, gridspec_kw={"left": 0.09, "right": 0.985, "top": 0.97, "bottom": 0.13}
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
    page = plot.figure(_WIDE, 4.3)
    cells = page.subplots(3, 1, sharex=True, gridspec_kw={"left": 0.09, "right": 0.985, "top": 0.92, "bottom": 0.11})
    found = ((phase, record.demonstrated_pose[:, :3, 3]),)
    plot.spread(cells, found, (shown, mean), np.full(3, noise), ("x [m]", "y [m]", "z [m]"))
    _legend(page, cells[0])
    return plot.svg(page)


def still(run: RunFolder) -> str:
    """Draw the arm at the start, half-way and at the end, beside the path: for paper, where nothing moves."""
    return _drawn_arm(run, (0, len(run.record.executed_time) // 2, -1), "The arm at three moments")


def poster(run: RunFolder) -> str:
    """Draw the arm half-way: what stands where it will move, until it does."""
    return _drawn_arm(run, (len(run.record.executed_time) // 2,), "The arm half-way")


def _drawn_arm(run: RunFolder, moments: tuple[int, ...], alt: str) -> str:
    record = run.record
    hand, tool = record.demonstrated_pose[:, :3, 3], record.executed_pose[:, :3, 3]
    shapes = triangles(record.arm, record.executed_joints[list(moments)])
    page = plot.figure(_WIDE if len(moments) > 1 else 5.0, 4.0)
    share = 0.96 / len(moments)
    for k, (moment, shape) in enumerate(zip(moments, shapes, strict=True)):
        axes = page.add_axes((share * k, 0.12, share, 0.76), projection="3d", facecolor="none")
        plot.shape(axes, shape, around=np.concatenate([shapes.reshape(-1, 3), hand, tool]))
        axes.plot(*hand[_few(len(hand))].T, color="#E69F00", linewidth=2.4, zorder=3, label="demonstrated")
        axes.plot(*tool[_few(len(tool))].T, color="#1A1A1A", linewidth=1.0, zorder=4, label="executed")
        axes.set_title(f"{record.executed_time[moment]:.2f} s", fontsize=9, y=1.03)
    _legend(page, axes)
    return f'<img alt="{alt}" src="data:image/png;base64,{base64.b64encode(plot.png(page)).decode()}">'


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
    rows = 1 + len("".join(labels)) // _LETTERS
    page.legend(lines, labels, loc="upper left", ncols=-(-len(lines) // rows), frameon=False, fontsize=8.5)
