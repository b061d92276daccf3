"""Learn a reach from samples, keep it in a file, and go to another goal at another tempo."""

import tempfile
from pathlib import Path

import dmpcpp
import numpy as np

time = np.linspace(0, 1, 100)  # s
minimum_jerk = time**3 * (10 - 15 * time + 6 * time**2)
position = np.c_[0.3 * minimum_jerk, -0.2 * minimum_jerk, 0.1 * np.sin(np.pi * minimum_jerk)]  # m

with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "reach.json"
    dmpcpp.save(dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, position), basis_count=50), file)
    reach = dmpcpp.load(file)

cup = np.array([0.35, -0.1, 0.05])
plan = reach.rollout(goal=cup, duration=2.0, dt=1e-3)
print(len(plan), "samples, last at", plan.position[-1], "m")
assert np.linalg.norm(plan.position[-1] - cup) < 1e-3
