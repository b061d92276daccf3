"""Forward kinematics and Jacobians of many robots, against Pinocchio on the same URDFs."""

from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import Arm, InverseKinematics

pinocchio = pytest.importorskip("pinocchio")
pybullet_data = pytest.importorskip("pybullet_data")

LINKS = {
    "bullet": {
        "franka_panda/panda.urdf": ("panda_link0", "panda_hand"),
        "kuka_iiwa/model.urdf": ("lbr_iiwa_link_0", "lbr_iiwa_link_7"),
        "xarm/xarm6_robot.urdf": ("link_base", "link6"),
    },
    "example": {
        "ur3_robot.urdf": ("base_link", "tool0"),
        "ur5_robot.urdf": ("base_link", "tool0"),
        "ur5_joint_limited_robot.urdf": ("base_link", "tool0"),
        "ur10_robot.urdf": ("base_link", "tool0"),
        "panda.urdf": ("panda_link0", "panda_hand"),
        "z1.urdf": ("link00", "link06"),
        "tiago_no_hand.urdf": ("torso_fixed_link", "arm_tool_link"),
        "talos_left_arm.urdf": ("arm_left_1_link", "gripper_left_base_link"),
        "baxter.urdf": ("torso", "left_wrist"),
        "icub.urdf": ("root_link", "l_hand"),
        "romeo.urdf": ("torso", "l_wrist"),
        "so101.urdf": ("base_link", "gripper_link"),
    },
}


def robots():
    folder = Path(pybullet_data.getDataPath())
    found = [(folder / name, *links) for name, links in LINKS["bullet"].items()]
    try:
        examples = {file.name: file.locate() for file in files("example-robot-data") or []}
    except PackageNotFoundError:
        return found
    return found + [(Path(str(examples[n])), *links) for n, links in LINKS["example"].items() if n in examples]


ROBOTS = robots()


class Pinocchio:
    """The same URDF in another library; joints beside the arm stay at their neutral place."""

    def __init__(self, path, arm):
        self.model = pinocchio.buildModelFromUrdf(str(path))
        self.data = self.model.createData()
        self.base, self.tip = (self.model.getFrameId(link) for link in (arm.base, arm.tip))
        joints = [self.model.joints[self.model.getJointId(name)] for name in arm.joint_names]
        assert all(joint.nq == joint.nv == 1 for joint in joints)
        self.at, self.column = [joint.idx_q for joint in joints], [joint.idx_v for joint in joints]

    def __call__(self, q):
        whole = pinocchio.neutral(self.model)
        whole[self.at] = q
        pinocchio.computeJointJacobians(self.model, self.data, whole)
        pinocchio.updateFramePlacements(self.model, self.data)
        base, tip = self.data.oMf[self.base], self.data.oMf[self.tip]
        world = pinocchio.LOCAL_WORLD_ALIGNED
        jacobian = pinocchio.getFrameJacobian(self.model, self.data, self.tip, world)[:, self.column]
        turn = np.kron(np.eye(2), base.rotation.T)
        return (base.inverse() * tip).homogeneous, turn @ jacobian


def test_there_are_at_least_twelve_robots():
    if len(ROBOTS) <= len(LINKS["bullet"]):
        pytest.skip('example-robot-data is not installed: pip install "dmpcpp[bench]"')
    assert len(ROBOTS) >= 12


@pytest.mark.parametrize(("path", "base", "tip"), ROBOTS, ids=[f"{path.stem}-{tip}" for path, _, tip in ROBOTS])
def test_tip_and_jacobian_agree_to_1e_12(path, base, tip):
    arm = Arm.from_urdf_file(path, base=base, tip=tip)
    other = Pinocchio(path, arm)
    random = np.random.default_rng(1)
    low, high = np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi)
    for q in random.uniform(low, high, (50, arm.joint_count)):
        pose, jacobian = other(q)
        np.testing.assert_allclose(arm.forward_kinematics(q), pose, atol=1e-12)
        np.testing.assert_allclose(arm.jacobian(q), jacobian, atol=1e-12)


@pytest.mark.parametrize(("path", "base", "tip"), ROBOTS, ids=[f"{path.stem}-{tip}" for path, _, tip in ROBOTS])
def test_the_solvers_own_recursion_meets_poses_that_kdl_confirms(path, base, tip):
    arm = Arm.from_urdf_file(path, base=base, tip=tip)
    low, high = np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi)
    joints = np.random.default_rng(2).uniform(low, high, (30, arm.joint_count))
    batch = InverseKinematics(arm, position_tolerance=1e-12, angle_tolerance=1e-12).solve_many(
        arm.forward_kinematics(joints), joints[0]
    )
    assert np.median(batch.position_error) < 1e-12
    assert np.median(batch.angle_error) < 1e-11
