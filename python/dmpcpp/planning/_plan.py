"""A model, led to a goal in a time, as joints of an arm: no physics but the geometry and the limits.

>>> from dmpcpp import arms, planning
>>> found = planning.plan(model, arms.find("panda"), duration=4.0)        # doctest: +SKIP
>>> found.ok, found.joints.position.shape                                 # doctest: +SKIP
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp import export, sending
from dmpcpp._atomic import write_text
from dmpcpp._core import Arm, JointTrajectory, Motion, PoseDmp, PoseTrajectory, Scaling, Via
from dmpcpp._typing import Array
from dmpcpp.checks import Check, Checked, accepted_names
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._avoidance import Detour, solve_around
from dmpcpp.planning._clearance import LookedAt, clear_of_itself, require_free_postures
from dmpcpp.planning._fit import DEFAULT_TOLERANCE, Fitted, Tolerance
from dmpcpp.planning._joints import Led, solve
from dmpcpp.planning._scaling import ChosenScaling, with_scaling
from dmpcpp.planning._tempo import Tempo, tempo_check
from dmpcpp.robot import (
    POSE,
    Follow,
    LimitUse,
    Obstacle,
    Surroundings,
    assumptions,
    dimension_checks,
    following,
    jerk_check,
    limits_summary,
    require_holdable,
    require_within_reach,
    tool_speed_check,
)
from dmpcpp.sending import RestToRest
from dmpcpp.simulation import Simulator, Tolerances, inverse_kinematics_checks, path_checks

__all__ = ["JointPlan", "at_phases", "plan", "write"]


_NO_ENGINE = "without an engine only the tool's path is kept clear of obstacles, not the whole arm."


@dataclass(frozen=True, eq=False)
class JointPlan(Checked):
    """What an arm would do.

    Attributes
    ----------
    arm : Arm
    motion : PoseTrajectory
        Of the arm's tip in its base frame.
    joints : JointTrajectory
    slowdown : float
        Its duration over the one that was wanted, 1 where the limits allow that.
    checks : tuple of Check
    accepted : tuple of str
        Checks that a person takes although they were not judged.
    contacts : LookedAt or None
        What is looked at for contacts, and what is left out; None where nothing is.
    follow : Follow
        The part of each pose that the arm follows.
    via : tuple of Via
        Poses that the motion passes.
    sent : RestToRest
        The joints with a lead-in and a lead-out: what a robot may get.
    scaling : ChosenScaling or None
        How the model goes to the goal, and why.
    tempo : Tempo or None
        Where it is slower than wanted, and by how much.
    fit : Fitted or None
        How far it is from the learned path; None where it is the learned path.
    obstacles : tuple of Obstacle
        What the motion keeps clear of.
    detour : Detour or None
        How it was led around them.
    """

    arm: Arm
    motion: PoseTrajectory
    joints: JointTrajectory
    sent: RestToRest
    slowdown: float
    checks: tuple[Check, ...]
    accepted: tuple[str, ...] = ()
    contacts: LookedAt | None = None
    follow: Follow = POSE
    via: tuple[Via, ...] = ()
    scaling: ChosenScaling | None = None
    tempo: Tempo | None = None
    fit: Fitted | None = None
    obstacles: tuple[Obstacle, ...] = ()
    detour: Detour | None = None

    def summary(self) -> dict[str, Any]:
        """Return what summary.json holds; m, rad, s."""
        return {
            **self.judged(),
            "arm": self.arm.name,
            "base": self.arm.base,
            "tip": self.arm.tip,
            "follow": str(self.follow),
            "duration": float(self.joints.time[-1]),
            "slowdown": self.slowdown,
            "leads": self.sent.to_dict(),
            "tempo": self.tempo.to_dict(self.arm.joint_names) if self.tempo else None,
            "fitted": self.fit.to_dict() if self.fit else None,
            "contacts": self.contacts.to_dict() if self.contacts else None,
            "samples": len(self.joints.time),
            "goal": self.motion.pose[-1].tolist(),
            "via": [{"phase": via.phase, "pose": np.asarray(via.point).tolist()} for via in self.via],
            "scaling": self.scaling.to_dict() if self.scaling else None,
            "obstacles": [obstacle.to_dict() for obstacle in self.obstacles],
            "detour": self.detour.to_dict() if self.detour else None,
            "limits": limits_summary(self.arm),
            "assumed": list(assumptions(self.arm)),
        }


def plan(
    model: Led,
    arm: Arm,
    *,
    goal: ArrayLike | None = None,
    duration: float | None = None,
    start: ArrayLike | None = None,
    slow_down: bool = True,
    tempo: str = "person",
    slowest: float | None = None,
    surroundings: Surroundings | None = None,
    tolerance: str | Tolerance | tuple[float, float] | None = DEFAULT_TOLERANCE,
    simulator: Callable[..., Simulator] | None = None,
    accept: Iterable[str] = (),
    follow: str | Follow | None = None,
    via: Sequence[Via] = (),
    scaling: str | Scaling = "automatic",
) -> JointPlan:
    """Lead a model to a goal and find the joints for it.

    Parameters
    ----------
    model : PoseDmp, PoseDmpSequence or Cycles
        Of poses of the arm's tip in its base frame.
    arm : Arm
    goal : (4, 4), optional
        The demonstrated one unless given.
    duration : float, optional
        s; the demonstrated one unless given.
    start : (n,), optional
        Current joints [rad, m]; the path must be followed from here. Default: searched.
    slow_down : bool
        Take longer where velocity or acceleration limits ask for it; otherwise a check says so.
    tempo : "person", "uniform" or "fastest"
        How: only where they bind, with a tempo that changes by at most a factor 2 in 0.2 s; evenly; or as fast as they
        allow at every point of the path, from rest to rest.
    slowest : float, optional
        The most that the duration may be of the one that is wanted, a check; unless stated, 10.
    tolerance : Tolerance, (float, float) or str, optional
        How far the tip may be from the learned path [m, rad] where that takes less time; None or "0": the path itself.
        From stated start joints, through via-poses and in cycles the path itself is followed.
    simulator : callable, optional
        Engine for contact checks, e.g. `simulation.default_simulator`. None (default): no collision check; `ok` and
        joints.csv do not cover collisions.
    accept : iterable of str
        Names of checks (`checks.ACCEPTABLE`) that may remain unjudged for lack of a limit; one that is judged and fails
        is never accepted.
    follow : str, optional
        "pose", "axis", "axis:x", .. or "position": the part of each pose that the arm follows. An arm with fewer
        than six joints needs it.
    via : sequence of Via
        Poses (4, 4) that the motion passes, in the order of their phases; see `at_phases` for places alone.
    surroundings : Surroundings, optional
        The floor, pairs that may touch, and obstacles: the motion is led around them (`solve_around`), and the whole
        arm keeps `margin` from them, also on its way from and to rest. Needs `simulator`, an engine to make such a
        world of; without one the whole arm is not judged.
    scaling : str or Scaling
        How the model goes to a new goal; automatic is the scaling that it was learned with.

    Raises
    ------
    InvalidArgument
        Not such a model, or a rhythmic one without `Cycles`; goal or via-point out of reach, unknown name in `accept`,
        too few joints for `follow`, links that always touch, motors that cannot hold the arm, or what
        `PoseDmp.rollout`, `InverseKinematics.follow` and `solve_around` refuse. An unreachable path does not raise:
        `ik_position_residual` or `ik_angle_residual` fails.
    """
    if not isinstance(model, Led):
        raise InvalidArgument(
            f"model: a {type(model).__name__}, expected a PoseDmp: an arm's tip has position and rotation."
        )
    if isinstance(model, PoseDmp) and model.options.motion == Motion.rhythmic:
        raise InvalidArgument("model: a rhythmic one comes to no end, expected planning.Cycles(model, count).")
    accepted = accepted_names(accept)
    followed = following(arm, follow)
    wanted = model.duration if duration is None else duration
    if not 0.0 < wanted < np.inf:
        raise InvalidArgument(f"duration: {wanted}, expected a positive number of seconds.")
    end = np.asarray(model.goal if goal is None else goal, dtype=np.float64)
    if end.shape == (4, 4):  # any other is refused by the rollout
        require_within_reach(end[:3, 3], arm, "goal: the end of the motion")
    for j, passed in enumerate(via):
        if np.shape(passed.point) == (4, 4):
            require_within_reach(np.asarray(passed.point)[:3, 3], arm, f"via[{j}].point")
    model, chosen = with_scaling(model, scaling, goal)
    around = surroundings or Surroundings()
    if simulator is not None and surroundings is not None:
        simulator = around.in_world(simulator)
    looked_at = require_free_postures(arm, simulator) if simulator is not None else None
    clear = clear_of_itself(arm, simulator, around.margin) if simulator is not None else None
    ways = partial(
        solve,
        model,
        arm,
        goal=goal,
        duration=wanted,
        stand=_stand(start, arm),
        accept=clear,
        slow_down=slow_down,
        tempo=tempo,
        tolerance=tolerance,
        follow=followed,
    )
    solution, detour = solve_around(ways, model, arm, around, clear, goal=goal, via=via)
    joints = solution.joints
    require_holdable(arm, joints.position)
    sent = sending.from_rest_to_rest(arm, joints, clear.keeps_clear if clear else None)
    use = LimitUse.of(arm, joints.time, joints.position, joints.velocity, joints.acceleration)
    checks = (
        *inverse_kinematics_checks(joints, Tolerances(), followed),
        *use.checks(),
        *dimension_checks(arm),
        *_stated(arm, joints),
        sending.ready(sending.check(sent, arm)),
        *(solution.fit.checks(followed) if solution.fit else ()),
        *tempo_check(solution.tempo, slowest),
    )
    if simulator is not None:
        checks = (*checks, *path_checks(arm, sent, simulator=simulator))
    elif around.obstacles:
        checks = (*checks, Check.not_judged("path_object_clearance", "m", _NO_ENGINE))
    plain = (
        checks,
        accepted,
        looked_at,
        followed,
        tuple(via),
        chosen,
        solution.tempo,
        solution.fit,
        around.obstacles,
        detour,
    )
    return JointPlan(arm, solution.motion, joints, sent, solution.slowdown, *plain)


def at_phases(model: PoseDmp, points: Iterable[tuple[float, ArrayLike]], goal: ArrayLike | None = None) -> list[Via]:
    """Return via-poses at places (3,) or poses (4, 4) with their phases; at a place the motion keeps its rotation.

    Parameters
    ----------
    model : PoseDmp
    points : iterable of (phase, place)
        In any order.
    goal : array_like (4, 4), optional
        What the motion is led to; the demonstrated one unless given.
    """
    vias = []
    for phase, point in sorted(points, key=lambda one: one[0]):
        place = np.asarray(point, dtype=np.float64)
        if place.shape == (3,) and 0.0 <= phase <= 1.0:  # any other phase is refused by the rollout
            pose = model.rollout_at([phase * model.duration], goal).pose[0].copy()
            pose[:3, 3] = place
            place = pose
        vias.append(Via(phase, place))
    return vias


def _stated(arm: Arm, joints: JointTrajectory) -> Iterator[Check]:
    yield from jerk_check(arm, joints.time, joints.acceleration)
    yield from tool_speed_check(arm, joints.time, joints.position)


def _stand(start: ArrayLike | None, arm: Arm) -> Array | None:
    if start is None:
        return None
    joints = np.asarray(start, dtype=np.float64)
    if joints.shape != (arm.joint_count,):
        raise InvalidArgument(
            f"start: shape {joints.shape}, expected ({arm.joint_count},): {', '.join(arm.joint_names)}."
        )
    return joints


def write(found: JointPlan, folder: str | PathLike[str], formats: Iterable[str] = ()) -> export.Written:
    """Write plan.npz, summary.json and the files for robots, each whole or not at all; the summary comes last.

    Joints.csv, and more by the names in `export.FORMATS`, are what a robot may be sent, from rest to rest: they are
    written of a plan that is ok; what an earlier plan left of them is removed. One that a robot must not get costs
    itself only.

    Returns
    -------
    export.Written
        The names of the files for robots, and why one was refused.

    Raises
    ------
    InvalidArgument
        An unknown format, or one that this arm does not take.
    MissingDependency
        What a format needs is not installed.
    FileError
        The folder or a file cannot be written.
    """
    chosen = export.chosen(formats, found.arm)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").unlink(missing_ok=True)
    export.remove_robot_files(folder)
    export.write_plan(
        folder / "plan.npz",
        found.motion,
        base=found.arm.base,
        tip=found.arm.tip,
        follow=str(found.follow),
        wanted_time=found.tempo.wanted if found.tempo else None,
    )
    sent = export.write_robot_files(folder, found.sent, found.arm, chosen) if found.ok else export.Written()
    write_text(folder / "summary.json", json.dumps(found.summary(), indent=2, allow_nan=False) + "\n")
    return sent
