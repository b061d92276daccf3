"""Joints for single poses: SciPy and the arm's own forward kinematics are the oracles."""

import itertools

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Arm, IkBackend, IkStatus, InverseKinematics
from dmpcpp.errors import IkError

from benchmarks import kinematics_causes as causes
from tests.python.postures import pose_errors, random_joints


def test_every_random_reachable_pose_is_met_within_the_limits(arm: Arm) -> None:
    goals = arm.forward_kinematics(random_joints(arm, 1000, seed=1))
    batch = InverseKinematics(arm).solve_many(goals)
    assert batch.solved == 1000
    assert np.all(batch.joints >= arm.lower) and np.all(batch.joints <= arm.upper)
    position, angle = pose_errors(arm.forward_kinematics(batch.joints), goals)
    assert position.max() <= 1e-6
    assert angle.max() <= 1.1e-6


def test_a_solution_tells_what_it_is_worth(panda: Arm) -> None:
    goal = panda.forward_kinematics(random_joints(panda, 1)[0])
    found = InverseKinematics(panda).solve(goal)
    assert found.ok and found.status is IkStatus.ok
    assert found.position_error <= 1e-6 and found.angle_error <= 1e-6
    margin = np.minimum(found.joints - panda.lower, panda.upper - found.joints).min()
    assert found.limit_margin == pytest.approx(margin)
    assert found.blocked == []


@pytest.mark.parametrize("backend", list(IkBackend))
def test_joints_are_within_the_limits_even_where_a_backend_fails(arm: Arm, backend: IkBackend) -> None:
    random = np.random.default_rng(1)
    goals = arm.forward_kinematics(random.uniform(arm.lower, arm.upper, (1000, arm.joint_count)))[:40]
    seeds = random.uniform(arm.lower, arm.upper, (1000, arm.joint_count))
    solver = InverseKinematics(arm, backend=backend, position_tolerance=5e-6, angle_tolerance=5e-6, diagnose=False)
    for goal, seed in zip(goals, seeds, strict=False):
        found = solver.solve(goal, seed)
        assert np.all(found.joints >= arm.lower) and np.all(found.joints <= arm.upper)
        assert np.isfinite(found.position_error) and np.isfinite(found.angle_error)


def test_a_pose_out_of_reach_gives_the_closest_joints_and_says_so(panda: Arm) -> None:
    goal = panda.forward_kinematics(random_joints(panda, 1)[0])
    goal[:3, 3] = [2.0, 0.0, 0.4]
    found = InverseKinematics(panda).solve(goal)
    assert found.status is IkStatus.out_of_reach
    assert not found.ok
    tip = panda.forward_kinematics(found.joints)
    assert np.linalg.norm(goal[:3, 3] - tip[:3, 3]) == pytest.approx(found.position_error)


@pytest.mark.parametrize("pose", [np.full((4, 4), np.nan), np.diag([1.0, 1.0, -1.0, 1.0]), np.zeros((4, 4))])
def test_poses_that_are_none_are_valueerrors(panda: Arm, pose: np.ndarray) -> None:
    ik = InverseKinematics(panda)
    with pytest.raises(dmpcpp.InvalidArgument, match="pose"):
        ik.solve(pose)
    with pytest.raises(dmpcpp.InvalidArgument, match=r"poses\[1\]"):
        ik.solve_many([panda.forward_kinematics(ik.middle), pose])
    with pytest.raises(dmpcpp.InvalidArgument, match=r"poses\[0\]"):
        ik.follow([pose], times=[0.0])


def test_wrong_shapes_are_refused_by_name(panda: Arm) -> None:
    ik = InverseKinematics(panda)
    with pytest.raises(dmpcpp.InvalidArgument, match="pose"):
        ik.solve(np.eye(3))
    with pytest.raises(dmpcpp.InvalidArgument, match="seed"):
        ik.solve(np.eye(4), seed=np.zeros(6))
    with pytest.raises(dmpcpp.InvalidArgument, match="q"):
        panda.forward_kinematics(np.zeros((2, 6)))
    with pytest.raises(dmpcpp.InvalidArgument, match="times"):
        ik.follow(np.eye(4)[None])


def test_options_are_keywords_and_unknown_ones_are_refused(panda: Arm) -> None:
    ik = InverseKinematics(panda, position_tolerance=1e-9, iteration_limit=500)
    assert ik.options.position_tolerance == 1e-9
    assert ik.options.iteration_limit == 500
    with pytest.raises(TypeError, match="position_tolerence"):
        InverseKinematics(panda, position_tolerence=1e-9)
    with pytest.raises(dmpcpp.InvalidArgument, match="max_step"):
        InverseKinematics(panda, max_step=0.0)


def test_strict_raises_with_the_report_of_what_was_missed(panda: Arm) -> None:
    ik = InverseKinematics(panda)
    far = np.eye(4)
    far[:3, 3] = [3.0, 0.0, 0.5]
    assert ik.solve(far).status == IkStatus.out_of_reach
    with pytest.raises(IkError, match="out_of_reach") as missed:
        ik.solve(far, strict=True)
    assert missed.value.report.position_error > 1.0
    path = np.tile(far, (3, 1, 1))
    with pytest.raises(IkError, match="0 of 3") as missed:
        ik.follow(path, times=[0.0, 1.0, 2.0], strict=True, thorough=False)
    assert missed.value.report.missed == [(0, 2)]
    near = panda.forward_kinematics(ik.middle)
    assert ik.solve(near, strict=True).ok


def test_branches_are_different_joints_for_one_pose_and_start_a_path(arm: Arm) -> None:
    ik = InverseKinematics(arm)
    pose = arm.forward_kinematics(random_joints(arm, 1, seed=5)[0])
    found = list(itertools.islice(ik.branches(pose, apart=1.0), 5))
    assert len(found) >= 2
    for i, branch in enumerate(found):
        position, angle = pose_errors(arm.forward_kinematics(branch.joints), pose)
        assert branch.ok and position < 1e-5 and angle.max() < 1e-5
        assert all(np.abs(branch.joints - other.joints).max() >= 1.0 for other in found[:i])
    joints = ik.follow(pose[None], times=[0.0], start=found[1].joints)
    np.testing.assert_allclose(joints.position[0], found[1].joints, atol=1e-4)


def test_what_is_not_finite_is_a_value_error(panda: Arm) -> None:
    ik = InverseKinematics(panda)
    pose = panda.forward_kinematics(ik.middle)
    with pytest.raises(ValueError, match="pose"):
        ik.solve(np.full((4, 4), np.nan))
    with pytest.raises(ValueError, match="seed"):
        ik.solve(pose, np.full(7, np.nan))
    with pytest.raises(ValueError, match="pose"):
        ik.branches(np.full((4, 4), np.nan))


@pytest.mark.slow
def test_unreachable_poses_are_met_as_closely_as_500_restarts_and_their_cause_is_named(arm: Arm) -> None:
    for kind in ("beyond", "limits", "step", "singular"):
        random = np.random.default_rng(11)
        for case in itertools.islice(causes.cases(arm, kind, random), 2):
            result = causes.answer(arm, case)
            assert result.status.name == case.status
            assert causes.held(arm, case, result)
            if kind in ("beyond", "limits"):
                known = causes.closest_of_restarts(arm, case.pose, 500, random)
                assert causes.distance(result) <= 1.01 * known
