"""Joints that follow a path within a tolerance, so that the arm's limits ask for less time."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm, JointTrajectory, PoseTrajectory, fit_path, tip_motion
from dmpcpp.checks import Check
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._placement import Accept
from dmpcpp.planning._tempo import RESERVE, held_effort
from dmpcpp.robot import Follow

__all__ = ["DEFAULT_TOLERANCE", "Fitted", "Tolerance", "fitted", "taken_tolerance"]

_UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "deg": np.pi / 180.0, "rad": 1.0}
_LENGTHS, _ANGLES = ("mm", "cm", "m"), ("deg", "rad")
_PART = re.compile(r"([0-9.]+(?:e[-+]?[0-9]+)?)\s*([a-z]+)", re.IGNORECASE)


@dataclass(frozen=True)
class Tolerance:
    """How far joints may lead the tip from the learned path: a maximum, in m and rad, both > 0."""

    position: float = 1e-3
    angle: float = float(np.radians(0.5))

    def __post_init__(self) -> None:
        """Refuse what is no tolerance."""
        for name in ("position", "angle"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise InvalidArgument(
                    f"tolerance: {name} {getattr(self, name)}, expected a number above 0; for the learned path itself "
                    "tolerance 0 (in Python None)."
                )

    def describe(self) -> str:
        """Return "1 mm, 0.5 deg"."""
        return f"{1e3 * self.position:.3g} mm, {np.degrees(self.angle):.3g} deg"


DEFAULT_TOLERANCE = Tolerance()


def taken_tolerance(value: str | Tolerance | tuple[float, float] | None) -> Tolerance | None:
    """Read "1mm,0.5deg", (m, rad) or a Tolerance; "0" and None are none: the learned path itself.

    Raises
    ------
    InvalidArgument
        Another text or numbers that are none.
    """
    if value is None or isinstance(value, Tolerance):
        return value
    if not isinstance(value, str):
        return Tolerance(*value)
    text = value.strip()
    if re.fullmatch(r"0+(\.0*)?", text):
        return None
    parts = [_PART.fullmatch(part.strip()) for part in text.split(",")]
    units = [part[2].lower() if part else "" for part in parts]
    if len(parts) != 2 or units[0] not in _LENGTHS or units[1] not in _ANGLES:
        raise InvalidArgument(
            f"tolerance: {value!r}, expected a length and an angle such as 1mm,0.5deg, or 0 for the learned path "
            "itself."
        )
    length, angle = (float(part[1]) * _UNITS[unit] for part, unit in zip(parts, units, strict=True) if part)
    return Tolerance(length, angle)


@dataclass(frozen=True, eq=False)
class Fitted:
    """Joints fitted to an arm, and how far they lead the tip from the learned path.

    Attributes
    ----------
    joints : JointTrajectory
    motion : PoseTrajectory
        Of the tip, at the samples of the joints.
    tolerance : Tolerance
    position_max, position_rms, angle_max, angle_rms : float
        m and rad, between the samples too.
    before, after : float
        Factor on the duration that the limits ask for, followed exactly and fitted.
    """

    joints: JointTrajectory
    motion: PoseTrajectory
    tolerance: Tolerance
    position_max: float
    position_rms: float
    angle_max: float
    angle_rms: float
    before: float
    after: float

    def checks(self, follow: Follow) -> tuple[Check, ...]:
        """Return the deviation from the learned path, held against the tolerance."""
        far, turned = self.position_max, self.angle_max
        position = Check("fitted_position_max", far <= self.tolerance.position, far, self.tolerance.position, "m")
        if follow.kind == "position":
            return (position,)
        angle = Check("fitted_angle_max", turned <= self.tolerance.angle, turned, self.tolerance.angle, "rad")
        return position, angle

    def describe(self) -> str:
        """Return one line for a history."""
        return (
            f"fitted to the arm: at most {1e3 * self.position_max:.2g} mm and {np.degrees(self.angle_max):.2g} deg "
            f"from the learned path, RMS {1e3 * self.position_rms:.2g} mm and {np.degrees(self.angle_rms):.2g} deg "
            f"(tolerance {self.tolerance.describe()}); the limits ask for {self.after:.2f} x the duration instead of "
            f"{self.before:.2f}"
        )

    def to_dict(self) -> dict[str, float]:
        """For JSON; m and rad."""
        return {
            "tolerance_position": self.tolerance.position,
            "tolerance_angle": self.tolerance.angle,
            "position_max": self.position_max,
            "position_rms": self.position_rms,
            "angle_max": self.angle_max,
            "angle_rms": self.angle_rms,
            "factor_before": self.before,
            "factor_after": self.after,
        }


def fitted(
    arm: Arm,
    motion: PoseTrajectory,
    joints: JointTrajectory,
    tolerance: Tolerance,
    follow: Follow,
    accept: Accept | None,
    torque_share: float | None,
) -> Fitted | None:
    """Return joints near those given for which the limits ask for less time; None where there are none.

    The limits have the reserve of 2 % in them; a motion that needs no slowing down is left alone.
    """
    found = fit_path(
        arm,
        motion.time,
        motion.pose,
        joints.position,
        position_tolerance=tolerance.position,
        angle_tolerance=tolerance.angle,
        weight=follow.weight,
        velocity_limit=arm.velocity_limit / RESERVE,
        acceleration_limit=arm.acceleration_limit / RESERVE**2,
        effort_limit=held_effort(arm, joints.position, torque_share),
        accept=accept,
    )
    if not found.improved:
        return None
    return Fitted(
        found.joints,
        tip_motion(arm, found.joints),
        tolerance,
        found.position_max,
        found.position_rms,
        found.angle_max,
        found.angle_rms,
        found.start_factor,
        found.duration_factor,
    )
