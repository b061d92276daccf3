"""The joints that bring the hand around a bottle and lift it: planned, checked against contact and retimed."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product

import numpy as np

from dmpcpp import motion
from dmpcpp._core import Arm, InverseKinematics, JointTrajectory, PoseDmp, so3
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.grasp._reach import laid, resting
from dmpcpp.grasp._task import Bottle, hand_pose
from dmpcpp.grasp._timing import timed_grasp
from dmpcpp.learning import learn
from dmpcpp.recordings import Recording
from dmpcpp.robot import Follow, Surroundings, following
from dmpcpp.simulation import PANDA_HAND, GraspWorld, ParallelGripper

__all__ = ["GraspPlan", "Planner"]

_BACK = 0.12  # m, from the grasp back along the tool's axis: where the reach ends and the straight approach begins
_LIFT = 0.10  # m
_CLEAR_REACH, _CLEAR_APPROACH = 0.010, 0.005  # m between the hand and the bottle; the fingers pass at 10 mm a side
_LOWEST = 0.06  # m, of the tip above the floor
_PITCHES = tuple(math.radians(angle) for angle in (0, 5, 10, 15, 20))  # steeper, the palm meets the bottle's top
_STARTS = ((-0.15, 0.0, 0.23), (-0.2, 0.0, 0.18), (-0.1, 0.0, 0.23), (-0.2, 0.2, 0.13), (-0.2, -0.2, 0.13))
_ROLLS = tuple(math.radians(angle) for angle in (90, 270, 180, 0, 135, 45, 225, 315))
_BRISK = 6.0  # slowdown of the reach that is good enough
_FURTHER = 40  # candidates tried for a brisker way once there is one
_REST = 1.2  # durations of the model after which the goal's pull has brought the hand to rest
_REACH_POSES, _APPROACH_POSES, _LIFT_POSES = 121, 25, 21
_EFFORT = {"starts": 24, "anchors": 3, "thorough": False}  # of the search for joints along one candidate


@dataclass(frozen=True, eq=False)
class GraspPlan:
    """How a bottle is to be grasped.

    Attributes
    ----------
    bottle : Bottle
    model : PoseDmp
        The reach, learned in the robot's frame for a bottle in the middle of the workspace.
    history : tuple of str
        What was done to the recording.
    poses : (T, 4, 4)
        Of the tip: reach, approach and lift.
    joints : JointTrajectory
        Reach, approach, a pause while the fingers close, lift, and the hold, from rest to rest.
    phases : dict of str to float
        When each of PHASES begins [s].
    pitch : float
        rad, by which the hand points below the horizontal.
    clearance : float
        m, least distance from the hand to the bottle on the way to it.
    slowdown : float
        Duration of the reach over that of the recorded one.
    position_error, angle_error : float
        m and rad, the largest of the inverse kinematics.
    around : Surroundings
        Its obstacles are what stands around the bottle.
    """

    bottle: Bottle
    model: PoseDmp
    history: tuple[str, ...]
    poses: Array
    joints: JointTrajectory
    phases: dict[str, float]
    pitch: float
    clearance: float
    slowdown: float
    position_error: float
    angle_error: float
    around: Surroundings = field(default_factory=Surroundings)


@dataclass(frozen=True, eq=False)
class _Candidate:
    model: PoseDmp
    history: tuple[str, ...]
    turned: bool
    pitch: float


class Planner:
    """Plans grasps with one human reach: learned when first needed, then led to every bottle by its goal.

    Parameters
    ----------
    recording : Recording
        The reach; see `longest_reach`.
    arm : Arm
    gripper : ParallelGripper
        At the arm's tip.
    follow : str, optional
        "pose", or "axis:x", "axis:y", "axis:z": the part of the hand's pose that the arm follows.
    surroundings : Surroundings, optional
        Its obstacles stand around the bottle: the arm keeps its margin from them.

    For several threads make several.
    """

    def __init__(
        self,
        recording: Recording,
        arm: Arm,
        gripper: ParallelGripper = PANDA_HAND,
        *,
        follow: str | Follow | None = None,
        surroundings: Surroundings | None = None,
    ) -> None:
        """Bring the reach to rest at both ends."""
        self.recording = resting(motion.continuous(recording))
        self.arm, self.gripper = arm, gripper
        self.around = surroundings or Surroundings()
        followed = following(arm, follow)
        if followed.kind == "position":
            raise InvalidArgument(
                "follow: 'position', expected axis:x, axis:y, axis:z or pose: a hand grasps by its pose."
            )
        self._solver = InverseKinematics(arm, weight=followed.weight)
        self._learned: dict[tuple[object, ...], tuple[PoseDmp, tuple[str, ...]]] = {}

    def plan(self, bottle: Bottle) -> GraspPlan:
        """Plan to grasp a bottle where the robot takes it to be.

        Tried in this order: how the reach is laid (its start, its roll, the hand's half turn), and how far the
        hand points down, the flattest first; the first way that the arm can follow within its joint limits
        and without contact in at most six times the recorded duration is taken, or else the briskest.

        Raises
        ------
        InvalidArgument
            No way was found; the message says what stood in the way most often.
        """
        grips = [grip for grip in product((False, True), _PITCHES) if self._reachable(bottle, *grip)]
        if not grips:
            tried = 2 * len(_PITCHES)
            raise _no_way(bottle, Counter({"the bottle is out of the arm's reach": tried}))
        obstacles: Counter[str] = Counter()
        best: GraspPlan | None = None
        left = math.inf
        stands = (self.arm, 1e-3, self.gripper, bottle.cylinder, bottle.believed_place)
        with GraspWorld(*stands, obstacles=self.around.obstacles) as world:
            for candidate in self._candidates(bottle, grips):
                found = self._attempt(bottle, candidate, world)
                if isinstance(found, str):
                    obstacles[found] += 1
                elif best is None or found.slowdown < best.slowdown:
                    best = found
                left = min(left, _FURTHER) - 1 if best else left
                if best and (best.slowdown <= _BRISK or left <= 0):
                    break
        if best is None:
            raise _no_way(bottle, obstacles)
        return best

    def _reachable(self, bottle: Bottle, turned: bool, pitch: float) -> bool:
        """Whether single poses before, around and above the bottle can be solved at all."""
        return self._solver.solve_many(np.stack(self._stations(bottle, turned, pitch))).solved == 3

    def _candidates(self, bottle: Bottle, grips: list[tuple[bool, float]]) -> Iterator[_Candidate]:
        for start, roll, turned in product(_STARTS, _ROLLS, (False, True)):
            pitches = [pitch for side, pitch in grips if side == turned]
            key = (start, roll, turned, bottle.height, bottle.grasp_height)
            if pitches and key not in self._learned:
                self._learned[key] = self._learn(bottle, np.array(start), roll, turned)
            for pitch in pitches:
                yield _Candidate(*self._learned[key], turned, pitch)

    def _learn(self, bottle: Bottle, start: Array, roll: float, turned: bool) -> tuple[PoseDmp, tuple[str, ...]]:
        """Learn the reach as it is laid towards a bottle of that height in the middle of the workspace."""
        middle = Bottle(height=bottle.height, grasp_height=bottle.grasp_height, cylinder=bottle.cylinder).grasp_point
        goal = hand_pose(middle, 0.0, float(np.median(_PITCHES)), self.gripper.depth + _BACK, turned)
        placed = laid(self.recording, middle + start, goal, roll)
        return learn(motion.demonstration(placed.recording)), placed.recording.history

    def _attempt(self, bottle: Bottle, candidate: _Candidate, world: GraspWorld) -> GraspPlan | str:
        """The plan, or what stands in its way."""
        poses = self._poses(bottle, candidate)
        if poses[:, 2, 3].min() < _LOWEST:
            return "the hand would come too low"
        joints = self._solver.follow(poses, times=np.arange(float(len(poses))), **_EFFORT)
        report = joints.report
        if not report.complete:
            return "the arm cannot follow"
        clearance = _clearance(world, joints.position, self.around.margin)
        if isinstance(clearance, str):
            return clearance
        timed = timed_grasp(self.arm, *_parts(joints.position), _REST * candidate.model.duration)
        if timed is None:
            return "the motors are too weak"
        slowdown = timed.phases["approach"] / (_REST * candidate.model.duration)
        errors = float(np.max(report.position_error)), float(np.max(report.angle_error))
        plain = candidate.model, candidate.history, poses, timed.joints, timed.phases
        return GraspPlan(bottle, *plain, candidate.pitch, clearance, slowdown, *errors, self.around)

    def _poses(self, bottle: Bottle, candidate: _Candidate) -> Array:
        """Of the tip: the model's reach to the new goal, straight on to the bottle, and straight up."""
        before, around, above = self._stations(bottle, candidate.turned, candidate.pitch)
        times = np.linspace(0.0, _REST * candidate.model.duration, _REACH_POSES)
        reach = candidate.model.rollout_at(times, goal=before).pose
        approach, lift = _line(reach[-1], around, _APPROACH_POSES), _line(around, above, _LIFT_POSES)
        return np.concatenate([reach, approach[1:], lift[1:]])

    def _stations(self, bottle: Bottle, turned: bool, pitch: float) -> tuple[Array, Array, Array]:
        """Poses (4, 4) of the tip before the bottle, around it, and where it is held up."""
        point, depth = bottle.grasp_point, self.gripper.depth
        before = hand_pose(point, bottle.yaw, pitch, depth + _BACK, turned)
        around = hand_pose(point, bottle.yaw, pitch, depth, turned)
        above = hand_pose(point + [0.0, 0.0, _LIFT], bottle.yaw, pitch, depth, turned)
        return before, around, above


def _no_way(bottle: Bottle, obstacles: Counter[str]) -> InvalidArgument:
    return InvalidArgument(
        f"bottle: no way to x {bottle.x:g}, y {bottle.y:g} m, yaw {bottle.yaw:g} rad; {obstacles.total()} were "
        f"tried, most often {obstacles.most_common(1)[0][0]}. Move it towards the middle of the workspace, or "
        "turn its yaw."
    )


def _parts(joints: Array) -> tuple[Array, Array, Array]:
    """Reach, approach and lift, each beginning where the one before ends."""
    grasp = _REACH_POSES + _APPROACH_POSES - 1
    return joints[:_REACH_POSES], joints[_REACH_POSES - 1 : grasp], joints[grasp - 1 :]


def _line(start: Array, end: Array, count: int) -> Array:
    """Poses (count, 4, 4) on the straight way, spaced for the smoothest motion from rest to rest.

    The quintic 10 u^3 - 15 u^4 + 6 u^5 (Flash and Hogan, J. Neuroscience 5, 1985).
    """
    u = np.linspace(0.0, 1.0, count)
    share = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
    turn = so3.log(end[:3, :3] @ start[:3, :3].T)  # some arcseconds, where a model came to rest
    poses = np.tile(end, (count, 1, 1))
    poses[:, :3, :3] = [so3.exp(part * turn) @ start[:3, :3] for part in share]
    poses[:, :3, 3] = start[:3, 3] + share[:, None] * (end[:3, 3] - start[:3, 3])
    return poses


def _clearance(world: GraspWorld, path: Array, margin: float) -> float | str:
    """Least distance of the arm to the bottle along joints (T, n) until they grip it, or what it would touch."""
    least = _CLEAR_REACH
    for k, position in enumerate(path):
        lifting = k >= _REACH_POSES + _APPROACH_POSES - 1  # the bottle goes along
        touched = [each for each in world.contacts_at(position) if not (lifting and each.other == world.object_name)]
        if touched:
            return f"{touched[0].link} would touch {touched[0].other}"
        if world.obstacles and (near := world.obstacle_clearance(margin))[0] < margin:
            return f"{near[1]} would come within {1e3 * margin:g} mm of {near[2]}"
        if lifting:
            continue
        needed = _CLEAR_REACH if k < _REACH_POSES - 1 else _CLEAR_APPROACH
        distance, link = world.clearance(_CLEAR_REACH)
        if distance < needed:
            return f"{link} would come within {1e3 * needed:.0f} mm of the bottle"
        least = min(least, distance)
    return least
