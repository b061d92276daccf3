"""Joints for whole paths, and their splines: SciPy is the oracle."""

import threading
from types import SimpleNamespace

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Arm, InverseKinematics, JointTrajectory
from scipy.interpolate import CubicSpline

from tests.python.postures import feasible_path, pose_errors


def test_a_feasible_path_is_followed_whole(arm: Arm) -> None:
    poses = feasible_path(arm)
    joints = InverseKinematics(arm).follow(poses, times=np.linspace(0.0, 4.0, 200))
    assert joints.report.complete, joints.report.summary()
    position, angle = pose_errors(arm.forward_kinematics(joints.position), poses)
    assert position.max() <= 1e-9
    assert angle.max() <= 1e-7
    assert joints.position.shape == (200, arm.joint_count)
    assert joints.joint_names == arm.joint_names
    assert np.all(joints.position >= arm.lower) and np.all(joints.position <= arm.upper)
    assert joints.report.max_step == pytest.approx(np.abs(np.diff(joints.position, axis=0)).max())


def test_a_trajectory_with_time_and_pose_can_be_followed(panda: Arm) -> None:
    plan = SimpleNamespace(time=np.linspace(0.0, 1.0, 50), pose=feasible_path(panda, 50))
    ik = InverseKinematics(panda)
    np.testing.assert_array_equal(ik.follow(plan).position, ik.follow(plan.pose, times=plan.time).position)


@pytest.mark.parametrize("weight", [[1, 1, 1, 0, 0, 0], [1, 1, 1, 1, 1, 0]])
def test_a_path_that_leaves_turns_free_is_followed_whole(panda: Arm, weight: list[float]) -> None:
    poses = feasible_path(panda, 50)
    spin = np.eye(4)
    spin[:2, :2] = [[-1, 0], [0, -1]]
    joints = InverseKinematics(panda, weight=weight).follow(poses @ spin, times=np.linspace(0.0, 2.0, 50))
    tips = panda.forward_kinematics(joints.position)
    assert joints.report.complete
    assert np.abs(tips[:, :3, 3] - poses[:, :3, 3]).max() < 1e-9
    if weight[4]:
        assert np.abs(tips[:, :3, 2] - poses[:, :3, 2]).max() < 1e-9
    with pytest.raises(ValueError, match="weight"):
        InverseKinematics(panda, weight=[1, 1, 1, 0, 0, 1])


def test_threads_may_share_a_solver_for_paths_and_batches(panda: Arm) -> None:
    ik = InverseKinematics(panda)
    poses, times = feasible_path(panda, 100), np.linspace(0.0, 1.0, 100)
    serial = ik.follow(poses, times=times).position
    answers: list[np.ndarray] = []
    threads = [
        threading.Thread(target=lambda: answers.append(ik.follow(poses, times=times).position)) for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4
    for answer in answers:
        np.testing.assert_array_equal(answer, serial)


@pytest.mark.parametrize("count", [2, 3, 4, 40])
@pytest.mark.parametrize(("ends", "scipys"), [("not_a_knot", "not-a-knot"), ("at_rest", "clamped")])
def test_velocity_and_acceleration_are_those_of_scipys_spline(ends: str, scipys: str, count: int) -> None:
    rng = np.random.default_rng(3)
    times = np.cumsum(rng.uniform(0.05, 0.3, count))
    joints = JointTrajectory.through(times, rng.uniform(-1.0, 1.0, (count, 4)), ends=dmpcpp.SplineEnds[ends])
    spline = CubicSpline(times, joints.position, bc_type=scipys)
    np.testing.assert_allclose(joints.velocity, spline(times, 1), atol=1e-9)
    np.testing.assert_allclose(joints.acceleration, spline(times, 2), atol=1e-7)
    if ends == "at_rest":
        assert not joints.velocity[[0, -1]].any()


def test_after_stretching_by_the_factor_the_limits_hold(panda: Arm) -> None:
    joints = InverseKinematics(panda).follow(feasible_path(panda), times=np.linspace(0.0, 0.3, 200))
    acceleration = np.full(7, 10.0)
    factor = dmpcpp.duration_factor(joints, panda.velocity_limit, acceleration)
    slow = dmpcpp.stretched(joints, factor)
    ratio = max(
        (np.abs(slow.velocity) / panda.velocity_limit).max(),
        np.sqrt(np.abs(slow.acceleration) / acceleration).max(),
    )
    assert factor > 1.0
    assert 0.999 < ratio <= 1.0 + 1e-9
    assert slow.time[-1] == pytest.approx(0.3 * factor)
    np.testing.assert_array_equal(slow.position, joints.position)
