"""Takes that differ, learned with how they differ: past a point that is given, as the takes went that did so."""

import numpy as np
from dmpcpp import Given, PoseDemonstration, PoseDistribution, damping_of, so3

rng = np.random.default_rng(1)
time = np.linspace(0, 2, 120)
share = time / 2
takes = []
for _ in range(8):  # reaches that end elsewhere and turn further
    aside, twist = rng.normal(size=(2, 3))
    poses = np.tile(np.eye(4), (len(time), 1, 1))
    poses[:, :3, 3] = np.c_[0.3 * share, 0.2 * np.sin(3 * share), 0.1 + 0.2 * share] + 0.03 * share[:, None] * aside
    poses[:, :3, :3] = [so3.exp(0.1 * s * twist) @ so3.exp([s, 0.5 * s, 0.0]) for s in share]
    takes.append(PoseDemonstration(time, poses))

learned = PoseDistribution.fit(takes)
band = learned.spread(3)
for phase, covariance in zip(band.phase, band.covariance, strict=True):
    print(f"at {phase:.1f}: {1e3 * np.sqrt(np.trace(covariance[:3, :3])):5.1f} mm of the takes")

wanted = learned.rollout(3).pose[1, :3, 3] + [0.0, 0.02, 0.0]
found = learned.condition({0.5: wanted})
print(f"{learned.distance(Given(0.5, wanted)):.1f} standard deviations from what the takes do there")
print(f"missed by {np.linalg.norm(found.rollout(3).pose[1, :3, 3] - wanted):.1e} m")
print(f"and the end moved by {1e3 * np.linalg.norm(found.rollout(3).pose[2] - learned.rollout(3).pose[2]):.1f} mm")

model = found.mean()  # a PoseDmp: run it, plan it, lead it to other goals
print(f"{model} ends at {np.round(model.goal[:3, 3], 3)}")
stiffness = found.stiffness(0.9, [800.0] * 3 + [40.0] * 3, [0.01] * 3 + [0.05] * 3)
print("stiffness [N/m]:", np.round(np.diag(stiffness)[:3]), "damping:", np.round(np.diag(damping_of(stiffness))[:3], 1))
