"""Carry out joints under physics, with computed torque at 1 kHz, and judge the run (needs PyBullet)."""

from pathlib import Path

import dmpcpp
import numpy as np
from dmpcpp import simulation

arm = dmpcpp.Arm.from_urdf_file(Path(__file__).parent / "arm.urdf", base="link0", tip="tool")
time = np.linspace(0, 2, 60)  # s
s = time / time[-1]
minimum_jerk = s**3 * (10 - 15 * s + 6 * s**2)
start, end = np.array([0, 0.5, 0, 1.0, 0, 0.5, 0]), np.array([0.6, 0.3, 0.2, 1.3, 0, 0.8, 0.4])  # rad
joints = dmpcpp.JointTrajectory.through(time, start + np.outer(minimum_jerk, end - start), arm.joint_names)

log = simulation.execute(arm, joints)
for check in log.verdict.checks:
    print("ok  " if check.ok else "FAIL", check.name, check.value)
print("tool error", 1e3 * log.errors.position_rmse, "mm;", log.caveat)
assert log.errors.position_rmse < 1e-4
