"""MuJoCo without PyBullet, and so without the arms that it ships: closed forms, and the arm of the examples."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="the extra `mujoco`")

from dmpcpp import Arm, simulation
from dmpcpp.errors import InvalidArgument
from dmpcpp.simulation import Disturbance, MuJoCo

from benchmarks.joint_motions import PENDULUM, reach, trajectory

URDF = Path(__file__).resolve().parents[2] / "examples" / "arm.urdf"
START = [0.0, 0.5, 0.0, 1.0, 0.0, 0.5, 0.0]
END = [0.6, 0.3, 0.2, 1.3, 0.0, 0.8, 0.4]


@pytest.fixture(scope="module")
def arm():
    return Arm.from_urdf_file(URDF, base="link0", tip="tool")


def execute(arm, target=END, seconds=2.0, **options):
    return simulation.execute(arm, reach(arm, target, seconds, home=START), simulator=MuJoCo, **options)


def test_a_reach_is_followed_to_a_micrometre_and_fails_no_check(arm):
    log = execute(arm)
    assert log.simulator.startswith("MuJoCo ")
    assert log.verdict.failed == ()
    assert log.errors.position_max <= 1e-6


def test_its_kinematics_are_those_of_the_arm(arm):
    with MuJoCo(arm, 1e-3) as world:
        for position in (START, END):
            world.reset(np.array(position), np.zeros(7))
            assert np.allclose(world.tool_pose(), arm.forward_kinematics(position), atol=1e-12)


def test_a_payload_weighs_on_the_joints_through_the_jacobian(arm):
    held = []
    for disturbance in (Disturbance(), Disturbance(payload=2.0, payload_offset=(0.0, 0.0, 0.0))):
        with MuJoCo(arm, 1e-3, disturbance=disturbance) as world:
            held.append(world.inverse_dynamics(np.zeros(7), np.array(END), np.zeros(7)))
    assert np.allclose(held[1] - held[0], arm.jacobian(END).T @ [0.0, 0.0, 2.0 * 9.81, 0.0, 0.0, 0.0], atol=1e-9)


def test_motors_too_weak_for_the_arm_are_caught(arm):
    weak = arm.with_limits(effort=[10.0] * 7)
    assert {"torque_ratio", "tracking_angle_max"} <= {check.name for check in execute(weak).verdict.failed}


def test_a_path_through_the_floor_is_seen_before_and_while_it_is_executed(arm):
    ball = '<link name="tool"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>'
    arm = Arm.from_urdf(URDF.read_text().replace('<link name="tool"/>', ball), base="link0", tip="tool")
    down = [0.0, 1.9, 0.0, 1.0, 0.0, 0.5, 0.0]
    joints = reach(arm, down, 2.0, home=START)
    assert simulation.contacts_along(arm, joints.position, simulator=MuJoCo)
    assert "floor_contact" in {check.name for check in execute(arm, down).verdict.failed}
    free = simulation.execute(arm, joints, simulator=partial(MuJoCo, floor=None))
    assert free.verdict["floor_contact"].ok


def test_two_disturbed_runs_are_bit_identical(arm):
    noise = Disturbance(payload=0.3, position_noise=1e-5, sensor_delay=1e-3, seed=7)
    one, two = (execute(arm, disturbance=noise, settle=0.1) for _ in range(2))
    for name in ("position", "velocity", "torque", "tool_pose"):
        assert getattr(one, name).tobytes() == getattr(two, name).tobytes(), name


def test_the_torque_of_a_pendulum_is_its_equation_of_motion():
    arm = Arm.from_urdf(PENDULUM.format(ixx=0.02), base="base", tip="rod")
    motion = trajectory(arm, np.linspace(0, 2, 201), np.sin(np.linspace(0, 4, 201))[:, None])
    log = simulation.execute(arm, motion, simulator=MuJoCo)
    position, velocity = log.position[:-1, 0], log.velocity[:-1, 0]
    acceleration = np.diff(log.velocity[:, 0]) / 1e-3
    expected = (0.03 + 2 * 0.4**2) * acceleration - 2 * 9.81 * 0.4 * np.cos(position) + 0.7 * velocity
    assert np.allclose(log.torque[:-1, 0], expected, atol=1e-9)


def test_a_pendulum_that_is_let_go_swings_with_its_own_period():
    arm = Arm.from_urdf(PENDULUM.format(ixx=0.02).replace('damping="0.7"', 'damping="0"'), base="base", tip="rod")
    with MuJoCo(arm, 1e-4) as world:
        world.reset(np.array([np.pi / 2 - 0.05]), np.zeros(1))
        angles = []
        for _ in range(30_000):
            world.step()
            angles.append(world.state()[0][0] - np.pi / 2)
    period = 2e-4 * float(np.mean(np.diff(np.flatnonzero(np.diff(np.sign(angles)) != 0))))
    assert period == pytest.approx(2 * np.pi * np.sqrt((0.03 + 2 * 0.16) / (2 * 9.81 * 0.4)), rel=1e-3)
    assert max(angles[-12_000:]) == pytest.approx(0.05, rel=1e-2)


def test_a_urdf_that_it_cannot_read_is_refused_with_its_reason(tmp_path):
    (tmp_path / "rod.dae").write_text("<nothing/>")
    geometry = '<collision><geometry><mesh filename="rod.dae"/></geometry></collision></link>'
    path = tmp_path / "pendulum.urdf"
    path.write_text(PENDULUM.format(ixx=0.02).replace("</inertial></link>", f"</inertial>{geometry}"))
    with pytest.raises(InvalidArgument, match=r"rod\.dae' cannot be read as a mesh.*Convert it"):
        MuJoCo(Arm.from_urdf_file(str(path)), 1e-3)
