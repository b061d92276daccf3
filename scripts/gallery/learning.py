"""Pictures of movement primitives in space."""

from __future__ import annotations

from typing import Any

import dmpcpp
import numpy as np
from dmpcpp import plot

from scripts.gallery.look import (
    BLUE,
    GREEN,
    ORANGE,
    PINK,
    RED,
    SKY,
    STROKES,
    TIME,
    columns,
    label,
    learned,
    legend,
    lift,
)


def goals() -> Any:
    """One motion, led to many goals: the shape is kept, every end is met."""
    model = learned()
    page, (side, top) = columns(2)
    heights = np.linspace(-0.15, 0.25, 6)
    aside = np.linspace(-0.25, 0.25, 6)
    for axes, second, offsets in ((side, 2, heights), (top, 1, aside)):
        for offset in offsets:
            goal = model.goal + offset * np.eye(3)[second]
            path = model.rollout(goal, dt=0.01).position
            axes.plot(path[:, 0], path[:, second], color=SKY, linewidth=1.3)
            axes.plot(goal[0], goal[second], "s", color=BLUE, markersize=5)
        axes.plot(lift()[::8, 0], lift()[::8, second], "o", color=ORANGE, markersize=3.6, label="demonstrated")
        axes.plot([], [], color=SKY, label="led there")
        axes.plot([], [], "s", color=BLUE, markersize=5, label="goals")
        axes.set_aspect("equal", adjustable="box")
    label(side, "x [m]", "z [m]", "from the side")
    label(top, "x [m]", "y [m]", "from above")
    page.legend(*side.get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False, fontsize=8.5)
    return page


def tempo() -> Any:
    """The same path in 1, 2 and 4 s."""
    model = learned()
    page, (height, speed) = columns(2)
    for duration, colour, stroke in zip((1.0, 2.0, 4.0), (RED, BLUE, GREEN), STROKES, strict=False):
        motion = model.rollout(duration=duration, dt=duration / 400)
        name = f"{duration:g} s" + (", as demonstrated" if duration == TIME[-1] else "")
        style = {"color": colour, "linestyle": stroke, "label": name}
        height.plot(motion.time, motion.position[:, 2], **style)
        speed.plot(motion.time, np.linalg.norm(motion.velocity, axis=1), **style)
    label(height, "time [s]", "z [m]", "the same way")
    label(speed, "time [s]", "speed [m/s]", "in another time")
    legend(speed)
    return page


def online() -> Any:
    """A goal that moves and a tempo that changes while the loop steps."""
    run = dmpcpp.Run(learned())
    goal = run.goal
    rows = []
    while run.step(0.002) or len(rows) < 1400:
        rows.append((run.time, *run.position, *run.velocity))
        if len(rows) == 400:
            run.goal = goal + [0.0, 0.15, 0.0]
        if len(rows) == 600:
            run.duration = 3.0
    moved = np.array(rows)
    usual = learned().rollout(dt=0.002)
    page, cells = columns(2, height=4.2, rows=True, sharex=True)
    for axes, now, before in zip(cells, (moved[:, 2], moved[:, 5]), (usual.position, usual.velocity), strict=True):
        axes.plot(usual.time, before[:, 1], ":", color="#1A1A1A", label="undisturbed")
        axes.plot(moved[:, 0], now, color=BLUE, label="led elsewhere on the way")
        for when, what in ((0.8, "goal moves by 15 cm"), (1.2, "duration 2 s → 3 s")):
            axes.axvline(when, color=RED, linewidth=0.9)
            if axes is cells[0]:
                axes.text(when, 0.19, f" {what} ", color=RED, fontsize=8.5, ha="right" if when < 1.0 else "left")
    cells[0].set_ylim(-0.12, 0.21)
    label(cells[0], "", "y [m]")
    label(cells[1], "time [s]", "velocity in y [m/s]")
    legend(cells[1], loc="lower right")
    return page


def scaling() -> Any:
    """What each scaling makes of a goal that is turned, and of one twice as far."""
    page, cells = columns(2, height=3.8)
    names = {
        "advance": "advance (default)",
        "none": "none",
        "per_axis": "per axis (the source)",
        "rotation_dilation": "rotation and dilation",
    }
    plane = lift()[:, [0, 2]] + np.c_[np.zeros(201), 0.1 * TIME / TIME[-1]]
    shown = dmpcpp.Demonstration(TIME, plane)
    model = {name: dmpcpp.Dmp.fit(shown, scaling=name, scaling_guard=name != "per_axis") for name in names}
    turned = plane[-1] @ np.array([[0.5, np.sqrt(0.75)], [-np.sqrt(0.75), 0.5]])
    for axes, goal, title in zip(cells, (turned, 2 * plane[-1]), ("turned by 60°", "twice as far"), strict=True):
        axes.plot(*plane[::8].T, "o", color=ORANGE, markersize=3.6, label="demonstrated")
        for (name, said), colour, stroke in zip(names.items(), (BLUE, PINK, RED, GREEN), STROKES, strict=False):
            path = model[name].rollout(goal, dt=0.01).position
            axes.plot(*path.T, color=colour, linestyle=stroke, label=said)
        axes.plot(*goal, "s", color="#1A1A1A", markersize=5, label="goal")
        axes.set_aspect("equal", adjustable="box")
        label(axes, "x [m]", "z [m]", title)
    page.legend(*cells[0].get_legend_handles_labels(), loc="outside lower center", ncols=5, frameon=False, fontsize=8.5)
    return page


def kernels() -> Any:
    """What drives a motion: the phase, the kernels over it, the force that their weights make."""
    model = learned(basis_count=30)
    share = np.linspace(0.0, 1.0, 400)
    page, (phase, bumps, force) = columns(3, height=5.0, rows=True, sharex=True)
    time = share * model.duration
    plot.phase(phase, time, np.exp(-model.options.alpha_x * share))
    plot.activations(bumps, time, model.activations(share))
    label(bumps, "", "kernels, 30")
    for k, (name, colour) in enumerate(zip("xyz", (BLUE, ORANGE, GREEN), strict=True)):
        force.plot(time, model.forcing(share)[:, k], color=colour, linestyle=STROKES[k], label=name)
    label(force, "time [s]", "forcing term [m]")
    legend(force, ncols=3)
    return page


def regression() -> Any:
    """One pass of locally weighted regression is a smoother; ten come close to least squares."""
    counts = np.array([5, 10, 20, 40, 80, 160])
    page, (axes,) = columns(1, width=6.0)
    ways = {
        "LWR, 1 pass (textbook)": {"regression": "lwr", "passes": 1},
        "LWR, 10 passes": {"regression": "lwr", "passes": 10},
        "ridge regression (default)": {"regression": "ridge"},
    }
    for (name, options), colour, marker in zip(ways.items(), (RED, BLUE, GREEN), "so^", strict=True):
        errors = [learned(basis_count=int(n), **options).rollout_at(TIME).position - lift() for n in counts]
        rmse = [1e3 * np.sqrt(np.mean(np.sum(error**2, axis=1))) for error in errors]
        axes.loglog(counts, rmse, marker=marker, color=colour, markersize=5, linewidth=1.2, label=name)
    axes.set_xticks(counts, counts)
    axes.minorticks_off()
    label(axes, "kernels", "RMSE [mm]")
    legend(axes)
    return page


def noise() -> Any:
    """A recording with 1 mm of noise: learned as it is, and with the noise found and taken out."""
    drawn = np.random.default_rng(1)
    noisy = dmpcpp.Demonstration(TIME, lift() + drawn.normal(scale=1e-3, size=lift().shape))
    page, cells = columns(2)
    clean = learned().rollout_at(TIME)
    for name, colour, width in (("exact", RED, 0.8), ("smooth", BLUE, 1.6)):
        derivatives = "smooth" if name == "smooth" else "interpolate"
        motion = dmpcpp.Dmp.fit(noisy, derivatives=derivatives).rollout_at(TIME)
        off = 1e3 * np.linalg.norm(motion.position - lift(), axis=1)
        said = "noise found and smoothed out" if name == "smooth" else "learned as recorded"
        cells[0].plot(TIME, off, color=colour, linewidth=width, label=said)
        cells[1].plot(TIME, np.linalg.norm(motion.velocity, axis=1), color=colour, linewidth=width, label=said)
    cells[1].plot(TIME, np.linalg.norm(clean.velocity, axis=1), ":", color="#1A1A1A", label="without noise")
    label(cells[0], "time [s]", "off the truth [mm]")
    label(cells[1], "time [s]", "speed [m/s]")
    legend(cells[1], loc="upper center")
    cells[1].set_ylim(0.0, 1.35 * cells[1].get_ylim()[1])
    return page


def spread() -> Any:
    """Six demonstrations, the model of all, and where the next one is to be expected."""
    drawn = np.random.default_rng(6)
    shape = np.sin(np.pi * TIME / TIME[-1])[:, None]
    shown = [
        dmpcpp.Demonstration(TIME * drawn.uniform(0.8, 1.25), lift() + shape * drawn.normal(scale=0.015, size=3))
        for _ in range(6)
    ]
    model = dmpcpp.Dmp.fit(shown)
    found = dmpcpp.spread(shown)
    page, cells = columns(3, height=5.0, rows=True, sharex=True)
    deviation = np.sqrt(np.diagonal(found.covariance, axis1=1, axis2=2))
    many = [(one.time / one.duration, one.position) for one in shown]
    plot.spread(cells, many, (found.phase, found.mean), deviation, ("x [m]", "y [m]", "z [m]"))
    learnt = model.rollout(dt=model.duration / 400)
    for k, axes in enumerate(cells):
        axes.plot(learnt.time / model.duration, learnt.position[:, k], "--", color="#1A1A1A", label="learned of all")
    legend(cells[0], loc="upper left", ncols=3)
    return page
