"""Another thread moves the goal while the loop steps: each call on a run is whole, the interpreter sees to that."""

import threading
import time as clock

import dmpcpp
import numpy as np

time = np.linspace(0, 1, 200)  # s
position = np.c_[0.4 * time, 0.1 * np.sin(3 * time), 0.2 + 0 * time]  # m
run = dmpcpp.Run(dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, position)))
goal = run.goal


def camera() -> None:
    """See 100 times where the cup stands; it drifts by 0.1 m."""
    for look in range(1, 101):
        run.goal = goal + [0, 0.001 * look, 0]  # in C++ a dmp::Mailbox carries it over
        clock.sleep(0.002)


thread = threading.Thread(target=camera)
thread.start()
for _ in range(1500):
    run.step(1e-3)
    clock.sleep(1e-3)
thread.join()
miss = np.linalg.norm(run.position - (goal + [0, 0.1, 0]))
print(f"at the end {1e3 * miss:.2f} mm from the last goal")
assert miss < 1e-3
