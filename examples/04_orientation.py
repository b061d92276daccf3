"""Learn an orientation that was recorded as Euler angles, and turn to another goal."""

import dmpcpp
import numpy as np

time = np.linspace(0, 2, 200)  # s
angles = np.c_[0.8 * np.sin(time), 0.5 * np.cos(time), 0.6 * time]  # rad: yaw, pitch, roll about the moving axes
model = dmpcpp.OrientationDmp.fit(dmpcpp.OrientationDemonstration.from_euler(time, angles, convention="ZYX"))

goal = model.goal @ dmpcpp.so3.exp([0, 0, 0.2])  # 0.2 rad further
plan = model.rollout(goal=goal, duration=3.0, dt=0.01)
last = plan.rotation[-1]
print("ends at yaw, pitch, roll =", dmpcpp.so3.to_euler(last, "ZYX"), "rad")
assert dmpcpp.so3.distance(last, goal) < 1e-3
