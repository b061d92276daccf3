import numpy as np
import dmpcpp

time = np.linspace(0, 2, 200)
turning = dmpcpp.OrientationDemonstration.from_euler(time, np.c_[0.5 * time, 0 * time, 0.2 * time], "ZYX")
poses = np.tile(np.eye(4), (200, 1, 1))  # [R p; 0 1], m
poses[:, :3, :3] = turning.rotation  # from quaternions: OrientationDemonstration.from_quaternions(time, q, "xyzw")
poses[:, :3, 3] = np.c_[0.1 * np.sin(time), 0.1 * np.cos(time), 0.05 * time]
model = dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses))
plan = model.rollout(duration=4.0, dt=0.01)  # twice as slow, the same path
print(plan.pose.shape, plan.twist.shape, np.abs(plan.pose[-1] - poses[-1]).max())
