"""Pictures of orientations."""

from __future__ import annotations

import itertools
from typing import Any

import dmpcpp
import numpy as np
from dmpcpp import plot, so3

from scripts.gallery.look import BLUE, GREEN, ORANGE, STROKES, TIME, columns, label, legend


def euler() -> Any:
    """A wrist that turns evenly: its Euler angles jump at gimbal lock, its rotation does not."""
    turned = np.array([so3.exp(1.2 * t * np.array([0.02, 1.0, 0.0])) for t in TIME])
    angles = np.degrees([so3.to_euler(rotation, "ZYX") for rotation in turned])
    page, (left, right) = columns(2)
    for k, (name, colour) in enumerate(zip(("yaw", "pitch", "roll"), (BLUE, ORANGE, GREEN), strict=True)):
        left.plot(TIME, angles[:, k], color=colour, linestyle=STROKES[k], label=name)
    label(left, "time [s]", "angle [deg]", "as Euler angles, ZYX")
    legend(left, loc="upper left")
    model = dmpcpp.OrientationDmp.fit(dmpcpp.OrientationDemonstration(TIME, turned))
    again = model.rollout_at(TIME)
    right.plot(TIME, np.degrees(np.linalg.norm(again.angular_velocity, axis=1)), color=BLUE, label="learned")
    steps = np.degrees([so3.distance(a, b) for a, b in itertools.pairwise(turned)]) / np.diff(TIME)
    right.plot(TIME[:-1], steps, ":", color="#1A1A1A", label="demonstrated")
    right.set_ylim(0.0, 100.0)
    label(right, "time [s]", "angular speed [deg/s]", "as a rotation")
    legend(right, loc="lower left")
    return page


def turn() -> Any:
    """Three quarters of a turn about a slanted axis: the nine entries of the matrix, demonstrated and learned."""
    axis = np.array([0.0, 0.6, 0.8])
    share = TIME / TIME[-1]
    turned = np.array([so3.exp([0.4 * np.sin(3 * s), 0, 0]) @ so3.exp(1.5 * np.pi * s * axis) for s in share])
    model = dmpcpp.OrientationDmp.fit(dmpcpp.OrientationDemonstration(TIME, turned))
    led = model.rollout_at(TIME, goal=model.goal @ so3.exp([0.5, 0.0, 0.0])).rotation
    page = plot.figure(8.0, 4.6)
    page.set_layout_engine("constrained")
    cells = page.subplots(3, 3, sharex=True)
    plot.rotation_entries(cells, TIME, turned, {"learned": model.rollout_at(TIME).rotation, "led 29° further": led})
    page.legend(
        *cells[0][0].get_legend_handles_labels(), loc="outside upper left", ncols=3, frameon=False, fontsize=8.5
    )
    return page
