"""Runs on a robot: followed by time, stopped along the path, refused where anything speaks against it."""

import json
import os
import pty
import signal
import time
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import Arm, JointTrajectory, export, planning, running, sending, verification
from dmpcpp.cli import main
from dmpcpp.cli._hold_to_run import _Released
from dmpcpp.errors import InvalidArgument

NAMES = ("a", "b", "c")
LINK = (
    "<link name='{0}'><inertial><mass value='1'/>"
    "<inertia ixx='.1' iyy='.1' izz='.1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
)
JOINT = (
    "<joint name='{0}' type='{4}'><parent link='{1}'/><child link='{2}'/><origin xyz='0 0 0.3'/><axis xyz='{3}'/>"
    "<limit lower='-2' upper='2' velocity='2' effort='200'/></joint>"
)


def three(first: str = "revolute") -> str:
    links = "".join(LINK.format(f"l{k}") for k in range(4))
    axes = ("0 0 1", "0 1 0", "1 0 0")
    types = (first, "revolute", "revolute")
    joints = "".join(JOINT.format(NAMES[k], f"l{k}", f"l{k + 1}", axes[k], types[k]) for k in range(3))
    return f"<robot name='three'>{links}{joints}</robot>"


@pytest.fixture(scope="module")
def arm() -> Arm:
    return Arm.from_urdf(three()).with_limits(acceleration=[10.0, 8.0, 12.0], jerk=[500.0, 400.0, 600.0])


def motion(arm: Arm, seed: int = 0, duration: float = 1.5) -> export.JointSamples:
    random = np.random.default_rng(seed)
    time = np.linspace(0.0, duration, 301)
    position = 0.5 * random.uniform(0.4, 1.0, 3) * np.sin(np.outer(time, random.uniform(1.0, 3.0, 3)) + seed)
    joints = planning.slowed(arm, JointTrajectory.through(time, position, list(NAMES))).joints
    sent = sending.from_rest_to_rest(arm, joints)
    return export.JointSamples(
        sent.time, sent.position, sent.velocity, sent.acceleration, sent.joint_names, sent.motion
    )


class Exact:
    """A robot that is exactly where it is told to be, one command a millisecond, and says what it is told to say."""

    def __init__(self, stands, ready=True, payload=0.0, names=NAMES, stop_at=None):
        self.stands, self.ready, self.payload, self.names = np.array(stands), ready, payload, names
        self.moved, self.at_cycle = False, stop_at or (lambda k: None)

    def connect(self):
        return running.RobotInfo("exact", tuple(self.names), 1000.0, self.payload)

    def state(self):
        zero = np.zeros(3)
        return running.RobotState(
            self.stands, zero, zero, self.stands.copy(), self.ready, "idle" if self.ready else "reflex"
        )

    def limits(self, arm):
        return arm

    def checks(self, joints, arm):
        return ()

    def advice(self, joints, arm):
        return ()

    def stream(self, targets, log):
        self.moved = True
        for k in range(10**6):
            self.at_cycle(k)
            target = targets(k * 1e-3)
            if target is None:
                return running.End(True)
            self.stands = target.position.copy()
            log.add(k * 1e-3, 1e-3, self.stands, target.velocity, target.acceleration, self.stands, 0.0)
        raise AssertionError

    def stop(self):
        self.halted = True

    def close(self):
        pass


# ---- by time, and stopped ---------------------------------------------------------------------------------


def test_the_joints_at_any_time_are_those_of_the_motion(arm):
    plan = motion(arm)
    follower = running.Follower(plan, arm)
    times = np.random.default_rng(0).uniform(0.0, follower.duration, 200)
    expected = sending.states_at(plan, times)
    for k, now in enumerate(times):
        target = follower(float(now))
        for got, wanted in zip((target.position, target.velocity, target.acceleration), expected, strict=True):
            np.testing.assert_allclose(got, wanted[k], atol=1e-9)
    assert follower(follower.duration + 1e-3) is None
    np.testing.assert_array_equal(follower.last().position, plan.position[-1])
    assert not follower.last().velocity.any()


def test_at_half_the_speed_everything_takes_twice_as_long(arm):
    plan = motion(arm)
    whole, half = running.Follower(plan, arm), running.Follower(plan, arm, 0.5)
    assert half.duration == pytest.approx(2 * whole.duration)
    expected = [x.copy() for x in (whole(0.6).position, whole.last().velocity, whole.last().acceleration)]
    target = half(1.2)
    np.testing.assert_allclose(target.position, expected[0])
    np.testing.assert_allclose(target.velocity, 0.5 * expected[1])
    np.testing.assert_allclose(target.acceleration, 0.25 * expected[2])
    for speed in (0.0, 1.1, np.nan):
        with pytest.raises(InvalidArgument, match="speed"):
            running.Follower(plan, arm, speed)


@pytest.mark.parametrize("seed", range(20))
def test_a_stop_stays_on_the_path_and_within_the_limits_and_ends_at_rest(arm, seed):
    plan = motion(arm, seed)
    follower = running.Follower(plan, arm)
    asked = float(np.random.default_rng(seed).uniform(0.0, follower.duration))
    position, targets = [], []
    for k in range(10_000):
        if k * 1e-3 >= asked:
            follower.stop()
        target = follower(k * 1e-3)
        if target is None:
            break
        targets.append(target.velocity.copy())
        position.append(target.position.copy())
    ended = k * 1e-3
    assert 0.0 < follower.stop_duration <= 0.43 and ended <= asked + follower.stop_duration + 2e-3
    position += [position[-1]] * 4
    velocity = np.diff(np.array([position[0]] * 4 + position), axis=0) * 1e3
    acceleration = np.diff(velocity, axis=0) * 1e3
    assert (np.abs(velocity) <= arm.velocity_limit).all()
    assert (np.abs(acceleration) <= arm.acceleration_limit).all()
    assert (np.abs(np.diff(acceleration, axis=0) * 1e3) <= arm.jerk_limit * 1.001).all()
    np.testing.assert_allclose(velocity[-1], 0.0, atol=1e-9)
    along = sending.states_at(plan, np.linspace(0.0, follower.duration, 200_001))[0]
    for q in position[:: max(1, len(position) // 40)]:
        near = np.abs(along - q).max(axis=1)
        assert near.min() < 1e-4  # between two of the samples of the path, which are up to 2e-5 rad apart
    assert np.abs(along - position[-1]).max(axis=1).min() < 2e-5


def test_a_stop_takes_a_fifth_of_a_second_where_the_limits_allow(arm):
    slow = motion(arm.with_limits(velocity=[0.3] * 3), 1)
    follower = running.Follower(slow, arm)
    follower(0.5)
    follower.stop()
    follower(0.6)
    assert follower.stop_duration == 0.2


def test_two_stops_are_one(arm):
    follower = running.Follower(motion(arm), arm)
    follower.stop()
    follower(0.4)
    follower.stop()
    follower(0.45)
    last = follower(0.4 + follower.stop_duration - 1e-6).position.copy()
    assert follower(0.4 + follower.stop_duration + 0.01) is None
    np.testing.assert_allclose(follower.last().position, last, atol=1e-12)


# ---- the way to the start ---------------------------------------------------------------------------------


def test_an_approach_is_slow_and_goes_from_rest_to_rest(arm):
    way = sending.approach(arm, np.zeros(3), np.array([0.5, -0.2, 0.0]))
    assert not way.velocity[[0, -1]].any() and not way.acceleration[[0, -1]].any()
    np.testing.assert_array_equal(way.position[[0, -1]], [[0, 0, 0], [0.5, -0.2, 0]])
    checks = {one.name: one.value for one in sending.check(way, arm)}
    most = max(checks[f"robot_{name}"] for name in ("velocity", "acceleration", "jerk"))
    assert 0.09 < most <= 0.1 + 1e-9
    assert sending.approach(arm, np.ones(3), np.ones(3)) is None


def test_the_whole_turns_nearest_to_the_robot_are_taken():
    arm = Arm.from_urdf(three("continuous"))
    path = np.array([[6.66, 0.1, 0.0], [6.9, 0.2, 0.0]])
    turns = sending.nearest_turns(arm, path, np.array([0.3, 6.0, 0.0]))
    np.testing.assert_allclose(turns, [-2 * np.pi, 0.0, 0.0])  # b may not turn: its limits are in the way
    np.testing.assert_allclose(sending.nearest_turns(arm, path, np.array([13.0, 0, 0]))[0], 2 * np.pi)


# ---- what speaks against it -------------------------------------------------------------------------------


def test_a_robot_that_may_be_moved_goes_to_the_start_and_along_the_plan(arm):
    plan = motion(arm)
    robot = Exact(plan.position[0] + [0.3, 0.0, -0.1])
    found = running.brief(robot, arm, plan)
    assert not found.problems and not robot.moved
    assert found.distance == (pytest.approx(0.3), "a") and found.duration[0] > 1.0
    run = running.execute(robot, found)
    assert run.end.complete and not run.stopped and run.log.count == len(run.time)
    np.testing.assert_allclose(run.log["position"][-1], plan.position[-1], atol=1e-9)
    at_start = np.searchsorted(run.time, plan.time[0])
    np.testing.assert_allclose(run.log["position"][at_start], plan.position[0], atol=1e-6)
    log = running.as_joint_log(run.log, run.time, NAMES, "exact")
    verified = verification.verify(found.arm, found.plan, log)
    assert verified.lag == pytest.approx(0.0, abs=1e-4) and verified.comparison.errors.position_max < 1e-5


@pytest.mark.parametrize(
    ("robot", "problem"),
    [
        ({"ready": False}, "not ready: reflex"),
        ({"payload": 0.73}, r"carries 0\.73 kg and the plan 0 kg.*payload of 0\.73"),
    ],
)
def test_a_robot_in_error_or_with_another_load_is_not_moved(arm, robot, problem):
    plan = motion(arm)
    exact = Exact(plan.position[0], **robot)
    found = running.brief(exact, arm, plan)
    assert len(found.problems) == 1
    with pytest.raises(running.RobotError, match=problem):
        running.execute(exact, found)
    assert not exact.moved


def test_another_robot_is_not_moved(arm):
    with pytest.raises(running.RobotError, match="has the joints x, b, c, the plan a, b, c"):
        running.brief(Exact(np.zeros(3), names=("x", "b", "c")), arm, motion(arm))


def test_a_plan_beyond_the_limits_or_a_way_that_touches_is_a_problem(arm):
    plan = motion(arm)
    slow = arm.with_limits(velocity=[0.1, 2.0, 2.0])
    assert "velocity" in running.brief(Exact(plan.position[0]), slow, plan).problems[0]
    away = running.brief(Exact(plan.position[0] + 0.2), arm, plan, clear=lambda arm: lambda position: False)
    assert "the way to the start comes nearer than 2 mm" in away.problems[0]


def test_a_robot_that_was_moved_since_it_was_looked_at_is_not_moved(arm):
    plan = motion(arm)
    robot = Exact(plan.position[0])
    found = running.brief(robot, arm, plan)
    robot.stands = robot.stands + [0.0, 0.5, 0.0]
    with pytest.raises(running.RobotError, match="has moved or changed"):
        running.execute(robot, found)
    assert not robot.moved


def test_ctrl_c_stops_along_the_path_and_a_second_one_at_once(arm):
    plan = motion(arm)
    robot = Exact(plan.position[0], stop_at=lambda k: signal.raise_signal(signal.SIGINT) if k in (300, 310) else None)
    before = signal.getsignal(signal.SIGINT)
    run = running.execute(robot, running.brief(robot, arm, plan))
    assert run.stopped and run.end.complete and robot.halted
    assert 300 < run.log.count < 800
    np.testing.assert_allclose(run.log["velocity"][-1], 0.0, atol=1e-6)
    assert signal.getsignal(signal.SIGINT) is before


def test_what_watches_is_asked_in_every_cycle_and_stops(arm):
    plan = motion(arm)
    robot, asked = Exact(plan.position[0]), []
    run = running.execute(robot, running.brief(robot, arm, plan), watch=lambda: asked.append(1) or len(asked) == 300)
    assert run.stopped and len(asked) == 300 and 300 < run.log.count < 800


def test_a_key_that_is_let_go_for_seven_tenths_of_a_second_is_released():
    keyboard, terminal = pty.openpty()
    released = _Released(terminal)
    assert not any(released() for _ in range(100))
    for _ in range(4):
        time.sleep(0.3)
        os.write(keyboard, b" \n")
        assert not any(released() for _ in range(20))
    time.sleep(0.8)
    assert any(released() for _ in range(10))
    os.close(keyboard)
    lost = _Released(terminal)
    assert any(lost() for _ in range(10))


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("ur://10.0.0.1", r"expected one of sim, franka://HOST"),
        ("franka://", "expected a host alone"),
        ("franka://host/path", "expected a host alone"),
        ("192.168.1.10", "expected one of"),
    ],
)
def test_an_address_without_a_known_robot_is_refused(arm, address, message):
    with pytest.raises(InvalidArgument, match=message):
        running.robot_at(address, arm, np.zeros(3))


def test_what_an_fr3_allows_falls_towards_the_ends_of_its_range():
    middle = np.array([0.0, 0.0, 0.0, -1.6, 0.0, 2.5, 0.0])
    low, high = running.velocity_range(middle)
    np.testing.assert_allclose(high, np.array([2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26]) - 1e-3)
    np.testing.assert_allclose(low[:3], -high[:3])
    near = middle.copy()
    near[0] = 2.7501 - 0.1
    assert running.velocity_range(near)[1][0] == pytest.approx(np.sqrt(12.0 * 0.1) - 0.30 - 1e-3)
    assert running.velocity_range(near)[0][0] == pytest.approx(-2.62 + 1e-3)


# ---- simulated, from the command line ---------------------------------------------------------------------


@pytest.fixture
def folder(arm, tmp_path) -> Path:
    """What `plan` leaves, of an arm of three joints."""
    (tmp_path / "arm.urdf").write_text(three())
    plan = tmp_path / "plan"
    plan.mkdir()
    export.write_joints(plan / "joints.csv", motion(arm))
    (plan / "summary.json").write_text('{"verdict": "pass"}')
    (plan / "config.toml").write_text(
        f'[plan]\narm = "{tmp_path / "arm.urdf"}"\nfollow = "position"\n'
        'acceleration = "10,8,12"\njerk = "500,400,600"\n'
    )
    return plan


def run_command(*arguments):
    return CliRunner().invoke(main, ["run", *map(str, arguments)])


def test_a_plan_runs_on_the_simulated_robot_and_is_verified(folder):
    pytest.importorskip("mujoco")
    stands = ",".join(f"{x + 0.02:.4f}" for x in export.read_joints(folder / "joints.csv").position[0])
    done = run_command(folder, "--from-joints", stands, "--simulator", "mujoco")
    assert done.exit_code == 0, done.output
    assert "approach" in done.output and "verified:" in done.output and "above 1 ms" in done.output
    summary = json.loads((folder / "robot" / "verification.json").read_text())
    assert summary["verdict"] == "pass" and summary["lag"] == pytest.approx(0.0, abs=2e-3)
    again = verification.read_log(folder / "robot" / "robot.csv")
    assert again.joint_names == NAMES and again.torque is not None
    text = (folder / "robot" / "robot.csv").read_text()
    assert all(f",{phase}\n" in text for phase in ("approach", "lead-in", "motion", "lead-out"))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda plan: (plan / "summary.json").write_text('{"verdict": "fail"}'), "its verdict is 'fail'"),
        (lambda plan: (plan / "summary.json").unlink(), r"no summary\.json"),
        (lambda plan: (plan / "joints.csv").unlink(), r"no joints\.csv"),
        (lambda plan: (plan / "config.toml").unlink(), "--arm: not given"),
        (lambda plan: (plan / "config.toml").write_text("[plan\n"), r"config\.toml: not TOML"),
    ],
)
def test_a_folder_that_is_no_verified_plan_is_not_run(folder, change, message):
    change(folder)
    done = run_command(folder)
    assert done.exit_code == 2 and message.replace("\\", "") in done.output
    assert not (folder / "robot").exists()


def test_a_host_that_does_not_answer_is_one_sentence(folder):
    pytest.importorskip("pylibfranka")
    done = run_command(folder, "--robot", "franka://127.0.0.254", "--go", "--yes")
    assert done.exit_code == 2 and "no robot is reached" in done.output and "FCI" in done.output
    assert not (folder / "robot").exists()
