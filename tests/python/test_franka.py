"""An FR3 that nobody here wrote: franky-sim, a server of Franka's network protocol over MuJoCo, in its own process."""

import contextlib
import itertools
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import JointTrajectory, arms, export, planning, running, sending, verification

pytest.importorskip("pylibfranka", reason="the extra `franka`")
franky_sim = pytest.importorskip("franky_sim", reason="the test extra `franky-sim`")

HOME = np.array([0.0, 0.0, 0.0, -1.57, 0.0, 1.57, 0.785])
SERVER = Path(sys.executable).with_name("franky-sim")


class Server:
    """One robot on a loopback address of its own."""

    def __init__(self, host: str) -> None:
        self.host = host
        command = [str(SERVER), "-s", "mujoco", "--hostname", host]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def robot(self) -> running.FrankaRobot:
        """The driver, once the server answers."""
        for left in reversed(range(60)):
            with contextlib.suppress(running.RobotError):
                robot = running.FrankaRobot(self.host)
                robot.connect()
                return robot
            assert self.process.poll() is None and left
            time.sleep(0.5)
        raise AssertionError

    def end(self) -> None:
        self.process.kill()
        self.process.wait()


@pytest.fixture
def server():
    found = Server(f"127.{os.getpid() % 200 + 20}.{time.time_ns() % 250 + 1}.7")
    yield found
    found.end()


@pytest.fixture(scope="module")
def fr3():
    return arms.load(Path(franky_sim.__file__).parent / "assets" / "fr3_clean.urdf")


def motion(arm, seed: int = 0, size: float = 0.25, duration: float = 1.0) -> export.JointSamples:
    """A swing about the robot's home, within the limits that the driver states."""
    random = np.random.default_rng(seed)
    limited = running.FrankaRobot("nowhere").limits(arm)
    t = np.linspace(0.0, duration, 251)
    position = HOME + size * random.uniform(-1.0, 1.0, 7) * np.sin(np.outer(t, random.uniform(1.0, 3.0, 7)))
    joints = planning.slowed(limited, JointTrajectory.through(t, position, list(arm.joint_names))).joints
    sent = sending.from_rest_to_rest(limited, joints)
    return export.JointSamples(
        sent.time, sent.position, sent.velocity, sent.acceleration, sent.joint_names, sent.motion
    )


def stands_still(robot: running.FrankaRobot) -> np.ndarray:
    """Where the robot stands, once its impedance controller has brought it to rest; its clock is slower than ours."""
    before = robot.state()
    for _ in range(300):
        time.sleep(0.1)
        after = robot.state()
        np.testing.assert_allclose(after.commanded, before.commanded, atol=1e-6)
        off = np.abs(after.position - after.commanded).max()
        if off < 5e-3 and np.abs(after.velocity).max() < 0.1:  # the simulator's last joint trembles for long
            return after.commanded
    raise AssertionError(f"it still moves: {after.velocity}, {after.position - after.commanded}")


def test_a_plan_is_approached_streamed_recorded_and_verified(server, fr3):
    plan = motion(fr3)
    plan = export.JointSamples(
        plan.time, plan.position + 0.02, plan.velocity, plan.acceleration, plan.joint_names, plan.motion
    )
    robot = server.robot()
    found = running.brief(robot, fr3, plan)
    assert found.problems == () and found.distance[0] == pytest.approx(np.abs(plan.position[0] - HOME).max(), abs=1e-3)
    np.testing.assert_allclose(stands_still(robot), HOME, atol=1e-3)  # nothing was moved yet
    run = running.execute(robot, found)
    assert run.end.complete and not run.stopped, run.end.reason
    assert run.log.count == pytest.approx(1e3 * sum(found.duration), abs=5)
    np.testing.assert_allclose(stands_still(robot), plan.position[-1], atol=1e-5)

    sent = sending.Joints(run.time, run.log["commanded"], *[np.zeros_like(run.log["commanded"])] * 2, plan.joint_names)
    steps = [np.diff(sent.position, n=n, axis=0) * 1e3**n for n in (1, 2, 3)]  # as the robot has seen it
    limits = (found.arm.velocity_limit, found.arm.acceleration_limit, found.arm.jerk_limit)
    assert all((np.abs(step) <= limit).all() for step, limit in zip(steps, limits, strict=True))
    verified = verification.verify(
        found.arm, found.plan, running.as_joint_log(run.log, run.time, plan.joint_names, "x")
    )
    assert 0.0 <= verified.lag < 0.2 and verified["log_coverage"].ok


def after_cycles(cycles: int, act):
    """Return what does something, and tells its result, in a cycle of the robot's: its clock is not ours."""
    counter = itertools.count(1)
    return lambda: next(counter) == cycles and act()


@pytest.mark.parametrize("cycles", [200, 700])
def test_a_stop_on_the_way_ends_at_rest_on_the_path(server, fr3, cycles):
    plan = motion(fr3, 1)
    robot = server.robot()
    found = running.brief(robot, fr3, plan)
    run = running.execute(robot, found, watch=after_cycles(cycles, lambda: True))
    assert run.stopped and run.end.complete and cycles - 1 <= run.log.count < 1e3 * sum(found.duration)
    whole = found.whole
    along = sending.states_at(whole, np.linspace(0.0, whole.time[-1] - whole.time[0], 100_001))[0]
    assert np.abs(along - run.log["commanded"][-1]).max(axis=1).min() < 1e-4
    stands_still(robot)


def test_a_server_that_goes_ends_the_run_with_one_sentence_and_a_whole_log(server, fr3):
    plan = motion(fr3, 2)
    robot = server.robot()
    found = running.brief(robot, fr3, plan)
    run = running.execute(robot, found, watch=after_cycles(300, lambda: bool(server.process.kill())))
    assert not run.end.complete and "the robot ended the motion" in run.end.reason and "\n" not in run.end.reason
    assert run.log.count >= 299 and np.isfinite(run.log["commanded"]).all() and np.isfinite(run.log["position"]).all()
    with pytest.raises(running.RobotError, match="does not answer"):
        robot.state()


def test_a_plan_beyond_the_limits_or_of_another_robot_moves_nothing(server, fr3):
    plan = motion(fr3, 3)
    robot = server.robot()
    fast = sending.slowed_by(plan, 0.05)
    fast = export.JointSamples(
        plan.time * 0.05,
        plan.position,
        plan.velocity / 0.05,
        plan.acceleration / 0.05**2,
        fast.joint_names,
        plan.motion,
    )
    found = running.brief(robot, fr3, fast)
    assert "may not get this motion: " in found.problems[0] and "of joint 'joint" in found.problems[0]
    with pytest.raises(running.RobotError):
        running.execute(robot, found)
    pytest.importorskip("pybullet_data")
    with pytest.raises(running.RobotError, match=r"arm 'panda' with joints panda_joint1.*and the robot is an FR3"):
        running.brief(robot, arms.find("panda"), plan)
    np.testing.assert_allclose(stands_still(robot), HOME, atol=1e-3)


def test_a_loop_that_stalls_goes_on_at_the_time_that_it_is(server, fr3):
    plan = motion(fr3, 4)
    robot = server.robot()
    found = running.brief(robot, fr3, plan)

    class Stalls(running.Follower):
        calls = 0

        def __call__(self, time_: float):
            self.calls += 1
            if self.calls == 200:
                time.sleep(0.05)
            return super().__call__(time_)

    log = running.CycleLog(20_000, 7)
    end = robot.stream(Stalls(found.whole, found.arm), log)
    assert end.complete or end.reason
    assert np.isfinite(log["commanded"]).all()
    expected = sending.states_at(found.whole, np.minimum(log["time"], found.whole.time[-1] - found.whole.time[0]))[0]
    np.testing.assert_allclose(log["commanded"], expected, atol=1e-9)
