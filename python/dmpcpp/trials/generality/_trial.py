"""One trial: a random motion learned, changed, solved and executed, and the cause where that failed."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from dmpcpp import imitation, metrics, motion
from dmpcpp._core import Arm, InverseKinematics, PoseDmp
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.imitation import Imitation
from dmpcpp.learning import learn
from dmpcpp.planning import clear_of_itself
from dmpcpp.recordings import Recording
from dmpcpp.robot import Surroundings, arms, following, without_dynamics
from dmpcpp.simulation import default_simulator
from dmpcpp.trials.generality._motions import NOISE, drawn_placement, noisy, random_change, random_motion

__all__ = ["Result", "Trial", "attempt"]

_POSITION, _ANGLE = 1e-3, np.radians(0.5)  # m, rad RMSE to the motion without noise; or the noise, if larger
_GOAL_MISS = 1e-3  # m, between the end of the changed motion and its goal
_RATE = 100.0  # Hz of the changed motion
_PLACES = 3  # searched at most


@dataclass(frozen=True)
class Trial:
    """Which trial: motion `index` of `seed` for an arm at a level of NOISE.

    Attributes
    ----------
    arm : str
        Name or URDF, as `arms.load` takes it.
    noise : str
    seed, index : int
    accept : tuple of str
        Checks that may stay unjudged, see `imitation.imitate`.
    choice : mapping
        What `arms.load` takes by keyword, for JSON.
    options : mapping
        `follow`, `dynamics`, `tempo`, `slowest`, `tolerance` and `surroundings` (`Surroundings.to_dict`) of
        `imitation.imitate`. A trial without `tempo` and `tolerance` is of before 0.2: uniform, and not fitted.
    """

    arm: str
    noise: str
    seed: int
    index: int
    accept: tuple[str, ...] = ()
    choice: Mapping[str, Any] = field(default_factory=dict)
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def key(self) -> str:
        """The same for trials that are the same."""
        return json.dumps(asdict(self), sort_keys=True)

    def imitation_options(self) -> dict[str, Any]:
        """Return what `imitation.imitate` takes by keyword."""
        around = Surroundings.of(self.options.get("surroundings"))
        return {"tempo": "uniform", "tolerance": "0", **self.options, "surroundings": around, "accept": self.accept}


@dataclass(frozen=True)
class Result:
    """How a trial went.

    Attributes
    ----------
    trial : Trial
    ok : bool
    cause : str
        What failed; empty if nothing did.
    places : int
        Searched until one passed, each with its own seed; 0 where the place that was drawn did.
    scale : float or None
        Of the positions, as the place that was searched has it; 1 where it was drawn, None if there is no place.
    learned_position, learned_angle : float
        m and rad RMSE of the learned motion to the one without noise.
    goal_miss : float
        m.
    slowdown : float or None
        Duration as executed over that asked for; None, like what follows, if nothing was executed.
    tracked_position, tracked_angle : float or None
        m and rad RMSE of the executed motion.
    seconds : float
        The trial took.
    """

    trial: Trial
    ok: bool
    cause: str
    places: int
    scale: float | None
    learned_position: float
    learned_angle: float
    goal_miss: float
    slowdown: float | None
    tracked_position: float | None
    tracked_angle: float | None
    seconds: float

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)

    @staticmethod
    def from_dict(values: dict[str, Any]) -> Result:
        """From what `to_dict` gave. Raises KeyError or TypeError for anything else."""
        trial = dict(values["trial"])
        return Result(**{**values, "trial": Trial(**{**trial, "accept": tuple(trial.get("accept", ()))})})


def attempt(trial: Trial) -> Result:
    """Learn, change, place, solve and execute; the same trial gives the same result but for the seconds.

    The motion is learned from its noisy samples with the noise found in them taken out, rolled out to another
    goal in another tempo, and carried out by `imitation.imitate`: where it was drawn if the arm can do that,
    else where `retarget.place` puts it, in up to three places until every check holds.
    """
    begun = time.perf_counter()
    random = np.random.default_rng([trial.seed, trial.index])
    clean = random_motion(random)
    change = random_change(random)
    noise = NOISE[trial.noise]
    # Every level has its own noise on the same motion, and every arm the same samples.
    shown = noisy(clean, noise, np.random.default_rng([trial.seed, trial.index, list(NOISE).index(trial.noise)]))
    model = learn(motion.demonstration(shown).smoothed())
    learned = metrics.compare(motion.poses(clean), model.rollout_at(clean.time).pose)
    changed, miss = _changed(model, change.goal, change.tempo)
    cause = _learning_cause(learned, miss, noise.position, noise.angle)
    run: Imitation | None = None
    places = 0
    if not cause:
        run, places, cause = _executed(changed, arms.load(trial.arm, **trial.choice), trial, random)
    return Result(
        trial=trial,
        ok=not cause,
        cause=cause,
        places=places,
        scale=(run.placement.scale if run.placement else 1.0) if run else None,
        learned_position=learned.position_rmse,
        learned_angle=learned.angle_rmse,
        goal_miss=miss,
        slowdown=run.slowdown if run else None,
        tracked_position=run.log.errors.position_rmse if run else None,
        tracked_angle=run.log.errors.angle_rmse if run else None,
        seconds=time.perf_counter() - begun,
    )


def _changed(model: PoseDmp, shift: Array, tempo: float) -> tuple[Recording, float]:
    """The motion to the moved goal in the new tempo, and how far from that goal it ends [m]."""
    goal = model.goal.copy()
    goal[:3, 3] += shift
    duration = tempo * model.duration
    plan = model.rollout_at(np.linspace(0.0, duration, round(duration * _RATE) + 1), goal=goal, duration=duration)
    recording = Recording(plan.time, plan.position, plan.rotation, "hand", "changed random motion", "z")
    return recording, float(np.linalg.norm(plan.position[-1] - goal[:3, 3]))


def _learning_cause(learned: metrics.StageErrors, miss: float, position: float, angle: float) -> str:
    if learned.position_rmse > max(_POSITION, position) or learned.angle_rmse > max(_ANGLE, angle):
        return f"learning: {1e3 * learned.position_rmse:.2f} mm, {np.degrees(learned.angle_rmse):.2f} deg RMSE"
    return f"goal: missed by {1e3 * miss:.2f} mm" if miss > _GOAL_MISS else ""


def _executed(
    changed: Recording, arm: Arm, trial: Trial, random: np.random.Generator
) -> tuple[Imitation | None, int, str]:
    """The last run, how many places were searched, and what failed in the last of them."""
    drawn = drawn_placement(changed, arm, random).apply_to(changed)
    how = trial.imitation_options()
    if _follows(drawn, arm, trial):
        run, cause = _imitated(drawn, arm, place=False, **how)
        if not cause:
            return run, 0, ""
    for place in range(_PLACES):
        run, cause = _imitated(changed, arm, seed=trial.seed + place, **how)
        if run is None or not cause:
            break
    return run, place + 1, cause


def _follows(recording: Recording, arm: Arm, trial: Trial) -> bool:
    """Whether the arm follows it where it is, without touching itself or the floor."""
    around = Surroundings.of(trial.options.get("surroundings"))
    engine = around.in_world(default_simulator)
    solver = InverseKinematics(arm, weight=following(arm, trial.options.get("follow")).weight)
    joints = solver.follow(motion.poses(recording), times=recording.time, thorough=False)
    if trial.options.get("dynamics") == "none":
        arm = without_dynamics(arm)
    return joints.report.complete and clear_of_itself(arm, engine)(joints)


def _imitated(recording: Recording, arm: Arm, **options: Any) -> tuple[Imitation | None, str]:
    """A run, if there is a place for it, and what failed."""
    try:
        run = imitation.imitate(recording, arm, **options)
    except InvalidArgument as error:
        return None, f"placement: {error}"
    return run, _failed(run)


def _failed(run: Imitation) -> str:
    failed = [
        f"{check.name} {check.value:.3g} (limit {check.limit:.3g}) {check.detail}".strip() for check in run.failed
    ]
    return "; ".join([*failed, *(f"not judged: {check.name}: {check.detail}" for check in run.open)])
