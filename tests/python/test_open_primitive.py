"""What a user may plug into a primitive: weights, learners, couplings, products of spaces."""

import copy
import pickle

import dmpcpp
import numpy as np
import pytest
from dmpcpp import so3

TIME = np.linspace(0, 2, 120)
POSITION = np.c_[0.3 * np.sin(TIME), 0.1 * np.cos(2 * TIME), 0.2 * TIME]
ROTATION = np.array([so3.exp([0.2 * t, 0.5 * np.sin(t), 0.3 * t]) for t in TIME])
POSES = np.tile(np.eye(4), (len(TIME), 1, 1))
POSES[:, :3, :3], POSES[:, :3, 3] = ROTATION, POSITION
OPENING = 0.04 * (1 + np.cos(3 * TIME))

MODELS = {
    "Dmp": lambda **fields: dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, POSITION), basis_count=20, **fields),
    "OrientationDmp": lambda **fields: dmpcpp.OrientationDmp.fit(
        dmpcpp.OrientationDemonstration(TIME, ROTATION), basis_count=20, **fields
    ),
    "PoseDmp": lambda **fields: dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(TIME, POSES), basis_count=20, **fields),
    "PoseGripperDmp": lambda **fields: dmpcpp.PoseGripperDmp.fit(
        dmpcpp.PoseGripperDemonstration(TIME, POSES, OPENING), basis_count=20, **fields
    ),
}
RUNS = {"Dmp": "Run", "OrientationDmp": "OrientationRun", "PoseDmp": "PoseRun", "PoseGripperDmp": "PoseGripperRun"}
every_kind = pytest.mark.parametrize("kind", MODELS)


def run_of(model):
    return getattr(dmpcpp, RUNS[type(model).__name__])(model)


def parts(value):
    """A point of a product is a tuple of arrays."""
    return value if isinstance(value, tuple) else (value,)


@every_kind
def test_arrays_that_a_model_hands_out_can_not_be_written_to(kind):
    model = MODELS[kind]()
    run = run_of(model)
    for array in (model.weights, *parts(model.start), *parts(model.goal), *parts(run.goal), model.parameters.weights):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0
        array.copy()[:] = 0
    assert np.abs(model.weights).max() > 0


@every_kind
def test_a_model_is_made_of_its_parameters(kind):
    model = MODELS[kind]()
    same = type(model)(model.parameters)
    assert dmpcpp.to_json(same) == dmpcpp.to_json(model)
    parameters = model.parameters
    parameters.duration = 3.0
    parameters.weights = 2 * model.weights
    changed = type(model)(parameters)
    assert changed.duration == 3.0
    np.testing.assert_array_equal(changed.weights, 2 * model.weights)
    assert model.duration == 2.0
    parameters.weights = np.zeros((3, 1))
    with pytest.raises(dmpcpp.InvalidArgument, match="weights: 3 x 1"):
        type(model)(parameters)


def test_parameters_are_made_of_keywords_and_name_what_they_refuse():
    parameters = dmpcpp.DmpParameters(
        options=dmpcpp.DmpOptions(basis_count=5),
        duration=1.0,
        start=[0.0],
        goal=[1.0],
        start_velocity=[0.0],
        amplitude=[1.0],
        weights=np.zeros((5, 1)),
    )
    model = dmpcpp.Dmp(parameters)
    assert abs(model.rollout(duration=4.0).position[-1, 0] - 1) < 1e-3
    with pytest.raises(TypeError, match="unknown option 'weight'"):
        dmpcpp.DmpParameters(weight=1)
    parameters.goal = [1.0, 2.0]
    with pytest.raises(dmpcpp.InvalidArgument, match="goal: 2 numbers, expected 1"):
        dmpcpp.Dmp(parameters)


@every_kind
def test_a_model_with_other_weights_keeps_all_else(kind):
    model = MODELS[kind]()
    still = model.with_weights(0 * model.weights)
    assert still.options == model.options
    assert np.abs(still.weights).max() == 0
    np.testing.assert_array_equal(model.with_weights(model.weights).forcing([0.5]), model.forcing([0.5]))
    with pytest.raises(dmpcpp.InvalidArgument, match=r"weights: 2 x 2, expected 20 x \d"):
        model.with_weights(np.zeros((2, 2)))


@every_kind
def test_the_regression_as_a_learner_gives_the_same_model(kind):
    def learner(basis, targets):
        return dmpcpp.fit_forcing(basis, targets, regression="ridge")

    own, usual = MODELS[kind](learner=learner).weights, MODELS[kind]().weights
    np.testing.assert_allclose(own, usual, rtol=1e-5, atol=1e-6 * np.abs(usual).max())  # columns solved together round


def test_targets_are_what_a_learner_gets():
    demonstration = dmpcpp.Demonstration(TIME, POSITION)
    seen = []

    def learner(basis, targets):
        seen.extend(targets)
        return np.zeros((basis.count, 3))

    stated = {"basis_count": 100, "regression": "ridge", "derivatives": "interpolate"}
    dmpcpp.Dmp.fit([demonstration], learner=learner, **stated)
    (target,) = dmpcpp.Dmp.targets([demonstration], **stated)
    np.testing.assert_array_equal(target.value, seen[0].value)
    model = dmpcpp.Dmp.fit(demonstration, basis_count=100, regression="ridge", derivatives="interpolate")
    learned = target.scale * (model.basis.features(target.phase) @ model.weights)
    np.testing.assert_allclose(learned, model.forcing(target.phase), atol=1e-9)
    np.testing.assert_allclose(learned, target.value, atol=1e-3 * np.abs(target.value).max())


def test_what_a_learner_raises_or_returns_wrongly_comes_through():
    def fails(basis, targets):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        MODELS["Dmp"](learner=fails)
    with pytest.raises(dmpcpp.InvalidArgument, match="learner: weights: 1 x 1, expected 20 x 3"):
        MODELS["Dmp"](learner=lambda basis, targets: np.zeros((1, 1)))


@every_kind
def test_a_coupling_adds_to_the_acceleration_in_each_internal_step(kind):
    model = MODELS[kind]()
    run = run_of(model)
    run.step(0.5)
    calls = []

    def push(state):
        calls.append(state.phase)
        return np.ones(model.dimension) / state.speed**2

    name = "angular_acceleration" if kind == "OrientationDmp" else "acceleration"
    before = getattr(run, name)
    run.step(0.0, coupling=push)
    np.testing.assert_allclose(getattr(run, name) - before, 1.0, atol=1e-9)
    assert calls == [run.phase]
    run.step(0.1, coupling=push)  # ten internal steps of 0.005, and the output
    assert len(calls) == 12


def test_a_coupling_that_raises_leaves_the_run_as_it_was():
    run = run_of(MODELS["PoseDmp"]())
    run.step(0.5)
    before = copy.copy(run)
    with pytest.raises(ZeroDivisionError):
        run.step(0.1, coupling=lambda state: 1 / 0)
    with pytest.raises(dmpcpp.InvalidArgument, match="coupling: returned 2 numbers, expected 6"):
        run.step(0.1, coupling=lambda state: np.zeros(2))
    assert run.time == before.time
    run.step(0.1)
    before.step(0.1)
    np.testing.assert_array_equal(run.pose, before.pose)


def test_a_pose_with_a_gripper_is_learned_saved_run_and_batched(tmp_path):
    model = MODELS["PoseGripperDmp"]()
    dmpcpp.save(model, tmp_path / "grasp.json")
    again = dmpcpp.load(tmp_path / "grasp.json")
    assert dmpcpp.to_json(pickle.loads(pickle.dumps(again))) == dmpcpp.to_json(model)

    pose, width = model.goal
    goal = (pose @ np.block([[so3.exp([0, 0, 0.2]), np.array([[0.1], [0], [0]])], [np.zeros(3), 1]]), width + 0.01)
    plan = again.rollout(goal=goal, duration=1.5)
    alone = dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(TIME, POSES), basis_count=20).rollout(goal[0], 1.5)
    np.testing.assert_allclose(plan.pose, alone.pose, atol=1e-10)
    narrow = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, OPENING), basis_count=20).rollout(goal[1], 1.5)
    np.testing.assert_allclose(plan.gripper, narrow.position, atol=1e-12)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(plan)).gripper_velocity, plan.gripper_velocity)

    run = dmpcpp.PoseGripperRun(again)
    run.goal = goal
    while run.step(1e-2):
        pass
    np.testing.assert_allclose(run.gripper, width + 0.01, atol=1e-3)
    with pytest.raises(dmpcpp.InvalidArgument, match="goal: not a pose"):
        run.goal = (pose, [0.1, 0.2])

    batch = model.rollout_each(goals=(np.stack([pose, goal[0]]), np.stack([width, goal[1]])), samples=11)
    assert batch.pose.shape == (2, 11, 4, 4)
    assert batch.gripper.shape == (2, 11, 1)
    one, two = dmpcpp.PoseGripperDmp.fit_each(TIME, (np.stack([POSES, POSES]), OPENING[None, :, None].repeat(2, 0)))
    np.testing.assert_array_equal(one.weights, two.weights)
    report = dmpcpp.assess(one, [dmpcpp.PoseGripperDemonstration(TIME, POSES, OPENING)])
    assert report.rmse.shape == (7,)
