"""MuJoCo behind the same interface: agreement with PyBullet, each by its own dynamics, on the arms PyBullet ships."""

import sys
from functools import partial

import numpy as np
import pytest

from benchmarks.joint_motions import HOME, reach, swing

pytest.importorskip("pybullet", reason="the extra `sim`")
pytest.importorskip("mujoco", reason="the extra `mujoco`")

from dmpcpp import arms, simulation
from dmpcpp.errors import InvalidArgument, MissingDependency
from dmpcpp.simulation import Box, Bullet, Disturbance, MuJoCo

ARMS = ["panda", "iiwa", "xarm6"]


def random_states(arm, name, count):
    random = np.random.default_rng(5)
    for _ in range(count):
        near = np.array(HOME[name]) + 0.3 * random.normal(size=arm.joint_count)
        yield near, random.normal(size=arm.joint_count), random.normal(size=arm.joint_count)


@pytest.mark.parametrize("name", ARMS)
def test_both_engines_have_the_same_inverse_dynamics_and_kinematics(name):
    arm = arms.find(name)
    with Bullet(arm, 1e-3) as bullet, MuJoCo(arm, 1e-3) as mujoco:
        assert mujoco.inertia_repairs == bullet.inertia_repairs
        for position, velocity, acceleration in random_states(arm, name, 20):
            for engine in (bullet, mujoco):
                engine.reset(position, velocity)
            torque = bullet.inverse_dynamics(acceleration)
            assert np.allclose(mujoco.inverse_dynamics(acceleration), torque, rtol=1e-7, atol=1e-7)
            assert np.allclose(mujoco.tool_pose(), arm.forward_kinematics(position), atol=1e-12)


@pytest.mark.parametrize("engine", [Bullet, MuJoCo])
def test_inverse_dynamics_in_a_given_state_are_those_in_the_arms_own(engine):
    arm = arms.find("iiwa")
    with engine(arm, 1e-3) as world:
        for position, velocity, acceleration in random_states(arm, "iiwa", 5):
            world.reset(np.zeros(7), np.zeros(7))
            asked = world.inverse_dynamics(acceleration, position, velocity)
            assert not world.state()[0].any()
            world.reset(position, velocity)
            assert np.allclose(world.inverse_dynamics(acceleration), asked, atol=1e-12)


@pytest.mark.parametrize("name", ["panda", "iiwa"])
@pytest.mark.parametrize("consistent", [True, False])
def test_one_trajectory_is_executed_alike_by_both_engines(name, consistent):
    arm = arms.find(name)
    logs = [simulation.execute(arm, swing(arm), consistent=consistent, simulator=one) for one in (Bullet, MuJoCo)]
    checks = simulation.agreement(*logs)
    names = ("position_max", "angle_max", "torque_rms", "verdicts")
    assert [check.name for check in checks] == [f"engines_{name}" for name in names]
    assert all(check.ok for check in checks), checks
    assert logs[0].simulator != logs[1].simulator


@pytest.mark.parametrize("name", ["panda", "iiwa"])
def test_both_engines_carry_a_disturbed_arm_alike(name):
    arm = arms.find(name)
    disturbance = Disturbance(mass_error=0.2, payload=0.5, damping=0.5, seed=3)
    logs = [
        simulation.execute(arm, swing(arm), disturbance=disturbance, simulator=engine) for engine in (Bullet, MuJoCo)
    ]
    assert logs[0].errors.position_max > 1e-3  # the load is felt, by both in the same way
    assert all(check.ok for check in simulation.agreement(*logs)), simulation.agreement(*logs)


def test_engines_that_differ_are_told_apart():
    arm = arms.find("panda")
    log = simulation.execute(arm, swing(arm), simulator=MuJoCo)
    loaded = simulation.execute(arm, swing(arm), disturbance=Disturbance(payload=3.0), simulator=MuJoCo)
    assert not any(check.ok for check in simulation.agreement(log, loaded))
    with pytest.raises(InvalidArgument, match="same options in both"):
        simulation.agreement(log, simulation.execute(arm, swing(arm), settle=0.1, simulator=MuJoCo))


@pytest.mark.parametrize("name", ARMS)
def test_clearances_of_both_engines_differ_by_no_more_than_bullets_margins(name):
    arm = arms.find(name)
    with Bullet(arm, 1e-3) as bullet, MuJoCo(arm, 1e-3) as mujoco:
        fingers = {"panda_leftfinger", "panda_rightfinger"}  # fixed in MuJoCo: never nearer to the hand's other links
        found = [
            {(c.link, c.other): c.distance for c in engine.clearances_at(np.array(HOME[name]), 0.6)}
            for engine in (bullet, mujoco)
        ]
    pairs = {pair for pair in found[0] if not fingers & set(pair) and found[0][pair] < 0.59}
    assert len(pairs) > 5
    assert pairs <= set(found[1])
    assert all(abs(found[0][pair] - found[1][pair]) < 3e-3 for pair in pairs)


def test_contacts_with_floor_itself_and_a_box_are_found_as_by_bullet():
    arm = arms.find("panda")
    box = Box("crate", (0.1, 0.1, 0.1), tuple(arm.forward_kinematics(np.array(HOME["panda"]))[:3, 3]))
    folded = np.array(HOME["panda"])
    folded[5] = 0.0
    low = np.array([0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8])
    for position in (HOME["panda"], folded, low):
        found = []
        for engine in (Bullet, MuJoCo):
            with engine(arm, 1e-3, obstacles=[box]) as world:
                found.append({(contact.link, contact.other) for contact in world.contacts_at(np.array(position))})
        assert found[0] == found[1]
        assert found[0]


def test_a_floor_is_felt_by_a_moving_link_beside_a_root_that_is_called_world():
    arm = arms.find("xarm6")  # the root of its URDF has the name of MuJoCo's own world
    with MuJoCo(arm, 1e-3, floor=0.2) as world:
        assert ("link1", "floor") in {(c.link, c.other) for c in world.contacts_at(np.array(HOME["xarm6"]))}


def test_an_arm_that_is_a_part_of_the_robot_is_measured_from_its_own_base():
    path = arms._pybullet_data() / arms.KNOWN["panda"].urdf
    part = arms.load(path, base="panda_link2", tip="panda_link8")
    log = simulation.execute(part, swing(part, centre=HOME["panda"][2:]), simulator=MuJoCo)
    assert log.errors.position_max <= 1e-9


@pytest.mark.parametrize("mode", ["position", "position_velocity", "velocity"])
def test_its_motors_follow_too(mode):
    arm = arms.find("panda")
    log = simulation.execute(arm, swing(arm), mode=mode, simulator=MuJoCo)
    assert log.errors.position_max <= 1e-6
    weak = arm.with_limits(effort=[87.0, 20.0, 87.0, 87.0, 12.0, 12.0, 12.0])
    capped = simulation.execute(weak, swing(weak), mode=mode, simulator=MuJoCo)
    assert np.abs(capped.torque[:, 1]).max() == 20.0
    assert capped.errors.position_max > 1e-3


class Breaks(MuJoCo):
    def inverse_dynamics(self, *state):
        self.calls = getattr(self, "calls", 0) + 1
        return super().inverse_dynamics(*state) * (np.nan if self.calls > 500 else 1.0)


def test_a_state_that_is_not_finite_stops_the_run_and_nothing_is_printed_or_logged(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    arm = arms.find("panda")
    log = simulation.execute(arm, swing(arm), simulator=Breaks)
    assert "finite" in {check.name for check in log.verdict.failed}
    assert len(log.time) == 491  # ten calls are made right after loading
    assert list(tmp_path.iterdir()) == []
    assert capfd.readouterr() == ("", "")


def test_without_mujoco_the_error_says_what_to_install(monkeypatch):
    arm = arms.find("panda")
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(MissingDependency, match=r"dmpcpp\[mujoco\]"):
        simulation.execute(arm, swing(arm, 0.1), simulator=MuJoCo)


def test_no_floor_no_contact():
    arm = arms.find("panda")
    motion = reach(arm, [0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8], 2.0)
    assert "floor_contact" in {c.name for c in simulation.execute(arm, motion, simulator=MuJoCo).verdict.failed}
    without = simulation.execute(arm, motion, simulator=partial(MuJoCo, floor=None))
    assert without.verdict["floor_contact"].ok
