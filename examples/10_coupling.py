"""A coupling term of your own: the run steers around an obstacle (Hoffmann et al. 2009, ICRA, in the plane)."""

import dmpcpp
import numpy as np

time = np.linspace(0, 1, 100)  # s
position = np.c_[time**2 * (3 - 2 * time), np.zeros(100)]  # m
reach = dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, position))
obstacle = np.array([0.5, 0.02])  # m


def steering(state: dmpcpp.RunState, gain: float = 60.0, decay: float = 3.0) -> np.ndarray:
    """Turn the velocity away from the obstacle, the faster the more straight it heads for it."""
    away, velocity = obstacle - state.point, state.velocity / state.speed  # over phase
    aside = np.array([-velocity[1], velocity[0]])
    angle = np.arctan2(abs(away @ aside), away @ velocity)
    return -np.sign(away @ aside) * gain * angle * np.exp(-decay * angle) * aside


run = dmpcpp.Run(reach)
clearance = 1.0
while run.step(1e-3, coupling=steering):  # called in each internal step
    clearance = min(clearance, float(np.linalg.norm(run.position - obstacle)))
print("passes the obstacle at", clearance, "m, ends", np.linalg.norm(run.position - reach.goal), "m from the goal")
assert clearance > 0.05
assert np.linalg.norm(run.position - reach.goal) < 0.02
