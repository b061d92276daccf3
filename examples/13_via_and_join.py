"""A pose is passed that is seen on the way, and another motion goes on from where the first one is."""

import dmpcpp
import numpy as np
from dmpcpp import Via, so3


def reach(at: float, turn: float) -> dmpcpp.PoseDmp:
    """Return a reach of 0.4 m along x that turns by `turn` rad, from `at` on."""
    time = np.linspace(0, 2, 101)
    way = np.polyval([6, -15, 10, 0, 0, 0], time / 2)
    poses = np.tile(np.eye(4), (len(time), 1, 1))
    poses[:, :3, :3] = [so3.exp([0, 0, turn * w]) for w in way]
    poses[:, :3, 3] = np.c_[at + 0.4 * way, 0 * way, 0.3 + 0 * way]
    return dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses))


there, back = reach(0.0, 0.8), reach(0.4, -0.8)
run = dmpcpp.PoseRun(there)
run.step(0.6)

# A pose to pass at six tenths, changed within a quarter of the phase.
via = run.ahead(0.6).point.copy()
via[2, 3] += 0.1
run.via(0.6, via, reach=0.25)
run.step(0.6)
print(f"missed by {np.linalg.norm(run.position - via[:3, 3]):.1e} m")

# On with the next motion, at speed.
acceleration = run.acceleration
run.join(back, reach=0.4)
print(f"the acceleration jumps by {np.linalg.norm(run.acceleration - acceleration):.1e}")
while run.step(0.01):
    pass
print(f"ends {np.linalg.norm(run.position - back.goal[:3, 3]):.1e} m from the goal")

# The same as one value, which is saved and planned like a model, and a rollout past a via-pose.
both = dmpcpp.PoseDmpSequence([there, back], leave=[0.6, 1.0], reach=0.4)
print(f"{both.duration:.1f} s in all")
past = there.rollout(via=[Via(0.6, via)])
print(f"{np.abs(past.pose - via).max(axis=(1, 2)).min():.1e} m from the via-pose")
