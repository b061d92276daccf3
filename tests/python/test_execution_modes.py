"""What a controller meets: ways to drive, unknown masses, friction, delay and noise; every run repeatable."""

from dataclasses import replace

import numpy as np
import pytest
from dmpcpp import Arm, arms, simulation
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._description import describe
from dmpcpp.simulation import Disturbance
from dmpcpp.simulation import _reference as reference
from dmpcpp.simulation._sensing import Sensors

from benchmarks.joint_motions import HOME, PENDULUM, reach, swing

MODES = ["position", "position_velocity", "velocity"]


@pytest.fixture(scope="module")
def panda():
    return arms.find("panda")


@pytest.fixture(params=["bullet", "mujoco"])
def engine(request):
    pytest.importorskip({"bullet": "pybullet", "mujoco": "mujoco"}[request.param])
    return simulation.ENGINES[request.param]


@pytest.mark.parametrize("mode", MODES)
def test_the_engines_motors_follow_and_say_that_they_are_blind(panda, mode):
    log = simulation.execute(panda, swing(panda), mode=mode)
    assert log.errors.position_max <= (1e-4 if mode == "velocity" else 1e-6)
    assert "only kinematics" in log.verdict.caveat


@pytest.mark.parametrize("mode", MODES)
def test_motors_do_not_feel_a_load_that_computed_torque_feels(panda, engine, mode):
    loaded = {"disturbance": Disturbance(payload=1.0), "simulator": engine}
    assert simulation.execute(panda, swing(panda), mode=mode, **loaded).errors.position_max <= 1e-4
    assert simulation.execute(panda, swing(panda), **loaded).errors.position_max > 1e-3


@pytest.mark.usefixtures("needs_bullet")
def test_open_loop_velocity_would_drift_the_gain_holds_it(panda):  # MuJoCo drifts by less
    log = simulation.execute(panda, swing(panda, 3.0), mode="velocity", consistent=False)
    assert 1e-6 < log.verdict["settle_error"].value <= 1e-4


def test_a_constant_load_leaves_its_weight_over_the_stiffness_and_the_integral_takes_that_away(engine):
    arm = Arm.from_urdf(PENDULUM.format(ixx=0.02), base="base", tip="rod")
    load = {"disturbance": Disturbance(payload=0.5, payload_offset=(0.8, 0.0, 0.0)), "simulator": engine}
    motion = reach(arm, [0.3], 1.0)
    plain = simulation.execute(arm, motion, kp=400.0, kd=40.0, settle=3.0, **load)
    # at rest the controller's inertia 0.35 times kp times the error carries the load's moment 0.5 g 0.8 cos q
    assert 0.35 * 400.0 * (plain.position[-1, 0] - 0.3) == pytest.approx(
        0.5 * 9.81 * 0.8 * np.cos(plain.position[-1, 0]), rel=1e-3
    )
    integral = simulation.execute(arm, motion, kp=400.0, kd=40.0, ki=4000.0, settle=6.0, **load)
    assert integral.position[-1, 0] == pytest.approx(0.3, abs=1e-6)


def test_the_integral_stands_still_while_the_torque_is_clipped():
    arm = Arm.from_urdf(PENDULUM.format(ixx=0.02), base="base", tip="rod").with_limits(effort=[7.0])
    raised = reach(arm, [0.3], 1.0, home=[1.4])  # held horizontally the rod weighs 7.85 Nm: it cannot be lifted
    log = simulation.execute(arm, raised, kp=400.0, kd=40.0, ki=4000.0, settle=2.0)
    inertia, stuck = 0.35, log.desired_position[-1, 0] - log.position[-1, 0]
    assert abs(log.torque_demand[-1, 0]) < 7.85 + inertia * (400.0 * abs(stuck) + 4000.0 * 0.2)


@pytest.mark.parametrize(
    "kind, left",
    [
        ("damping", 0.1 * np.exp(-0.04 / (2 * 0.35) * np.pi * np.sqrt(0.35 / 7.848))),  # exp(-d t / 2 I), half a period
        ("friction", 0.1 - 2 * 0.04 / 7.848),  # twice the angle at which friction holds the weight
    ],
)
def test_half_a_swing_of_a_pendulum_loses_what_friction_takes(engine, kind, left):
    text = PENDULUM.format(ixx=0.02).replace('damping="0.7"', 'damping="0"')
    arm = Arm.from_urdf(text, base="base", tip="rod")
    with engine(arm, 1e-4, disturbance=Disturbance(**{kind: 0.04})) as world:
        world.reset(np.array([np.pi / 2 - 0.1]), np.zeros(1))
        angles = []
        for _ in range(8_000):
            world.step()
            angles.append(world.state()[0][0] - np.pi / 2)
    assert max(angles) == pytest.approx(left, rel=2e-3)


def test_the_controller_knows_nothing_of_the_friction(panda, engine):
    position, velocity = np.array(HOME["panda"]), np.ones(7)
    torque = []
    for disturbance in (None, Disturbance(damping=0.5, friction=1.0)):
        with engine(panda, 1e-3, disturbance=disturbance) as world:
            torque.append(world.inverse_dynamics(np.zeros(7), position, velocity))
    assert np.array_equal(*torque)


def test_masses_are_off_by_the_share_that_was_asked_for_with_their_inertia(panda, tmp_path):
    import xml.etree.ElementTree as ET

    def masses(disturbance):
        folder = tmp_path / str(disturbance)
        folder.mkdir()
        links = ET.fromstring(describe(panda, folder, disturbance=disturbance).text).findall("link")
        rows = {link.get("name"): (link.find("inertial/mass"), link.find("inertial/inertia")) for link in links}
        return {name: (float(m.get("value")), float(i.get("ixx"))) for name, (m, i) in rows.items()}

    true, off = masses(Disturbance()), masses(Disturbance(mass_error=0.2, seed=4))
    factors = {name: off[name][0] / mass for name, (mass, _) in true.items() if mass > 0.0}
    assert set(np.round(list(factors.values()), 12)) == {0.8, 1.2}
    assert all(off[name][1] == pytest.approx(factors[name] * true[name][1]) for name in factors)
    assert off != masses(Disturbance(mass_error=0.2, seed=5))


def test_an_unknown_payload_hangs_where_it_was_put(panda, engine):
    position = np.array(HOME["panda"])
    load = Disturbance(payload=2.0, payload_offset=(0.1, 0.0, 0.2))
    torque = []
    for disturbance in (None, load):
        with engine(panda, 1e-3, disturbance=disturbance) as world:
            torque.append(world.inverse_dynamics(np.zeros(7), position, np.zeros(7)))
    jacobian, tool = panda.jacobian(position), panda.forward_kinematics(position)
    arm = tool[:3, :3] @ load.payload_offset
    velocity = jacobian[:3] - np.cross(arm, jacobian[3:], axis=0)  # of the payload: v + w x r
    assert np.allclose(torque[1] - torque[0], velocity.T @ [0.0, 0.0, 2.0 * 9.81], atol=1e-6)


def everything():
    gaps = {"mass_error": 0.1, "payload": 0.3, "damping": 0.2, "friction": 0.1, "sensor_delay": 1e-3}
    noise = {"position_noise": 1e-5, "velocity_noise": 1e-4}
    return Disturbance(**gaps, **noise, control_rate=500.0, seed=7)


@pytest.mark.parametrize("mode", ["computed_torque", *MODES])
def test_two_disturbed_runs_are_bit_identical_and_another_seed_is_another_run(panda, engine, mode):
    options = {"mode": mode, "simulator": engine, "settle": 0.1}
    one, two = (simulation.execute(panda, swing(panda, 0.2), disturbance=everything(), **options) for _ in range(2))
    for name in ("position", "velocity", "torque", "torque_demand", "tool_pose"):
        assert getattr(one, name).tobytes() == getattr(two, name).tobytes(), name
    other = simulation.execute(panda, swing(panda, 0.2), disturbance=replace(everything(), seed=8), **options)
    assert not np.array_equal(one.position, other.position)


def test_what_the_controller_did_not_know_is_said_with_the_verdict(panda):
    log = simulation.execute(panda, swing(panda, 0.2), disturbance=Disturbance(payload=0.1, seed=2))
    assert log.verdict.caveat == "the controller does not know of payload 0.1, seed 2"
    assert log.disturbance.payload == 0.1
    blind = simulation.execute(panda, swing(panda, 0.2), mode="position", disturbance=Disturbance(payload=0.1))
    assert "only kinematics" in blind.verdict.caveat
    assert blind.verdict.caveat.endswith("the controller does not know of payload 0.1")


def test_each_gap_between_model_and_arm_costs_accuracy(panda):
    exact = simulation.execute(panda, swing(panda)).errors.position_rmse
    for gap in (
        {"mass_error": 0.2},
        {"payload": 0.5},
        {"damping": 0.5},
        {"friction": 0.5},
        {"sensor_delay": 2e-3},
        {"position_noise": 1e-4},
        {"velocity_noise": 1e-2},
        {"control_rate": 250.0},
    ):
        log = simulation.execute(panda, swing(panda), disturbance=Disturbance(**gap))
        assert log.errors.position_rmse > 10 * exact, gap
        assert log.errors.position_max < 0.03, gap


def test_a_command_is_held_between_the_controllers_actions(panda):
    log = simulation.execute(panda, swing(panda, 0.2), disturbance=Disturbance(control_rate=100.0))
    held = log.torque_demand[: len(log.torque_demand) // 10 * 10].reshape(-1, 10, 7)
    assert np.array_equal(held, np.repeat(held[:, :1], 10, axis=1))
    assert not np.array_equal(held[0], held[-1])


def test_sensors_are_late_by_whole_steps_and_noisy_as_stated():
    late = Sensors(Disturbance(sensor_delay=3e-3), 1e-3)
    seen = [late.see((np.array([float(k)]), np.zeros(1)))[0][0] for k in range(8)]
    assert seen == [0, 0, 0, 0, 1, 2, 3, 4]
    noisy = Sensors(Disturbance(position_noise=0.1, velocity_noise=0.4), 1e-3)
    states = np.array([noisy.see((np.zeros(50), np.ones(50))) for _ in range(200)])
    assert np.std(states, axis=(0, 2)) == pytest.approx([0.1, 0.4], rel=0.03)
    assert np.mean(states, axis=(0, 2)) == pytest.approx([0.0, 1.0], abs=0.02)


def test_the_cubic_reference_is_the_hermite_spline_through_positions_and_velocities(panda):
    from scipy.interpolate import CubicHermiteSpline

    joints = swing(panda)
    options = {"settle": 0.0, "from_rest": True, "consistent": False}
    sampled = reference.sample(panda, joints, 1000.0, interpolation="cubic", **options)
    spline, inside = CubicHermiteSpline(joints.time, joints.position, joints.velocity), sampled.motion
    for order, values in enumerate((sampled.position, sampled.velocity)):
        assert np.allclose(values[inside], spline(sampled.time[inside], order), atol=1e-10)
    between = np.abs((sampled.time[inside] * 100) % 1 - 0.5) < 0.3  # the acceleration jumps at the samples
    assert np.allclose(sampled.acceleration[inside][between], spline(sampled.time[inside], 2)[between], atol=1e-7)
    log = simulation.execute(panda, joints, interpolation="cubic")
    assert log.errors.position_max <= 1e-6


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"mass_error": 1.0}, "mass_error: 1.0, expected a share below 1"),
        ({"payload": -1.0}, "payload: -1.0, expected a number >= 0"),
        ({"position_noise": np.nan}, "position_noise: nan, expected a number >= 0"),
        ({"control_rate": 0.0}, "control_rate: 0.0, expected a positive number"),
        ({"payload_offset": (0.0, 1.0)}, "payload_offset: .*expected three finite numbers"),
        ({"seed": -1}, "seed: -1, expected"),
    ],
)
def test_a_disturbance_out_of_range_is_refused(wrong, message):
    with pytest.raises(InvalidArgument, match=message):
        Disturbance(**wrong)


def test_what_cannot_be_driven_is_refused(panda):
    with pytest.raises(InvalidArgument, match="control_rate: 300 Hz does not divide the simulation's 1000 Hz"):
        simulation.execute(panda, swing(panda), disturbance=Disturbance(control_rate=300.0))
    with pytest.raises(InvalidArgument, match="interpolation: 'linear', expected one of quintic, cubic"):
        simulation.execute(panda, swing(panda), interpolation="linear")
    with pytest.raises(InvalidArgument, match=r"mode: 'torque', expected one of computed_torque, position, pos"):
        simulation.execute(panda, swing(panda), mode="torque")
    with pytest.raises(InvalidArgument, match="ki: -1.0, expected a number >= 0"):
        simulation.execute(panda, swing(panda), ki=-1.0)
