"""Joints for a learned motion: a path of poses, followed by a URDF arm and slowed down to its limits."""

from pathlib import Path

import dmpcpp
import numpy as np

arm = dmpcpp.Arm.from_urdf_file(Path(__file__).parent / "arm.urdf", base="link0", tip="tool")
ik = dmpcpp.InverseKinematics(arm)  # one for each thread

time = np.linspace(0, 1, 100)  # s
poses = np.tile(np.eye(4), (100, 1, 1))  # tool in link0, m
poses[:, :3, :3] = [dmpcpp.so3.exp([0, np.pi / 2 + 0.3 * t, 0]) for t in time]
poses[:, :3, 3] = np.c_[np.full(100, 0.5), 0.2 * np.sin(np.pi * (time - 0.5)), 0.6 + 0.1 * time]
wipe = dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses))

first = ik.solve(wipe.start)  # the closest joints, and why they are not exact
print("start:", first.status.name, first.position_error, "m off")

joints = ik.follow(wipe.rollout(dt=0.01))
factor = dmpcpp.duration_factor(joints, arm.velocity_limit, np.full(arm.joint_count, 10.0))  # rad/s^2
joints = dmpcpp.stretched(joints, factor)
print(joints.report.summary(), "\nfastest at", joints.time[-1], "s")
assert first.ok and joints.report.complete
