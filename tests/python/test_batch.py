"""Many demonstrations and many rollouts in one call: the same as one by one, bit for bit."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import so3

COUNT, SAMPLES = 5, 200
TIME = np.linspace(0.0, 1.5, SAMPLES)


def positions() -> np.ndarray:
    phase = np.linspace(0.0, 1.0, SAMPLES)
    return np.array(
        [np.c_[np.sin(2 * phase + j), phase**2, (j + 1) * phase + 0.1 * np.cos(7 * phase)] for j in range(COUNT)]
    )


def rotations() -> np.ndarray:
    return np.array([[so3.exp([0.5 * t, 0.2 * j, t * t]) for t in TIME] for j in range(COUNT)])


def poses() -> np.ndarray:
    result = np.tile(np.eye(4), (COUNT, SAMPLES, 1, 1))
    result[..., :3, :3] = rotations()
    result[..., :3, 3] = positions()
    return result


KINDS = {
    "positions": (dmpcpp.Dmp, dmpcpp.Demonstration, positions),
    "rotations": (dmpcpp.OrientationDmp, dmpcpp.OrientationDemonstration, rotations),
    "poses": (dmpcpp.PoseDmp, dmpcpp.PoseDemonstration, poses),
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("threads", [1, 2, 0])
def test_models_of_one_grid_are_those_of_single_fits(kind: str, threads: int) -> None:
    model, demonstration, make = KINDS[kind]
    values = make()
    fitted = model.fit_each(TIME, values, threads=threads, basis_count=30)
    listed = model.fit_each([demonstration(TIME, value) for value in values], threads=threads, basis_count=30)
    assert len(fitted) == len(listed) == COUNT
    for one, other, value in zip(fitted, listed, values, strict=True):
        alone = model.fit(demonstration(TIME, value), basis_count=30)
        assert dmpcpp.to_json(one) == dmpcpp.to_json(other) == dmpcpp.to_json(alone)


@pytest.mark.parametrize("threads", [1, 3])
def test_motions_of_many_goals_and_durations_are_those_of_single_rollouts(threads: int) -> None:
    model = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, positions()[0]))
    goals = np.random.default_rng(1).normal(size=(COUNT, 3))
    durations = np.linspace(0.5, 3.0, COUNT)
    batch = model.rollout_each(goals, durations, samples=51, threads=threads)
    assert len(batch) == COUNT
    assert batch.time.shape == (COUNT, 51)
    assert batch.position.shape == batch.velocity.shape == batch.acceleration.shape == (COUNT, 51, 3)
    assert batch.position.flags.c_contiguous
    for m in range(COUNT):
        one = model.rollout(goals[m], durations[m], durations[m] / 50)
        assert np.array_equal(batch.time[m], one.time)
        assert np.array_equal(batch.position[m], one.position)
        assert np.array_equal(batch.velocity[m], one.velocity)
        assert np.array_equal(batch.acceleration[m], one.acceleration)


def test_orientations_and_poses_roll_out_many_times_as_once() -> None:
    turning = dmpcpp.OrientationDmp.fit(dmpcpp.OrientationDemonstration(TIME, rotations()[1]))
    turned = turning.rollout_each(rotations()[:, -1], samples=21)
    moving = dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(TIME, poses()[1]))
    moved = moving.rollout_each(durations=[1.0, 2.0], samples=21, threads=2)
    for m in range(COUNT):
        one = turning.rollout(rotations()[m, -1], dt=TIME[-1] / 20)
        assert np.array_equal(turned.rotation[m], one.rotation)
        assert np.array_equal(turned.angular_velocity[m], one.angular_velocity)
    assert moved.pose.shape == (2, 21, 4, 4)
    for m, duration in enumerate([1.0, 2.0]):
        assert np.array_equal(moved.pose[m], moving.rollout(duration=duration, dt=duration / 20).pose)
        assert np.array_equal(moved.twist[m], moving.rollout(duration=duration, dt=duration / 20).twist)


def test_what_is_wrong_is_named_by_its_number() -> None:
    values = positions()
    values[3, 17, 1] = np.nan
    with pytest.raises(dmpcpp.InvalidArgument, match=r"^demonstrations\[3\]: positions\[17, 1\]"):
        dmpcpp.Dmp.fit_each(TIME, values, threads=2)
    with pytest.raises(dmpcpp.InvalidArgument, match=r"^positions: 2 dimensions, expected 3: \(M, T, d\)"):
        dmpcpp.Dmp.fit_each(TIME, values[0])
    with pytest.raises(dmpcpp.InvalidArgument, match=r"^threads: -2"):
        dmpcpp.Dmp.fit_each(TIME, positions(), threads=-2)
    model = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, positions()[0]))
    with pytest.raises(dmpcpp.InvalidArgument, match=r"^rollouts\[1\]: duration"):
        model.rollout_each(durations=[1.0, -1.0])
    with pytest.raises(dmpcpp.InvalidArgument, match=r"^durations: 3 for 2 goals"):
        model.rollout_each(np.zeros((2, 3)), [1.0, 1.0, 1.0])
    with pytest.raises(dmpcpp.InvalidArgument, match=r"^samples: 1"):
        model.rollout_each(np.zeros((2, 3)), samples=1)
    with pytest.raises(dmpcpp.InvalidArgument, match=r"^rollouts\[0\]: goal"):
        model.rollout_each(np.zeros((2, 2)))
    assert len(model.rollout_each()) == 0
