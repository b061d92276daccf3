"""Whether joints keep clear of the arm itself and the floor along their whole path; and what always touches."""

from __future__ import annotations

import weakref
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from dmpcpp import simulation
from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import FLOOR, OBSTACLE_MARGIN, ContactRules, links_of, random_postures
from dmpcpp.simulation import Nearest, Simulator, kind_of

__all__ = ["ClearOfItself", "LookedAt", "clear_of_itself", "require_free_postures"]

_POSTURES = 40  # random ones that are looked at for pairs that always touch
_NEARLY_ALL = 0.95
_TIGHT = 5e-3  # m; where a pair is nearer in nearly all of them, it is built so
_SHOWN = 6  # pairs that are named in a line


class ClearOfItself:
    """A test of joints: the arm keeps 2 mm off itself and the floor, and its margin off obstacles, proven for the
    whole path.

    Pairs that are built closer than 5 mm to each other have to keep clear of contact alone.

    Attributes
    ----------
    refused : Counter of (str, str)
        How many of the tested paths each pair stopped.
    tested : int
    """

    def __init__(self, arm: Arm, engine: Callable[..., Simulator], obstacle_margin: float = OBSTACLE_MARGIN) -> None:
        """Nothing is loaded yet."""
        self._beside = obstacle_margin
        self._arm, self._engine, self._links = arm, engine, links_of(arm)
        self._world: Simulator | None = None
        self._tight: frozenset[tuple[str, str]] = frozenset()
        self.refused: Counter[tuple[str, str]] = Counter()
        self.tested = 0

    def __call__(self, joints: JointTrajectory) -> bool:
        """Whether these keep clear."""
        self.tested += 1
        close = self._close(joints.position)
        if close:
            nearest = min(close, key=lambda one: one.margin).clearance
            self.refused[nearest.link, nearest.other] += 1
        return not close

    def keeps_clear(self, position: Array) -> bool:
        """Whether a lead (T, n) keeps clear; not one of the paths that are searched."""
        return not self._close(position)

    def nearest_object(self, position: Array) -> Nearest | None:
        """Return what joints (T, n) come too close to that is no link and not the floor; None of joints that do not."""
        near = (one for one in self._close(position) if kind_of(one.clearance.other, self._links) == "object")
        return min(near, key=lambda one: one.margin, default=None)

    def refusing_objects(self) -> tuple[str, ...]:
        """Return the obstacles for which joints were refused so far, the most frequent first."""
        others = (other for (_, other), _ in self.refused.most_common() if kind_of(other, self._links) == "object")
        return tuple(dict.fromkeys(others))

    def _close(self, position: Array) -> list[Nearest]:
        world = self._open()
        near = simulation.nearest_along(
            world, position, self._links, simulation.CLEAR, tight=self._tight, of_objects=self._beside
        )
        return [one for one in near.values() if one.margin < 0.0]

    def _open(self) -> Simulator:
        """Load the arm at the first path; a search tries hundreds. It is freed with this test."""
        if self._world is None:
            self._world = self._engine(self._arm, 1e-3).__enter__()
            self._tight = _tight_pairs(self._world, self._arm)
            weakref.finalize(self, self._world.__exit__)
        return self._world

    def describe(self) -> str:
        """Return which pairs came closer than 2 mm, and on how many of the paths; "" without any."""
        if not self.refused:
            return ""
        named = ", ".join(f"'{a}' and '{b}' on {n}" for (a, b), n in self.refused.most_common(3))
        return (
            f"{self.refused.total()} of the {self.tested} paths that the joints could follow bring links closer than "
            f"{1e3 * simulation.CLEAR:.0f} mm to each other or to the floor, or too close to an obstacle: {named}. "
            f"{self._advice(self.refused.most_common(1)[0][0])}"
        )

    def _advice(self, pair: tuple[str, str]) -> str:
        if FLOOR in pair:
            return "State the real height of the floor, floor=Z, or floor=None without one"
        if kind_of(pair[1], self._links) == "object":
            return f"Move the obstacle '{pair[1]}', or take a smaller obstacle_margin"
        return f"If their shapes overlap by construction, state ignored=[('{pair[0]}', '{pair[1]}')]"


@dataclass(frozen=True)
class LookedAt:
    """What is looked at for contacts: all pairs but those that the rules leave out, and a floor [m] unless None.

    `unjudged` are links that the arm does not move and whose shapes cannot be read; `at_rest` are the pairs that touch
    with every joint at 0, `tight` those that are built so close that only contact counts.
    """

    rules: ContactRules
    floor: float | None
    unjudged: tuple[str, ...] = ()
    at_rest: tuple[tuple[str, str], ...] = ()
    tight: tuple[tuple[str, str], ...] = ()

    def describe(self) -> str:
        """Return one line for reports."""
        floor = "no floor" if self.floor is None else f"floor at z = {round(self.floor, 3) + 0.0:g} m"
        unread = f"; not judged: contacts of {', '.join(self.unjudged)}, no mesh" if self.unjudged else ""
        return f"{self.rules.describe()}; {floor}{self._close()}{unread}{self._touching()}"

    def _touching(self) -> str:
        """Name what touches at rest: an overlap by construction, if it is one, has to be stated."""
        if not self.at_rest:
            return ""
        return f"; touching with every joint at 0 (if they are built so, ignore them): {_listed(self.at_rest)}"

    def _close(self) -> str:
        """Name what is closer in every posture than a placement keeps otherwise."""
        if not self.tight:
            return ""
        return f"; built within {1e3 * _TIGHT:g} mm of each other, so that only contact counts: {_listed(self.tight)}"

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "floor": self.floor,
            "not_judged": list(self.unjudged),
            "ignored": [list(pair) for pair in self.rules.stated],
            "left_out": self.describe(),
        }


def clear_of_itself(
    arm: Arm, engine: Callable[..., Simulator], obstacle_margin: float = OBSTACLE_MARGIN
) -> ClearOfItself:
    """Return a test of joints: the arm keeps 2 mm off itself and the floor along the whole path, more off obstacles."""
    return ClearOfItself(arm, engine, obstacle_margin)


def require_free_postures(arm: Arm, engine: Callable[..., Simulator], seed: int = 0) -> LookedAt:
    """Refuse an arm of which two links that it moves against each other, or a link and the floor, always touch.

    Looked at are 40 random postures; a search for joints without contacts would end with none. Returned is what is
    looked at for contacts and what is not.

    Raises
    ------
    InvalidArgument
        With the pairs, how often they touch, and what to state.
    """
    found: Counter[tuple[str, str]] = Counter()
    with engine(arm, 1e-3) as world:
        for q in random_postures(arm, _POSTURES, seed):
            found.update({(contact.link, contact.other) for contact in world.contacts_at(q)})
        rest = world.contacts_at(np.clip(np.zeros(arm.joint_count), arm.lower, arm.upper))
        at_rest = tuple((contact.link, contact.other) for contact in rest)
        tight = tuple(sorted(_tight_pairs(world, arm)))
        looked_at = LookedAt(world.contact_rules, world.floor, world.unjudged_links, at_rest, tight)
    always = [(pair, n) for pair, n in found.most_common() if n >= _NEARLY_ALL * _POSTURES]
    if not always:
        return looked_at
    standing = next(((a, b) for (a, b), _ in always if kind_of(b, links_of(arm)) == "object"), None)
    if standing is not None:
        raise InvalidArgument(
            f"obstacle: '{standing[1]}' touches link '{standing[0]}' of {arm.name!r} in (nearly) every posture. Move "
            "it: obstacles are in the frame of the URDF's root."
        )
    named = "; ".join(f"'{a}' and '{b}' in {n} of {_POSTURES}" for (a, b), n in always)
    stated = "ignored=[" + ", ".join(f"('{a}', '{b}')" for (a, b), _ in always) + "]"
    floor = " Or state where the floor is: floor=Z, or floor=None." if any(FLOOR in pair for pair, _ in always) else ""
    raise InvalidArgument(
        f"arm: links of {arm.name!r} touch in (nearly) every posture: {named} random ones. If they are built so, state "
        f"{stated}, or disable_collisions in an .srdf beside the URDF.{floor}"
    )


def _tight_pairs(world: Simulator, arm: Arm) -> frozenset[tuple[str, str]]:
    """Return the pairs that stand close to each other in nearly every posture."""
    found: Counter[tuple[str, str]] = Counter()
    for q in random_postures(arm, _POSTURES):
        found.update({(near.link, near.other) for near in world.clearances_at(q, _TIGHT)})
    return frozenset(pair for pair, n in found.items() if n >= _NEARLY_ALL * _POSTURES)


def _listed(pairs: tuple[tuple[str, str], ...]) -> str:
    more = f" and {len(pairs) - _SHOWN} more" if len(pairs) > _SHOWN else ""
    return "; ".join(f"{a}, {b}" for a, b in pairs[:_SHOWN]) + more
