"""A reach that keeps limits and goes around a ball that comes across."""

import dmpcpp
import numpy as np

time = np.linspace(0.0, 2.0, 101)
s = time / 2.0
path = np.c_[0.6 * s**3 * (10 - 15 * s + 6 * s**2), 0.1 * np.sin(np.pi * s), np.full(101, 0.3)]
model = dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, path))

ball = dmpcpp.Sphere([0.3, 0.4, 0.3], 0.08, velocity=[0.0, -0.25, 0.0])
table = dmpcpp.Plane([0.0, 0.0, 0.2], [0.0, 0.0, 1.0])
safe = dmpcpp.SafetyFilter([ball, table], velocity=[0.8] * 3, acceleration=[5.0] * 3, margin=0.02)

run = dmpcpp.Run(model)
nearest, blocked = np.inf, 0
for _ in range(3000):
    # A tracker of the ball would say here where it is now: safe.set(0, ..).
    run.step(1e-3, filter=safe)
    nearest = min(nearest, safe.clearance)
    blocked += run.status == dmpcpp.Status.blocked
off = np.linalg.norm(run.position - run.goal)
print(f"nearest: {nearest:.3f} m, blocked in {blocked} steps, {off:.1e} m from the goal")
assert nearest > 0.0
assert off < 1e-3
