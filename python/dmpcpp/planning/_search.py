"""The search for a placement with which an arm can carry out a whole motion, within its joint limits.

Of random placements only a few in a hundred carry a motion of a whole arm. So each candidate starts from a
random configuration of the robot, which shall hold the middle pose of the motion; what the robot cannot
reach anyway is dropped by a look at the positions its tip can take; then single poses are solved, those far
apart first; and only what is left is followed from the first pose to the last. Where none is carried, the
candidates that miss least are changed until one is. The best is improved by small changes, each judged by
one pass along the path from the joints at its first pose.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from scipy.spatial import cKDTree

from dmpcpp import motion
from dmpcpp._core import Arm, InverseKinematics, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._approach import approached, missed_by
from dmpcpp.planning._candidates import about_base, drawn_through, far_apart, middle_of, neighbour
from dmpcpp.planning._clearance import clear_of_itself, require_free_postures
from dmpcpp.planning._joints import Engine
from dmpcpp.planning._placement import EFFORT, Accept, Placement, to_follow
from dmpcpp.planning._shortfall import Shortfall
from dmpcpp.planning._tempo import paced_slowdown
from dmpcpp.recordings import Recording
from dmpcpp.robot import Follow, farthest_reach, following, random_postures
from dmpcpp.simulation import default_simulator

__all__ = ["place", "placed"]

_SCALE = (0.25, 1.0)  # of positions, unless stated
_SMALLEST_SHARE = 0.15  # of the arm's reach, of the size of a motion at the smallest scale that is tried by itself
_FLOOR = 0.15  # m, the lowest height of the tip, unless stated
_FLOOR_SHARE = 0.2  # of the arm's reach, if that is less
_CLOUD = 20_000  # random configurations whose tip positions tell where the arm reaches
_COARSE = 24  # poses that stand for the motion in the first tests
_FOLLOWED = 300  # candidates that are followed from end to end at most
_ENOUGH = 8  # of them carried; no further ones are followed
_MORE = 10  # times as many candidates, if none of the first is carried
_NEAR, _CHANGED = 300, 6  # random candidates if none is carried, and those of them that are changed until one is
_CHANGES = 1000  # small ones of each, at most
_IMPROVEMENTS = 300  # small changes tried on the best one; fewer on a long path:
_IMPROVING_POSES = 100_000  # that are followed meanwhile, about
_IN_FRONT = (1.0, 0.75, 0.5, 0.25)  # shares of the way to the front that are tried
_AS_GOOD = 0.8  # of a placement's worth that a place in front of the arm may cost
_FULL_MARGIN = 0.2  # rad; joint limits further away than this are no worry


def place(
    recording: Recording,
    arm: Arm,
    seed: int = 0,
    *,
    scale: tuple[float, float] | None = None,
    floor: float | None = None,
    candidates: int = 3000,
    accept: Accept | None = None,
    follow: str | Follow | None = None,
    in_front: bool = True,
    tool_tilt: float = np.pi,
) -> Placement:
    """Search a placement of the whole motion in an arm's workspace; the same seed gives the same placement.

    Parameters
    ----------
    recording : Recording
        Its up axis stays up; where it has none, z is taken and the placement's note says so.
    arm : Arm
        Mounted upright: z of its base points up.
    seed : int
        Of the random candidates.
    scale : (float, float), optional
        Smallest and largest scale of positions. Preferred is what lets the tip go fastest, joints away from their
        limits: scale over slowdown. Unless given 0.25 to 1, and where nothing is
        carried so, smaller ones down to where the motion is as large as 15 % of the arm's reach.
    floor : float, optional
        Lowest allowed tip height above the base [m]; leave room for what the tip carries. Not the ground of
        `Surroundings`. Default: 0.15, or a fifth of the arm's reach if less.
    candidates : int
        How many random placements are tried; ten times as many if none of them carries the motion.
    accept : JointTrajectory -> bool, optional
        Called with each complete joint trajectory; False rejects it (e.g. self-collision).
    follow : str, optional
        "pose", "axis", "axis:x", .. or "position": the part of each pose that the arm follows. An arm with fewer
        than six joints needs it.
    in_front : bool
        Turn the placement about the base's z axis to where its middle lies in front of the arm (x of the base), or as
        near to it as joints and contacts let it.
    tool_tilt : float
        How far the tool may be turned in the hand [rad]; any rotation by default, 0 for the axes of the hand.

    Returns
    -------
    Placement
        Every sample of the motion is met by inverse kinematics on one continuous path of the joints.

    Raises
    ------
    InvalidArgument
        A range of scale that is empty; or no candidate carries the whole motion: the message says how much
        of it the best one carries.
    """
    if scale is not None and not 0.0 < scale[0] <= scale[1] < np.inf:
        raise InvalidArgument(f"scale: {scale}, expected (smallest, largest) with 0 < smallest <= largest.")
    if candidates < 1:
        raise InvalidArgument(f"candidates: {candidates}, expected at least 1.")
    if not 0.0 <= tool_tilt < np.inf:
        raise InvalidArgument(f"tool_tilt: {tool_tilt}, expected an angle in rad of at least 0.")
    search = _Search(recording, arm, floor, accept, following(arm, follow), tool_tilt)
    random = np.random.default_rng(seed)
    found, used = [], (0.0, 0.0)
    for used, count in _attempts(scale, search.smallest_scale, candidates):
        found = search.carried(search.promising(random, used, count) if count else search.near(random, used))
        if found:
            break
    if not found:
        raise InvalidArgument(
            f"recording: no placement found with which arm {arm.name!r} carries the whole motion at a scale of "
            f"{used[0]:.2g} to {used[1]:.2g}; {search.shortfall()}"
        )
    best = search.improved(max(found, key=lambda carried: carried.worth), random, used)
    best = search.in_front(best) if in_front else best
    followed = "" if len(search.time) >= len(recording) else f" (followed at {len(search.time)})"
    note = f"carries all {len(recording)} samples{followed}, {best.summary} ({candidates} candidates, seed {seed})"
    return replace(best.placement, note=note)


def _attempts(
    scale: tuple[float, float] | None, smallest: float, count: int
) -> Iterator[tuple[tuple[float, float], int]]:
    """Yield ranges of scale and numbers of candidates: as stated, or the usual range and then smaller ones.

    Without any candidates (0) those that nearly carry the motion are changed until they do.
    """
    usual = scale or _SCALE
    yield usual, count
    if scale is None and smallest < _SCALE[0]:
        yield (smallest, _SCALE[0]), count
        usual = (smallest, _SCALE[1])
    yield usual, 0
    yield usual, _MORE * count


def placed(
    recordings: Sequence[Recording],
    arm: Arm,
    *,
    scale: tuple[float, float] | None = None,
    seed: int = 0,
    engine: Engine = default_simulator,
    follow: str | Follow | None = None,
) -> list[Recording]:
    """Place the first recording in an arm's workspace, clear of the arm itself, and the others by the same placement.

    `engine` is the one in whose geometry that is looked at; `functools.partial(Bullet, floor=None)` has no floor.

    Raises
    ------
    InvalidArgument
        One of them is no motion of a hand (`motion.plausible`), or no placement carries the first.
    MissingDependency
        Neither PyBullet nor MuJoCo, which finds contacts, is installed.
    """
    whole = [motion.plausible(motion.continuous(recording)) for recording in recordings]
    following(arm, follow)
    require_free_postures(arm, engine)
    clear = clear_of_itself(arm, engine)
    placement = place(whole[0], arm, seed, scale=scale, accept=clear, follow=follow)
    return [placement.apply_to(recording) for recording in whole]


@dataclass(frozen=True)
class _Carried:
    """A placement with its start joints that the arm carries from the first pose to the last, and how."""

    placement: Placement
    limit_margin: float  # rad, smallest distance from a joint limit
    slowdown: float  # of the duration, where limits of velocity and acceleration bind

    @property
    def worth(self) -> float:
        """Larger is better: size, damped by joints close to their limits and by the time it takes."""
        margin = min(1.0, 0.05 + self.limit_margin / _FULL_MARGIN)
        return self.placement.scale * margin / max(1.0, self.slowdown)

    @property
    def summary(self) -> str:
        return f"joints at least {np.degrees(self.limit_margin):.1f} deg within their limits"


class _Search:
    """One motion and one arm, and the placements found so far."""

    def __init__(
        self,
        recording: Recording,
        arm: Arm,
        floor: float | None,
        accept: Accept | None,
        follow: Follow,
        tool_tilt: float,
    ) -> None:
        self.recorded = recording.time
        recording = to_follow(recording)
        self.time = recording.time
        self.poses = motion.poses(recording)
        centre = (recording.position.min(axis=0) + recording.position.max(axis=0)) / 2
        self.free = Placement(np.zeros(3), up_axis=recording.up_axis or "z", centre=centre)
        self.coarse = far_apart(recording, middle_of(recording, centre), _COARSE)
        self.arm = arm
        reach = farthest_reach(arm)[1]
        self.floor = min(_FLOOR, _FLOOR_SHARE * reach) if floor is None else floor
        size = float(np.linalg.norm(np.ptp(recording.position, axis=0)))
        self.smallest_scale = _SMALLEST_SHARE * reach / size if np.isfinite(reach) and size > 0.0 else np.inf
        self.accept, self.follow, self.tilt = accept, follow, tool_tilt
        self.solver = InverseKinematics(arm, weight=follow.weight)
        # Poses out of reach would spend all of the default's iterations, and most candidates have some.
        self.quick_solver = InverseKinematics(arm, weight=follow.weight, iteration_limit=150, diagnose=False)
        self.closest: Placement | None = None  # by a look at its positions
        self.most: Shortfall | None = None  # of the placement that carries most

    def promising(self, random: np.random.Generator, scale: tuple[float, float], count: int) -> list[Placement]:
        """Return the largest candidates of which every coarse pose can be solved, the largest first."""
        reach = self._reach(random)
        candidates = list(
            drawn_through(self.poses[self.coarse[0]], self.free, self.arm, random, scale, count, self.tilt)
        )
        shares = [self._share_near(placement, *reach) for placement in candidates]
        self.closest = candidates[int(np.argmax(shares))]
        within = [placement for placement, share in zip(candidates, shares, strict=True) if share == 1.0]
        within.sort(key=lambda placement: -placement.scale)
        able = (placement for placement in within if self._above_floor(placement) and self._solves(placement))
        return list(islice(able, _FOLLOWED))

    def near(self, random: np.random.Generator, scale: tuple[float, float]) -> Iterator[Placement]:
        """Yield placements of which every coarse pose is solved, and most often the path, by changes of others.

        The changes begin at the candidates that miss least, of those whose positions are within reach. Nothing where
        paths could be followed and were not accepted: that is no matter of the wrist.
        """
        if self.most is not None and self.most.share == 1.0:
            return
        middle, reach = self.poses[self.coarse[0]], self._reach(random)
        drawn = drawn_through(middle, self.free, self.arm, random, scale, _NEAR, self.tilt)
        within_reach = [placement for placement in drawn if self._share_near(placement, *reach) == 1.0]
        for placement in sorted(within_reach, key=self._missed)[:_CHANGED]:
            within, missed = approached(placement, self._missed, random, scale, _CHANGES, self.tilt)
            if missed <= 0.0:
                yield approached(within, self._missed_on_the_way, random, scale, _CHANGES, self.tilt)[0]

    def carried(self, promising: Iterable[Placement]) -> list[_Carried]:
        """Follow one after the other until enough are carried from end to end and accepted."""
        found: list[_Carried] = []
        for placement in promising:
            joints = self._followed(placement)
            if joints.report.complete:
                carried = self._carry(placement, joints.position[0], otherwise=joints)
                found += [carried] if carried else []
            if len(found) == _ENOUGH:
                break
        return found

    def improved(self, best: _Carried, random: np.random.Generator, scale: tuple[float, float]) -> _Carried:
        """Return the best after small random changes, growing smaller."""
        for step in np.geomspace(1.0, 0.1, min(_IMPROVEMENTS, 1 + _IMPROVING_POSES // len(self.poses))):
            placement = neighbour(best.placement, random, step, scale, self.tilt)
            nearby = placement.start + random.normal(0.0, 0.2 * step, self.arm.joint_count)
            held = self.solver.solve(placement.apply(self.poses[0]), nearby)
            if held.ok and self._above_floor(placement):
                best = self._carry(placement, held.joints, better_than=best.worth) or best
        return best

    def in_front(self, best: _Carried) -> _Carried:
        """Return it turned about the base's vertical axis to the front, or as far as it is carried about as well."""
        away = -float(np.arctan2(best.placement.position[1], best.placement.position[0]))
        turning = self.arm.jacobian(best.placement.start)[5, 0]  # of the first joint about the vertical: +1 or -1
        for share in _IN_FRONT:
            placement = about_base(best.placement, share * away)
            start = np.array(best.placement.start)
            start[0] = self._within_limits(start[0] + share * away * np.rint(turning))
            held = self.solver.solve(placement.apply(self.poses[0]), start)
            found = self._carry(placement, held.joints, better_than=_AS_GOOD * best.worth) if held.ok else None
            if found:
                return found
        return best

    def _within_limits(self, angle: float) -> float:
        """Return an angle of the first joint, or the same a turn away, within its limits where there is one."""
        lower, upper = self.arm.lower[0], self.arm.upper[0]
        return next((a for a in (angle, angle - 2 * np.pi, angle + 2 * np.pi) if lower <= a <= upper), lower)

    def shortfall(self) -> str:
        """Return what the best placement lacks and what to do about it, for an error."""
        refused = getattr(self.accept, "describe", str)()
        if refused:
            return f"{refused}."
        if self.most is not None and self.most.share == 1.0:
            return "what the joints could follow was not accepted. Try another seed."
        if self.closest is not None:
            self._followed(self.closest)
        return self.most.describe(self.follow) if self.most else "no candidate could be tried."

    def _reach(self, random: np.random.Generator) -> tuple[cKDTree, float]:
        """Return random positions of the tip, and how near to one the arm reaches: twice their usual distance."""
        joints = random_postures(self.arm, _CLOUD, random)
        reached = cKDTree(self.arm.forward_kinematics(joints)[:, :3, 3])
        return reached, 2.0 * float(np.median(reached.query(reached.data[:500], k=2)[0][:, 1]))

    def _share_near(self, placement: Placement, reached: cKDTree, near: float) -> float:
        """Return the share of the coarse positions that the tip can take, a little less if one is too low."""
        position = placement.apply(self.poses[self.coarse])[:, :3, 3]
        share = float(np.mean(reached.query(position)[0] < near))
        return share if position[:, 2].min() >= self.floor else 0.9 * share

    def _above_floor(self, placement: Placement) -> bool:
        return bool(placement.apply(self.poses)[:, 2, 3].min() >= self.floor)

    def _solves(self, placement: Placement) -> bool:
        """Whether each coarse pose can be solved by itself; gives up at the first third with a failure."""
        thirds = np.array_split(placement.apply(self.poses[self.coarse]), 3)
        return all(self.quick_solver.solve_many(third).solved == len(third) for third in thirds)

    def _missed(self, placement: Placement) -> float:
        poses = placement.apply(self.poses[self.coarse])
        return missed_by(self.quick_solver.solve_many(poses), poses, self.floor)

    def _missed_on_the_way(self, placement: Placement) -> float:
        poses = placement.apply(self.poses)
        return missed_by(self._followed(placement).report, poses, self.floor)

    def _followed(self, placement: Placement) -> JointTrajectory:
        """Search joints for the whole path, from any start."""
        poses = placement.apply(self.poses)
        joints = self.solver.follow(poses, times=self.time, **EFFORT)
        if self.most is None or joints.report.solved / len(self.time) > self.most.share:
            self.most = Shortfall.of(joints, poses, self.arm, self._frame)
        return joints

    def _frame(self, k: int) -> str:
        """Return which frame of the recording a pose that is followed is, for an error."""
        frame = int(np.searchsorted(self.recorded, self.time[k], side="right")) - 1
        return f"frame {frame} ({self.time[k]:.4g} s)"

    def _carry(
        self,
        placement: Placement,
        start: Array,
        better_than: float = 0.0,
        otherwise: JointTrajectory | None = None,
    ) -> _Carried | None:
        """Follow the path from `start`, or take the joints given; None unless they carry it better and are accepted."""
        joints = self.solver.follow(placement.apply(self.poses), times=self.time, start=start, thorough=False)
        if otherwise is not None and not joints.report.complete:
            joints = otherwise
        report = joints.report
        placement = replace(placement, start=start)
        slowdown = paced_slowdown(self.arm, joints)
        carried = _Carried(placement, report.limit_margin, slowdown)
        if not report.complete or carried.worth <= better_than:
            return None
        return carried if self.accept is None or self.accept(joints) else None
