"""Every number that can be given to the library, replaced by every bad one: refused by name, or answered finitely.

The cases are generated: ENTRIES has one good call for each public entry that takes numbers, and a test holds it
against the module. Not finite, empty or of the wrong size must be refused; 0, negative, denormal and huge may be
answered where they have a meaning, but never with NaN. What was refused leaves no trace.
"""

import inspect
from collections.abc import Callable
from typing import Any

import dmpcpp
import numpy as np
import pytest
from dmpcpp import InvalidArgument

TIME = np.linspace(0.0, 1.0, 12)
POSITION = np.c_[np.sin(TIME), TIME**2]
ROTATION = np.array([dmpcpp.so3.exp([0.1 * t, 0.2, 0.3 * t]) for t in TIME])
POSES = np.tile(np.eye(4), (12, 1, 1))
POSES[:, :3, :3] = ROTATION
POSES[:, :3, 3] = np.c_[0.4 + 0.1 * TIME, 0.1 * TIME, 0 * TIME]
DEMONSTRATIONS = {
    "Dmp": dmpcpp.Demonstration(TIME, POSITION),
    "OrientationDmp": dmpcpp.OrientationDemonstration(TIME, ROTATION),
    "PoseDmp": dmpcpp.PoseDemonstration(TIME, POSES),
}
KINDS = {"Dmp": dmpcpp.Run, "OrientationDmp": dmpcpp.OrientationRun, "PoseDmp": dmpcpp.PoseRun}
MODELS = {
    kind: getattr(dmpcpp, kind).fit(demonstration, basis_count=5) for kind, demonstration in DEMONSTRATIONS.items()
}
TWO_LINKS = """<robot name="two"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <joint name="k" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <joint name="f" type="fixed"><parent link="c"/><child link="d"/><origin xyz="0.5 0 0"/></joint></robot>"""
ARM = dmpcpp.Arm.from_urdf(TWO_LINKS)
JOINTS = np.array([0.3, 0.7])
QUATERNIONS = np.tile([1.0, 0.0, 0.0, 0.0], (len(TIME), 1))
REACHED = ARM.forward_kinematics(JOINTS)
PATH = ARM.forward_kinematics(JOINTS + np.outer(TIME, [0.3, 0.2]))
TRAJECTORY = dmpcpp.JointTrajectory.through(TIME, JOINTS + np.outer(TIME, [0.3, 0.2]))


def tracked(pose: Any, dt: Any) -> np.ndarray:
    tracker = dmpcpp.JointTracker(ARM, JOINTS)
    tracker.track(pose, dt)
    return tracker.joints


Entry = tuple[Callable[..., Any], dict[str, Any]]
ENTRIES: dict[str, Entry] = {
    "Demonstration.__init__": (dmpcpp.Demonstration, {"times": TIME, "positions": POSITION}),
    "OrientationDemonstration.__init__": (dmpcpp.OrientationDemonstration, {"times": TIME, "rotations": ROTATION}),
    "PoseDemonstration.__init__": (dmpcpp.PoseDemonstration, {"times": TIME, "poses": POSES}),
    "OrientationDemonstration.from_euler": (
        lambda times, angles: dmpcpp.OrientationDemonstration.from_euler(times, angles, "ZYX"),
        {"times": TIME, "angles": np.c_[TIME, TIME, TIME]},
    ),
    "OrientationDemonstration.from_quaternions": (
        lambda times, quaternions: dmpcpp.OrientationDemonstration.from_quaternions(times, quaternions, "wxyz"),
        {"times": TIME, "quaternions": QUATERNIONS},
    ),
    "PoseDemonstration.from_quaternions": (
        lambda times, positions, quaternions: dmpcpp.PoseDemonstration.from_quaternions(
            times, positions, quaternions, "wxyz"
        ),
        {"times": TIME, "positions": POSES[:, :3, 3], "quaternions": QUATERNIONS},
    ),
    "Demonstration.at": (DEMONSTRATIONS["Dmp"].at, {"times": TIME}),
    "OrientationDemonstration.at": (DEMONSTRATIONS["OrientationDmp"].at, {"times": TIME}),
    **{
        f"{type(shown).__name__}.with_measured": (shown.with_measured, {"measured": np.ones(len(shown))})
        for shown in DEMONSTRATIONS.values()
    },
    "so3.exp": (dmpcpp.so3.exp, {"v": np.ones(3)}),
    "so3.hat": (dmpcpp.so3.hat, {"v": np.ones(3)}),
    "so3.left_jacobian": (dmpcpp.so3.left_jacobian, {"v": np.ones(3)}),
    "so3.log": (dmpcpp.so3.log, {"r": ROTATION[3]}),
    "so3.distance": (dmpcpp.so3.distance, {"a": ROTATION[3], "b": ROTATION[4]}),
    "so3.from_euler": (lambda angles: dmpcpp.so3.from_euler(angles, "ZYX"), {"angles": np.ones(3)}),
    "so3.to_euler": (lambda r: dmpcpp.so3.to_euler(r, "ZYX"), {"r": ROTATION[3]}),
    "Arm.forward_kinematics": (ARM.forward_kinematics, {"q": JOINTS}),
    "Arm.jacobian": (ARM.jacobian, {"q": JOINTS}),
    "Arm.manipulability": (ARM.manipulability, {"q": JOINTS}),
    "Arm.gravity_effort": (ARM.gravity_effort, {"q": JOINTS}),
    "Arm.inverse_dynamics": (
        ARM.inverse_dynamics,
        {"q": JOINTS, "velocity": np.ones(2), "acceleration": np.ones(2)},
    ),
    "Arm.with_tool": (lambda frame: ARM.with_tool(frame).forward_kinematics(JOINTS), {"frame": REACHED}),
    "Arm.with_limits": (
        ARM.with_limits,
        {"lower": -JOINTS, "upper": 3 * JOINTS, "velocity": JOINTS, "effort": JOINTS},
    ),
    "InverseKinematics.__init__": (
        lambda **options: dmpcpp.InverseKinematics(ARM, **options).solve(REACHED),
        {"position_tolerance": 1e-6, "angle_tolerance": 1e-6, "angle_weight": 0.1, "max_step": 1.0},
    ),
    "InverseKinematics.solve": (dmpcpp.InverseKinematics(ARM).solve, {"pose": REACHED, "seed": JOINTS}),
    "InverseKinematics.solve_many": (dmpcpp.InverseKinematics(ARM).solve_many, {"poses": PATH, "seed": JOINTS}),
    "InverseKinematics.follow": (
        lambda path, times, **options: dmpcpp.InverseKinematics(ARM).follow(path, times, thorough=False, **options),
        {
            "path": PATH,
            "times": TIME,
            "start": JOINTS,
            "max_step": 0.3,
            "position_tolerance": 1e-5,
            "angle_tolerance": 1e-5,
        },
    ),
    "JointTrajectory.through": (
        dmpcpp.JointTrajectory.through,
        {"times": TIME, "positions": np.c_[TIME, TIME**2]},
    ),
    "duration_factor": (
        lambda **limits: dmpcpp.duration_factor(TRAJECTORY, **limits),
        {"velocity_limit": np.ones(2), "acceleration_limit": np.ones(2)},
    ),
    "InverseKinematics.branches": (
        lambda pose, seed, **options: next(dmpcpp.InverseKinematics(ARM).branches(pose, seed, **options)),
        {"pose": REACHED, "seed": JOINTS, "apart": 0.3, "tries": 3},
    ),
    "JointTracker.__init__": (
        lambda start, **options: dmpcpp.JointTracker(ARM, start, **options),
        {
            "start": JOINTS,
            "position_tolerance": 1e-6,
            "angle_tolerance": 1e-6,
            "angle_weight": 0.1,
            "limit_pull": 1.0,
        },
    ),
    "JointTracker.track": (tracked, {"pose": PATH[1], "dt": 0.01}),
    "time_optimal": (
        lambda **limits: dmpcpp.time_optimal(TRAJECTORY, arm=ARM, **limits),
        {
            "velocity_limit": np.ones(2),
            "acceleration_limit": np.ones(2),
            "effort_limit": np.full(2, 50.0),
            "gravity": np.array([0.0, 0.0, -9.81]),
        },
    ),
    "align": (
        lambda a, b, **options: dmpcpp.align(a, b, **options).distance,
        {"a": POSES, "b": POSES[::2], "angle_weight": 0.2, "band": 3.0},
    ),
    "frechet": (dmpcpp.frechet, {"a": POSITION, "b": POSITION[::2]}),
    "paced": (
        lambda **limits: dmpcpp.paced(TRAJECTORY, arm=ARM, **limits).joints,
        {
            "velocity_limit": np.ones(2),
            "acceleration_limit": np.ones(2),
            "effort_limit": np.full(2, 50.0),
            "jerk_limit": np.full(2, 100.0),
            "tool_speed_limit": 2.0,
            "tempo_rate": 3.0,
        },
    ),
    "largest_demand": (
        lambda **limits: dmpcpp.largest_demand(TRAJECTORY, arm=ARM, **limits),
        {
            "velocity_limit": np.ones(2),
            "acceleration_limit": np.ones(2),
            "effort_limit": np.full(2, 50.0),
            "jerk_limit": np.full(2, 100.0),
            "tool_speed_limit": 2.0,
        },
    ),
    "fit_path": (
        lambda **given: dmpcpp.fit_path(ARM, weight=np.r_[1.0, 1.0, np.zeros(4)], **given).joints,
        {
            "times": TIME,
            "poses": PATH,
            "start": JOINTS + np.outer(TIME, [0.3, 0.2]),
            "position_tolerance": 1e-3,
            "angle_tolerance": 1e-2,
        },
    ),
    "Pace.__init__": (dmpcpp.Pace, {"time": TIME, "slowdown": np.ones(len(TIME)), "rate": np.zeros(len(TIME))}),
    "stretched": (lambda factor: dmpcpp.stretched(TRAJECTORY, factor), {"factor": 2.0}),
    "spread": (lambda count: dmpcpp.spread([DEMONSTRATIONS["Dmp"]], count), {"count": 5}),
    "assess": (
        lambda **tolerance: dmpcpp.assess(MODELS["Dmp"], [DEMONSTRATIONS["Dmp"]], **tolerance),
        {"position": 1e-3, "angle": 1e-2},
    ),
}
SAMPLES = {"Dmp": POSITION, "OrientationDmp": ROTATION, "PoseDmp": POSES}
for kind, model in MODELS.items():
    ENTRIES |= {
        f"{kind}.fit_each": (
            lambda times, samples, threads, kind=kind: [
                each.rollout(dt=0.1)
                for each in getattr(dmpcpp, kind).fit_each(times, samples, threads=threads, basis_count=5)
            ],
            {"times": TIME, "samples": np.stack([SAMPLES[kind]] * 2), "threads": 2},
        ),
        f"{kind}.rollout_each": (
            model.rollout_each,
            {"goals": np.stack([model.goal] * 2), "durations": np.array([1.0, 2.0]), "samples": 5, "threads": 2},
        ),
        f"{kind}.rollout": (model.rollout, {"goal": model.goal, "duration": 1.0, "dt": 0.1}),
        f"{kind}.rollout_at": (model.rollout_at, {"times": TIME, "goal": model.goal, "duration": 1.0}),
        f"{kind}.scaling_notes": (
            lambda goal, model=model: np.zeros(len(model.scaling_notes(goal))), {"goal": model.goal}
        ),
        f"{kind}.forcing": (model.forcing, {"phase": TIME}),
        f"{kind}.activations": (model.activations, {"phase": TIME}),
        f"{kind}.fit": (
            lambda kind=kind, **options: getattr(dmpcpp, kind).fit(DEMONSTRATIONS[kind], **options).rollout(dt=0.1),
            {
                "alpha": 25.0, "beta": 6.0, "orientation_alpha": 25.0, "orientation_beta": 6.0, "alpha_x": 4.0,
                "overlap": 0.5, "ridge": 1e-9, "goal_filter": 20.0, "tempo_filter": 0.1, "phase_stop": 1.0,
                "basis_count": 5, "passes": 2,
            },
        ),
    }  # fmt: skip

OPENING = 0.04 * (1 + np.cos(3 * TIME))[:, None]
GRASP = dmpcpp.PoseGripperDmp.fit(dmpcpp.PoseGripperDemonstration(TIME, POSES, OPENING), basis_count=5)
BASIS = MODELS["Dmp"].basis
TARGET = dmpcpp.Dmp.targets([DEMONSTRATIONS["Dmp"]])[0]


def after(run: Any, *call: Any) -> Any:
    """Return a run after the call of a method."""
    getattr(run, call[0])(*call[1:])
    return run


def with_weights(model: Any) -> Callable[..., Any]:
    return lambda weights: model.with_weights(weights).rollout(dt=0.1)


ENTRIES |= {f"{kind}.with_weights": (with_weights(model), {"weights": model.weights}) for kind, model in MODELS.items()}
ENTRIES |= {
    "GaussianBasis.equal_in_time": (
        lambda **values: dmpcpp.GaussianBasis.equal_in_time(**values).activations(TIME),
        {"count": 5, "alpha_x": 4.0, "overlap": 0.5},
    ),
    "GaussianBasis.source": (
        lambda **values: dmpcpp.GaussianBasis.source(**values).activations(TIME),
        {"count": 5, "alpha_x": 4.0},
    ),
    "GaussianBasis.activations": (BASIS.activations, {"phase": TIME}),
    "GaussianBasis.features": (BASIS.features, {"phase": TIME}),
    "ForcingTarget.__init__": (
        lambda **values: dmpcpp.fit_forcing(BASIS, [dmpcpp.ForcingTarget(**values)]),
        {"phase": TARGET.phase, "value": TARGET.value, "scale": TARGET.scale},
    ),
    "PoseGripperDemonstration.__init__": (
        dmpcpp.PoseGripperDemonstration,
        {"times": TIME, "poses": POSES, "gripper": OPENING},
    ),
    "PoseGripperDmp.rollout": (
        lambda pose, gripper, **values: GRASP.rollout((pose, gripper), **values),
        {"pose": GRASP.goal[0], "gripper": GRASP.goal[1], "duration": 1.0, "dt": 0.1},
    ),
    "PoseGripperDmp.rollout_at": (GRASP.rollout_at, {"times": TIME, "duration": 1.0}),
    "PoseGripperDmp.rollout_each": (
        lambda poses, grippers, durations: GRASP.rollout_each((poses, grippers), durations, 5),
        {
            "poses": np.stack([GRASP.goal[0]] * 2),
            "grippers": np.stack([GRASP.goal[1]] * 2),
            "durations": np.array([1.0, 2.0]),
        },
    ),
    "PoseGripperDmp.fit_each": (
        lambda times, poses, grippers: [
            each.rollout(dt=0.1) for each in dmpcpp.PoseGripperDmp.fit_each(times, (poses, grippers), basis_count=5)
        ],
        {"times": TIME, "poses": np.stack([POSES] * 2), "grippers": np.stack([OPENING] * 2)},
    ),
    "PoseGripperDmp.with_weights": (with_weights(GRASP), {"weights": GRASP.weights}),
    "PoseGripperDmp.scaling_notes": (
        lambda pose, gripper: np.zeros(len(GRASP.scaling_notes((pose, gripper)))),
        {"pose": GRASP.goal[0], "gripper": GRASP.goal[1]},
    ),
    "PoseGripperDmp.forcing": (GRASP.forcing, {"phase": TIME}),
    "PoseGripperDmp.activations": (GRASP.activations, {"phase": TIME}),
    "PoseGripperRun.step": (lambda dt: after(dmpcpp.PoseGripperRun(GRASP), "step", dt), {"dt": 0.1}),
    "PoseGripperRun.set_tracking_error": (
        lambda error: after(dmpcpp.PoseGripperRun(GRASP), "set_tracking_error", error),
        {"error": 0.1},
    ),
    "PoseGripperRun.start_from": (
        lambda pose, gripper, velocity: after(dmpcpp.PoseGripperRun(GRASP), "start_from", (pose, gripper), velocity),
        {"pose": GRASP.start[0], "gripper": GRASP.start[1], "velocity": np.ones(7)},
    ),
}

PAIRS = {kind: getattr(dmpcpp, f"{kind}Sequence") for kind in MODELS}


def adaptation_entries(kind: str) -> dict[str, Entry]:
    """The calls that adapt a run of one kind, and its sequences."""
    run, model, pair = KINDS[kind], MODELS[kind], PAIRS[kind]
    velocity = np.full(model.dimension, 0.1)
    running = f"{kind}SequenceRun"
    start = getattr(dmpcpp, running)
    return {
        f"{run.__name__}.via": (
            lambda **values: after_step(run(model), lambda r: r.via(**values)),
            {"phase": 0.5, "point": model.start, "velocity": velocity, "reach": 0.2},
        ),
        f"{run.__name__}.move_via": (lambda point: moved_via(run(model), point), {"point": model.start}),
        f"{run.__name__}.ahead": (lambda phase: run(model).ahead(phase), {"phase": 0.5}),
        f"{run.__name__}.join": (
            lambda reach: after_step(run(model), lambda r: r.join(model, reach)),
            {"reach": 0.2},
        ),
        f"{kind}Sequence.__init__": (
            lambda **values: pair([model, model], **values).rollout(dt=0.1),
            {"leave": 0.8, "reach": 0.3},
        ),
        f"{kind}Sequence.rollout": (pair([model, model]).rollout, {"goal": model.goal, "duration": 1.0, "dt": 0.1}),
        f"{kind}Sequence.rollout_at": (pair([model, model]).rollout_at, {"times": TIME, "duration": 1.0}),
        f"{running}.step": (lambda dt: after(start(pair([model, model])), "step", dt), {"dt": 0.1}),
        f"{running}.set_goal": (lambda goal: after(start(pair([model])), "set_goal", goal), {"goal": model.goal}),
        f"{running}.stretch": (lambda factor: after(start(pair([model])), "stretch", factor), {"factor": 2.0}),
    }


def after_step(run: Any, call: Callable[[Any], Any]) -> Any:
    """Return a run after a call and a step."""
    call(run)
    run.step(0.1)
    return run


def moved_via(run: Any, point: Any) -> Any:
    """Return a run whose via-point was moved."""
    run.via(0.5, run.goal)
    return after_step(run, lambda r: r.move_via(0.5, point))


for kind in MODELS:
    ENTRIES |= adaptation_entries(kind)
ROUND = np.linspace(0, 4, 200)
ENTRIES["find_cycle"] = (
    lambda **values: dmpcpp.find_cycle(
        dmpcpp.Demonstration(ROUND, np.c_[np.cos(6 * ROUND), np.sin(6 * ROUND)]), **values
    ),
    {"minimum_period": 0.5, "harmonics": 4},
)
ENTRIES["Via.__init__"] = (
    lambda **values: MODELS["PoseDmp"].rollout(dt=0.1, via=[dmpcpp.Via(**values)]),
    {"phase": 0.5, "point": MODELS["PoseDmp"].start, "velocity": np.ones(6), "reach": 0.2},
)

OBSTACLE = dmpcpp.Sphere([0.4, 0.1, 0.05], 0.02)


def filtered(**limits: Any) -> Any:
    """Return a run of a pose after steps behind a filter."""
    run, safe = dmpcpp.PoseRun(MODELS["PoseDmp"]), dmpcpp.SafetyFilter([OBSTACLE], **limits)
    for _ in range(5):
        run.step(0.02, filter=safe)
    return [run, safe]


def beside(shape: Any) -> Any:
    """Return a run of a pose after steps beside an obstacle, the obstacle, and how far away a point is."""
    run, safe = dmpcpp.PoseRun(MODELS["PoseDmp"]), dmpcpp.SafetyFilter([shape])
    run.step(0.05, filter=safe)
    return [run, safe, shape, shape.distance(np.ones(3)), shape.gradient(np.ones(3))]


VECTOR = np.array([0.3, 0.2, 0.1])
SHAPES = {
    "Sphere": {"center": VECTOR, "radius": 0.1, "velocity": VECTOR},
    "Box": {"pose": np.eye(4), "half_sizes": VECTOR, "velocity": VECTOR},
    "Capsule": {"start": VECTOR, "end": -VECTOR, "radius": 0.1, "velocity": VECTOR},
    "Plane": {"point": -VECTOR, "normal": VECTOR, "velocity": VECTOR},
}
for shape, fields in SHAPES.items():
    made = getattr(dmpcpp, shape)
    ENTRIES |= {
        f"{shape}.__init__": (lambda made=made, **values: beside(made(**values)), fields),
        f"{shape}.distance": (made(**fields).distance, {"points": np.ones((4, 3))}),
        f"{shape}.gradient": (made(**fields).gradient, {"point": VECTOR}),
    }
ENTRIES |= {
    "SafetyFilter.__init__": (
        filtered,
        {
            "lower": -np.ones(3),
            "upper": np.ones(3),
            "velocity": np.ones(3),
            "acceleration": np.ones(3),
            "angular_velocity": 1.0,
            "angular_acceleration": 10.0,
            "margin": 0.02,
            "radius": 0.01,
            "gain": 30.0,
            "largest_step": 0.01,
            "room": 4,
        },
    ),
    "SafetyFilter.set": (
        lambda index: dmpcpp.SafetyFilter().set(index, OBSTACLE),
        {"index": 1},
    ),
    "SafetyFilter.remove": (lambda index: dmpcpp.SafetyFilter().remove(index), {"index": 1}),
    "SafetyFilter.set_tracking_error": (
        lambda error: dmpcpp.SafetyFilter().set_tracking_error(error),
        {"error": 0.01},
    ),
}


def takes_of(kind: str) -> list[Any]:
    """Return three demonstrations that differ a little."""
    waves = [0.1 * j * np.sin(3 * TIME) for j in range(3)]
    positions = [np.c_[TIME + wave, wave, TIME**2] for wave in waves]
    rotations = [np.array([dmpcpp.so3.exp([t, w, 0.0]) for t, w in zip(TIME, wave, strict=True)]) for wave in waves]
    poses = [np.tile(np.eye(4), (len(TIME), 1, 1)) for _ in waves]
    for pose, position, rotation in zip(poses, positions, rotations, strict=True):
        pose[:, :3, 3], pose[:, :3, :3] = position, rotation
    if kind == "Dmp":
        return [dmpcpp.Demonstration(TIME, position) for position in positions]
    if kind == "OrientationDmp":
        return [dmpcpp.OrientationDemonstration(TIME, rotation) for rotation in rotations]
    if kind == "PoseGripperDmp":
        return [dmpcpp.PoseGripperDemonstration(TIME, pose, wave) for pose, wave in zip(poses, waves, strict=True)]
    return [dmpcpp.PoseDemonstration(TIME, pose) for pose in poses]


def distribution_entries(kind: str) -> dict[str, Entry]:
    """The calls of a distribution of one kind."""
    name = "DmpDistribution" if kind == "Dmp" else kind.replace("Dmp", "Distribution")
    takes = takes_of(kind)
    one = getattr(dmpcpp, name).fit(takes)
    parts = 3 if kind == "PoseGripperDmp" else 2 if kind == "PoseDmp" else 1
    d = one.dimension
    return {
        f"{name}.fit": (
            lambda **values: type(one).fit(takes, **values).rollout(3),
            {"control_points": 6, "prior": 4.0, "iterations": 2},
        ),
        f"{name}.continued": (
            lambda **values: one.continued(takes[0], **values).rollout(3),
            {"duration": takes[0].duration, "phase": 0.0, "noise": np.full(parts, 0.01)},
        ),
        f"{name}.rollout": (one.rollout, {"samples": 5}),
        f"{name}.sample": (one.sample, {"seed": 3, "samples": 5}),
        f"{name}.observation_covariance": (one.observation_covariance, {"phase": 0.3}),
        f"{name}.stiffness": (one.stiffness, {"phase": 0.3, "most": np.full(d, 9.0), "spread": np.full(d, 0.1)}),
        **({} if kind == "PoseGripperDmp" else {f"{name}.spread": (one.spread, {"count": 4})}),
    }


for kind in (*MODELS, "PoseGripperDmp"):
    ENTRIES |= distribution_entries(kind)
SPREAD = dmpcpp.PoseDistribution.fit(takes_of("PoseDmp"))
ENTRIES["Given.__init__"] = (
    lambda **values: SPREAD.condition([dmpcpp.Given(**values)]).rollout(5),
    {
        "phase": 0.4,
        "point": SPREAD.rollout(3).pose[1],
        "velocity": np.ones(6),
        "covariance": 0.01 * np.eye(6),
        "velocity_covariance": 0.01 * np.eye(6),
    },
)
ENTRIES["damping_of"] = (dmpcpp.damping_of, {"stiffness": np.eye(3), "zeta": 0.7})
ENTRIES["blend"] = (
    lambda weights: dmpcpp.blend([SPREAD, SPREAD], weights).rollout(3),
    {"weights": np.array([0.5, 0.5])},
)

RUN_CALLS: dict[str, Callable[[Any, Any], Any]] = {
    "step": lambda run, value: run.step(value),
    "duration": lambda run, value: setattr(run, "duration", value),
    "set_tracking_error": lambda run, value: run.set_tracking_error(value),
    "goal": lambda run, value: setattr(run, "goal", value),
    "amplitude": lambda run, value: setattr(run, "amplitude", value),
    "start_from place": lambda run, value: run.start_from(value, velocity_of(run)),
    "start_from velocity": lambda run, value: run.start_from(place_of(run), value),
}
NO_NUMBERS = {"fastest_tip", "tip_motion", "retimed",
              "Arm.from_urdf", "Arm.from_urdf_file", "DmpOptions.__init__", "DmpOptions.source", "IkOptions.__init__",
              "FollowOptions.__init__", "TrackOptions.__init__", "average", "from_json", "load", "save",
              "to_json", "PoseDemonstration.noise_estimates", "fit_forcing", "PoseGripperDmp.fit",
              "PoseGripperRun.__init__", "DmpOptions.validate",
              *(f"PoseGripperRun.{name}" for name in ("via", "move_via", "ahead", "join"))}  # fmt: skip
for name in ("__init__", "rollout", "rollout_at"):
    NO_NUMBERS.add(f"PoseGripperDmpSequence.{name}")
for name in ("__init__", "step", "set_goal", "stretch"):
    NO_NUMBERS.add(f"PoseGripperDmpSequenceRun.{name}")
NO_NUMBERS |= {f"{kind}SequenceRun.__init__" for kind in MODELS}
for kind in ("DmpDistribution", "OrientationDistribution", "PoseDistribution", "PoseGripperDistribution"):
    NO_NUMBERS |= {f"{kind}.{name}" for name in ("condition", "distance", "mean", "log_likelihood")}
for kind in (*MODELS, "PoseGripperDmp"):
    NO_NUMBERS |= {f"{kind}.__init__", f"{kind}.targets", f"{kind}.with_scaling", f"{kind}Parameters.__init__"}


def place_of(run: Any) -> np.ndarray:
    return next(getattr(run, name) for name in ("pose", "rotation", "position") if hasattr(run, name))


def velocity_of(run: Any) -> np.ndarray:
    return next(getattr(run, name) for name in ("twist", "angular_velocity", "velocity") if hasattr(run, name))


def bad(good: Any) -> dict[str, Any]:
    """Return what may take the place of a good value, by name."""
    if isinstance(good, (int, float)):
        values = (np.nan, np.inf, -np.inf, 0, -1, 5e-324, 1e308, -1e308)
        return {str(value): value for value in (*values, -(2**31))} | {"a string": "many", "an array": np.ones(3)}
    spoiled: dict[str, Any] = {"empty": good[:0], "shorter": good[:-1], "a number": 1.0, "text": "many"}
    spoiled["one dimension more"] = np.stack([good, good])[None]
    for value in (np.nan, np.inf, -np.inf, 0.0, -1.0, 5e-324, 1e308, -1e308):
        one = np.array(good, dtype=float)
        one.flat[one.size // 2] = value
        spoiled |= {f"one {value}": one, f"all {value}": np.full_like(one, value)}
    return spoiled


def never(name: str) -> bool:
    """Return whether a value of that name must always be refused."""
    return any(word in name for word in ("nan", "text", "a string", "an array", "one dimension more"))


def finite(answer: Any) -> bool:
    """Return whether all numbers that an answer shows are numbers."""
    if answer is None or isinstance(answer, (bool, str)):
        return True
    if isinstance(answer, list):
        return all(finite(each) for each in answer)
    if isinstance(answer, (int, float, np.ndarray)):
        return not np.isnan(answer).any()
    shown = (getattr(answer, name) for name in dir(type(answer)) if isinstance(getattr(type(answer), name), property))
    return all(finite(value) for value in shown if isinstance(value, (float, np.ndarray)))


CASES = [(entry, argument) for entry, (_, arguments) in ENTRIES.items() for argument in arguments]


@pytest.mark.parametrize(("entry", "argument"), CASES, ids=[f"{e}-{a}" for e, a in CASES])
def test_a_bad_argument_is_refused_or_answered_finitely(entry, argument):
    call, good = ENTRIES[entry]
    assert finite(call(**good))
    for name, value in bad(good[argument]).items():
        try:
            answer = call(**{**good, argument: value})
        except (ValueError, TypeError):  # InvalidArgument, or numpy for what is no array
            continue
        assert not never(name), f"{entry}({argument}={name}) was taken"
        assert finite(answer), f"{entry}({argument}={name}) answers NaN"


def state(run: Any) -> list[bytes]:
    return [
        np.asarray(getattr(run, name)).tobytes()
        for name in sorted(dir(type(run)))
        if isinstance(getattr(type(run), name), property) and name not in ("status", "state")
    ] + [run.status.name.encode()]


@pytest.mark.parametrize("call", RUN_CALLS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_run_is_as_it_was_after_a_refusal(kind, call):
    run = KINDS[kind](MODELS[kind])
    run.step(0.3)
    goods = {"goal": run.goal, "start_from place": place_of(run), "start_from velocity": velocity_of(run)}
    for name, value in bad(goods.get(call, 0.5)).items():
        trial = run.__copy__()
        before = state(trial)
        try:
            RUN_CALLS[call](trial, value)
        except (InvalidArgument, TypeError):
            assert state(trial) == before, f"{call}({name}) was refused and changed the run"
            continue
        except FloatingPointError:  # huge but finite: the last finite state is kept and said
            assert finite(trial)
            continue
        assert not never(name), f"{call}({name}) was taken"
        assert finite(trial), f"{call}({name})"


def test_every_public_entry_is_tested_here():
    """Methods of models and runs that take nothing are left out by their signature."""
    expected = set()
    for name, thing in vars(dmpcpp._core).items():
        if inspect.isclass(thing) and thing.__module__ == "dmpcpp._core" and not issubclass(thing, Exception):
            methods = {m for m, f in vars(thing).items() if takes_arguments(f) and (m[0] != "_" or m == "__init__")}
            expected |= {f"{name}.{method}" for method in methods}
        elif inspect.isbuiltin(thing) or (callable(thing) and not inspect.isclass(thing)):
            expected.add(name)
    expected |= {f"so3.{name}" for name in vars(dmpcpp.so3) if name[0] != "_"}
    runs = {f"{run.__name__}.{call.split()[0]}" for run in KINDS.values() for call in RUN_CALLS}
    covered = ENTRIES.keys() | NO_NUMBERS | runs | {f"{run.__name__}.__init__" for run in KINDS.values()}
    assert {entry for entry in expected if not entry.startswith("_")} <= covered


def takes_arguments(function: Any) -> bool:
    signature = getattr(function, "__doc__", None) or ""
    if isinstance(function, staticmethod):
        return True
    first = signature.split("\n")[0]
    return callable(function) and "(self:" in first and "," in first
