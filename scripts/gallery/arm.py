"""Pictures of arms: what they do, how fast they may, how far off they are when they are not what was thought."""

from __future__ import annotations

from typing import Any

import dmpcpp
import numpy as np
from dmpcpp import arms, metrics, plot, simulation
from dmpcpp.scene import triangles

from scripts.gallery.look import BLUE, GREEN, ORANGE, RED, STROKES, columns, label, legend


def _wave(joints: int, seconds: float) -> tuple[Any, Any]:
    """Return times (T,) [s] and joints (T, n) [rad] of an arm that waves, from rest to rest."""
    time = np.linspace(0.0, seconds, 301)
    s = time / seconds
    along = (s**3 * (10 - 15 * s + 6 * s**2))[:, None]
    middle = np.array([0.0, 0.2, 0.0, -1.9, 0.0, 2.1, 0.8])[:joints]
    reach = np.array([0.9, 0.5, 0.3, 0.6, 0.4, -0.5, 0.6])[:joints]
    return time, middle - 0.5 * reach + along * reach + 0.25 * np.sin(2 * np.pi * along) * reach[::-1]


def moments() -> Any:
    """A Panda on its way, followed from a hand's path by inverse kinematics."""
    panda = arms.find("panda")
    time, joints = _wave(7, 3.0)
    poses = panda.forward_kinematics(joints)
    model = dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses))
    goal = model.goal.copy()
    goal[:3, 3] += [-0.05, 0.0, 0.2]
    plan = model.rollout(goal, dt=model.duration / 300)
    followed = dmpcpp.InverseKinematics(panda).follow(plan, start=joints[0]).position
    shapes = triangles(panda, followed[[0, 150, 300]])
    page = plot.figure(8.0, 3.4)
    around = np.concatenate([shapes.reshape(-1, 3), plan.position, poses[:, :3, 3]])
    for k, moment in enumerate((0, 150, 300)):
        axes = page.add_axes((0.315 * k, 0.1, 0.315, 0.82), projection="3d", facecolor="none")
        plot.shape(axes, shapes[k], around)
        axes.plot(*poses[:, :3, 3].T, ":", color=ORANGE, linewidth=2.2, zorder=3, label="learned from")
        axes.plot(*plan.position.T, color=BLUE, linewidth=1.6, zorder=4, label="led to a higher goal")
        axes.set_title(f"{plan.time[moment]:.1f} s", fontsize=9, y=0.97)
    page.legend(*axes.get_legend_handles_labels(), loc="upper left", ncols=2, frameon=False, fontsize=8.5)
    return page


def timing() -> Any:
    """The same path twice: slowed down evenly until the limits hold, and timed as fast as they allow everywhere."""
    panda = arms.find("panda")
    time, joints = _wave(7, 3.0)
    path = dmpcpp.JointTrajectory.through(time, joints, panda.joint_names)
    acceleration = panda.acceleration_limit
    even = dmpcpp.stretched(path, dmpcpp.duration_factor(path, panda.velocity_limit, acceleration))
    fast = dmpcpp.time_optimal(path, panda.velocity_limit, acceleration)
    page, cells = columns(2, sharey=True)
    for axes, found, title in ((cells[0], even, "evenly"), (cells[1], fast, "time-optimally")):
        uses = np.abs(found.velocity / panda.velocity_limit).max(axis=1)
        pulls = np.abs(found.acceleration / acceleration).max(axis=1)
        axes.plot(found.time, 100 * uses, color=BLUE, label="velocity")
        axes.plot(found.time, 100 * pulls, linestyle=STROKES[1], color=RED, label="acceleration")
        axes.axhline(100.0, color="#333333", linewidth=0.9, linestyle=(0, (6, 2)))
        label(axes, "time [s]", "", f"{title}: {found.time[-1]:.2f} s")
    label(cells[0], "time [s]", "most used of any joint's limit [%]", f"evenly: {even.time[-1]:.2f} s")
    page.legend(*cells[0].get_legend_handles_labels(), loc="outside lower center", ncols=2, frameon=False, fontsize=8.5)
    cells[0].set_ylim(0.0, 112.0)
    return page


def disturbance() -> Any:
    """An iiwa under physics, and what its controller does not know."""
    iiwa = arms.find("iiwa")
    time, joints = _wave(7, 3.0)
    path = dmpcpp.JointTrajectory.through(time, joints * [1, 1, 1, 0.6, 1, 0.4, 1], iiwa.joint_names)
    worlds = {
        "all known": simulation.Disturbance(),
        "masses off by 20 %": simulation.Disturbance(mass_error=0.2, seed=1),
        "0.5 kg in its hand": simulation.Disturbance(payload=0.5),
        "2 ms old joint states": simulation.Disturbance(sensor_delay=0.002),
    }
    page, (axes,) = columns(1, width=7.0)
    for (name, world), colour, stroke in zip(worlds.items(), (BLUE, RED, GREEN, ORANGE), STROKES, strict=True):
        log = simulation.execute(iiwa, path, disturbance=world)
        off = metrics.position_errors(log.desired_tool_pose[log.motion], log.tool_pose[log.motion])
        every = log.time[log.motion][::10], 1e3 * np.maximum(off, 1e-9)[::10]
        axes.semilogy(*every, color=colour, linestyle=stroke, linewidth=1.3, label=name)
    axes.minorticks_off()
    label(axes, "time [s]", "tool off its path [mm]")
    legend(axes, ncols=2, loc="upper center", bbox_to_anchor=(0.5, 1.22))
    return page
