"""The whole flow in one call: a recorded motion, placed, learned, solved, slowed to the limits and executed.

>>> from dmpcpp import arms, imitation, recordings
>>> run = imitation.imitate(recordings.clip("dance_b"), arms.find("panda"))   # doctest: +SKIP
>>> run.ok, run.stages["ik_to_executed"].position_rmse                        # doctest: +SKIP

Every stage is a value that can be looked at on its own; each step here is one call into the module that does it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from dmpcpp import metrics, motion, sending, simulation
from dmpcpp._core import Arm, JointTrajectory, PoseDmp, PoseTrajectory
from dmpcpp._engines import default_engine
from dmpcpp.checks import Check, Checked, accepted_names
from dmpcpp.errors import InvalidArgument
from dmpcpp.imitation._calmer import Calmer, calmer
from dmpcpp.learning import Evidence, Lesson, evidence, learn, learnable, reproduction, reproduction_checks, teach
from dmpcpp.metrics import StageErrors
from dmpcpp.motion import Noise
from dmpcpp.planning import (
    DEFAULT_TOLERANCE,
    Cycles,
    Detour,
    Engine,
    Fitted,
    LookedAt,
    Placement,
    Solution,
    Tempo,
    Tolerance,
    clear_of_itself,
    place_among,
    require_free_postures,
    solve,
    solve_around,
    tempo_check,
)
from dmpcpp.planning import place as place_motion
from dmpcpp.recordings import Recording
from dmpcpp.robot import (
    Follow,
    Obstacle,
    Surroundings,
    assumptions,
    following,
    limits_summary,
    require_holdable,
    without_dynamics,
)
from dmpcpp.sending import RestToRest
from dmpcpp.simulation import ExecutionLog, Mode

__all__ = ["STAGES", "Imitation", "PlacementPolicy", "Progress", "clear_of_itself", "imitate"]

Progress = Callable[[str, float], None]
"""Called as progress(stage, share done): a name of STAGES and 0 to 1."""

PlacementPolicy = Callable[..., Placement]
"""Called as policy(recording, arm, accept=...): `retarget.place` is one, and `retarget.anchor_within_reach` with its
anchor bound, `functools.partial(retarget.anchor_within_reach, at=(0.4, 0, 0.5), on="start")`.
"""

_OF_DYNAMICS = ("torque_ratio", "inertia")
STAGES = ("place", "learn", "solve", "execute")


@dataclass(frozen=True, eq=False)
class Imitation(Checked):
    """A motion from recording to execution.

    Attributes
    ----------
    recording : Recording
        As it stands in the robot's base frame; its history says what was done to it.
    placement : Placement or None
        None where the recording was taken as it was.
    model : PoseDmp
    slowdown : float
        Duration of the executed motion over that of the recording.
    plan : PoseTrajectory
        The model's rollout, slowed down; or what was fitted to the arm within the tolerance of it.
    joints : JointTrajectory
    sent : RestToRest
        The joints with a lead-in and a lead-out: what was executed, and what a robot may get.
    log : ExecutionLog
    stages : dict of str to StageErrors
        "demonstration_to_dmp" (at the samples that were measured, equal phase), "dmp_to_ik", "ik_to_executed"; of a
        motion that was fitted to the arm also "recording_to_fitted" and "dmp_to_fitted", "dmp_to_ik" being of the
        fitted poses.
    checks : tuple of Check
    evidence : Evidence
        What the recording shows of noise, as it stands in the robot's base frame, and whether it was taken out.
    second_log : ExecutionLog or None
        The same joints in the second engine, where both were asked for.
    accepted : tuple of str
        Checks that a person takes although they were not judged.
    contacts : LookedAt or None
        What is looked at for contacts, and what is left out.
    calmer : Calmer or None
        What a low-pass would gain, where the motion is much slower than recorded because of what is fast in it.
    tempo : Tempo or None
        Where the motion is slower than the person's, and by how much.
    fit : Fitted or None
        How far the plan is from the learned path; None where it is the learned path.
    obstacles : tuple of Obstacle
        What the motion keeps clear of.
    detour : Detour or None
        How it was led around them.
    """

    recording: Recording
    placement: Placement | None
    model: PoseDmp
    slowdown: float
    plan: PoseTrajectory
    joints: JointTrajectory
    sent: RestToRest
    log: ExecutionLog
    stages: dict[str, StageErrors]
    checks: tuple[Check, ...]
    evidence: Evidence
    second_log: ExecutionLog | None = None
    accepted: tuple[str, ...] = ()
    contacts: LookedAt | None = None
    calmer: Calmer | None = None
    tempo: Tempo | None = None
    fit: Fitted | None = None
    obstacles: tuple[Obstacle, ...] = ()
    detour: Detour | None = None

    @property
    def noise(self) -> Noise:
        """Standard deviation of the noise found along and about one axis; 0 where there is none."""
        return self.evidence.noise

    @property
    def verdict_word(self) -> str:
        """How a person is told; of a recording that is a sketch "verified, approximate"."""
        word = super().verdict_word
        return word.replace("verified", "verified, approximate", 1) if self.ok and self.recording.approximate else word

    @property
    def changed(self) -> tuple[str, ...]:
        """Parts of the arm's description that were replaced or are missing: inertias, with the size of the change."""
        return tuple(simulation.inertia_notes(self.log.inertia_repairs)) if self["inertia"].ok else ()

    def summary(self) -> dict[str, Any]:
        """Return what `summary.json` holds; m and rad."""
        accuracy = self.recording.accuracy
        return {
            **self.judged(),
            "stages": {name: errors.to_dict() for name, errors in self.stages.items()},
            "arm": self.log.arm.name,
            "base": self.log.arm.base,
            "tip": self.log.arm.tip,
            "follow": str(self.log.follow),
            "contacts": self.contacts.to_dict() if self.contacts else None,
            "recording": {
                "source": self.recording.source,
                "body": self.recording.body,
                "samples": len(self.recording),
                "duration": self.recording.duration,
                "noise": {"position": self.noise.position, "angle": self.noise.angle},
                "evidence": self.evidence.to_dict(),
                "history": list(self.recording.history),
                "accuracy": dict(zip(("position", "angle"), accuracy, strict=True)) if accuracy else None,
            },
            "approximate": self.recording.approximate,
            "basis_count": self.model.options.basis_count,
            "regression": self.model.options.regression.name,
            "derivatives": self.model.options.derivatives.name,
            "duration": self.plan.time[-1],
            "slowdown": self.slowdown,
            "leads": self.sent.to_dict(),
            "calmer": self.calmer.to_dict() if self.calmer else None,
            "tempo": self.tempo.to_dict(self.log.arm.joint_names) if self.tempo else None,
            "fitted": self.fit.to_dict() if self.fit else None,
            "simulator": self.log.simulator,
            "second_simulator": self.second_log.simulator if self.second_log else None,
            "mode": self.log.mode,
            "caveat": self.log.caveat,
            "obstacles": [obstacle.to_dict() for obstacle in self.obstacles],
            "detour": self.detour.to_dict() if self.detour else None,
            "limits": limits_summary(self.log.arm),
            "assumed": list(assumptions(self.log.arm)),
            "changed": list(self.changed),
        }


def imitate(
    recording: Recording,
    arm: Arm,
    *,
    seed: int = 0,
    place: bool | PlacementPolicy = True,
    scale: tuple[float, float] | None = None,
    smooth: bool = True,
    keep_rests: bool = False,
    basis_count: int | None = None,
    others: Sequence[Recording] = (),
    simulator: str | None = None,
    accept: Iterable[str] = (),
    dynamics: str = "full",
    surroundings: Surroundings | None = None,
    follow: str | Follow | None = None,
    cycles: int | None = None,
    minimum_period: float = 0.0,
    tempo: str = "person",
    slowest: float | None = None,
    tolerance: str | Tolerance | tuple[float, float] | None = DEFAULT_TOLERANCE,
    progress: Progress | None = None,
) -> Imitation:
    """Carry out a recorded motion on a simulated arm and say how well that went.

    Parameters
    ----------
    recording : Recording
    arm : Arm
    seed : int
        Random seed of the default placement search; unused if `place` is a policy or False.
    place : bool or PlacementPolicy
        Search a placement of the motion in the arm's workspace (`retarget.place`), or by the policy given; if False
        the recorded poses are taken as poses of the arm's tip in its base frame. Bind `follow` to a policy yourself.
    scale : (float, float), optional
        Range of position scales of that search; likewise. Default: that of `retarget.place`.
    smooth : bool
        Whether noise found in the recording may be smoothed out in learning; the recording's history says so.
    keep_rests : bool
        Whether rests before and behind the motion (`motion.rests`) are carried out with it. Durations and the slowdown
        count what is learned.
    basis_count : int, optional
        Kernels of the model; by default as many as the motion needs.
    others : sequence of Recording
        More demonstrations of the same motion, in the same frame: they are placed as the first one and learned with it,
        and no single one of them is then what the model has to reproduce.
    simulator : {"bullet", "mujoco", "both"}, optional
        The physics engine; unless given "bullet", or "mujoco" where that alone is installed. With both, Bullet is
        the one that everything is measured in, MuJoCo executes the same joints, and checks say how far the two are
        apart.
    accept : iterable of str
        Names of checks (`checks.ACCEPTABLE`) that may remain unjudged for lack of a limit; one that is judged and fails
        is never accepted.
    dynamics : {"full", "none"}
        "none" carries the joints out by position, without masses and torques: for arms whose inertias nobody states.
        Torque and inertia are then not judged, which this accepts.
    surroundings : Surroundings, optional
        Where the floor lies, which pairs of links may touch, and obstacles: the motion is placed clear of them, or led
        around them (`planning.solve_around`), and the whole arm keeps `margin` from them, on its way from and to rest,
        too. They are real bodies in the simulation.
    follow : str, optional
        "pose", "axis", "axis:x", .. or "position": the part of each pose that the arm follows. An arm with fewer
        than six joints needs it.
    cycles : int, optional
        The recording is a motion that repeats: one cycle of it is found (`motion.one_cycle`) and learned as a rhythmic
        model, which is carried out so many times, from rest to rest (`planning.Cycles`).
    minimum_period : float
        s, of the cycle that is looked for.
    tempo : "person", "uniform" or "fastest"
        The recorded timing, slower only where the arm's limits bind (the tempo changes by at most a factor 2 in
        0.2 s); slower by one factor; or as fast as the limits allow at every point of the path, from rest to rest.
    slowest : float, optional
        The most that the duration may be of the recorded one, a check; unless stated, 10.
    tolerance : Tolerance, (float, float) or str, optional
        How far the tip may be from the learned path [m, rad] where the arm's limits then ask for less time: a maximum,
        "1mm,0.5deg" for instance. None or "0": the learned path itself.
    progress : callable, optional
        See `Progress`.

    Raises
    ------
    InvalidArgument
        The recording cannot be learned or is no motion of a hand (`motion.plausible`), no placement carries it, the
        arm's motors cannot hold it up, or there is no such simulator or check.
    MissingDependency
        The simulator is not installed.
    """
    followed = following(arm, follow)
    tell = progress or (lambda stage, done: None)
    around = surroundings or Surroundings()
    engines = _engines(simulator or default_engine(), around)
    accepted, mode = accepted_names(accept), _mode(dynamics)
    if dynamics == "none":
        arm, accepted = without_dynamics(arm), accepted_names((*accepted, *_OF_DYNAMICS))
    require_holdable(arm)
    tell("place", 0.0)
    looked_at = require_free_postures(arm, engines[0])
    clear = clear_of_itself(arm, engines[0], around.margin)
    recording = learnable(recording, smooth=smooth, keep_rests=keep_rests or cycles is not None)
    if cycles is not None:
        if others:
            raise InvalidArgument(
                "others: more recordings, expected none: a rhythmic motion is learned from one take. Choose one."
            )
        recording = motion.one_cycle(recording, minimum_period)
    if place is True:
        place = partial(place_motion, seed=seed, scale=scale, follow=followed)
    placement = place_among(place, recording, arm, clear, around, engines[0]) if place else None
    placed = placement.apply_to(recording) if placement else recording
    tell("learn", 0.0)
    demonstration = motion.demonstration(placed)
    found = evidence(demonstration, smooth=smooth)
    ready = [learnable(other, smooth=smooth, keep_rests=keep_rests) for other in others]
    lesson = _together(placed, ready, placement, basis_count, smooth) if others else None
    model = lesson.model if lesson else learn(demonstration, basis_count, smooth=smooth, rhythmic=cycles is not None)
    placed = _noted(placed, found)
    tell("solve", 0.0)
    ways = partial(
        solve,
        arm=arm,
        start=placement.start if placement else None,
        accept=clear,
        tempo=tempo,
        tolerance=tolerance,
        engine=engines[0],
        follow=followed,
    )
    led = Cycles(model, cycles) if cycles is not None else model
    solution, detour = solve_around(partial(ways, led), led, arm, around, clear)
    less = None
    if smooth and cycles is None:
        less = calmer(placed, found.motion, solution.slowdown, lambda of: float(ways(of).motion.time[-1]))
    plan, joints, slowdown = solution.motion, solution.joints, solution.slowdown
    placed = placed.with_(solution.fit.describe()) if solution.fit else placed
    for note in (*around.notes(), *([detour.describe()] if detour else ())):
        placed = placed.with_(note)
    require_holdable(arm, joints.position)
    sent = sending.from_rest_to_rest(arm, joints, clear.keeps_clear)
    tell("execute", 0.0)
    path_checks = simulation.path_checks(arm, sent, simulator=engines[0])
    logs = _execute(arm, sent, engines, followed, mode, lambda done: tell("execute", done))
    log, second = logs[0], logs[1] if len(logs) > 1 else None
    stages = {
        "demonstration_to_dmp": reproduction(model, demonstration, placed.measured),
        **_fitted_stages(arm, solution, placed),
        "dmp_to_ik": metrics.compare(plan.pose, arm.forward_kinematics(joints.position)),
        "ik_to_executed": log.errors,
    }
    reproduced = lesson.checks if lesson else reproduction_checks(model, found)
    fitted = solution.fit.checks(followed) if solution.fit else ()
    ready = sending.ready(sending.check(sent, arm))
    checks = (*reproduced, *fitted, *path_checks, ready, *log.verdict.checks, *tempo_check(solution.tempo, slowest))
    if second is not None:
        checks = (*checks, *simulation.agreement(log, second))
    if dynamics == "none":
        checks = tuple(_by_kinematics(checks))
    return Imitation(
        placed,
        placement,
        model,
        slowdown,
        plan,
        joints,
        sent,
        log,
        stages,
        checks,
        found,
        second,
        accepted,
        looked_at,
        less,
        solution.tempo,
        solution.fit,
        around.obstacles,
        detour,
    )


def _fitted_stages(arm: Arm, solution: Solution, placed: Recording) -> dict[str, StageErrors]:
    """Return how far a fitted motion is from the placed recording, at its samples, and from the learned motion."""
    if solution.fit is None:
        return {}
    when = solution.tempo.when(placed.time - placed.time[0])
    joints = np.stack([np.interp(when, solution.joints.time, q) for q in solution.joints.position.T], axis=1)
    return {
        "recording_to_fitted": metrics.compare(motion.poses(placed), arm.forward_kinematics(joints)),
        "dmp_to_fitted": metrics.compare(solution.learned.pose, solution.motion.pose),
    }


def _together(
    first: Recording, others: Sequence[Recording], placement: Placement | None, basis_count: int | None, smooth: bool
) -> Lesson:
    """Return what is learned from the first recording, as it was placed, and others in the same frame."""
    placed = [placement.apply_to(recording) for recording in others] if placement else others
    return teach([first, *placed], basis_count=basis_count, smooth=smooth, keep_rests=True)


def _engines(simulator: str, around: Surroundings) -> tuple[Engine, ...]:
    engines = simulation.ENGINES
    if simulator not in (*engines, "both"):
        raise InvalidArgument(f"simulator: '{simulator}', expected one of {', '.join(engines)}, both.")
    chosen = engines.values() if simulator == "both" else [engines[simulator]]
    return tuple(around.in_world(engine) for engine in chosen)


def _execute(
    arm: Arm,
    joints: RestToRest,
    engines: tuple[Engine, ...],
    follow: Follow,
    mode: Mode,
    tell: Callable[[float], None],
) -> list[ExecutionLog]:
    """Return the log of every engine; ``tell`` hears the share of all that is done."""

    def run(k: int) -> ExecutionLog:
        return simulation.execute(
            arm,
            joints,
            simulator=engines[k],
            mode=mode,
            follow=follow,
            progress=lambda done, total: tell((k + done / total) / len(engines)),
        )

    return [run(k) for k in range(len(engines))]


def _mode(dynamics: str) -> Mode:
    if dynamics not in ("full", "none"):
        raise InvalidArgument(f"dynamics: '{dynamics}', expected full or none.")
    return "computed_torque" if dynamics == "full" else "position"


def _by_kinematics(checks: Iterable[Check]) -> Iterator[Check]:
    """Leave out what only masses could show; torque and inertia are named as not judged."""
    for check in checks:
        if check.name in _OF_DYNAMICS:
            yield Check.not_judged(check.name, check.unit, "the run is by kinematics alone (dynamics='none').")
        elif check.name not in ("torque_clipped", "dynamics_mismatch", "engines_torque_rms"):
            yield check


def _noted(recording: Recording, found: Evidence) -> Recording:
    if not found.smoothed:
        return recording
    return recording.with_(f"learned with its noise smoothed out: {found.noise.describe()} found, once placed")
