"""The arms of the kinematics benchmark, their random poses and paths, and what counts as met."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

import numpy as np
from dmpcpp import Arm, InverseKinematics, arms
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]
TOLERANCE = 1e-5
"""m and rad"""
ANGLE_WEIGHT = 0.1
"""m per rad"""
TIME = np.linspace(0.0, 10.0, 1000)
"""s, of every path"""


def load(name: str) -> tuple[Arm, str]:
    """Return an arm and the path of its URDF: panda, iiwa, xarm6 (pybullet_data), ur5 (example-robot-data)."""
    if name != "ur5":
        arm = arms.find(name)
        return arm, str(Path(arm.folder) / Path(arms.KNOWN[name].urdf).name)
    path = example_urdf("ur5_robot.urdf")
    if path is None:
        raise SystemExit('ur5: not installed; pip install "dmpcpp[bench]".')
    return Arm.from_urdf_file(path, base="base_link", tip="tool0"), path


def example_urdf(name: str) -> str | None:
    """Return the path of a URDF of the package example-robot-data, None if that is not installed."""
    try:
        found = [file for file in files("example-robot-data") or [] if file.name == name]
    except PackageNotFoundError:
        return None
    return str(found[0].locate()) if found else None


def random_joints(arm: Arm, random: np.random.Generator, count: int) -> Array:
    """Uniform in the limits, (count, n)."""
    return random.uniform(arm.lower, arm.upper, (count, arm.joint_count))


def errors(arm: Arm, joints: Array, poses: Array) -> tuple[Array, Array]:
    """Position [m] and angle [rad] between the tip at the joints and the poses, by KDL's forward kinematics."""
    tips = arm.forward_kinematics(joints)
    between = poses[:, :3, :3] @ np.swapaxes(tips[:, :3, :3], 1, 2)
    return np.linalg.norm(poses[:, :3, 3] - tips[:, :3, 3], axis=1), Rotation.from_matrix(between).magnitude()


def inside(arm: Arm, joints: Array) -> NDArray[np.bool_]:
    """Whether joints hold the limits."""
    return np.all((joints >= arm.lower) & (joints <= arm.upper), axis=1)


def met(arm: Arm, joints: Array, poses: Array) -> NDArray[np.bool_]:
    """Whether joints hold the limits and the tolerance."""
    position, angle = errors(arm, joints, poses)
    return inside(arm, joints) & (position <= TOLERANCE) & (angle <= TOLERANCE)


def smooth_path(arm: Arm) -> Array:
    """A circle of 0.1 m with a swing of 0.4 rad about the arm's middle, 1000 poses."""
    angle = np.linspace(0.0, 2.0 * np.pi, len(TIME))
    poses = np.tile(arm.forward_kinematics(0.6 * InverseKinematics(arm).middle + 0.4), (len(TIME), 1, 1))
    poses[:, :3, :3] = Rotation.from_rotvec(np.outer(np.sin(angle), [0.4, 0.0, 0.0])).as_matrix() @ poses[0, :3, :3]
    poses[:, :3, 3] += 0.1 * np.stack([np.cos(angle) - 1.0, np.sin(angle), 0.0 * angle], axis=1)
    return poses


def feasible_path(arm: Arm, random: np.random.Generator, reach: float) -> Array:
    """Poses of the tip along random joints inside 90 % of the limits (the rule: see benchmarks.kinematics)."""
    middle, half = (arm.lower + arm.upper) / 2, 0.9 * (arm.upper - arm.lower) / 2
    while True:
        through = middle + half * random.uniform(-1.0, 1.0, (4, arm.joint_count))
        for k in range(1, 4):
            through[k] = through[k - 1] + reach * (through[k] - through[k - 1])
        joints = CubicSpline(np.arange(4.0), through, bc_type="clamped")(np.linspace(0.0, 3.0, len(TIME)))
        if np.all(np.abs(joints - middle) <= half):
            return arm.forward_kinematics(joints)
