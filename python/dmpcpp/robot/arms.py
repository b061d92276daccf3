"""Arms by name, from the packages that carry their descriptions, and arms from files."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp import _pybullet_data as _data
from dmpcpp._core import Arm, LimitSource, so3
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, MissingDependency, within
from dmpcpp.robot import _robot_descriptions
from dmpcpp.robot._body_inertia import with_density as with_density
from dmpcpp.robot._catalogue import CATALOGUE, Listed, Place, key, lookup, nearest
from dmpcpp.robot._makers import MAKERS as MAKERS
from dmpcpp.robot._makers import MakerLimits
from dmpcpp.robot._packages import Packages, with_packages
from dmpcpp.robot._payload import with_payload as with_payload
from dmpcpp.robot._reader import expanded, read_description
from dmpcpp.robot._stated_limits import with_stated as with_stated

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
        Base and tip link of the chain.
    velocity_limit, effort_limit : tuple of float or None
        [rad/s, Nm] of the real machine; None where the URDF holds them already.
    acceleration_limit, jerk_limit : tuple of float or None
        [rad/s^2, rad/s^3]; None where the maker publishes none.
    tool_speed_limit : float or None
        m/s; None where the maker publishes none.
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
    tool_speed_limit: float | None = None


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
        acceleration_limit=MAKERS["xarm6"].acceleration,
        jerk_limit=MAKERS["xarm6"].jerk,
        tool_speed_limit=MAKERS["xarm6"].tool_speed,
        source=f"{MAKERS['xarm6'].source}; the URDF's own efforts.",
    ),
}


def find(name: str, base: str | None = None, tip: str | None = None) -> Arm:
    """An arm by name ("panda", "ur5e", "SO-101", "robot_descriptions:xarm6"), with the limits that its maker publishes.

    Case, dashes and underscores do not count. Its description comes from a package that is installed, or from the cache
    of robot_descriptions; nothing is fetched. `listed` says what there is.

    Raises
    ------
    InvalidArgument
        No such name; the message has the nearest ones and where they come from.
    MissingDependency
        The package that carries its description is not installed.
    """
    known = KNOWN.get(key(name))
    if known is not None:
        return _known_arm(known, base, tip)
    listed = lookup(name)
    if listed is None:
        near = ", ".join(f"{one.name} ({one.places[0].package})" for one in nearest(name))
        raise InvalidArgument(
            f"arm: '{name}' is not known. Nearest are {near}; `dmpcpp arms` lists all, and the path of a .urdf file "
            "works too."
        )
    there = listed.found()
    if there is None:
        ways = ", or ".join(dict.fromkeys(place.command for place in listed.places))
        raise MissingDependency(f"arm: '{name}': its description is not on this machine. Get it: {ways}.")
    default = _listed_arm(listed, *there, listed.base, listed.tip)
    arm = _listed_arm(listed, *there, base or listed.base, tip or listed.tip) if base or tip else default
    return _with_maker_limits(arm, default, listed.maker)


def listed() -> tuple[Listed, ...]:
    """Return the arms that have a name, each with the packages that carry its description."""
    return CATALOGUE


def description_of(name: str) -> str | None:
    """Return the module of robot_descriptions that describes an arm; None where there is none."""
    listed = lookup(name)
    places = listed.places if listed else ()
    named = next((place.path for place in places if place.package == "robot_descriptions"), None)
    return named or _robot_descriptions.module_of(key(name))


def fetch(module: str) -> Path:
    """Clone what a module of robot_descriptions needs into its cache, and return the description's path.

    Raises
    ------
    MissingDependency
        robot_descriptions is not installed, or has no such module.
    """
    return _robot_descriptions.fetch(module)


def load(
    name_or_path: str | Path,
    base: str | None = None,
    tip: str | None = None,
    *,
    tool: ArrayLike | None = None,
    package_path: Sequence[str] = (),
    limits: Mapping[str, Any] | None = None,
) -> Arm:
    """An arm by name, or from a URDF or xacro file.

    Parameters
    ----------
    name_or_path : str or Path
        A name as `find` takes it, or the path of a file.
    base, tip : str, optional
        Base and tip link of the chain; chosen unless given (`Arm.choice` says how).
    tool : array_like (3,), (6,) or (4, 4), optional
        Tool frame relative to the tip link: x, y, z [m], or with roll, pitch and yaw [rad] as a URDF's <origin>, or
        a pose. Default: the tip itself.
    package_path : sequence of str
        Where packages of `package://` paths are: NAME=DIR, or DIR that holds them.
    limits : mapping, optional
        Limits and a payload in place of those of the description or maker: what `with_stated` takes by keyword.

    Raises
    ------
    InvalidArgument
        No such name; not a URDF; or one with which no motion can be planned.
    FileError
        The file cannot be read.
    MissingDependency
        The package that carries the description of a named arm is not installed.
    """
    arm = with_stated(_found(name_or_path, base, tip, package_path), **(limits or {}))
    return arm if tool is None else arm.with_tool(_tool_frame(tool))


def _known_arm(known: KnownArm, base: str | None, tip: str | None) -> Arm:
    path = _pybullet_data() / known.urdf
    default = Arm.from_urdf_file(str(path), base=known.base, tip=known.tip)
    arm = Arm.from_urdf_file(str(path), base=base or known.base, tip=tip or known.tip) if base or tip else default
    limits = MakerLimits(
        known.source,
        known.velocity_limit,
        known.acceleration_limit,
        known.jerk_limit,
        known.effort_limit,
        known.tool_speed_limit,
    )
    return _with_maker_limits(arm, default, limits)


def _listed_arm(listed: Listed, place: Place, path: Path, base: str, tip: str) -> Arm:
    if place.package != "robot_descriptions":
        text = read_description(path)
    else:
        found = _robot_descriptions.cached(place.path)
        assert found is not None  # its path was found just now
        of_xacro = not path.name.endswith(".urdf")
        text = expanded(path, found.packages, found.arguments) if of_xacro else read_description(path)
        text = with_packages(text, Packages(found.packages))
    return _named(f"arm '{listed.name}'", text, base, tip, path.parent)


def _named(what: str, text: str, base: str, tip: str, folder: Path) -> Arm:
    try:
        return Arm.from_urdf(text, base, tip, str(folder.absolute()))
    except InvalidArgument as error:
        raise within(what, error) from None


def _with_maker_limits(arm: Arm, default: Arm, limits: MakerLimits | None) -> Arm:
    """Return the arm with the maker's limits: those of the joints that it has of the default one."""
    if limits is None:
        return arm
    given: dict[str, dict[str, float]] = {}
    for kind in ("velocity", "acceleration", "jerk", "effort"):
        values = getattr(limits, kind)
        if values is not None and len(values) == default.joint_count:
            given[kind] = dict(zip(default.joint_names, values, strict=True))
    own = {kind: getattr(arm, f"{kind}_limit") for kind in given}
    stated: dict[str, Any] = {
        kind: [by_name.get(joint, own[kind][k]) for k, joint in enumerate(arm.joint_names)]
        for kind, by_name in given.items()
    }
    sources = {
        kind: tuple(
            LimitSource.maker if joint in by_name else arm.limit_sources[kind][k]
            for k, joint in enumerate(arm.joint_names)
        )
        for kind, by_name in given.items()
    }
    limited = arm.with_limits(**stated, source=sources) if stated else arm
    return limited if limits.tool_speed is None else limited.with_limits(tool_speed=limits.tool_speed)


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


def _found(name_or_path: str | Path, base: str | None, tip: str | None, package_path: Sequence[str]) -> Arm:
    path = Path(name_or_path)
    if path.suffix.lower() in (".urdf", ".xacro", ".xml") or path.is_file():
        return _named(f"'{path}'", read_description(path, package_path), base or "", tip or "", path.absolute().parent)
    return find(str(name_or_path), base, tip)


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
