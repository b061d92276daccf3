"""A stirring motion is found in a recording, learned, and carried out faster, smaller and elsewhere."""

import dmpcpp
import numpy as np

# Eight rounds of about 1.2 s: people are not periodic.
time = np.linspace(0, 10, 1000)
phase = 2 * np.pi * (time / 1.2 + 0.1 * np.sin(time))
position = np.c_[0.4 + 0.06 * np.cos(phase), 0.06 * np.sin(phase), 0.2 + 0.01 * np.sin(2 * phase)]
found = dmpcpp.find_cycle(dmpcpp.Demonstration(time, position))
print(f"{len(found.lengths)} cycles of {found.period:.2f} s")

stir = dmpcpp.Dmp.fit(found.demonstration, motion="rhythmic")
run = dmpcpp.Run(stir)
run.start_from(stir.goal, np.zeros(3), 0.5)  # from rest at the centre
run.step(2.0)

# On the way, without a jump of the acceleration.
run.duration = 0.8
run.amplitude = 0.5
run.goal = stir.goal + [0.1, 0.0, 0.0]
radii = []
while run.time < 10.0:
    run.step(0.01)
    radii.append(np.linalg.norm((run.position - run.goal)[:2]))
print(f"after {run.phase:.1f} rounds {1e3 * max(radii[-100:]):.0f} mm from the centre")
