"""What a planned path comes near to, in the engine's own geometry and before anything is executed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass

import numpy as np

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.checks import Check
from dmpcpp.robot import links_of
from dmpcpp.sending import RestToRest
from dmpcpp.simulation._default import default_simulator
from dmpcpp.simulation._path_clearance import nearest_along
from dmpcpp.simulation._simulator import Clearance, Contact, Simulator, kind_of

_FAR = 1.0  # m; what is farther away than this is not looked for
_NEAR = {"self": "another link", "floor": "the floor", "object": "an obstacle"}


@dataclass(frozen=True)
class PathTolerances:
    """The least clearance along a planned path [m]: of links to one another, to the floor, to obstacles."""

    self_clearance: float = 0.0
    floor_clearance: float = 0.0
    object_clearance: float = 0.0


def contacts_along(
    arm: Arm,
    position: Array,
    *,
    simulator: Callable[[Arm, float], Simulator] = default_simulator,
) -> list[tuple[int, Contact]]:
    """Contacts of the arm with itself, the floor and obstacles at joints (T, n), no dynamics: (index, contact)."""
    with simulator(arm, 1e-3) as engine:
        return [(k, contact) for k, q in enumerate(position) for contact in engine.contacts_at(q)]


def path_checks(
    arm: Arm,
    joints: JointTrajectory | RestToRest,
    tolerances: PathTolerances | None = None,
    *,
    poses: int = 100,
    simulator: Callable[[Arm, float], Simulator] = default_simulator,
) -> tuple[Check, ...]:
    """Hold the clearances along a planned path against what is asked for.

    Parameters
    ----------
    arm : Arm
    joints : JointTrajectory or RestToRest
        With leads these are looked at, too.
    tolerances : PathTolerances, optional
        By default nothing may overlap.
    poses : int
        How many poses of the path are looked at, evenly spread, the last among them; >= 1. That nothing is nearer than
        the tolerances is proven for the whole path.
    simulator : callable
        As of ``execute``; ``functools.partial(Bullet, obstacles=[Box(...)])`` has something in the way.

    Returns
    -------
    tuple of Check
        ``path_self_clearance``, ``path_floor_clearance`` and, where there are obstacles, also
        ``path_object_clearance``: the least distance [m] (1 if all are farther), where, and between what.
    """
    tolerances = tolerances or PathTolerances()
    samples = np.unique(np.linspace(0, len(joints.time) - 1, poses).round().astype(int))
    links = links_of(arm)
    with simulator(arm, 1e-3) as engine:
        found = [(int(k), c) for k in samples for c in engine.clearances_at(joints.position[k], _FAR)]
        around = engine.obstacles
        close = nearest_along(engine, joints.position, links, max(asdict(tolerances).values()))
    checks = []
    for kind, what in _NEAR.items():
        near = [(float(k), clearance) for k, clearance in found if kind_of(clearance.other, links) == kind]
        near += [(close[kind].sample, close[kind].clearance)] if kind in close else []
        if near or kind != "object" or around:
            checks.append(_check(kind, what, near, joints, getattr(tolerances, f"{kind}_clearance")))
    return tuple(checks)


def _check(
    kind: str, what: str, near: list[tuple[float, Clearance]], joints: JointTrajectory | RestToRest, limit: float
) -> Check:
    name = f"path_{kind}_clearance"
    if not near:
        return Check(name, True, _FAR, limit, "m", None, f"nowhere near {what}")
    k, closest = min(near, key=lambda pair: pair[1].distance)
    origin = joints.origin if isinstance(joints, RestToRest) else joints.time[0]
    time = float(np.interp(k, np.arange(len(joints.time)), joints.time) - origin)
    detail = f"{closest.link} and {closest.other}"
    return Check(name, closest.distance >= limit, closest.distance, limit, "m", time, detail)
