"""Poses that cannot be met, with the cause known by construction; see benchmarks.kinematics.

- beyond: further from the base than 200,000 random joints without limits come, by a tenth or more;
- limits: reached by joints without limits, and by none within them that 500 restarts find;
- step: reached by joints nearby, but further than the step allows;
- singular: from a singular posture, along the direction that is lost there; the pose itself can be reached.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from dmpcpp import Arm, IkResult, InverseKinematics
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from benchmarks.kinematics_arms import ANGLE_WEIGHT, Array, inside, random_joints

_WEIGHT = np.array([1.0, 1.0, 1.0, ANGLE_WEIGHT, ANGLE_WEIGHT, ANGLE_WEIGHT])
_STEP = 0.1  # rad
_SHORT_STEP = 0.02  # rad


@dataclass(frozen=True)
class Case:
    """A pose, where the search begins, how far it may go, and the status that is right."""

    pose: Array
    seed: Array
    status: str
    step: float = np.inf


def distance(result: IkResult) -> float:
    """What "closest" means, m."""
    return result.position_error + ANGLE_WEIGHT * result.angle_error


def closest_of_restarts(arm: Arm, pose: Array, count: int, random: np.random.Generator) -> float:
    """The distance that `count` descents from random joints come to; 0 if one meets the pose."""
    solver = InverseKinematics(arm, iteration_limit=100, diagnose=False)
    best = np.inf
    for seed in random_joints(arm, random, count):
        result = solver.solve(pose, seed)
        if result.ok:
            return 0.0
        best = min(best, distance(result))
    return best


def has_narrow_joint(arm: Arm) -> bool:
    """Whether any joint is kept from a whole turn: without one, no limit ever blocks a pose."""
    return bool(np.any(arm.upper - arm.lower < 2.0 * np.pi - 1e-3))


def cases(arm: Arm, kind: str, random: np.random.Generator) -> Iterator[Case]:
    """Labelled cases of one kind, without end."""
    make = {"beyond": _beyond, "limits": _limits, "step": _step, "singular": _singular}[kind]
    yield from make(arm, random)


def answer(arm: Arm, case: Case) -> IkResult:
    """What the solver says of a case."""
    return InverseKinematics(arm, max_step=case.step).solve(case.pose, case.seed)


def held(arm: Arm, case: Case, result: IkResult) -> bool:
    """Whether the limits and the step were held."""
    near = bool(np.all(np.abs(result.joints - case.seed) <= case.step + 1e-12))
    return near and bool(inside(arm, result.joints[None])[0])


def _without_limits(arm: Arm) -> Arm:
    half_turn = np.full(arm.joint_count, np.pi)
    return arm.with_limits(lower=-half_turn, upper=half_turn)


def _beyond(arm: Arm, random: np.random.Generator) -> Iterator[Case]:
    everywhere = arm.forward_kinematics(random_joints(_without_limits(arm), random, 200_000))
    reach = np.linalg.norm(everywhere[:, :3, 3], axis=1).max()
    while True:
        joints, seed = random_joints(arm, random, 2)
        pose = arm.forward_kinematics(joints)
        direction = random.normal(size=3)
        pose[:3, 3] = reach * random.uniform(1.1, 2.0) * direction / np.linalg.norm(direction)
        yield Case(pose, seed, "out_of_reach")


def _limits(arm: Arm, random: np.random.Generator) -> Iterator[Case]:
    free, quick = _without_limits(arm), InverseKinematics(arm, diagnose=False)
    while True:
        pose = arm.forward_kinematics(random_joints(free, random, 1)[0])
        if not quick.solve(pose).ok and closest_of_restarts(arm, pose, 500, random) > 0.0:
            yield Case(pose, random_joints(arm, random, 1)[0], "limit_blocked")


def _step(arm: Arm, random: np.random.Generator) -> Iterator[Case]:
    while True:
        seed = random_joints(arm, random, 1)[0]
        away = seed + random.uniform(-1.0, 1.0, arm.joint_count)
        case = Case(arm.forward_kinematics(np.clip(away, arm.lower, arm.upper)), seed, "step_limited", _STEP)
        if not answer(arm, case).ok:
            yield case


def _singular(arm: Arm, random: np.random.Generator) -> Iterator[Case]:
    def least(q: Array) -> float:
        return float(np.linalg.svd(_WEIGHT[:, None] * arm.jacobian(q), compute_uv=False)[5])

    options = {"maxiter": 3000, "xatol": 1e-7, "fatol": 1e-9}
    while True:
        found = minimize(least, random_joints(arm, random, 1)[0], method="Nelder-Mead", options=options).x
        seed = np.clip(found, arm.lower, arm.upper)
        if least(seed) > 2e-4:
            continue
        lost = np.linalg.svd(_WEIGHT[:, None] * arm.jacobian(seed))[0][:, 5] / _WEIGHT
        way = 0.03 * random.choice([-1.0, 1.0]) * lost * np.minimum(1.0, _WEIGHT * 10.0)
        pose = arm.forward_kinematics(seed)
        pose[:3, 3] += way[:3]
        pose[:3, :3] = Rotation.from_rotvec(way[3:]).as_matrix() @ pose[:3, :3]
        case = Case(pose, seed, "singular", _SHORT_STEP)
        if InverseKinematics(arm, diagnose=False).solve(pose, seed).ok and not answer(arm, case).ok:
            yield case
