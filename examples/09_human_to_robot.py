"""From the recording of a hand to a simulated arm in one call, and its files (needs PyBullet and matplotlib)."""

import tempfile
from pathlib import Path

import dmpcpp
import numpy as np
from dmpcpp import imitation, recordings

arm = dmpcpp.Arm.from_urdf_file(Path(__file__).parent / "arm.urdf", base="link0", tip="tool")

with tempfile.TemporaryDirectory() as folder:
    # What a motion capture system would write: time [s], position [mm], orientation as a quaternion (x, y, z, w).
    time = np.arange(0, 2, 1 / 60)
    lift = np.sin(np.pi * time / 2) ** 2
    angle = 0.4 * lift
    turn = np.c_[0 * time, np.sin(angle / 2), 0 * time, np.cos(angle / 2)]
    hand = np.c_[time, 300 * lift, 150 * lift, 900 + 200 * lift, turn]
    session = Path(folder) / "session.csv"
    np.savetxt(session, hand, delimiter=",", header="time,x,y,z,qx,qy,qz,qw", comments="")

    recording = recordings.load(session, unit="mm")
    run = imitation.imitate(recording, arm, seed=0)  # placed, learned, solved, slowed to the limits, executed
    imitation.write(run, Path(folder) / "session")
    written = sorted(path.name for path in (Path(folder) / "session").iterdir())

for stage, errors in run.stages.items():
    print(stage, 1e3 * errors.position_rmse, "mm")
print("slowed down", run.slowdown, "times; wrote", *written)
assert run.stages["dmp_to_ik"].position_rmse < 1e-5
