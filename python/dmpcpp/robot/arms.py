"""Arms by name: the URDFs that ship with PyBullet, with the real limits where those hold placeholders."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp import _pybullet_data as _data
from dmpcpp._core import Arm, LimitSource, so3
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, MissingDependency

DEFAULT_ACCELERATION = 10.0
"""Joint acceleration limit [rad/s^2] that is assumed where nobody states one."""


@dataclass(frozen=True)
class KnownArm:
    """An arm that can be found by name.

    Attributes
    ----------
    urdf : str
        Path inside the installed ``pybullet_data`` package.
    base, tip : str
        Links between which the arm stands.
    velocity_limit, effort_limit : tuple of float or None
        [rad/s, Nm] of the real machine; None where the URDF holds them already.
    acceleration_limit, jerk_limit : tuple of float or None
        [rad/s^2, rad/s^3]; None where the maker publishes none.
    source : str
        Where the limits come from.
    """

    urdf: str
    base: str
    tip: str
    velocity_limit: tuple[float, ...] | None
    effort_limit: tuple[float, ...] | None
    acceleration_limit: tuple[float, ...] | None
    source: str
    jerk_limit: tuple[float, ...] | None = None


KNOWN: dict[str, KnownArm] = {
    "panda": KnownArm(
        urdf="franka_panda/panda.urdf",
        base="panda_link0",
        tip="panda_hand",
        velocity_limit=None,
        effort_limit=None,
        acceleration_limit=(15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0),
        jerk_limit=(7500.0, 3750.0, 5000.0, 6250.0, 7500.0, 10000.0, 10000.0),
        source="Franka Emika Panda: Franka Control Interface documentation, 'Robot limits' (libfranka).",
    ),
    "iiwa": KnownArm(
        urdf="kuka_iiwa/model.urdf",
        base="lbr_iiwa_link_0",
        tip="lbr_iiwa_link_7",
        velocity_limit=tuple(math.radians(v) for v in (85, 85, 100, 75, 130, 135, 135)),
        effort_limit=(320.0, 320.0, 176.0, 176.0, 110.0, 40.0, 40.0),
        acceleration_limit=None,
        source="KUKA LBR iiwa 14 R820: brochure 'Sensitive robotics LBR iiwa', axis data, p. 30. The URDF's "
        "links (0.36 m, 0.42 m) are those of the R820; its velocity 10 and effort 300 are placeholders.",
    ),
    "xarm6": KnownArm(
        urdf="xarm/xarm6_robot.urdf",
        base="link_base",
        tip="link6",
        velocity_limit=None,
        effort_limit=None,
        acceleration_limit=None,
        source="UFACTORY xArm 6: the URDF's own limits (180 deg/s).",
    ),
}


def find(name: str) -> Arm:
    """The arm "panda", "iiwa" or "xarm6", with the limits of the real machine (``KNOWN[name].source``).

    Raises
    ------
    InvalidArgument
        No such name; the message lists those that exist.
    MissingDependency
        pybullet_data, which holds the URDFs, is not installed.
    """
    if name not in KNOWN:
        raise InvalidArgument(
            f"arm: '{name}' is not known. Known are {', '.join(KNOWN)}; the path of a .urdf file works too."
        )
    known = KNOWN[name]
    arm = Arm.from_urdf_file(str(_pybullet_data() / known.urdf), base=known.base, tip=known.tip)
    return arm.with_limits(
        velocity=known.velocity_limit,
        effort=known.effort_limit,
        acceleration=known.acceleration_limit,
        jerk=known.jerk_limit,
        source=LimitSource.maker,
    )


def load(
    name_or_path: str | Path, base: str | None = None, tip: str | None = None, *, tool: ArrayLike | None = None
) -> Arm:
    """An arm by name, or from a URDF file.

    Parameters
    ----------
    name_or_path : str or Path
        "panda", "iiwa", "xarm6" or the path of a URDF (anything that ends in .urdf or names a file).
    base, tip : str, optional
        Links between which the arm stands, for a URDF file; chosen unless given (`Arm.choice` says how).
    tool : array_like (3,), (6,) or (4, 4), optional
        The frame that follows the hand, in that of the tip: x, y, z [m], or with roll, pitch and yaw [rad] as a
        URDF's <origin>, or a pose. The tip itself unless given.
    """
    arm = _found(name_or_path, base, tip)
    return arm if tool is None else arm.with_tool(_tool_frame(tool))


def _tool_frame(tool: ArrayLike) -> Array:
    values = np.asarray(tool, dtype=np.float64)
    if values.shape == (4, 4):
        return values
    if values.shape not in ((3,), (6,)):
        raise InvalidArgument(f"tool: shape {values.shape}, expected x, y, z, or with roll, pitch, yaw, or a pose.")
    frame = np.eye(4)
    frame[:3, 3] = values[:3]
    frame[:3, :3] = so3.from_euler(values[3:] if len(values) == 6 else np.zeros(3), "xyz")
    return frame


def _found(name_or_path: str | Path, base: str | None, tip: str | None) -> Arm:
    path = Path(name_or_path)
    if path.suffix.lower() == ".urdf" or path.is_file():
        return Arm.from_urdf_file(str(path), base=base or "", tip=tip or "")
    if base or tip:
        raise InvalidArgument(f"base, tip: '{name_or_path}' has its own; they are for a .urdf file only.")
    return find(str(name_or_path))


def acceleration_limit(arm: Arm) -> Array:
    """Return ``arm.acceleration_limit``, which replaces this function. Deprecated since 0.2."""
    warnings.warn("arms.acceleration_limit(arm) is arm.acceleration_limit now.", DeprecationWarning, stacklevel=2)
    return arm.acceleration_limit


def _pybullet_data() -> Path:
    found = _data.find()
    if found is None:
        raise MissingDependency(
            "pybullet_data, which holds the URDFs of the known arms, is not installed. Run `dmpcpp fetch`, install "
            'PyBullet (pip install "dmpcpp[bullet]"), or give the path of a .urdf file.'
        )
    return found
