"""What dmpcpp's kinematics are worth, measured: single poses, smooth paths, and paths known to be feasible.

    python benchmarks/kinematics.py [--poses 10000] [--paths 20] [--arms panda,iiwa,xarm6]

Fixed seeds; times are CPU time of this thread. Every error is computed from the arm's forward kinematics (KDL). The
arms' URDFs come with PyBullet. The rule for feasible paths: the joints pass through four random postures on a cubic
spline with ends at rest, inside 90 % of every range; each posture lies the share `reach` of the way from the one
before to a uniformly random one (0.35 easy, 0.8 hard). Only the tip's 1000 poses over 10 s are given, and no start.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import dmpcpp
import numpy as np
from dmpcpp import Arm, IkBackend, InverseKinematics, arms
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]
_TOLERANCE = 1e-5  # m and rad


def random_joints(arm: Arm, random: np.random.Generator, count: int) -> Array:
    """Uniform in the limits, (count, n)."""
    return random.uniform(arm.lower, arm.upper, (count, arm.joint_count))


def errors(arm: Arm, joints: Array, poses: Array) -> tuple[Array, Array]:
    """Position [m] and angle [rad] between the tip at the joints and the poses."""
    tips = arm.forward_kinematics(joints)
    between = poses[:, :3, :3] @ np.swapaxes(tips[:, :3, :3], 1, 2)
    return np.linalg.norm(poses[:, :3, 3] - tips[:, :3, 3], axis=1), Rotation.from_matrix(between).magnitude()


def met(arm: Arm, joints: Array, poses: Array) -> NDArray[np.bool_]:
    """Whether joints hold the limits and the tolerance."""
    position, angle = errors(arm, joints, poses)
    inside = np.all((joints >= arm.lower) & (joints <= arm.upper), axis=1)
    return inside & (position <= _TOLERANCE) & (angle <= _TOLERANCE)


def seconds_of(work: Callable[[], object]) -> float:
    """CPU seconds that the work takes."""
    begin = time.thread_time()
    work()
    return time.thread_time() - begin


def single_poses(name: str, arm: Arm, backend: IkBackend, count: int) -> None:
    """Random reachable poses from random seeds, one call each."""
    random = np.random.default_rng(1)
    poses = arm.forward_kinematics(random_joints(arm, random, count))
    seeds = random_joints(arm, random, count)
    solver = InverseKinematics(
        arm, backend=backend, position_tolerance=0.5 * _TOLERANCE, angle_tolerance=0.5 * _TOLERANCE, diagnose=False
    )
    joints, times = np.empty_like(seeds), np.empty(count)
    for k, (pose, seed) in enumerate(zip(poses, seeds, strict=True)):
        begin = time.thread_time()
        joints[k] = solver.solve(pose, seed).joints
        times[k] = time.thread_time() - begin
    share = np.mean(met(arm, joints, poses))
    median, late = 1e6 * np.quantile(times, [0.5, 0.99])
    print(f"{name:6} {backend.name:10} {count:6} poses  {100 * share:6.2f} % met  {median:7.1f} us, p99 {late:8.1f} us")


def smooth_path(name: str, arm: Arm) -> None:
    """A circle of 0.1 m with a swing of 0.4 rad about the arm's middle, followed from its first joints."""
    angle = np.linspace(0.0, 2.0 * np.pi, 1000)
    poses = np.tile(arm.forward_kinematics(0.6 * InverseKinematics(arm).middle + 0.4), (1000, 1, 1))
    poses[:, :3, :3] = Rotation.from_rotvec(np.outer(np.sin(angle), [0.4, 0.0, 0.0])).as_matrix() @ poses[0, :3, :3]
    poses[:, :3, 3] += 0.1 * np.stack([np.cos(angle) - 1.0, np.sin(angle), 0.0 * angle], axis=1)
    solver = InverseKinematics(arm)
    times = np.linspace(0.0, 10.0, 1000)
    whole = solver.follow(poses, times=times)
    begin = whole.position[0]
    each = min(seconds_of(lambda: solver.follow(poses, times=times, start=begin)) for _ in range(5)) / 1000
    position, _ = errors(arm, whole.position, poses)
    print(
        f"{name:6} smooth path: {whole.report.solved} of 1000 met, {position.max():.1e} m, "
        f"{1e6 * each:.2f} us a pose from a given start, report and spline included"
    )


def feasible_path(arm: Arm, random: np.random.Generator, reach: float) -> Array:
    """Poses of the tip along random joints inside 90 % of the limits."""
    middle, half = (arm.lower + arm.upper) / 2, 0.9 * (arm.upper - arm.lower) / 2
    while True:
        through = middle + half * random.uniform(-1.0, 1.0, (4, arm.joint_count))
        for k in range(1, 4):
            through[k] = through[k - 1] + reach * (through[k] - through[k - 1])
        joints = CubicSpline(np.arange(4.0), through, bc_type="clamped")(np.linspace(0.0, 3.0, 1000))
        if np.all(np.abs(joints - middle) <= half):
            return arm.forward_kinematics(joints)


def feasible_paths(name: str, arm: Arm, reach: float, count: int) -> None:
    """The share of feasible paths that are followed whole."""
    random = np.random.default_rng(2)
    solver = InverseKinematics(arm)
    complete, times = 0, []
    for _ in range(count):
        poses = feasible_path(arm, random, reach)
        begin = time.thread_time()
        joints = solver.follow(poses, times=np.linspace(0.0, 10.0, 1000))
        times.append(time.thread_time() - begin)
        steps = np.abs(np.diff(joints.position, axis=0)).max()
        complete += bool(np.all(met(arm, joints.position, poses)) and steps <= 0.2)
    print(
        f"{name:6} feasible paths, reach {reach}: {complete} of {count} whole, "
        f"median {1e3 * np.median(times):.0f} ms, longest {1e3 * np.max(times):.0f} ms"
    )


def scaling(name: str, arm: Arm) -> None:
    """The cost of the duration factor."""
    joints = InverseKinematics(arm).follow(
        feasible_path(arm, np.random.default_rng(3), 0.35), times=np.linspace(0.0, 10.0, 1000)
    )
    limit = arms.acceleration_limit(arm)
    each = min(seconds_of(lambda: dmpcpp.duration_factor(joints, arm.velocity_limit, limit)) for _ in range(20))
    print(f"{name:6} duration factor of 1000 x {arm.joint_count}: {1e6 * each:.0f} us")


def main() -> None:
    """Run all of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=int, default=10_000)
    parser.add_argument("--paths", type=int, default=20)
    parser.add_argument("--arms", default="panda,iiwa,xarm6")
    chosen = parser.parse_args()
    for name in chosen.arms.split(","):
        arm = arms.find(name)
        single_poses(name, arm, IkBackend.bounded_lm, chosen.poses)
        single_poses(name, arm, IkBackend.kdl_lma, chosen.poses // 10)
        single_poses(name, arm, IkBackend.kdl_nr_jl, chosen.poses // 10)
        smooth_path(name, arm)
        for reach in (0.35, 0.8):
            feasible_paths(name, arm, reach, chosen.paths)
        scaling(name, arm)


if __name__ == "__main__":
    main()
