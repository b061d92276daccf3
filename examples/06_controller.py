"""A loop at 100 Hz with absolute deadlines and an overrun count; for 1 kHz and hard deadlines there is C++."""

import sys
import time

import dmpcpp
import numpy as np

PERIOD = 0.01  # s

moments = np.linspace(0, 2, 200)  # s
poses = np.tile(np.eye(4), (200, 1, 1))
poses[:, :3, :3] = [dmpcpp.so3.exp([0.2 * t, 0, 0.5 * t]) for t in moments]
poses[:, :3, 3] = np.c_[0.1 * np.sin(moments), 0.1 * np.cos(moments), 0.05 * moments]
run = dmpcpp.PoseRun(dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(moments, poses)))
run.duration = float(sys.argv[1]) if len(sys.argv) > 1 else 0.5  # s

ticks = overruns = 0
deadline = time.monotonic()
while run.step(PERIOD):  # here a robot would be sent run.pose and run.twist
    ticks += 1
    deadline += PERIOD
    rest = deadline - time.monotonic()
    if rest > 0:
        time.sleep(rest)
    else:
        overruns += 1
print(ticks, "ticks,", overruns, "overruns")
assert run.status is dmpcpp.Status.finished
