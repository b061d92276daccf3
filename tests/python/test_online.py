"""A goal that moves while the robot does: taken or dropped, followed within limits, reached, stopped at rest."""

import json
import socket

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import InverseKinematics, PoseDemonstration, PoseDmp, export, running, save
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument
from dmpcpp.running import GoalSource, JointLimiter, OnlineMotion, goals_from
from dmpcpp.simulation import Tolerances

from tests.python.test_planning import six_joints, swing

PERIOD = 1e-3


@pytest.fixture(scope="module")
def arm():
    return six_joints().with_limits(jerk=np.full(6, 400.0))


@pytest.fixture(scope="module")
def model(arm) -> PoseDmp:
    return swing(arm, duration=2.0)


def from_lines(lines) -> GoalSource:
    """Lines by their own times, also the broken ones, which come at 0.5 s."""
    waiting = sorted(lines, key=lambda each: -each[0])

    def due(time):
        found = []
        while waiting and waiting[-1][0] <= time:
            found.append(waiting.pop()[1])
        return found

    return GoalSource(due)


def carried(motion: OnlineMotion):
    states, k = [], 0
    while (sample := motion(k * PERIOD)) is not None:
        states.append([sample.position.copy(), sample.velocity.copy(), sample.acceleration.copy()])
        k += 1
        assert k < 20_000
    return np.moveaxis(np.array(states), 1, 0)


def online(arm, model, goals, **how) -> OnlineMotion:
    first = InverseKinematics(arm).follow(model.rollout()).position[0]
    return OnlineMotion(model, arm, first, first, goals, duration=model.duration, period=PERIOD, **how)


@pytest.mark.parametrize("seed", range(3))
def test_a_goal_that_moves_twenty_times_is_reached_within_the_limits(arm, model, seed):
    random = np.random.default_rng(seed)
    places = model.goal[:3, 3] + random.uniform(-0.04, 0.04, (20, 3))
    times = np.sort(random.uniform(0.0, 2.0, 20))
    lines = [(t, f"{t} {x} {y} {z}") for t, (x, y, z) in zip(times, places, strict=True)]
    motion = online(arm, model, from_lines(lines))
    position, velocity, acceleration = carried(motion)
    found = motion.reached(position[-1])
    assert found.position < 1e-5 and found.missed == 0
    np.testing.assert_allclose(arm.forward_kinematics(position[-1])[:3, 3], places[-1], atol=1e-5)
    checks = running.online_checks(found, position, arm, PERIOD, Tolerances())
    assert [check.name for check in checks if not check.ok] == []
    assert (velocity[-1] == 0.0).all() and (acceleration[-1] == 0.0).all()
    assert np.abs(np.diff(acceleration[:-1], axis=0)).max() <= 400.0 * PERIOD * (1 + 1e-9)  # continuous
    np.testing.assert_allclose(np.diff(position, axis=0), 0.5 * PERIOD * (velocity[1:] + velocity[:-1]), atol=1e-6)


def test_without_a_goal_it_is_the_motion_of_the_model(arm, model):
    motion = online(arm, model, from_lines([]))
    position, *_ = carried(motion)
    np.testing.assert_allclose(arm.forward_kinematics(position[-1]), model.goal, atol=1e-5)
    assert motion.reached(position[-1]).angle < 1e-4


def test_a_stop_comes_to_rest_soon_and_takes_no_further_goal(arm, model):
    motion = online(arm, model, from_lines([(1.2, "1.2 9 9 9")]))
    for k in range(1000):
        motion(k * PERIOD)
    motion.stop()
    states = []
    for k in range(1000, 6000):
        sample = motion(k * PERIOD)
        if sample is None:
            break
        states.append((np.abs(sample.velocity).max(), sample.position.copy()))
    assert sample is None and states[-1][0] == 0.0 and motion.stopping
    assert states[600][0] < 0.02 * states[0][0] + 1e-3
    assert np.abs(motion.reached(states[-1][1]).position) < 1.0  # the goal at 9 m was not taken


def test_a_goal_that_never_rests_ends_at_rest_all_the_same(arm, model):
    x, y, z = model.goal[:3, 3]
    lines = [(t, f"{t} {x + 0.02 * np.sin(5 * t)} {y} {z}") for t in np.arange(0.0, 9.0, 0.1)]
    motion = online(arm, model, from_lines(lines))
    motion.duration = 4.0
    position, velocity, _ = carried(motion)
    assert 4.0 < PERIOD * len(position) < 7.0 and motion.stopping
    assert (velocity[-1] == 0.0).all() and np.abs(np.diff(position, axis=0)).max() > 0.0


@pytest.mark.parametrize(
    ("line", "taken", "broken", "late"),
    [
        ("2 0.4 0 0.5", 1, 0, 0),
        ("2, 0.4, 0, 0.5, 0, 0, 0, 1", 1, 0, 0),
        ("1 0.4 0 0.5", 0, 0, 1),
        ("0.5 0.4 0 0.5", 0, 0, 1),
        ("2 0.4 0", 0, 1, 0),
        ("2 nan 0 0.5", 0, 1, 0),
        ("inf 0.4 0 0.5", 0, 1, 0),
        ("2 0.4 0 0.5 0 0 0 2", 0, 1, 0),
        ("here 0.4 0 0.5", 0, 1, 0),
        ("2 1e300 0 0.5", 0, 1, 0),
        ("", 0, 1, 0),
    ],
)
def test_what_is_no_finite_pose_or_not_newer_is_left_out_and_counted(line, taken, broken, late):
    source = from_lines([(0.0, "1 0 0 0"), (0.1, line)])
    assert source.newest(0.0, np.eye(4)) is not None
    found = source.newest(0.2, np.eye(4))
    assert (source.taken - 1, source.broken, source.late) == (taken, broken, late)
    assert (found is not None) == bool(taken)
    if taken:
        np.testing.assert_allclose(found[:3, 3], [0.4, 0.0, 0.5])
        np.testing.assert_allclose(found[:3, :3], np.eye(3))


def test_packets_arrive_and_this_machine_alone_is_listened_to():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    source = goals_from(f"udp://:{port}")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for line in ("1 0.1 0.2 0.3", "rubbish", "2 0.2 0.2 0.3"):
            sender.sendto(line.encode(), ("127.0.0.1", port))
    found = source.newest(0.0, np.eye(4))
    assert source.newest(0.0, np.eye(4)) is None
    np.testing.assert_allclose(found[:3, 3], [0.2, 0.2, 0.3])
    assert source.describe() == "goal: moved 2 times; left out: 1 no finite pose"
    with pytest.raises(InvalidArgument, match=r"cannot be listened at"):
        goals_from(f"udp://127.0.0.1:{port}")
    source.close()


@pytest.mark.parametrize("address", ["udp://127.0.0.1", "udp://127.0.0.1:0", "udp://127.0.0.1:99999", "udp://x:y"])
def test_an_address_that_is_none_is_refused(address):
    with pytest.raises(InvalidArgument, match=r"expected udp://HOST:PORT"):
        goals_from(address)


def test_a_file_with_a_line_that_is_no_goal_is_refused_before_anything_moves(tmp_path):
    (tmp_path / "goals.txt").write_text("# t x y z\n0 0 0 0\n\n0.1 0 0\n")
    with pytest.raises(InvalidArgument, match=r"line 4: '0.1 0 0', expected t x y z"):
        goals_from(str(tmp_path / "goals.txt"))
    with pytest.raises(InvalidArgument, match="cannot be read"):
        goals_from(str(tmp_path / "none.txt"))


def test_targets_that_jump_are_followed_within_every_limit_and_from_rest_without_overshoot(arm):
    random = np.random.default_rng(5)
    limiter = JointLimiter(arm, np.zeros(6))
    share, before = 0.0, limiter.acceleration
    for k in range(6000):
        if k % 150 == 0:
            target = random.uniform(arm.lower, arm.upper)
        limiter.step(target, np.zeros(6), PERIOD)
        jerk = np.abs(limiter.acceleration - before) / PERIOD / 400.0
        before = limiter.acceleration
        speed = np.abs(limiter.velocity) / arm.velocity_limit
        share = max(share, (np.abs(before) / arm.acceleration_limit).max(), jerk.max(), speed.max())
        assert (limiter.position >= arm.lower).all() and (limiter.position <= arm.upper).all()
    assert 0.9 < share <= 1.0
    start, target = random.uniform(arm.lower, arm.upper, (2, 6))
    limiter, way = JointLimiter(arm, start), np.sign(target - start)
    for _ in range(8000):
        limiter.step(target, np.zeros(6), PERIOD)
        assert (way * (limiter.position - target)).max() < 1e-6
    np.testing.assert_allclose(limiter.position, target, atol=1e-9)


def test_a_rhythmic_model_has_no_goal(arm):
    time = np.linspace(0.0, 2 * np.pi, 101)
    pose = np.tile(np.eye(4), (101, 1, 1))
    pose[:, 0, 3], pose[:, 1, 3] = 0.4 + 0.1 * np.cos(time), 0.1 * np.sin(time)
    stir = PoseDmp.fit(PoseDemonstration(time, pose), motion="rhythmic")
    with pytest.raises(InvalidArgument, match="rhythmic"):
        OnlineMotion(stir, arm, np.zeros(6), np.zeros(6), from_lines([]), duration=2.0, period=PERIOD)


def test_the_command_follows_a_goal_on_the_simulated_robot(tmp_path, model):
    pytest.importorskip("pybullet")
    from tests.python.test_planning import six_urdf

    (tmp_path / "six.urdf").write_text(six_urdf())
    save(model, tmp_path / "model.json")
    out = tmp_path / "plan"
    invoke = CliRunner().invoke
    done = invoke(main, ["plan", str(tmp_path / "model.json"), "--arm", str(tmp_path / "six.urdf"), "--out", str(out)])
    assert done.exit_code == 0, done.output
    refused = invoke(main, ["run", str(out), "--goal-from", "stdin"])
    assert refused.exit_code == 2 and "Give the folder of `dmpcpp imitate`" in refused.output
    (out / "model.json").write_bytes((tmp_path / "model.json").read_bytes())
    x, y, z = model.goal[:3, 3]
    (tmp_path / "goals.txt").write_text("".join(f"{t} {x} {y} {z + 0.02 * t}\n" for t in np.linspace(0, 1, 11)))
    done = invoke(main, ["run", str(out), "--goal-from", str(tmp_path / "goals.txt")])
    assert done.exit_code == 0, done.output
    assert "goal: moved 11 times" in done.output and "contacts and torques were not judged" in done.output
    summary = json.loads((out / "robot" / "verification.json").read_text())
    assert summary["ok"] and summary["goal"] == {"taken": 11, "broken": 0, "late": 0}
    log = export.read_joints(out / "joints.csv")
    assert len(log.time) > 2 and "approach" not in (out / "robot" / "robot.csv").read_text()[:4000]
    far = tmp_path / "far.txt"
    far.write_text("0.2 9 9 9\n")
    missed = invoke(main, ["run", str(out), "--goal-from", str(far)])
    assert missed.exit_code == 3 and "goal_position" in missed.output and "out of reach" in missed.output
