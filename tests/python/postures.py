"""Joints, poses and errors for the tests of arms' kinematics."""

import numpy as np
from dmpcpp import Arm
from scipy.spatial.transform import Rotation


def random_joints(arm: Arm, count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(arm.lower, arm.upper, (count, arm.joint_count))


def feasible_path(arm: Arm, count: int = 200, seed: int = 0) -> np.ndarray:
    """Poses of the tip on a smooth way between two postures inside the limits."""
    a, b = random_joints(arm, 2, seed) * 0.9
    s = (0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count)))[:, None]
    return arm.forward_kinematics(np.clip(a + 0.4 * s * (b - a), arm.lower, arm.upper))


def pose_errors(actual: np.ndarray, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    position = np.linalg.norm(actual[..., :3, 3] - wanted[..., :3, 3], axis=-1)
    between = wanted[..., :3, :3] @ np.swapaxes(actual[..., :3, :3], -1, -2)
    return position, Rotation.from_matrix(between.reshape(-1, 3, 3)).magnitude()
