"""Time-optimal timing: toppra, SciPy and Pinocchio are the oracles."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import JointTrajectory, arms
from scipy.interpolate import CubicSpline

SPEED = np.array([1.48, 1.48, 1.74, 1.31, 2.27, 2.36, 2.36])
ACCELERATION = np.full(7, 10.0)


def random_motion(seed):
    through = np.random.default_rng(seed).uniform(-1.5, 1.5, (5, 7))
    times = np.linspace(0.0, 10.0, 1000)
    return through, JointTrajectory.through(times, CubicSpline(np.linspace(0.0, 10.0, 5), through)(times))


@pytest.mark.parametrize("seed", range(5))
def test_limits_hold_to_1e_9_between_the_samples_too_by_scipys_spline(seed):
    _, joints = random_motion(seed)
    fast = dmpcpp.time_optimal(joints, SPEED, ACCELERATION)
    spline = CubicSpline(fast.time, fast.position, bc_type="clamped")
    dense = np.sort(np.concatenate([fast.time, np.linspace(fast.time[0], fast.time[-1], 50_000)]))
    assert np.all(np.abs(spline(dense, 1)) <= SPEED * (1 + 1e-9))
    assert np.all(np.abs(spline(fast.time, 2)) <= ACCELERATION * (1 + 1e-7))  # SciPy's own rounding
    assert np.all(np.abs(fast.acceleration) <= ACCELERATION * (1 + 1e-9))
    np.testing.assert_array_equal(fast.position, joints.position)
    np.testing.assert_allclose(fast.velocity, spline(fast.time, 1), atol=1e-8)
    assert not fast.velocity[[0, -1]].any()


@pytest.mark.filterwarnings("ignore")
def test_the_duration_is_within_a_seventh_of_toppras():
    toppra = pytest.importorskip("toppra")
    from toppra.algorithm import TOPPRA
    from toppra.constraint import JointAccelerationConstraint, JointVelocityConstraint

    limits = [
        JointVelocityConstraint(np.stack([-SPEED, SPEED], axis=1)),
        JointAccelerationConstraint(np.stack([-ACCELERATION, ACCELERATION], axis=1)),
    ]
    for seed in range(5):
        through, joints = random_motion(seed)
        path = toppra.SplineInterpolator(np.linspace(0.0, 10.0, 5), through)
        best = TOPPRA(limits, path, solver_wrapper="seidel").compute_trajectory(0, 0).duration
        found = dmpcpp.time_optimal(joints, SPEED, ACCELERATION).time[-1]
        assert 0.99 * best < found < 1.15 * best


def test_efforts_hold_at_every_sample_by_pinocchios_inverse_dynamics():
    pytest.importorskip("pybullet_data")
    pinocchio = pytest.importorskip("pinocchio")
    arm = arms.find("iiwa")
    _, joints = random_motion(1)
    model = pinocchio.buildModelFromXML(arm.urdf)
    data = model.createData()
    rest = np.zeros(7)
    limit = 1.0 + 1.1 * np.abs([pinocchio.rnea(model, data, q, rest, rest) for q in joints.position]).max(axis=0)
    fast = dmpcpp.time_optimal(joints, SPEED, 3 * ACCELERATION, limit, arm=arm)
    rows = zip(fast.position, fast.velocity, fast.acceleration, strict=True)
    effort = np.abs([pinocchio.rnea(model, data, *row) for row in rows])
    assert np.all(effort <= limit * (1 + 1e-9))
    assert np.max(effort / limit) > 0.8


def test_stretched_by_the_factor_the_greatest_effort_is_the_limit_by_pinocchios_inverse_dynamics():
    pytest.importorskip("pybullet_data")
    pinocchio = pytest.importorskip("pinocchio")
    arm = arms.find("iiwa")
    _, joints = random_motion(1)
    model = pinocchio.buildModelFromXML(arm.urdf)
    data = model.createData()
    rest = np.zeros(7)
    limit = 1.0 + 1.1 * np.abs([pinocchio.rnea(model, data, q, rest, rest) for q in joints.position]).max(axis=0)
    factor = dmpcpp.duration_factor(joints, 100 * SPEED, 100 * ACCELERATION, limit, arm=arm)
    slow = dmpcpp.stretched(joints, factor)
    rows = zip(slow.position, slow.velocity, slow.acceleration, strict=True)
    effort = np.abs([pinocchio.rnea(model, data, *row) for row in rows])
    assert np.max(effort / limit) == pytest.approx(1.0, abs=1e-9)
    with pytest.raises(ValueError, match=r"effort_limit\[.\].*stand still"):
        dmpcpp.duration_factor(joints, SPEED, ACCELERATION, np.full(7, 1e-3), arm=arm)
    with pytest.raises(ValueError, match="needs an arm"):
        dmpcpp.duration_factor(joints, SPEED, ACCELERATION, limit)


def test_limits_that_are_none_are_value_errors():
    _, joints = random_motion(0)
    with pytest.raises(ValueError, match=r"velocity\[0\]"):
        dmpcpp.time_optimal(joints, 0 * SPEED, ACCELERATION)
    with pytest.raises(ValueError, match="needs an arm"):
        dmpcpp.time_optimal(joints, SPEED, ACCELERATION, ACCELERATION)
    with pytest.raises(ValueError, match="gravity"):
        dmpcpp.time_optimal(joints, SPEED, ACCELERATION, gravity=[0.0, 1.0])


def test_an_arm_carries_out_what_is_timed_with_its_efforts(panda):
    pytest.importorskip("pybullet")
    from dmpcpp import simulation

    _, joints = random_motion(4)
    middle = 0.5 * (panda.lower + panda.upper)
    joints = JointTrajectory.through(joints.time, middle + 0.3 * joints.position, panda.joint_names)
    fast = dmpcpp.time_optimal(
        joints, 0.95 * panda.velocity_limit, panda.acceleration_limit, 0.8 * panda.effort_limit, arm=panda
    )
    log = simulation.execute(panda, fast)
    assert log.verdict.ok, log.verdict
    assert log.errors.position_max < 1e-5
