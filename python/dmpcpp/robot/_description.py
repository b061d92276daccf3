"""The URDF as a physics engine needs it: meshes found and convex, inertias that a rigid body can have.

The same text goes to every engine, so that none repairs (or silently drops) anything in its own way.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations, product
from pathlib import Path

from dmpcpp._core import Arm
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._contact_rules import groups_of
from dmpcpp.robot._convex_pieces import convex_pieces
from dmpcpp.robot._disturbance import Disturbance
from dmpcpp.robot._engine_urdf import written
from dmpcpp.robot._inertia import InertiaRepair, repaired_links
from dmpcpp.robot._link_masses import refuse_massless, repaired, shares_without_mass
from dmpcpp.robot._packages import find_mesh
from dmpcpp.robot._urdf_changes import (
    add_payload,
    freeze,
    normalize_axes,
    remove_bare_frames,
    rename_links,
    scale_masses,
)
from dmpcpp.robot._xml import parsed

_DRAWN = (".obj", ".stl", ".dae")  # by Bullet
_WITH_MOTORS = ("revolute", "continuous", "prismatic")
"""Joints that a motor can hold; no engine here moves a planar one, and a floating one would fall off."""


@dataclass(frozen=True)
class RobotDescription:
    """A URDF prepared for an engine.

    Attributes
    ----------
    text : str
        The URDF.
    repairs : tuple of InertiaRepair
        Of the links that the arm moves: those whose inertia was not physical and was replaced by the nearest one that
        is, and bodies that state none.
    unjudged : tuple of str
        Links that the arm does not move and whose shapes cannot be read: their contacts are not judged.
    aliases : mapping of str to str
        Other names of the links whose own an engine cannot bear.
    rigid_groups : tuple of frozenset of str
        The links of the robot, grouped: the links of a group never move against one another.
    neighbours : frozenset of frozenset of str
        Pairs of links whose groups are joined by one moving joint: their meshes overlap by construction.
    """

    text: str
    repairs: tuple[InertiaRepair, ...]
    unjudged: tuple[str, ...]
    aliases: Mapping[str, str]
    rigid_groups: tuple[frozenset[str], ...]
    neighbours: frozenset[frozenset[str]]

    @property
    def repaired_links(self) -> tuple[str, ...]:
        """Links whose inertia was replaced."""
        return repaired_links(self.repairs)

    def in_engine(self, link: str) -> str:
        """Return the name of a link in the text."""
        return self.aliases.get(link, link)

    def link(self, in_engine: str) -> str:
        """Return the link of that name in the text."""
        return next((link for link, alias in self.aliases.items() if alias == in_engine), in_engine)


def describe(
    arm: Arm,
    folder: Path,
    *,
    visuals: bool = False,
    disturbance: Disturbance | None = None,
    only_the_arm_moves: bool = False,
) -> RobotDescription:
    """Prepare ``arm.urdf`` for a physics engine.

    The URDF's Coulomb friction (xarm6 states 1 Nm for every joint) is left out: no controller here
    compensates for it. State one in the disturbance instead.

    Parameters
    ----------
    arm : Arm
    folder : Path
        Where the convex pieces of the collision meshes are written; the engine needs them while it loads.
    visuals : bool
        Keep what is only drawn; without it loading is several times faster.
    disturbance : Disturbance, optional
        Its masses and its payload are put in.
    only_the_arm_moves : bool
        Fix every other joint (fingers) in the middle of its range. Planar and floating ones are always fixed.

    Raises
    ------
    InvalidArgument
        A mesh cannot be found, a mass is negative, an inertia is not made of finite numbers, nothing beyond a
        joint has a mass, or a joint of the arm follows another.
    """
    robot = parsed(arm.urdf)
    _refuse_folded_joints(robot, arm)
    normalize_axes(robot)
    links = robot.findall("link")
    moved = links_beyond(robot, arm.joint_names[0])
    unstated = shares_without_mass(robot, arm, moved)
    unjudged = tuple(
        link.get("name", "")
        for link in links
        if not _prepared(link, arm.folder, folder, visuals, link.get("name") in moved)
    )
    repairs = tuple(repair for repair in repaired(robot, unstated) if repair.link in moved)
    _change(robot, arm, disturbance or Disturbance())
    refuse_massless(robot, arm.joint_names[-1], links_beyond(robot, arm.joint_names[-1]))
    freeze(robot, arm.joint_names, () if only_the_arm_moves else _WITH_MOTORS)
    remove_bare_frames(robot, (arm.base, arm.tip))
    groups = tuple(dict.fromkeys(groups_of(robot, lambda joint: joint.get("type") == "fixed").values()))
    neighbours, aliases = _neighbours(robot, groups), rename_links(robot)
    return RobotDescription(written(robot), repairs, unjudged, aliases, groups, neighbours)


def links_of(arm: Arm) -> frozenset[str]:
    """Names of all links of the robot that the arm is a part of."""
    return frozenset(link.get("name", "") for link in parsed(arm.urdf).findall("link"))


def links_beyond(robot: ET.Element, joint_name: str) -> frozenset[str]:
    """Names of the links that a joint moves."""
    below: dict[str, list[str]] = {}
    found = []
    for joint in robot.findall("joint"):
        parent, child = _ends(joint)
        below.setdefault(parent, []).append(child)
        found += [child] if joint.get("name") == joint_name else []
    for link in found:
        found += below.get(link, [])
    return frozenset(found)


def _change(robot: ET.Element, arm: Arm, disturbance: Disturbance) -> None:
    if disturbance.mass_error:
        scale_masses(robot, disturbance.mass_factors(link.get("name", "") for link in robot.findall("link")))
    if disturbance.payload:
        add_payload(robot, arm.tip, disturbance.payload, disturbance.payload_offset)


def _refuse_folded_joints(robot: ET.Element, arm: Arm) -> None:
    """A mimic joint between base and tip moves with its master in ``Arm``, but would be held by the engines."""
    above = {_ends(joint)[1]: joint for joint in robot.findall("joint")}
    link = arm.tip
    while link != arm.base and link in above:
        joint = above[link]
        if joint.get("type") != "fixed" and joint.get("name") not in arm.joint_names:
            raise InvalidArgument(
                f"arm: joint '{joint.get('name')}' between '{arm.base}' and '{arm.tip}' mimics another; the physics "
                "engines cannot couple them. Choose a base and a tip without it."
            )
        link = _ends(joint)[0]


def _prepared(link: ET.Element, urdf_folder: str, folder: Path, visuals: bool, is_moved: bool) -> bool:
    """Prepare the shapes of a link; whether they could be: one that the arm does not move may lack a mesh."""
    try:
        _prepare_shapes(link, urdf_folder, folder, visuals)
    except InvalidArgument:
        if is_moved:
            raise
        for shape in (*link.findall("collision"), *link.findall("visual")):
            link.remove(shape)
        return False
    return True


def _prepare_shapes(link: ET.Element, urdf_folder: str, folder: Path, visuals: bool) -> None:
    """Find the meshes, and make those that collide convex."""
    for visual in link.findall("visual"):
        mesh = visual.find("geometry/mesh")
        if not visuals or (mesh is not None and Path(mesh.get("filename", "")).suffix.lower() not in _DRAWN):
            link.remove(visual)
    for mesh in link.iter("mesh"):
        mesh.set("filename", str(find_mesh(mesh.get("filename", ""), urdf_folder, link.get("name", ""))))
    for collision in link.findall("collision"):
        _split_into_convex_pieces(link, collision, folder)


def _split_into_convex_pieces(link: ET.Element, collision: ET.Element, folder: Path) -> None:
    mesh = collision.find("geometry/mesh")
    if mesh is None:
        return
    path = Path(mesh.get("filename", ""))
    try:
        pieces = convex_pieces(path)
    except InvalidArgument as error:
        raise InvalidArgument(f"arm.urdf: link '{link.get('name')}': collision mesh {error}") from None
    if pieces is None:
        raise InvalidArgument(
            f"arm.urdf: link '{link.get('name')}': collision mesh '{path.name}' holds no triangles. "
            "Replace it, or take the <collision> out."
        )
    link.remove(collision)
    for piece in pieces:
        path = folder / f"piece{len(list(folder.iterdir()))}.obj"
        path.write_text(piece, encoding="ascii")
        part = copy.deepcopy(collision)
        part.find("geometry/mesh").set("filename", str(path))  # type: ignore[union-attr]
        link.append(part)


def _neighbours(robot: ET.Element, groups: tuple[frozenset[str], ...]) -> frozenset[frozenset[str]]:
    of_link = {link: group for group in groups for link in group}
    pairs = {frozenset(pair) for group in groups for pair in combinations(group, 2)}
    for joint in robot.findall("joint"):
        parent, child = (of_link[name] for name in _ends(joint))
        pairs |= {frozenset(pair) for pair in product(parent, child)}
    return frozenset(pair for pair in pairs if len(pair) == 2)


def _ends(joint: ET.Element) -> tuple[str, str]:
    parent, child = joint.find("parent"), joint.find("child")
    assert parent is not None and child is not None  # urdfdom has read this text
    return parent.get("link", ""), child.get("link", "")
