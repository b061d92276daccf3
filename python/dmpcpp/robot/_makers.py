"""Limits that makers publish, with where: what a URDF lacks, or states as a placeholder. Joints from base to tip."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["MAKERS", "MakerLimits"]


@dataclass(frozen=True)
class MakerLimits:
    """Limits of a real machine, joint by joint; None where the maker publishes none or the URDF has them.

    Attributes
    ----------
    source : str
    velocity : tuple of float or None
        rad/s
    acceleration : tuple of float or None
        rad/s^2
    jerk : tuple of float or None
        rad/s^3
    effort : tuple of float or None
        Nm
    tool_speed : float or None
        m/s
    """

    source: str
    velocity: tuple[float, ...] | None = None
    acceleration: tuple[float, ...] | None = None
    jerk: tuple[float, ...] | None = None
    effort: tuple[float, ...] | None = None
    tool_speed: float | None = None


def _deg(*values: float) -> tuple[float, ...]:
    return tuple(math.radians(value) for value in values)


def _ur(name: str, velocity: Sequence[float], effort: Sequence[float]) -> MakerLimits:
    source = f"Universal Robots, technical specification of the {name} and support article 'Max. joint torques'"
    return MakerLimits(source, velocity=_deg(*velocity), effort=tuple(effort))


def _xarm(joints: int) -> MakerLimits:
    return MakerLimits(
        "UFACTORY, xArm user manual, ranges of motion parameters: joint speed 180 deg/s, acceleration 1145 deg/s^2, "
        "jerk 28647 deg/s^3, tool speed 1 m/s",
        velocity=_deg(180) * joints,
        acceleration=_deg(1145) * joints,
        jerk=_deg(28647) * joints,
        tool_speed=1.0,
    )


_FRANKA = "Franka Control Interface documentation, 'Robot and interface specifications'"
_SMALL_UR, _WRISTS = (56.0, 56.0, 28.0, 12.0, 12.0, 12.0), (180, 180, 180, 360, 360, 360)

MAKERS = {
    "panda": MakerLimits(
        f"{_FRANKA}: limits for Franka Emika Robot (FER)",
        velocity=(2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61),
        acceleration=(15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0),
        jerk=(7500.0, 3750.0, 5000.0, 6250.0, 7500.0, 10000.0, 10000.0),
        effort=(87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0),
    ),
    "fr3": MakerLimits(
        f"{_FRANKA}: limits for Franka Research 3 (FR3)",
        velocity=(2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26),
        acceleration=(10.0,) * 7,
        jerk=(5000.0,) * 7,
        effort=(87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0),
    ),
    "iiwa14": MakerLimits(
        "KUKA, brochure 'Sensitive robotics LBR iiwa', axis data of the LBR iiwa 14 R820, p. 30",
        velocity=_deg(85, 85, 100, 75, 130, 135, 135),
        effort=(320.0, 320.0, 176.0, 176.0, 110.0, 40.0, 40.0),
    ),
    "iiwa7": MakerLimits(
        "KUKA, brochure 'Sensitive robotics LBR iiwa', axis data of the LBR iiwa 7 R800, p. 30",
        velocity=_deg(98, 98, 100, 130, 140, 180, 180),
        effort=(176.0, 176.0, 110.0, 110.0, 110.0, 40.0, 40.0),
    ),
    "ur3": _ur("UR3", _WRISTS, _SMALL_UR),
    "ur5": _ur("UR5", (180,) * 6, (150.0, 150.0, 150.0, 28.0, 28.0, 28.0)),
    "ur10": _ur("UR10", (120, 120, 180, 180, 180, 180), (330.0, 330.0, 150.0, 56.0, 56.0, 56.0)),
    "ur3e": _ur("UR3e", _WRISTS, _SMALL_UR),
    "ur5e": _ur("UR5e", (180,) * 6, (150.0, 150.0, 150.0, 28.0, 28.0, 28.0)),
    "ur10e": _ur("UR10e", (120, 120, 180, 180, 180, 180), (330.0, 330.0, 150.0, 56.0, 56.0, 56.0)),
    "ur16e": _ur("UR16e", (120, 120, 180, 180, 180, 180), (330.0, 330.0, 150.0, 56.0, 56.0, 56.0)),
    "xarm5": _xarm(5),
    "xarm6": _xarm(6),
    "xarm7": _xarm(7),
    "rizon4": MakerLimits(
        "Flexiv, specification of the Rizon 4: axis speeds", velocity=_deg(120, 120, 140, 140, 280, 280, 280)
    ),
    "irb120": MakerLimits(
        "ABB, product specification IRB 120 (3HAC035960): maximum axis speeds",
        velocity=_deg(250, 250, 250, 320, 320, 420),
    ),
    "irb140": MakerLimits(
        "ABB, product specification IRB 140 (3HAC041346): maximum axis speeds",
        velocity=_deg(200, 200, 260, 360, 360, 450),
    ),
}
