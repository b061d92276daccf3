"""Arms from URDFs: PyBullet, which reads the same files by itself, is the oracle."""

import pickle
from pathlib import Path

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Arm, arms

from tests.python.postures import random_joints

pybullet = pytest.importorskip("pybullet")
pybullet_data = pytest.importorskip("pybullet_data")


def urdf_path(name: str) -> Path:
    return Path(pybullet_data.getDataPath()) / arms.KNOWN[name].urdf


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


@pytest.mark.parametrize("name", ["panda", "iiwa", "xarm6"])
def test_forward_kinematics_agree_with_pybullet(name: str) -> None:
    arm = arms.find(name)
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


def test_limits_name_their_source_joint_by_joint(panda: Arm) -> None:
    panda = Arm.from_urdf(panda.urdf, panda.base, panda.tip)
    unstated, user, maker = dmpcpp.LimitSource.unstated, dmpcpp.LimitSource.user, dmpcpp.LimitSource.maker
    assert set(panda.limit_sources["acceleration"]) == {dmpcpp.LimitSource.assumed}
    assert set(panda.limit_sources["jerk"]) == {unstated}
    stated = panda.with_limits(jerk=[5.0] * 6 + [np.inf], acceleration=np.full(7, 3.0))
    np.testing.assert_array_equal(stated.acceleration_limit, 3.0)
    assert stated.limit_sources["jerk"] == (user,) * 6 + (unstated,)
    assert stated.limit_sources["velocity"] == panda.limit_sources["velocity"]
    mixed = panda.with_limits(effort=np.full(7, 9.0), source={"effort": (maker,) * 3 + (user,) * 4})
    assert mixed.limit_sources["effort"] == (maker,) * 3 + (user,) * 4
    with pytest.raises(dmpcpp.InvalidArgument, match=r"jerk\[1\]: 0.*expected > 0"):
        panda.with_limits(jerk=[1, 0, 1, 1, 1, 1, 1])
    with pytest.raises(dmpcpp.InvalidArgument, match="source: 3 values, expected 7"):
        panda.with_limits(effort=np.full(7, 9.0), source={"effort": (maker,) * 3})


def test_limits_and_their_sources_go_through_a_pickle(panda: Arm) -> None:
    stated = panda.with_limits(
        jerk=np.arange(1.0, 8.0),
        acceleration=np.full(7, 4.0),
        source={"jerk": (dmpcpp.LimitSource.maker,) * 7, "acceleration": (dmpcpp.LimitSource.user,) * 7},
    )
    copy = pickle.loads(pickle.dumps(stated))
    assert copy.limit_sources == stated.limit_sources
    np.testing.assert_array_equal(copy.jerk_limit, stated.jerk_limit)
    np.testing.assert_array_equal(copy.acceleration_limit, stated.acceleration_limit)


def test_errors_about_links_list_those_that_exist() -> None:
    with pytest.raises(dmpcpp.InvalidArgument, match=r"no link 'hand'.*panda_grasptarget, panda_hand"):
        Arm.from_urdf_file(urdf_path("panda"), base="hand")
    with pytest.raises(ValueError, match=r"no link 'wrist'.*panda_link7"):
        Arm.from_urdf_file(urdf_path("panda"), tip="wrist")


def test_a_missing_file_is_an_oserror_that_names_it(tmp_path: Path) -> None:
    with pytest.raises(OSError, match=r"nothing\.urdf"):
        Arm.from_urdf_file(tmp_path / "nothing.urdf")


def test_nothing_is_printed_about_a_bad_urdf(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(dmpcpp.InvalidArgument):
        Arm.from_urdf("<robot name='r'><link name='a'/><joint name='j' type='revolute'/></robot>")
    assert capfd.readouterr() == ("", "")
