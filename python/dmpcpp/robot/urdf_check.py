"""Lists every defect of a URDF that affects loading, planning or physics, not only the first."""

from __future__ import annotations

import math
import tempfile
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp._core import Arm
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._description import describe
from dmpcpp.robot._dimensions import dimension_doubts
from dmpcpp.robot._gravity import overloads, random_postures
from dmpcpp.robot._inertia import is_physical, moment_change, nearest_physical
from dmpcpp.robot._packages import find_mesh
from dmpcpp.robot._plausible_limits import limit_doubts
from dmpcpp.robot._reader import read_description

__all__ = ["Defect", "UrdfReport", "check"]

_MOVING = ("revolute", "continuous", "prismatic")
_KINDS = (*_MOVING, "fixed", "floating", "planar")
_COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


@dataclass(frozen=True)
class Defect:
    """Something wrong: `where` (link, joint or file), `what`, what `to_do`, and whether work can go on with it."""

    where: str
    what: str
    to_do: str
    fatal: bool


@dataclass(frozen=True)
class UrdfReport:
    """What was found in a URDF.

    Attributes
    ----------
    path : str
    defects : tuple of Defect
        The fatal ones first.
    arm : Arm or None
        None where it cannot be loaded.
    """

    path: str
    defects: tuple[Defect, ...]
    arm: Arm | None

    @property
    def ok(self) -> bool:
        """Whether there is no defect at all."""
        return not self.defects

    def summary(self) -> dict[str, Any]:
        """Return what `dmpcpp check-urdf --json` prints."""
        found: dict[str, Any] = {
            "path": self.path,
            "ok": self.ok,
            "defects": [asdict(defect) for defect in self.defects],
        }
        if self.arm is not None:
            arm = self.arm
            found["arm"] = {"name": arm.name, "base": arm.base, "tip": arm.tip, "joints": list(arm.joint_names)}
        return found


def check(path: str | PathLike[str], base: str = "", tip: str = "", package_path: Sequence[str] = ()) -> UrdfReport:
    """Look for defects: of the XML, the tree of links, joints and limits, masses, meshes, and by loading it.

    The file is read as a run reads it. What keeps a run from its arm is fatal; what a run survives is not.

    Parameters
    ----------
    path : path
    base, tip : str
        Links between which the arm stands; chosen unless given.
    package_path : sequence of str
        Where packages are, as `arms.load` takes it.

    Raises
    ------
    FileError
        The file cannot be read.
    """
    path = Path(path)
    try:
        text = read_description(path, package_path)
    except InvalidArgument as error:
        what, _, to_do = str(error).removeprefix(f"'{path}': ").partition("; ")
        return UrdfReport(
            str(path), (Defect(str(path), what, f"{to_do or 'Give a URDF'}".rstrip(".") + ".", True),), None
        )
    try:
        robot = ET.fromstring(text)
    except ET.ParseError as error:
        return UrdfReport(
            str(path), (Defect(str(path), f"not XML: {error}", "Fix the file at that place.", True),), None
        )
    found = [defect for look in _LOOKS for defect in look(robot, path.absolute().parent)]
    arm, of_loading = _loaded(text, path, base, tip)
    if arm is not None and not any(defect.fatal for defect in of_loading):
        found = [replace(defect, fatal=False) for defect in found]  # a run survives it: it is beside the arm
    found += [defect for defect in of_loading if not any(_covers(other, defect) for other in found)]
    return UrdfReport(str(path), tuple(sorted(found, key=lambda defect: not defect.fatal)), arm)


def _covers(known: Defect, loading: Defect) -> bool:
    """Whether what loading says of a link or joint is already reported with at least this severity."""
    named = "'" in known.where and f"'{known.where.split(chr(39))[1]}'" in loading.what
    return named and known.fatal >= loading.fatal


def _names(robot: ET.Element, _: Path) -> Iterator[Defect]:
    if robot.tag != "robot":
        yield Defect(
            f"<{robot.tag}>",
            "the outermost element is not <robot>",
            "Give a URDF (a xacro is to be expanded first).",
            True,
        )
    if any("xacro" in str(element.tag) for element in robot.iter()):
        yield Defect("the file", "holds leftovers of xacro", "They are passed over; take them out.", False)
    for kind in ("link", "joint"):
        counted = Counter(element.get("name") for element in robot.findall(kind))
        for name, count in counted.items():
            if not name:
                yield Defect(f"<{kind}>", f"{count} without a name", "Name each.", True)
            elif count > 1:
                yield Defect(
                    f"{kind} '{name}'", f"there are {count} of this name", "Give each a name of its own.", True
                )


def _tree(robot: ET.Element, _: Path) -> Iterator[Defect]:
    links = {str(link.get("name")) for link in robot.findall("link")}
    parents = Counter()
    for joint in robot.findall("joint"):
        for role in ("parent", "child"):
            end = getattr(joint.find(role), "attrib", {}).get("link")
            if end not in links:
                yield Defect(
                    f"joint '{joint.get('name')}'",
                    f"its {role} link '{end}' does not exist",
                    "Name an existing link.",
                    True,
                )
            elif role == "child":
                parents[end] += 1
    for link, count in parents.items():
        if count > 1:
            yield Defect(f"link '{link}'", f"hangs on {count} joints", "A URDF is a tree: leave one.", True)
    roots = sorted(links - set(parents))
    if len(roots) != 1:
        what = f"{len(roots)} links without a parent joint: {', '.join(roots) or 'none, there is a loop'}"
        yield Defect("the tree", what, "Join all links to one root.", True)


def _joints(robot: ET.Element, _: Path) -> Iterator[Defect]:
    for joint in robot.findall("joint"):
        where, kind = f"joint '{joint.get('name')}'", joint.get("type", "")
        if kind not in _KINDS:
            yield Defect(where, f"its type is '{kind}'", f"Give one of {', '.join(_KINDS)}.", True)
        if kind in _MOVING:
            yield from _axis(joint, where)
            yield from _limits(joint, where, kind)
        if joint.find("mimic") is not None:
            yield Defect(
                where,
                "mimics another: the physics cannot couple joints of the arm",
                "Choose base and tip without it.",
                False,
            )


def _axis(joint: ET.Element, where: str) -> Iterator[Defect]:
    text = getattr(joint.find("axis"), "attrib", {}).get("xyz", "1 0 0")
    values = _numbers(text)
    if values is None or len(values) != 3:
        yield Defect(where, f"its axis is '{text}'", "Give three numbers.", True)
    elif not math.isclose(math.dist(values, (0, 0, 0)), 1.0, abs_tol=1e-3):
        zero = not any(values)
        yield Defect(
            where, f"its axis '{text}' has length {math.dist(values, (0, 0, 0)):.3g}", "Give a unit vector.", zero
        )


def _limits(joint: ET.Element, where: str, kind: str) -> Iterator[Defect]:
    limit = joint.find("limit")
    if limit is None:
        yield Defect(where, "has no <limit>", "State lower, upper, velocity and effort.", kind != "continuous")
        return
    values = {}
    for name in ("lower", "upper", "velocity", "effort"):
        found = _numbers(limit.get(name, "0" if name in ("lower", "upper") else "nan"))
        values[name] = found[0] if found and len(found) == 1 else math.nan
        stated = limit.get(name)
        if stated is not None and not math.isfinite(values[name]):
            yield Defect(where, f"its limit {name} is '{stated}'", "Give a finite number.", True)
    if kind != "continuous" and values["lower"] >= values["upper"]:
        yield Defect(where, f"its limits are {values['lower']:g} to {values['upper']:g}", "State lower < upper.", True)
    for name, unit, loss in (
        ("velocity", "rad/s", "no motion can be timed"),
        ("effort", "Nm", "no torque can be checked"),
    ):
        if limit.get(name) is None or values[name] == 0.0:
            yield Defect(
                where,
                f"its limit {name} is {limit.get(name, 'missing')}: {loss}",
                f"State the real one [{unit}].",
                False,
            )
        elif values[name] < 0.0:
            yield Defect(where, f"its limit {name} is {values[name]:g}", "State a positive one.", True)


def _masses(robot: ET.Element, _: Path) -> Iterator[Defect]:
    moved = {
        getattr(joint.find("child"), "attrib", {}).get("link")
        for joint in robot.findall("joint")
        if joint.get("type") in _MOVING
    }
    for link in robot.findall("link"):
        where, inertial = f"link '{link.get('name')}'", link.find("inertial")
        if inertial is None:
            if link.get("name") in moved:
                yield Defect(where, "has no <inertial>: it moves without mass", "State mass and inertia.", False)
            continue
        mass = _numbers(getattr(inertial.find("mass"), "attrib", {}).get("value", "nan"))
        if not mass or not math.isfinite(mass[0]) or mass[0] < 0.0:
            yield Defect(where, "its mass is missing, negative or not a number", "State the mass [kg].", True)
        yield from _inertia(inertial, where, mass[0] if mass else math.nan)


def _inertia(inertial: ET.Element, where: str, mass: float) -> Iterator[Defect]:
    attributes = getattr(inertial.find("inertia"), "attrib", {})
    numbers = [_numbers(attributes.get(name, "0")) for name in _COMPONENTS]
    if any(number is None or len(number) != 1 or not math.isfinite(number[0]) for number in numbers):
        yield Defect(where, "its <inertia> is not made of finite numbers", "Give six numbers [kg m^2].", True)
        return
    xx, xy, xz, yy, yz, zz = (number[0] for number in numbers if number)
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if (mass > 0.0 or inertia.any()) and not is_physical(inertia):
        change = moment_change(inertia, nearest_physical(inertia))
        size = f", which differs by {100.0 * change:.2g} %" if math.isfinite(change) else ""
        yield Defect(
            where,
            f"no rigid body can have its inertia; the physics takes the nearest that one can{size}",
            "Compute it anew from the CAD model.",
            False,
        )


def _meshes(robot: ET.Element, folder: Path) -> Iterator[Defect]:
    for link in robot.findall("link"):
        where = f"link '{link.get('name')}'"
        for role in ("visual", "collision"):
            for mesh in link.iterfind(f"{role}/geometry/mesh"):
                name = mesh.get("filename", "")
                try:
                    find_mesh(name, str(folder))
                except InvalidArgument:
                    yield Defect(
                        where,
                        f"its {role} mesh '{name}' is not there",
                        "Put it beside the URDF, or fix the path.",
                        role == "collision",
                    )
                    continue
    if not any(link.find("collision") is not None for link in robot.findall("link")):
        yield Defect(
            "the robot", "no link has a <collision>: no contact can be found", "Give shapes to collide with.", False
        )


def _loaded(text: str, path: Path, base: str, tip: str) -> tuple[Arm | None, list[Defect]]:
    """Load the arm, then prepare it for the physics, as a run does."""
    try:
        arm = Arm.from_urdf(text, base, tip, str(path.absolute().parent))
    except InvalidArgument as error:
        return None, [Defect("loading", str(error).rstrip("."), "A run is not possible until it is fixed.", True)]
    found = [
        Defect("loading", warning.rstrip("."), "Fix it, or ignore it deliberately.", False) for warning in arm.warnings
    ]
    found += _implausible(arm)
    try:
        with tempfile.TemporaryDirectory() as folder:
            describe(arm, Path(folder))
    except (InvalidArgument, ValueError) as error:
        found.append(Defect("physics", str(error).rstrip("."), "A run is not possible until it is fixed.", True))
    return arm, found


def _implausible(arm: Arm) -> Iterator[Defect]:
    """What stands in place of real figures: by these no run can be judged."""
    for doubt in limit_doubts(arm):
        if not doubt.missing:  # what is missing is reported of every joint of the robot
            yield Defect(f"joint '{doubt.joint}'", doubt.what, doubt.to_do, False)
    for what, to_do in dimension_doubts(arm):
        yield Defect("the arm", what, to_do, False)
    for overload in overloads(arm, random_postures(arm)):
        what, _, to_do = overload.sentence.removeprefix(f"joint '{overload.joint}': ").partition(". ")
        yield Defect(
            f"joint '{overload.joint}'",
            f"{what} (of 100 postures {100 * overload.share:.0f} cannot be held)",
            to_do,
            False,
        )


def _numbers(text: str) -> list[float] | None:
    try:
        return [float(word) for word in text.split()]
    except ValueError:
        return None


_LOOKS: tuple[Callable[[ET.Element, Path], Iterator[Defect]], ...] = (_names, _tree, _joints, _masses, _meshes)
