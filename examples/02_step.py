"""Step through a motion as a control loop does, and change the goal and the tempo on the way."""

import dmpcpp
import numpy as np

time = np.linspace(0, 1, 100)  # s
position = np.c_[time**2 * (3 - 2 * time), 0.5 * np.sin(np.pi * time) ** 2]  # m
reach = dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, position))

run = dmpcpp.Run(reach)  # one for each loop or thread
moved = np.array([1.2, 0.1])
steps = 0
while run.step(1e-3):  # True while the motion runs
    steps += 1
    if steps == 300:
        run.goal = moved
    if steps == 600:
        run.duration = 1.5  # s; the path stays the same
for _ in range(500):
    run.step(1e-3)  # the spring holds the goal
print(steps, "steps, at", run.position, "m, moving at", np.linalg.norm(run.velocity), "m/s")
assert np.linalg.norm(run.position - moved) < 1e-3
