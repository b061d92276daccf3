"""The pictures of a reproduction, like the figures of the source, and its numbers, in a folder."""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from dmpcpp._atomic import write_text
from dmpcpp.metrics import rotation_angles
from dmpcpp.show import plot
from dmpcpp.show.plot import INK, LEGEND
from dmpcpp.trials.reproduction._experiments import TITLES, PositionExperiment, RotationExperiment
from dmpcpp.trials.reproduction._repetition import NoiseLevel
from dmpcpp.trials.reproduction._run import Reproduction

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def write(run: Reproduction, folder: str | PathLike[str]) -> None:
    """Write the pictures and summary.json into `folder`, each whole or not at all, the summary last.

    activations.png, helix.png, coordinates.png and rotation-<convention>-<seconds>s.png are the source's figures
    2.1, 3.1, 3.2 and 3.3; repetition.png is there if there was one.

    Raises
    ------
    FileError
        The folder or a file cannot be written.
    MissingDependency
        matplotlib is not installed.
    """
    folder = Path(folder)
    pages = {"activations": activations_page(run.helix), "helix": helix_page(run.helix)}
    pages["coordinates"] = coordinates_page(run.helix)
    for experiment in run.rotations:
        name = f"rotation-{experiment.convention.lower()}-{experiment.demonstration.duration:g}s"
        pages[name] = rotation_page(experiment)
    if run.levels:
        pages["repetition"] = repetition_page(run.levels)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").unlink(missing_ok=True)
    for name, page in pages.items():
        plot.save(page, folder / f"{name}.png")
    write_text(folder / "summary.json", json.dumps(run.summary(), indent=2, allow_nan=False) + "\n")


def activations_page(experiment: PositionExperiment) -> Figure:
    """Like the source's figure 2.1: the kernels over time, its own beside the default's."""
    page = plot.figure(12.5, 4.6, title="Basis activations")
    columns = page.subplots(1, 2, sharey=True)
    phase = np.linspace(0.0, 1.0, 2001)
    for axes, (name, model) in zip(columns, experiment.models.items(), strict=True):
        plot.activations(axes, phase * model.duration, model.activations(phase))
        axes.set_title(f"{TITLES[name]}: {model.options.basis_count} kernels", loc="left", fontsize=10, color=INK)
    columns[0].set_ylabel("activation", color=INK)
    page.subplots_adjust(left=0.06, right=0.985, top=0.84, bottom=0.13, wspace=0.06)
    return page


def helix_page(experiment: PositionExperiment) -> Figure:
    """Like the source's figure 3.1: imitated against original path, under its equations and under the default."""
    page = plot.figure(12.5, 6.6, title="x = sin(0.05 k), y = cos(0.05 k), z = 2 k: imitated against original path")
    columns = page.subplots(1, 2, subplot_kw={"projection": "3d"})
    for axes, (name, path) in zip(columns, experiment.reproduced.items(), strict=True):
        plot.path_3d(axes, experiment.demonstration.position, {"imitated": path})
        axes.set_title(TITLES[name], fontsize=10, y=0.97, color=INK)
    every = np.concatenate([experiment.demonstration.position, *experiment.reproduced.values()])
    for axes in columns:
        axes.set(**{f"{d}lim": (every[:, k].min(), every[:, k].max()) for k, d in enumerate("xyz")})
    _legend_above(page, columns[0])
    page.subplots_adjust(left=0.0, right=0.97, top=0.93, bottom=0.03, wspace=0.0)
    return page


def coordinates_page(experiment: PositionExperiment) -> Figure:
    """Like the source's figure 3.2: coordinates over time, and beside them their errors."""
    page = plot.figure(12.5, 7.0, title="x = sin(0.05 k), y = cos(0.05 k), z = 2 k: coordinates over time")
    cells = page.subplots(3, 2, sharex=True)
    shown = experiment.demonstration
    again = {TITLES[name]: path for name, path in experiment.reproduced.items()}
    plot.coordinates(cells[:, 0], shown.time, shown.position, again, "xyz")
    for d, axis in enumerate("xyz"):
        errors = {name: np.abs(path[:, d] - shown.position[:, d]) for name, path in again.items()}
        plot.series_errors(cells[d, 1], shown.time, errors, f"error of {axis}")
    cells[-1, 1].set_xlabel("time [s]", color=INK)
    _legend_above(page, cells[0, 0])
    page.subplots_adjust(left=0.06, right=0.985, top=0.88, bottom=0.08, wspace=0.16, hspace=0.12)
    return page


def rotation_page(experiment: RotationExperiment) -> Figure:
    """Like the source's figure 3.3: the nine entries of R over time, and below them the angle of the error."""
    shown = experiment.demonstration
    title = f"Euler angles (.8 sin t, .5 cos t, .6 t), {_product(experiment.convention)}: the entries of R over time"
    page = plot.figure(12.5, 8.4, title=title)
    grid = page.add_gridspec(3, 3, left=0.06, right=0.985, top=0.905, bottom=0.32, wspace=0.16, hspace=0.16)
    cells = [[page.add_subplot(grid[i, j]) for j in range(3)] for i in range(3)]
    again = {TITLES[name]: rotation for name, rotation in experiment.reproduced.items()}
    plot.rotation_entries(cells, shown.time, shown.rotation, again)
    below = page.add_axes((0.06, 0.065, 0.925, 0.175))
    angles = {name: np.degrees(rotation_angles(shown.rotation, r)) for name, r in again.items()}
    plot.series_errors(below, shown.time, angles, "error [deg]").set_xlabel("time [s]", color=INK)
    _legend_above(page, cells[0][0])
    return page


def repetition_page(levels: tuple[NoiseLevel, ...]) -> Figure:
    """Mean, standard deviation and worst case of the random motions at every level of noise."""
    count = next(iter(levels[0].rmse.values())).count
    title = f"{count} random motions: RMSE to the motion without noise"
    page = plot.figure(12.5, 5.2, title=title, note="Bars: one standard deviation.")
    columns = page.subplots(1, 2)
    for axes, quantity, unit, scale in zip(
        columns, ("position", "orientation"), ("mm", "deg"), (1e3, np.degrees(1.0)), strict=True
    ):
        chosen = [level for level in levels if level.quantity == quantity]
        series = {
            field: {TITLES[n]: [scale * getattr(level.rmse[n], field) for level in chosen] for n in chosen[0].rmse}
            for field in ("mean", "std", "worst")
        }
        noise = [f"{scale * level.noise:.3g} {unit}" if level.noise else "none" for level in chosen]
        plot.errors_over_noise(axes, noise, **series, label=f"{quantity} RMSE [{unit}]")
        axes.set_xlabel("noise of the demonstration, standard deviation per component", color=INK)
    _legend_above(page, columns[0])
    page.subplots_adjust(left=0.06, right=0.985, top=0.84, bottom=0.15, wspace=0.16)
    return page


def _product(convention: str) -> str:
    return {"source": "the source's product $R_z^T R_y^T R_x^T$", "ZYX": "$R_z R_y R_x$"}[convention]


def _legend_above(page: Figure, axes: object) -> None:
    handles, labels = axes.get_legend_handles_labels()  # type: ignore[attr-defined]
    high = 1.0 - 0.42 / page.get_figheight()
    page.legend(handles, labels, loc="upper left", bbox_to_anchor=(0.022, high), ncols=len(labels), **LEGEND)
