"""New goals are approached as the demonstration advances, by default; scalings that multiply have a guard."""

import dmpcpp
import numpy as np
import pytest

TIME = np.linspace(0.0, 2.0, 401)
S = TIME / 2.0
REACH = (S**3 * (10.0 - 15.0 * S + 6.0 * S**2))[:, None] * [0.4, 0.0, 0.0]


@pytest.fixture(scope="module")
def model():
    return dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, REACH))


@pytest.mark.parametrize("goal", [(0.35, 0.0, 0.0), (0.2, 0.0, 0.0), (0.8, 0.0, 0.0), (0.4, 0.1, 0.0)])
def test_a_new_goal_is_met_without_going_back_and_from_rest(model, goal):
    motion = model.rollout(goal=np.array(goal), dt=1e-3)
    along = (motion.position @ goal) / np.linalg.norm(goal)
    assert np.max(np.maximum.accumulate(along) - along) < 1e-4
    assert np.linalg.norm(motion.acceleration[0]) < 0.15 * np.abs(model.rollout().acceleration).max()
    assert motion.position[-1] == pytest.approx(goal, abs=1e-5)


def test_the_spring_alone_goes_back_first():
    plain = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, REACH), scaling="none")
    assert plain.rollout(goal=np.array([0.2, 0.0, 0.0])).position[:, 0].min() < -0.1


def test_the_demonstrated_goal_is_reached_as_without(model):
    plain = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, REACH), scaling="none")
    assert np.abs(model.rollout().position - plain.rollout().position).max() < 1e-10


def test_the_advance_is_kept_in_the_file_and_belongs_to_its_scaling(model, tmp_path):
    dmpcpp.save(model, tmp_path / "reach.json")
    again = dmpcpp.load(tmp_path / "reach.json")
    assert again.options.scaling == dmpcpp.Scaling.advance
    goal = np.array([0.2, 0.1, 0.0])
    assert np.array_equal(again.rollout(goal=goal).position, model.rollout(goal=goal).position)
    parameters = model.parameters
    assert parameters.advance.shape == (len(model.weights), 1)
    parameters.options.scaling = "none"
    with pytest.raises(dmpcpp.InvalidArgument, match="advance: given, expected none unless"):
        dmpcpp.Dmp(parameters)


def test_the_default_is_to_advance_and_the_sources_options_are_literal(model):
    assert dmpcpp.DmpOptions().scaling == dmpcpp.Scaling.automatic
    assert model.options.scaling == dmpcpp.Scaling.advance
    source = dmpcpp.DmpOptions.source()
    assert source.scaling == dmpcpp.Scaling.per_axis and not source.scaling_guard
    assert (
        dmpcpp.Dmp.fit(
            dmpcpp.Demonstration(TIME, REACH + [0.0, 1e-3, 1e-3] * TIME[:, None]), source
        ).parameters.advance.size
        == 0
    )


@pytest.mark.parametrize("scaling", ["per_axis", "per_axis_relative", "rotation_dilation"])
def test_a_loop_led_aside_stays_in_its_box_and_says_why(scaling):
    around = 2.0 * np.pi * S**3 * (10.0 - 15.0 * S + 6.0 * S**2)
    loop = np.c_[0.1 * np.sin(around) + 4e-3 * S, 0.1 * np.cos(around) + 1e-3 * S]
    demonstration = dmpcpp.Demonstration(TIME, loop)
    goal = loop[-1] + [0.1, 0.0]
    guarded = dmpcpp.Dmp.fit(demonstration, scaling=scaling)
    assert np.abs(guarded.rollout(goal=goal).position).max() < 0.21
    assert any("too little for " + scaling in note for note in guarded.scaling_notes(goal))
    assert any("too little" in warning for warning in dmpcpp.assess(guarded, [demonstration]).warnings)
    plain = dmpcpp.Dmp.fit(demonstration, scaling=scaling, scaling_guard=False)
    assert np.abs(plain.rollout(goal=goal).position).max() > 0.5 and plain.scaling_notes(goal) == []


def test_a_model_is_put_under_another_scaling_by_name(model):
    goal = np.array([0.2, 0.1, 0.0])
    turned = model.with_scaling("rotation_dilation")
    fitted = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, REACH), scaling="rotation_dilation")
    np.testing.assert_allclose(turned.rollout(goal=goal).position, fitted.rollout(goal=goal).position, atol=1e-9)
    assert model.with_scaling("automatic").options == model.options
    with pytest.raises(dmpcpp.InvalidArgument, match="scaling: 'wide' is unknown, expected one of none, per_axis"):
        model.with_scaling("wide")


@pytest.mark.parametrize("dt", [0.3, 0.7, 0.013, 5.0])
def test_a_rollout_ends_at_its_duration(model, dt):
    motion = model.rollout(dt=dt)
    assert motion.time[-1] == model.duration and len(motion.time) == np.ceil(2.0 / dt) + 1
    np.testing.assert_allclose(motion.position[-1], model.goal, atol=1e-5)
