"""dmp::kinematics from Python, on the arms that PyBullet ships: PyBullet and SciPy are the oracles."""

import itertools
import threading
from pathlib import Path
from types import SimpleNamespace

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Arm, IkBackend, IkStatus, InverseKinematics, JointTrajectory
from dmpcpp.errors import IkError

from benchmarks import kinematics_causes as causes

pybullet = pytest.importorskip("pybullet")
pybullet_data = pytest.importorskip("pybullet_data")

ARMS = {
    "panda": ("franka_panda/panda.urdf", "panda_link0", "panda_hand"),
    "iiwa": ("kuka_iiwa/model.urdf", "lbr_iiwa_link_0", "lbr_iiwa_link_7"),
    "xarm6": ("xarm/xarm6_robot.urdf", "link_base", "link6"),
}


def urdf_path(name: str) -> Path:
    return Path(pybullet_data.getDataPath()) / ARMS[name][0]


def load(name: str) -> Arm:
    _, base, tip = ARMS[name]
    return Arm.from_urdf_file(urdf_path(name), base=base, tip=tip)


@pytest.fixture(params=list(ARMS))
def arm(request: pytest.FixtureRequest) -> Arm:
    return load(request.param)


@pytest.fixture
def panda() -> Arm:
    return load("panda")


def random_joints(arm: Arm, count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(arm.lower, arm.upper, (count, arm.joint_count))


def feasible_path(arm: Arm, count: int = 200, seed: int = 0) -> np.ndarray:
    """Poses of the tip on a smooth way between two postures inside the limits."""
    a, b = random_joints(arm, 2, seed) * 0.9
    s = (0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count)))[:, None]
    return arm.forward_kinematics(np.clip(a + 0.4 * s * (b - a), arm.lower, arm.upper))


def pose_errors(actual: np.ndarray, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    from scipy.spatial.transform import Rotation

    position = np.linalg.norm(actual[..., :3, 3] - wanted[..., :3, 3], axis=-1)
    between = wanted[..., :3, :3] @ np.swapaxes(actual[..., :3, :3], -1, -2)
    return position, Rotation.from_matrix(between.reshape(-1, 3, 3)).magnitude()


class Bullet:
    """The same URDF in a physics engine of its own."""

    def __init__(self, name: str, arm: Arm) -> None:
        self.client = pybullet.connect(pybullet.DIRECT)
        self.body = pybullet.loadURDF(str(urdf_path(name)), useFixedBase=True, physicsClientId=self.client)
        infos = [
            pybullet.getJointInfo(self.body, i, physicsClientId=self.client)
            for i in range(pybullet.getNumJoints(self.body, physicsClientId=self.client))
        ]
        by_joint = {info[1].decode(): info[0] for info in infos}
        by_link = {info[12].decode(): info[0] for info in infos}
        self.joints = [by_joint[joint] for joint in arm.joint_names]
        self.tip = by_link[arm.tip]
        self.base = by_link.get(arm.base)

    def link_pose(self, index: int | None) -> np.ndarray:
        pose = np.eye(4)
        if index is None:  # the base link; PyBullet gives the pose of its centre of mass
            dynamics = pybullet.getDynamicsInfo(self.body, -1, physicsClientId=self.client)
            inverse = pybullet.invertTransform(dynamics[3], dynamics[4])
            body = pybullet.getBasePositionAndOrientation(self.body, physicsClientId=self.client)
            position, quaternion = pybullet.multiplyTransforms(*body, *inverse)
        else:
            state = pybullet.getLinkState(self.body, index, computeForwardKinematics=True, physicsClientId=self.client)
            position, quaternion = state[4], state[5]
        pose[:3, :3] = np.reshape(pybullet.getMatrixFromQuaternion(quaternion), (3, 3))
        pose[:3, 3] = position
        return pose

    def forward_kinematics(self, q: np.ndarray) -> np.ndarray:
        for joint, value in zip(self.joints, q, strict=True):
            pybullet.resetJointState(self.body, joint, value, physicsClientId=self.client)
        return np.linalg.inv(self.link_pose(self.base)) @ self.link_pose(self.tip)

    def close(self) -> None:
        pybullet.disconnect(self.client)


@pytest.mark.parametrize("name", list(ARMS))
def test_forward_kinematics_agree_with_pybullet(name: str) -> None:
    arm = load(name)
    bullet = Bullet(name, arm)
    for q in random_joints(arm, 100):
        # PyBullet stores the URDF's transforms in single precision where it reads them.
        np.testing.assert_allclose(arm.forward_kinematics(q), bullet.forward_kinematics(q), atol=2e-6)
    bullet.close()


def test_an_arm_tells_its_limits_as_numpy_arrays(panda: Arm) -> None:
    assert panda.joint_count == 7
    assert panda.joint_names == [f"panda_joint{i}" for i in range(1, 8)]
    assert panda.lower.shape == panda.upper.shape == (7,)
    np.testing.assert_allclose(panda.velocity_limit, [2.175] * 4 + [2.61] * 3)
    np.testing.assert_allclose(panda.effort_limit, [87.0] * 4 + [12.0] * 3)
    assert Path(panda.folder) == urdf_path("panda").parent
    assert panda.urdf == urdf_path("panda").read_text()
    assert "panda_hand" in repr(panda)


def test_poses_and_jacobians_are_c_contiguous_and_owned(panda: Arm) -> None:
    q = random_joints(panda, 3)
    for array, shape in [
        (panda.forward_kinematics(q[0]), (4, 4)),
        (panda.forward_kinematics(q), (3, 4, 4)),
        (panda.jacobian(q[0]), (6, 7)),
    ]:
        assert array.shape == shape
        assert array.flags.c_contiguous
    np.testing.assert_array_equal(panda.forward_kinematics(q)[2], panda.forward_kinematics(q[2]))


def test_limits_can_be_replaced(panda: Arm) -> None:
    slow = panda.with_limits(velocity=np.full(7, 0.5))
    np.testing.assert_array_equal(slow.velocity_limit, 0.5)
    np.testing.assert_array_equal(slow.lower, panda.lower)
    with pytest.raises(dmpcpp.InvalidArgument, match=r"velocity\[3\]"):
        panda.with_limits(velocity=[1, 1, 1, 0, 1, 1, 1])


def test_errors_about_links_list_those_that_exist() -> None:
    with pytest.raises(dmpcpp.InvalidArgument, match="panda_grasptarget, panda_leftfinger"):
        Arm.from_urdf_file(urdf_path("panda"))
    with pytest.raises(ValueError, match=r"no link 'wrist'.*panda_link7"):
        Arm.from_urdf_file(urdf_path("panda"), tip="wrist")


def test_a_missing_file_is_an_oserror_that_names_it(tmp_path: Path) -> None:
    with pytest.raises(OSError, match=r"nothing\.urdf"):
        Arm.from_urdf_file(tmp_path / "nothing.urdf")


def test_nothing_is_printed_about_a_bad_urdf(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(dmpcpp.InvalidArgument):
        Arm.from_urdf("<robot name='r'><link name='a'/><joint name='j' type='revolute'/></robot>")
    assert capfd.readouterr() == ("", "")


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


def test_velocity_and_acceleration_are_those_of_scipys_spline(panda: Arm) -> None:
    scipy_interpolate = pytest.importorskip("scipy.interpolate")
    rng = np.random.default_rng(3)
    times = np.cumsum(rng.uniform(0.05, 0.3, 40))
    joints = JointTrajectory.through(times, rng.uniform(-1.0, 1.0, (40, 4)))
    spline = scipy_interpolate.CubicSpline(times, joints.position)
    np.testing.assert_allclose(joints.velocity, spline(times, 1), atol=1e-9)
    np.testing.assert_allclose(joints.acceleration, spline(times, 2), atol=1e-7)


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
