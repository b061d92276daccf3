"""New goals are approached as the demonstration advances, where that is asked for by name."""

import dmpcpp
import numpy as np
import pytest

TIME = np.linspace(0.0, 2.0, 401)
S = TIME / 2.0
REACH = (S**3 * (10.0 - 15.0 * S + 6.0 * S**2))[:, None] * [0.4, 0.0, 0.0]


@pytest.fixture(scope="module")
def model():
    return dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, REACH), scaling="advance")


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
