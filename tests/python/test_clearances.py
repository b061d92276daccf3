"""Clearances are looked for at every pose of a path, its ends among them; a world that is closed stays closed."""

import numpy as np
import pytest
from dmpcpp import arms, simulation

from benchmarks.joint_motions import HOME, reach, trajectory

PANDA = arms.find("panda")
LOW = [0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8]  # the hand in the floor


@pytest.fixture(params=["bullet", "mujoco"])
def engine(request):
    pytest.importorskip({"bullet": "pybullet", "mujoco": "mujoco"}[request.param])
    return simulation.ENGINES[request.param]


@pytest.mark.parametrize("end", ["first", "last"])
def test_a_path_that_touches_the_floor_at_one_end_alone_fails_there(engine, end):
    up = reach(PANDA, LOW, 2.0)
    touching = up.position if end == "last" else up.position[::-1].copy()
    # All poses but the one at the end stand where the motion is free.
    free, index = np.asarray(HOME["panda"]), {"first": 0, "last": -1}[end]
    only = np.tile(free, (len(touching), 1))
    only[index] = touching[index]
    path = trajectory(PANDA, up.time, only)
    checks = {check.name: check for check in simulation.path_checks(PANDA, path, simulator=engine)}
    assert not checks["path_floor_clearance"].ok
    assert checks["path_floor_clearance"].time == pytest.approx(path.time[index] - path.time[0])


def test_a_world_closed_twice_leaves_the_others_alone():
    pytest.importorskip("pybullet", reason="the extra `sim`")
    first = simulation.Bullet(PANDA, 1e-3)
    first.close()
    second = simulation.Bullet(PANDA, 1e-3)  # may get the number of the first
    first.close()
    second.reset(np.asarray(HOME["panda"]), np.zeros(7))
    assert second.state()[0] == pytest.approx(HOME["panda"])
    second.close()
