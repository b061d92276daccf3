"""Which pairs of links may touch without a word, and how low the floor lies: one answer for every engine.

An arm's joints cannot change how two links stand to each other that none of them lies between: wheels on the floor,
bellows, the other arm. Whether these touch is not the arm's business. Neighbours on a joint overlap by construction.
What else is left out somebody has to state: the caller, or an SRDF beside the URDF (`disable_collisions`).
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import combinations, product
from pathlib import Path
from typing import Any, Literal

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._obstacles import Obstacle, obstacles_in
from dmpcpp.robot._shapes import lowest, poses_at_rest
from dmpcpp.robot._urdf_changes import freeze
from dmpcpp.robot._xml import parsed

__all__ = ["FLOOR", "ContactRules", "Surroundings", "base_in_root", "contact_rules", "floor_height", "groups_of"]

FLOOR = "floor"
"""The name of the ground in contacts."""

OBSTACLE_MARGIN = 0.01
"""m that a planned motion stays away from obstacles."""

Pair = frozenset[str]
_SHOWN = 6  # pairs that are named in a line


@dataclass(frozen=True)
class Surroundings:
    """What an arm may touch, as somebody states it.

    Attributes
    ----------
    floor : float, "auto" or None
        Height of the ground in the frame of the URDF's root, m; None for no ground. "auto": at 0, or below the lowest
        collision shape that the arm does not move, whichever is lower.
    ignored : tuple of (str, str)
        Pairs of links, or a link and "floor", whose contacts are not looked for.
    obstacles : tuple of Obstacle
        What stands around it.
    margin : float
        How far a planned motion stays away from them, m, above 0.
    """

    floor: float | Literal["auto"] | None = "auto"
    ignored: tuple[tuple[str, str], ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    margin: float = OBSTACLE_MARGIN

    def __post_init__(self) -> None:
        """Refuse a margin that is none."""
        if not 0.0 < self.margin < 10.0:
            raise InvalidArgument(f"obstacle_margin: {self.margin:g}, expected a distance in m above 0, to 10.")

    def in_world(self, engine: Callable[..., Any]) -> Callable[..., Any]:
        """Return an engine whose worlds are like this."""
        return partial(engine, floor=self.floor, ignored=self.ignored, obstacles=self.obstacles)

    def notes(self) -> list[str]:
        """Return what is kept clear of, a line or none, and what was taken for what it is."""
        if not self.obstacles:
            return []
        named = ", ".join(f"'{obstacle.name}'" for obstacle in self.obstacles[:_SHOWN])
        more = f" and {len(self.obstacles) - _SHOWN} more" if len(self.obstacles) > _SHOWN else ""
        kept = f"obstacles {named}{more}: the whole arm keeps {1e3 * self.margin:g} mm from them"
        return [kept, *(obstacle.note for obstacle in self.obstacles if obstacle.note)]

    @staticmethod
    def of(values: dict[str, Any] | None) -> Surroundings:
        """Return what `to_dict` wrote."""
        values = values or {}
        ignored = tuple((a, b) for a, b in values.get("ignored", ()))
        obstacles = obstacles_in(values.get("obstacles", ()))
        margin = float(values.get("obstacle_margin", OBSTACLE_MARGIN))
        return Surroundings(values.get("floor", "auto"), ignored, obstacles, margin)

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        known: dict[str, Any] = {"floor": self.floor, "ignored": [list(pair) for pair in self.ignored]}
        if self.obstacles:
            known["obstacles"] = [obstacle.to_dict() for obstacle in self.obstacles]
            known["obstacle_margin"] = self.margin
        return known


@dataclass(frozen=True)
class ContactRules:
    """What is not looked at for contacts.

    Attributes
    ----------
    left_out : frozenset of frozenset of str
        Pairs of links: rigid to each other as far as the arm goes, neighbours on a joint, or stated.
    still : frozenset of str
        Links that the arm does not move: these may stand on the floor.
    off_floor : frozenset of str
        Links whose contact with the floor is left out because that was stated.
    held : tuple of (str, str)
        Pairs with shapes that hang on joints which the arm does not move.
    neighbours : int
        How many pairs with shapes are neighbours on a joint of the arm.
    stated : tuple of (str, str)
        By the caller.
    by_srdf : dict of str to int
        How many pairs each SRDF leaves out.
    """

    left_out: frozenset[Pair]
    still: frozenset[str]
    off_floor: frozenset[str]
    held: tuple[tuple[str, str], ...]
    neighbours: int
    stated: tuple[tuple[str, str], ...]
    by_srdf: dict[str, int]

    def describe(self) -> str:
        """Return one line for reports."""
        parts = [f"{self.neighbours} pair(s) of neighbours on a joint"]
        if self.held:
            more = f" and {len(self.held) - _SHOWN} more" if len(self.held) > _SHOWN else ""
            parts.append(f"{_listed(self.held[:_SHOWN])}{more}, which the arm does not move against each other")
        parts += [f"{count} pair(s) by {name}" for name, count in self.by_srdf.items()]
        if self.stated:
            parts.append(f"{_listed(self.stated)}, as stated")
        return "left out: " + "; ".join(parts)


def contact_rules(arm: Arm, surroundings: Surroundings | None = None) -> ContactRules:
    """Return the rules for an arm.

    Raises
    ------
    InvalidArgument
        A pair to ignore names a link that the robot does not have.
    """
    return _rules(arm.urdf, arm.folder, tuple(arm.joint_names), (surroundings or Surroundings()).ignored)


@lru_cache(maxsize=32)
def _rules(urdf: str, folder: str, joints: tuple[str, ...], ignored: tuple[tuple[str, str], ...]) -> ContactRules:
    robot = parsed(urdf)
    links = {link.get("name", "") for link in robot.findall("link")}
    solid = {link.get("name", "") for link in robot.findall("link") if link.find("collision") is not None}
    fixed, arms = (
        groups_of(robot, lambda j: j.get("type") == "fixed"),
        groups_of(robot, lambda j: j.get("name") not in joints),
    )
    same = _pairs_within(set(arms.values()))
    across = frozenset(
        pair
        for j in robot.findall("joint")
        if j.get("name") in joints
        for pair in _across(*(fixed[e] for e in _ends(j)))
    )
    beside = frozenset(pair for j in robot.findall("joint") for pair in _across(*(fixed[e] for e in _ends(j))))
    srdf = {path.name: pairs for path, pairs in _srdf_pairs(Path(folder), robot.get("name", ""), links)}
    _require_links(ignored, links)
    stated = frozenset(frozenset(pair) for pair in ignored)
    held = sorted(
        tuple(sorted(pair)) for pair in same - beside if pair <= solid and len({fixed[link] for link in pair}) == 2
    )
    return ContactRules(
        left_out=same | across | stated.union(*srdf.values()),
        still=arms[_root(robot, links)],
        off_floor=frozenset(link for pair in stated if FLOOR in pair for link in pair if link != FLOOR),
        held=tuple((a, b) for a, b in held),
        neighbours=sum(pair <= solid for pair in across),
        stated=tuple((a, b) for a, b in ignored),
        by_srdf={name: len(pairs) for name, pairs in srdf.items()},
    )


def base_in_root(arm: Arm) -> Array:
    """Return the pose (4, 4) of the arm's base in the frame of the URDF's root, joints below it at 0."""
    return poses_at_rest(parsed(arm.urdf)).get(arm.base, np.eye(4))


def floor_height(urdf: str, arm: Arm, surroundings: Surroundings | None, still: frozenset[str]) -> float | None:
    """Return how high the floor lies in the root's frame, m, for a described robot; None for no floor."""
    floor = (surroundings or Surroundings()).floor
    if floor != "auto":
        return floor
    robot = copy.deepcopy(parsed(urdf))
    freeze(robot, arm.joint_names)
    return min(0.0, lowest(robot, still))


def groups_of(robot: ET.Element, rigid: Any) -> dict[str, frozenset[str]]:
    """Return the group of each link: merged over the joints that are rigid."""
    group = {link.get("name", ""): frozenset([link.get("name", "")]) for link in robot.findall("link")}
    for joint in robot.findall("joint"):
        if rigid(joint):
            merged = frozenset().union(*(group[name] for name in _ends(joint)))
            group.update(dict.fromkeys(merged, merged))
    return group


def _pairs_within(groups: Iterable[frozenset[str]]) -> frozenset[Pair]:
    return frozenset(frozenset(pair) for group in groups for pair in combinations(group, 2))


def _across(one: frozenset[str], other: frozenset[str]) -> frozenset[Pair]:
    return frozenset(frozenset(pair) for pair in product(one, other) if len(set(pair)) == 2)


def _ends(joint: ET.Element) -> tuple[str, str]:
    ends = tuple(getattr(joint.find(role), "attrib", {}).get("link", "") for role in ("parent", "child"))
    return ends[0], ends[1]


def _root(robot: ET.Element, links: set[str]) -> str:
    children = {_ends(joint)[1] for joint in robot.findall("joint")}
    return next(iter(sorted(links - children)))


def _srdf_pairs(folder: Path, name: str, links: set[str]) -> list[tuple[Path, frozenset[Pair]]]:
    """Return the pairs of every SRDF beside the URDF that is about this robot."""
    found = []
    for path in sorted(folder.glob("*.srdf")) if str(folder) not in ("", ".") else []:
        try:
            srdf = ET.fromstring(path.read_bytes())
        except (OSError, ET.ParseError):
            continue
        pairs = {frozenset((e.get("link1", ""), e.get("link2", ""))) for e in srdf.iterfind("disable_collisions")}
        known = frozenset(pair for pair in pairs if pair <= links and len(pair) == 2)
        if srdf.get("name") == name and known:
            found.append((path, known))
    return found


def _require_links(pairs: Sequence[tuple[str, str]], links: set[str]) -> None:
    for pair in pairs:
        for name in pair:
            if name not in links and name != FLOOR:
                known = ", ".join(sorted(links))
                raise InvalidArgument(f"ignored: no link '{name}' in this URDF, expected 'floor' or one of {known}.")


def _listed(pairs: Iterable[tuple[str, str]]) -> str:
    return "; ".join(f"{a}, {b}" for a, b in pairs)
