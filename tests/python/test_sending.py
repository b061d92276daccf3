"""What leaves for a robot: at rest at both ends, the motion untouched, no limit exceeded, and faults refused."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from dmpcpp import Arm, JointTrajectory, export, planning, sending
from dmpcpp.errors import InvalidArgument
from dmpcpp.sending._ramp import ramp

NAMES = ("a", "b", "c")
LINK = (
    "<link name='{0}'><inertial><mass value='1'/>"
    "<inertia ixx='.1' iyy='.1' izz='.1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
)
JOINT = (
    "<joint name='{0}' type='revolute'><parent link='{1}'/><child link='{2}'/><origin xyz='0 0 0.3'/><axis xyz='{3}'/>"
    "<limit lower='-2' upper='2' velocity='2' effort='200'/></joint>"
)


@pytest.fixture(scope="module")
def arm() -> Arm:
    links = "".join(LINK.format(f"l{k}") for k in range(4))
    axes = ("0 0 1", "0 1 0", "1 0 0")
    joints = "".join(JOINT.format(NAMES[k], f"l{k}", f"l{k + 1}", axes[k]) for k in range(3))
    three = Arm.from_urdf(f"<robot name='three'>{links}{joints}</robot>")
    return three.with_limits(acceleration=[10.0, 8.0, 12.0], jerk=[500.0, 400.0, 600.0])


def swinging(arm: Arm, seed: int = 0, size: float = 1.2, duration: float | None = None) -> JointTrajectory:
    """A motion cut out of a swing, within the limits: it begins and ends at speed."""
    random = np.random.default_rng(seed)
    time = np.linspace(0.0, duration or random.uniform(1.0, 5.0), 801)
    phase, pace = random.uniform(0.0, 6.3, 3), random.uniform(0.5, 5.0, 3)
    position = size * random.uniform(0.3, 1.0, 3) * np.sin(np.outer(time, pace) + phase)
    return planning.slowed(arm, JointTrajectory.through(time, position, list(NAMES))).joints


def differences(sent, rate: float = 1000.0) -> list[np.ndarray]:
    """Position, velocity, acceleration, jerk as a robot takes them from what it gets, standing before and after."""
    time = np.arange(sent.time[0] - 5 / rate, sent.time[-1] + 5 / rate, 1 / rate)
    found = [sending.interpolated(sent, np.clip(time, sent.time[0], sent.time[-1]))[0]]
    for _ in range(3):
        found.append(np.diff(found[-1], axis=0) * rate)
    return found


@pytest.mark.parametrize("rate", [None, 125.0, 500.0, 1000.0])
@pytest.mark.parametrize("seed", range(8))
def test_what_is_sent_goes_from_rest_to_rest_and_no_limit_is_exceeded(arm, seed, rate):
    joints = swinging(arm, seed)
    assert np.abs(joints.velocity[[0, -1]]).max() > 0.1
    sent = sending.from_rest_to_rest(arm, joints)
    sampled = sent if rate is None else sent.at_rate(rate)
    for ends in (sampled.velocity[[0, -1]], sampled.acceleration[[0, -1]]):
        assert (ends == 0.0).all()
    position, *others = differences(sampled)
    assert (position <= arm.upper).all() and (position >= arm.lower).all()
    limits = (arm.velocity_limit, arm.acceleration_limit, arm.jerk_limit)
    assert [float((np.abs(x) / y).max()) for x, y in zip(others, limits, strict=True)] == pytest.approx(
        [0, 0, 0], abs=1
    )
    assert sending.ready(sending.check(sampled, arm)).ok


def test_an_end_that_lies_on_the_grid_up_to_rounding_is_exactly_at_rest(arm):
    joints = swinging(arm, 3)
    whole = sending.from_rest_to_rest(arm, joints)
    for steps in range(50, 400):
        sent = whole.at_rate(steps / (whole.time[-1] - whole.time[0]))
        assert len(sent.time) == steps + 1
        assert not sent.velocity[[0, -1]].any() and not sent.acceleration[[0, -1]].any()
        np.testing.assert_array_equal(sent.position[-1], whole.position[-1])


def test_the_motion_keeps_its_times_and_joints_bit_for_bit(arm):
    joints = swinging(arm, 3)
    sent = sending.from_rest_to_rest(arm, joints)
    assert sent.motion.start > 0 and sent.motion.stop < len(sent.time)
    for name in ("time", "position", "velocity", "acceleration"):
        np.testing.assert_array_equal(getattr(sent, name)[sent.motion], getattr(joints, name))
    np.testing.assert_allclose(np.diff(sent.time), np.diff(joints.time)[0], rtol=1e-9)
    assert sent.origin == 0.0 and sent.path == (0.0, joints.time[-1]) and sent.slowed == (0.0, 0.0)


def test_a_motion_that_rests_at_its_ends_gets_no_lead(arm):
    time = np.linspace(0.0, 2.0, 201)
    s = time / 2.0
    share = np.outer(s**3 * (10 - 15 * s + 6 * s**2), [0.3, 0.2, 0.1])
    speed = np.outer(30 * s**2 * (1 - s) ** 2, [0.15, 0.1, 0.05])
    rate = np.outer(60 * s - 180 * s**2 + 120 * s**3, [0.075, 0.05, 0.025])
    still = SimpleNamespace(time=time, position=share, velocity=speed, acceleration=rate, joint_names=NAMES)
    assert sending.from_rest_to_rest(arm, still).motion == slice(0, 201)


@pytest.mark.parametrize("velocity, acceleration", [(1.0, 0.0), (1.0, 4.0), (1.0, -6.0), (0.0, 5.0), (-0.5, 2.0)])
def test_a_ramp_starts_with_the_motions_state_and_is_the_integral_of_its_derivatives(arm, velocity, acceleration):
    start = np.array([0.1, 0.2, 0.3]), np.array([velocity, 0.0, 0.5]), np.array([acceleration, 0.0, 0.0])
    found = ramp(arm, *start, 0.004)
    assert found.fits and found.length[1] == 0.0
    time = np.linspace(0.0, found.length.max(), 20001)
    states = found.states(start[0], time)
    for state, expected in zip(states, start, strict=True):
        np.testing.assert_allclose(state[0], expected, atol=1e-12)
    for value, derivative in pairwise(states):
        steps = 0.5 * (derivative[1:] + derivative[:-1]) * np.diff(time)[:, None]
        np.testing.assert_allclose(value[-1] - value[0], steps.sum(axis=0), atol=1e-6)
    assert not states[1][-1].any() and not states[2][-1].any()
    jerk = np.diff(states[2], axis=0) / np.diff(time)[:, None]
    assert np.abs(jerk[-3:]).max() < 0.1  # it ends without a jerk, too


def test_a_ramp_stays_gentle_and_short_of_the_limits_of_position(arm):
    gentle = ramp(arm, np.zeros(3), np.ones(3), np.zeros(3), 0.004)
    acceleration = gentle.states(np.zeros(3), np.arange(0.0, 1.0, 1e-4))[2]
    peak = np.abs(acceleration).max(axis=0) / sending.LEAD_ACCELERATION
    jerk = np.abs(np.diff(acceleration, axis=0) / 1e-4).max(axis=0) / (arm.acceleration_limit / 0.1)  # in 0.1 s
    assert (peak <= 1.0).all() and (jerk <= 1.0).all()
    assert (np.maximum(peak, jerk) > 0.95).all()  # and it is no longer than that asks for
    near = ramp(arm, np.array([1.9, 0.0, 0.0]), np.ones(3), np.zeros(3), 0.004)
    way = near.states(np.array([1.9, 0.0, 0.0]), np.arange(0.0, 1.0, 1e-3))[0]
    assert near.fits and near.length[0] < near.length[1] and way[:, 0].max() <= arm.upper[0]
    assert not ramp(arm, np.array([1.99, 0.0, 0.0]), np.ones(3), np.zeros(3), 0.004).fits


@pytest.mark.parametrize("why", ["limit", "contact"])
def test_where_no_lead_fits_the_ends_of_the_path_are_slowed_down(arm, why):
    time = np.linspace(0.0, 2.0, 801)
    slope = np.outer(time - 1.0, [0.99, 0.5, 0.3])
    towards = np.array([1.0, 0.0, 0.0]) if why == "limit" else np.zeros(3)
    joints = JointTrajectory.through(time, slope + towards, list(NAMES))  # begins and ends at 1 rad/s, a at its limit
    sent = sending.from_rest_to_rest(arm, joints, (lambda position: False) if why == "contact" else None)
    assert sent.fits and sent.slowed[1] > 0.0 and (sent.slowed[0] > 0.0) is (why == "contact")
    assert sent.time[-1] == pytest.approx(2.0 + sent.slowed[1])
    assert "by" in sent.note() and f"{1e3 * sent.slowed[1]:.0f} ms" in sent.note()
    on_path = sent.position[sent.motion.start :]
    share = np.clip((on_path[:, 1] / 0.5), -1.0, 1.0)
    np.testing.assert_allclose(on_path, np.outer(share, [0.99, 0.5, 0.3]) + towards, atol=1e-9)
    np.testing.assert_array_equal(sent.position[-1], joints.position[-1])
    assert sending.ready(sending.check(sent, arm)).ok


def test_no_lead_and_no_slow_end_is_said(arm):
    time = np.linspace(0.0, 0.05, 11)
    joints = JointTrajectory.through(time, np.outer(time - 0.05, [1.9, 0, 0]) + [2.0, 0, 0], list(NAMES))
    sent = sending.from_rest_to_rest(arm, joints)
    assert not sent.fits and not sending.ready(sending.check(sent, arm)).ok


# ---- faults ---------------------------------------------------------------------------------------------


@pytest.fixture
def good(arm):
    sent = sending.from_rest_to_rest(arm, swinging(arm, 5)).at_rate(1000.0)
    assert all(one.ok for one in sending.check(sent, arm, stands=sent.position[0]))
    return SimpleNamespace(
        **{name: np.array(getattr(sent, name)) for name in ("time", "position", "velocity", "acceleration")},
        joint_names=sent.joint_names,
    )


def refusals(motion, arm, **options):
    return {one.name: one for one in sending.check(motion, arm, **options) if not one.ok}


def test_a_start_a_milliradian_off_is_refused(arm, good):
    found = refusals(good, arm, stands=good.position[0] + [0.0, 0.0, 1e-3])
    assert found["robot_start"].value == pytest.approx(1e-3) and found["robot_start"].detail == "c"
    with pytest.raises(InvalidArgument, match=r"start 0\.001 rad .* of joint 'c' at "):
        sending.require(good, arm, stands=good.position[0] + [0.0, 0.0, 1e-3])


def bumped(good, joint: int, power: int, size: float) -> float:
    """Add size t^power exp(-(t / 0.3)^2) from the middle on: a step of the derivative of that order, which fades."""
    k = len(good.time) // 2
    late = good.time[k:] - good.time[k]
    fading = np.polynomial.Polynomial([0.0] * power + [size])
    for name in ("position", "velocity", "acceleration"):
        getattr(good, name)[k:, joint] += fading(late) * np.exp(-((late / 0.3) ** 2))
        fading = fading.deriv() - fading * np.polynomial.Polynomial([0.0, 2 / 0.09])
    return float(good.time[k])


def test_a_step_of_velocity_is_refused(arm, good):
    when = bumped(good, 1, 1, 0.05)
    found = refusals(good, arm)["robot_acceleration"]
    assert found.detail == "b" and found.time == pytest.approx(when, abs=3e-3)


def test_a_step_of_acceleration_is_refused(arm, good):
    when = bumped(good, 0, 2, 1.0)
    found = refusals(good, arm)
    assert found["robot_jerk"].detail == "a" and found["robot_jerk"].time == pytest.approx(when, abs=3e-3)
    assert "robot_acceleration" not in found


def test_a_jerk_one_percent_over_its_limit_is_refused(arm, good):
    share = next(one for one in sending.check(good, arm) if one.name == "robot_jerk").value
    over = arm.with_limits(jerk=arm.jerk_limit * share / 1.01)
    assert refusals(good, over)["robot_jerk"].value == pytest.approx(1.01)
    assert "robot_jerk" not in refusals(good, arm.with_limits(jerk=arm.jerk_limit * share / 0.99))


def test_a_cut_end_is_refused(arm, good):
    cut = SimpleNamespace(**vars(good))
    for name in ("time", "position", "velocity", "acceleration"):
        setattr(cut, name, getattr(good, name)[:-200])
    found = refusals(cut, arm)
    assert {"robot_end_velocity", "robot_acceleration"} <= set(found)
    assert found["robot_end_velocity"].time == cut.time[-1]


@pytest.mark.parametrize("stamped_anew", [False, True])
def test_a_lost_sample_is_refused(arm, good, stamped_anew):
    k = int(np.argmax(np.abs(good.velocity).max(axis=1)))
    lost = SimpleNamespace(
        **{
            name: np.delete(getattr(good, name), k, axis=0) for name in ("time", "position", "velocity", "acceleration")
        },
        joint_names=good.joint_names,
    )
    if stamped_anew:
        lost.time = good.time[:-1]
    found = refusals(lost, arm)
    name = "robot_acceleration" if stamped_anew else "robot_spacing"
    assert found[name].time == pytest.approx(good.time[k], abs=4e-3)


def test_joints_beyond_position_torque_or_tool_speed_are_refused(arm, good):
    assert "robot_joint_margin" in refusals(good, arm.with_limits(upper=good.position.max(axis=0) - 1e-3))
    assert "robot_torque" in refusals(good, arm.with_limits(effort=[0.1, 0.1, 0.1]))
    assert "robot_tool_speed" in refusals(good, arm.with_limits(tool_speed=0.01))
    with pytest.raises(InvalidArgument, match="joint_names"):
        sending.check(SimpleNamespace(**{**vars(good), "joint_names": ("x", "b", "c")}), arm)


def test_an_export_asks_the_same_function(arm, good, tmp_path):
    good.velocity[-1, 0] = 1e-9
    for write, file in (
        (export.write_joints, "a.csv"),
        (export.write_joint_arrays, "a.npz"),
        (export.write_ros2_yaml, "a.yaml"),
    ):
        with pytest.raises(InvalidArgument, match="end velocity 1e-09 rad/s .* of joint 'a'"):
            write(tmp_path / file, good, arm)
    assert list(tmp_path.iterdir()) == []


# ---- files ----------------------------------------------------------------------------------------------


def test_joints_csv_says_of_each_sample_which_phase_it_is_of(arm, tmp_path):
    joints = swinging(arm, 2)
    sent = sending.from_rest_to_rest(arm, joints)
    export.write_joints(tmp_path / "joints.csv", sent, arm)
    header, first, *_, last = (tmp_path / "joints.csv").read_text().splitlines()
    assert header == "time,a,b,c,a_vel,b_vel,c_vel,a_acc,b_acc,c_acc,phase"
    assert first.endswith(",0.0,0.0,0.0,0.0,0.0,0.0,lead-in") and last.endswith(",0.0,0.0,0.0,0.0,0.0,0.0,lead-out")
    read = export.read_joints(tmp_path / "joints.csv")
    assert read.motion == sent.motion
    np.testing.assert_array_equal(read.of_motion().position, joints.position)
    export.write_joints(tmp_path / "again.csv", read)
    assert (tmp_path / "again.csv").read_text() == (tmp_path / "joints.csv").read_text()


def test_joints_csv_of_before_is_read_as_a_motion_alone(arm, tmp_path):
    export.write_joints(tmp_path / "old.csv", swinging(arm, 2))
    read = export.read_joints(tmp_path / "old.csv")
    assert read.motion is None and len(read.of_motion().time) == len(read.time) == 801


def test_phases_out_of_order_are_refused_by_their_line(arm, tmp_path):
    path = tmp_path / "joints.csv"
    export.write_joints(path, sending.from_rest_to_rest(arm, swinging(arm, 2)))
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:-1], lines[-1].replace("lead-out", "lead-in")]))
    with pytest.raises(
        InvalidArgument, match=f"line {len(lines)}, phase 'lead-in', expected lead-in, motion, lead-out"
    ):
        export.read_joints(path)


def test_an_export_that_fails_costs_its_file_only(arm, tmp_path, monkeypatch):
    sent = sending.from_rest_to_rest(arm, swinging(arm, 2))

    def refuse(path, trajectory, arm):
        raise InvalidArgument("no room for it")

    formats = export.chosen(["npz", "ros2"], arm)
    broken = export.Format("joints.broken", refuse)
    written = export.write_robot_files(tmp_path, sent, arm, [formats[0], broken, formats[1]])
    assert written == ("joints.csv", "joints.npz", "joints.yaml") and written.refused == {
        "joints.broken": "no room for it"
    }
    with np.load(tmp_path / "joints.npz") as arrays:
        np.testing.assert_array_equal(arrays["position"], sent.position)
        assert tuple(arrays["phase"]) == sent.phase
    yaml = export.read_ros2_yaml(tmp_path / "joints.yaml")
    np.testing.assert_allclose(np.diff(yaml.time), 0.008, atol=2e-9)
    assert not yaml.velocity[[0, -1]].any()
    export.remove_robot_files(tmp_path)
    assert list(tmp_path.iterdir()) == []
