"""Improvement by trial: less cost in few trials, the same for the same seed, nothing changed that was not searched."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import InvalidArgument, learning
from dmpcpp.improvement import improve

TIME = np.linspace(0, 2, 101)
MODEL = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, np.c_[0.5 * TIME, 0.3 * np.sin(1.5 * TIME)]))
PLACE = np.array([0.5, 0.6])


def miss(motion):
    """How far the middle of the motion is from a place, and a little of how hard it accelerates."""
    middle = np.argmin(np.abs(motion.time - 1.0))
    return np.linalg.norm(motion.position[middle] - PLACE) + 1e-5 * np.sqrt(np.mean(motion.acceleration**2))


@pytest.mark.parametrize("search", ["via", "weights"])
def test_a_place_that_the_demonstration_misses_is_reached_in_few_trials(search):
    trials, ends = [], []
    for seed in range(4):
        found = improve(MODEL, miss, search=search, rollouts=301, seed=seed)
        best = np.minimum.accumulate(found.costs)
        trials.append(int(np.argmax(best < 0.08)))
        ends.append(best[-1])
        assert found.cost == best[-1] == pytest.approx(miss(found.rollout(dt=1e-2)))
        assert found.rollout(dt=1e-2).position[-1] == pytest.approx(MODEL.goal, abs=2e-3)
    assert found.costs[0] == pytest.approx(miss(MODEL.rollout(dt=1e-2)))
    assert 0 < np.median(trials) <= 30 and np.median(ends) < 0.015


def test_a_goal_is_found_and_of_poses_rotations_stay():
    poses = np.tile(np.eye(4), (101, 1, 1))
    poses[:, :3, 3] = np.c_[0.5 * TIME, 0.3 * np.sin(1.5 * TIME), 0.1 * TIME]
    model = dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(TIME, poses))
    wanted = model.goal[:3, 3] + [0.1, -0.05, 0.1]
    found = learning.improve(model, lambda m: np.linalg.norm(m.pose[-1, :3, 3] - wanted), search="goal", rollouts=200)
    assert found.cost < 0.25 * found.costs[0]
    assert np.array_equal(found.goal[:3, :3], model.goal[:3, :3])
    assert found.via == ()
    past = improve(model, lambda m: np.abs(m.pose[:, 2, 3] - 0.3).min(), phases=(0.3, 0.7), rollouts=31)
    assert [via.phase for via in past.via] == [0.3, 0.7] and past.cost < past.costs[0]


def test_one_seed_gives_the_same_trials_and_failed_ones_count_as_none():
    def fails_often(motion):
        return miss(motion) if motion.position[:, 1].max() < 0.5 else np.nan

    one, again, other = (improve(MODEL, fails_often, rollouts=41, seed=seed) for seed in (3, 3, 4))
    assert np.array_equal(one.costs, again.costs) and not np.array_equal(one.costs, other.costs)
    assert len(one.costs) == 41 and np.isinf(one.costs).any() and np.isfinite(one.cost)
    assert one.cost <= one.costs[0]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"search": "all"}, "search: 'all', expected one of via, goal, weights"),
        ({"rollouts": 5}, "rollouts: 5, expected 11 or more"),
        ({"step": -1.0}, "step: -1.0, expected a positive number"),
        ({"decay": 0.1}, "decay: 0.1, expected 0.5 to 1"),
        ({"cost": lambda _: np.nan}, "cost: not finite for the model as it is"),
        ({"phases": (0.5, 0.1)}, r"via\[1\]"),
        ({"reach": 3.0}, "reach"),
    ],
)
def test_what_cannot_be_searched_is_refused(change, words):
    with pytest.raises(InvalidArgument, match=words):
        improve(MODEL, **{"cost": miss, **change})
