"""Learn the pose of a tool and the opening of its gripper in one phase, save them, and go to a new goal."""

import tempfile
from pathlib import Path

import dmpcpp
import numpy as np

time = np.linspace(0, 2, 100)  # s
s = time / 2
way = s**2 * (3 - 2 * s)
poses = np.tile(np.eye(4), (100, 1, 1))
poses[:, :3, :3] = [dmpcpp.so3.exp([0, 0, angle]) for angle in way]
poses[:, :3, 3] = np.c_[0.4 * way, np.zeros(100), 0.3 * np.sin(np.pi * s)]  # m
opening = 0.04 * (1 - way)  # m, closes on the way
grasp = dmpcpp.PoseGripperDmp.fit(dmpcpp.PoseGripperDemonstration(time, poses, opening))

with tempfile.TemporaryDirectory() as folder:
    dmpcpp.save(grasp, Path(folder) / "grasp.json")
    grasp = dmpcpp.load(Path(folder) / "grasp.json")

there, _ = grasp.goal
there = there.copy()  # what a model hands out cannot be written to
there[1, 3] += 0.1  # m
plan = grasp.rollout(goal=(there, [0.005]), duration=3.0)  # it closes on something 5 mm wide
print("ends at\n", plan.pose[-1], "\nopen by", plan.gripper[-1], "m")
assert np.allclose(plan.pose[-1], there, atol=1e-3)
assert np.allclose(plan.gripper[-1], 0.005, atol=1e-4)
