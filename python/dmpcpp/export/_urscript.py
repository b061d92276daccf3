"""URScript for arms of Universal Robots: the joints at even steps, one servoj a step."""

from __future__ import annotations

import re
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from dmpcpp._atomic import write_text
from dmpcpp._text import read_text
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.export._checks import checked, finite
from dmpcpp.sending import APPROACH_SHARE, JointMotion

if TYPE_CHECKING:
    from dmpcpp import Arm

__all__ = ["read_urscript", "write_urscript"]

_SPEED = 0.3  # rad/s, of the way to the first joints at most
_JOINTS = 6  # of every arm that understands it


def write_urscript(
    path: str | PathLike[str],
    trajectory: JointMotion,
    arm: Arm | None = None,
    *,
    period: float = 0.008,
    lookahead: float = 0.1,
    gain: float = 300.0,
    name: str = "dmpcpp_motion",
) -> None:
    """Write a URScript function that moves (movej) to the first joints and then follows the trajectory by servoj.

    Between samples joints are taken from the cubic through positions and velocities; the last ones are held by stopj.

    Parameters
    ----------
    path : path
    trajectory : JointTrajectory
        Of six joints, rad, in the order base, shoulder, elbow, wrist 1 to 3.
    arm : Arm, optional
        Whose limits it must hold.
    period : float
        s, one command each: 0.002 (e-Series, at 500 Hz) to 0.008 (CB3, at 125 Hz) and multiples.
    lookahead : float
        s, 0.03 to 0.2; smooths the motion.
    gain : float
        100 to 2000; how stiffly joints are followed.
    name : str
        Of the function.

    Raises
    ------
    InvalidArgument
        What `checked` refuses, a number of joints other than six, a parameter outside its range.
    FileError
        The file cannot be written; an older one is untouched.
    """
    samples = checked(trajectory, arm)
    _six(samples.joint_names)
    if len(samples.time) < 2:
        raise InvalidArgument("time: 1 sample, expected at least 2.")
    for what, value, low, high in (
        ("period", period, 0.002, 0.1),
        ("lookahead", lookahead, 0.03, 0.2),
        ("gain", gain, 100.0, 2000.0),
    ):
        if not low <= value <= high:
            raise InvalidArgument(f"{what}: {value}, expected {low:g} to {high:g}.")
    if not re.fullmatch(r"[A-Za-z_]\w*", name):
        raise InvalidArgument(f"name: {name!r}, expected letters, digits and underscores.")
    duration = samples.time[-1] - samples.time[0]
    at = samples.time[0] + np.minimum(np.arange(int(np.ceil(duration / period - 1e-9)) + 1) * period, duration)
    joints = CubicHermiteSpline(samples.time, samples.position, samples.velocity)(at)
    speed = _SPEED if arm is None else min(_SPEED, APPROACH_SHARE * float(np.min(arm.velocity_limit)))
    write_text(path, _script(joints, period, lookahead, gain, name, speed))


def understands_urscript(arm: Arm) -> None:
    """Refuse an arm that does not have six joints."""
    _six(arm.joint_names)


def read_urscript(path: str | PathLike[str]) -> tuple[float, Array]:
    """Read the period [s] and the joints (T, 6) [rad] of a script that `write_urscript` wrote.

    Raises
    ------
    FileError
        The file cannot be read.
    InvalidArgument
        There are not servoj commands of one period in it.
    """
    path = Path(path)
    command = re.compile(r"^  servoj\(\[([^\]]*)\], 0, 0, ([^,]+), [^,]+, [^,]+\)$", re.MULTILINE)
    found = command.findall(read_text(path))
    try:
        joints = np.array([[float(cell) for cell in row.split(",")] for row, _ in found])
        periods = {float(period) for _, period in found}
    except ValueError:
        raise InvalidArgument(f"{path.name}: a servoj command without numbers.") from None
    if len(periods) != 1:
        raise InvalidArgument(f"{path.name}: {len(periods)} different periods of servoj, expected one.")
    return periods.pop(), finite("servoj", joints, (len(found), _JOINTS))


def _six(joint_names: Sequence[str]) -> None:
    if len(joint_names) != _JOINTS:
        raise InvalidArgument(f"joint_names: {len(joint_names)} joints, expected 6 for URScript.")


def _script(joints: Array, period: float, lookahead: float, gain: float, name: str, speed: float) -> str:
    lines = [
        f"# First the robot goes straight in joint space, at {speed:.3g} rad/s, from where it stands to the first",
        f"# joints: keep that way free. Joints in rad, one command each {period:g} s.",
        f"def {name}():",
        f"  movej({_list(joints[0])}, 0.5, {speed:.3g})",
    ]
    tail = f"0, 0, {period!r}, {lookahead!r}, {gain!r}"
    lines += [f"  servoj({_list(row)}, {tail})" for row in joints]
    return "\n".join([*lines, "  stopj(2.0)", "end", f"{name}()"]) + "\n"


def _list(row: Array) -> str:
    return "[" + ", ".join(map(repr, row.tolist())) + "]"
