"""Whether an engine simulates the masses that the description states: what it read against KDL, right after loading."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm
from dmpcpp.robot import links_beyond, parsed, random_postures
from dmpcpp.simulation._simulator import Simulator

_POSTURES = 10


@dataclass(frozen=True)
class DynamicsMismatch:
    """The largest difference of a mass or of a joint's gravity torque.

    Attributes
    ----------
    value : float
        Over the largest mass, or the largest torque, of the arm.
    detail : str
        The link or joint, the engine's figure and the description's.
    """

    value: float = 0.0
    detail: str = ""


def dynamics_mismatch(engine: Simulator, arm: Arm) -> DynamicsMismatch:
    """Compare the masses of the links that the arm moves, and the gravity torques of ten random postures, with KDL's.

    The arm is left at the last posture.
    """
    return max(_of_masses(engine, arm), _of_torques(engine, arm), key=lambda found: found.value)


def _of_masses(engine: Simulator, arm: Arm) -> DynamicsMismatch:
    robot = parsed(arm.urdf)
    found = engine.masses()
    stated = {
        name: float(mass.get("value", 0.0))
        for link in robot.findall("link")
        if (name := link.get("name", "")) in links_beyond(robot, arm.joint_names[0]) & found.keys()
        and (mass := link.find("inertial/mass")) is not None
    }
    largest = max(stated.values(), default=0.0) or 1.0
    off = {name: abs(found[name] - mass) / largest for name, mass in stated.items()}
    worst = max(off, key=lambda name: off[name], default="")
    if not worst:
        return DynamicsMismatch()
    return DynamicsMismatch(off[worst], f"{worst}: {found[worst]:.6g} kg, in the URDF {stated[worst]:.6g}")


def _of_torques(engine: Simulator, arm: Arm) -> DynamicsMismatch:
    postures = random_postures(arm, _POSTURES)
    expected, rest = arm.gravity_effort(postures), np.zeros(arm.joint_count)
    found = np.empty_like(expected)
    for k, posture in enumerate(postures):
        engine.reset(posture, rest)
        found[k] = engine.inverse_dynamics(rest)
    off = np.abs(found - expected) / (float(np.abs(expected).max()) or 1.0)
    off = np.where(np.isfinite(off), off, np.inf)
    k, joint = np.unravel_index(int(np.argmax(off)), off.shape)
    detail = f"{arm.joint_names[joint]}: {found[k, joint]:.6g} Nm against gravity, by KDL {expected[k, joint]:.6g}"
    return DynamicsMismatch(float(off[k, joint]), detail)
