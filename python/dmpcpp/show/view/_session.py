"""What the teaching page shows for a choice of goal, time, gains, kernels and start: fast enough to follow a hand."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._core import Arm, InverseKinematics, JointTrajectory, PoseDemonstration, PoseDmp, PoseRun
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning import limit_factor
from dmpcpp.robot import Follow, LimitUse, following

__all__ = ["Choice", "Session", "Shown"]

_SAMPLES = 600  # of the motion that is shown
_LEARNED = 1000  # samples of the model's own motion, from which it is learned again with other gains or kernels


@dataclass(frozen=True, eq=False)
class Choice:
    """What a person has set.

    Attributes
    ----------
    goal, start : (4, 4)
        Poses of the arm's tip in its base frame.
    duration : float
        s
    alpha : float
        Of the transformation system [1], > 0; beta is alpha / 4: critically damped.
    basis_count : int
    """

    goal: Array
    start: Array
    duration: float
    alpha: float
    basis_count: int


@dataclass(frozen=True, eq=False)
class Shown:
    """What came of it.

    Attributes
    ----------
    time, pose : (T,) s, (T, 4, 4)
        The motion.
    joints : JointTrajectory
        Its report lists the poses that are met.
    velocity_share, acceleration_share : (n,)
        The most that each joint uses of its limits; more than 1 is too fast.
    margin : (n,)
        rad; the least that each joint keeps from its limits.
    shortest : float
        s; the shortest time that the limits allow.
    """

    time: Array
    pose: Array
    joints: JointTrajectory
    velocity_share: Array
    acceleration_share: Array
    margin: Array
    shortest: float

    @property
    def feasible(self) -> bool:
        """Whether every pose is met within the limits."""
        within = max(self.velocity_share.max(), self.acceleration_share.max()) <= 1.0 and self.margin.min() >= 0.0
        return bool(self.joints.report.complete and within)


class Session:
    """One person's session with a model and an arm."""

    def __init__(self, model: PoseDmp, arm: Arm, follow: str | Follow | None = None) -> None:
        """Find where the arm stands at the start of the motion as it was demonstrated.

        Raises
        ------
        InvalidArgument
            The model is not one of poses.
        """
        if not isinstance(model, PoseDmp):
            raise InvalidArgument(f"model: a {type(model).__name__}, expected a PoseDmp, such as `dmpcpp fit` writes.")
        self._model, self._arm = model, arm
        self._solver = InverseKinematics(arm, weight=following(arm, follow).weight)
        own = model.rollout(dt=model.duration / _LEARNED)
        self._demonstration = PoseDemonstration(own.time, own.pose)
        self._stand = self._solver.follow(own).position[0]
        self._learned: dict[tuple[float, int], PoseDmp] = {}

    @property
    def demonstrated(self) -> Choice:
        """The model as it was learned."""
        model, options = self._model, self._model.options
        return Choice(model.goal, model.start, model.duration, options.alpha, options.basis_count)

    def update(self, choice: Choice) -> Shown:
        """Return the motion, its joints and how near they come to their limits.

        Raises
        ------
        InvalidArgument
            A number of the choice is out of range, or the motion does not stay finite.
        """
        time, pose = self._motion(self._model_of(choice), choice)
        stand = self._stand
        if not np.array_equal(choice.start, self._model.start):
            stand = self._solver.solve(choice.start, stand).joints
        joints = self._solver.follow(pose, time, start=stand, thorough=False)
        use = LimitUse.of(self._arm, joints.time, joints.position, joints.velocity, joints.acceleration)
        shortest = choice.duration * limit_factor(self._arm, joints)
        return Shown(
            time, pose, joints, use.velocity.max(axis=0), use.acceleration.max(axis=0), use.margin.min(axis=0), shortest
        )

    def _model_of(self, choice: Choice) -> PoseDmp:
        """Return the model, or one with other gains or kernels that has learned the model's own motion."""
        options = self._model.options
        if (choice.alpha, choice.basis_count) == (options.alpha, options.basis_count):
            return self._model
        key = (choice.alpha, choice.basis_count)
        if key not in self._learned:
            options.alpha, options.basis_count, options.beta = choice.alpha, choice.basis_count, None
            self._learned = {key: PoseDmp.fit(self._demonstration, options)}
        return self._learned[key]

    def _motion(self, model: PoseDmp, choice: Choice) -> tuple[Array, Array]:
        if not 0.0 < choice.duration < np.inf:
            raise InvalidArgument(f"duration: {choice.duration}, expected a positive number of seconds.")
        if np.array_equal(choice.start, self._model.start):
            motion = model.rollout(choice.goal, choice.duration, choice.duration / _SAMPLES)
            return motion.time, motion.pose
        run = PoseRun(model)
        run.goal, run.duration = choice.goal, choice.duration
        run.start_from(choice.start, np.zeros(6))
        poses = [run.pose]
        for _ in range(_SAMPLES):
            run.step(choice.duration / _SAMPLES)
            poses.append(run.pose)
        return np.linspace(0.0, choice.duration, _SAMPLES + 1), np.array(poses)
