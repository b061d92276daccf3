"""Trajectories for robots: what is written is read back by other readers too; what no robot should get is refused."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from dmpcpp import arms, export, sending
from dmpcpp.errors import FileError, InvalidArgument

WRITERS = {
    "csv": (export.write_joints, export.read_joints),
    "yaml": (export.write_ros2_yaml, export.read_ros2_yaml),
    "bag": (export.write_ros2_bag, export.read_ros2_bag),
}


def reach(names=tuple("abcdef"), size=0.3, duration=2.0) -> SimpleNamespace:
    """A minimum-jerk motion of every joint, at rest at both ends."""
    time = np.linspace(0.0, duration, 81)
    s = time / duration
    scale = size * np.arange(1, len(names) + 1) / len(names)
    return SimpleNamespace(
        time=time,
        position=np.outer(s**3 * (10 - 15 * s + 6 * s**2), scale),
        velocity=np.outer(30 * s**2 * (1 - s) ** 2, scale) / duration,
        acceleration=np.outer(60 * s - 180 * s**2 + 120 * s**3, scale) / duration**2,
        joint_names=list(names),
    )


def write(kind, path, *arguments, **options):
    if kind == "bag":
        pytest.importorskip("rosbags")
    WRITERS[kind][0](path, *arguments, **options)
    return WRITERS[kind][1](path)


@pytest.mark.parametrize("kind", WRITERS)
def test_what_is_written_is_read_back(kind, tmp_path):
    written = reach(["it's", "left arm/1", "c", "d", "e: 5", "#f"])
    written.position[3] = [1e-5, -1e-300, 1e22, 0.1, -0.0, 3.0]
    read = write(kind, tmp_path / "motion", written)
    assert read.joint_names == tuple(written.joint_names)
    np.testing.assert_allclose(read.time, written.time, atol=1e-9)
    for what in ("position", "velocity", "acceleration"):
        np.testing.assert_array_equal(getattr(read, what), getattr(written, what))


def test_the_yaml_is_what_a_yaml_reader_takes_for_a_joint_trajectory(tmp_path):
    yaml = pytest.importorskip("yaml")
    written = reach(["it's", "e: 5"])
    written.position[1] = [1e-5, 3.0]
    export.write_ros2_yaml(tmp_path / "m.yaml", written, lead=0.25)
    message = yaml.safe_load((tmp_path / "m.yaml").read_text())
    assert list(message) == ["header", "joint_names", "points"]
    assert message["joint_names"] == ["it's", "e: 5"]
    assert message["points"][0]["time_from_start"] == {"sec": 0, "nanosec": 250_000_000}
    assert message["points"][-1]["time_from_start"] == {"sec": 2, "nanosec": 250_000_000}
    for k, point in enumerate(message["points"]):
        assert point["positions"] == written.position[k].tolist()
        assert point["velocities"] == written.velocity[k].tolist()
        assert point["accelerations"] == written.acceleration[k].tolist()


def test_the_bag_holds_one_message_on_the_topic_and_is_never_written_over(tmp_path):
    rosbag2 = pytest.importorskip("rosbags.rosbag2")
    export.write_ros2_bag(tmp_path / "bag", reach(), topic="/arm/command")
    with rosbag2.Reader(tmp_path / "bag") as reader:
        assert [(c.topic, c.msgtype) for c in reader.connections] == [
            ("/arm/command", "trajectory_msgs/msg/JointTrajectory")
        ]
        assert reader.message_count == 1
    assert export.read_ros2_bag(tmp_path / "bag", "/arm/command").time[-1] == pytest.approx(2.0)
    with pytest.raises(InvalidArgument, match="no message of type .*JointTrajectory on /other"):
        export.read_ros2_bag(tmp_path / "bag", "/other")
    with pytest.raises(FileError, match="there already"):
        export.write_ros2_bag(tmp_path / "bag", reach())
    with pytest.raises(FileError, match="cannot be"):
        export.write_ros2_bag(tmp_path / "no" / "bag", reach())
    with pytest.raises(FileError, match="cannot be read"):
        export.read_ros2_bag(tmp_path / "nowhere")
    assert [path.name for path in tmp_path.iterdir()] == ["bag"]


@pytest.mark.parametrize("kind", [*WRITERS, "urscript"])
@pytest.mark.parametrize(
    ("what", "index", "value", "message"),
    [
        ("position", (3, 2), math.nan, r"position\[3, 2\]: nan of joint 'c'"),
        ("acceleration", (80, 5), math.inf, r"acceleration\[80, 5\]: inf of joint 'f'"),
        ("time", 5, 0.0, r"time\[5\]"),
    ],
)
def test_numbers_no_robot_should_get_are_refused_and_nothing_is_left(kind, what, index, value, message, tmp_path):
    broken = reach()
    getattr(broken, what)[index] = value
    writer = export.write_urscript if kind == "urscript" else WRITERS[kind][0]
    if kind == "bag":
        pytest.importorskip("rosbags")
    with pytest.raises(InvalidArgument, match=message):
        writer(tmp_path / "motion", broken)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("kind", WRITERS)
def test_joints_outside_an_arms_limits_are_refused_with_sample_and_joint(kind, tmp_path):
    pytest.importorskip("pybullet_data")
    if kind == "bag":
        pytest.importorskip("rosbags")
    arm = arms.find("iiwa")
    within = reach(arm.joint_names)
    write(kind, tmp_path / "within", within, arm)
    far = reach(arm.joint_names)
    far.position[40, 3] = arm.upper[3] + 0.01
    fast = reach(arm.joint_names)
    fast.velocity[7, 1] = -1.5 * arm.velocity_limit[1]
    for trajectory, message in (
        (far, rf"position\[40, 3\]: .* rad of joint '{arm.joint_names[3]}', expected -.* to "),
        (fast, rf"velocity\[7, 1\]: -.* rad/s of joint '{arm.joint_names[1]}'"),
        (reach(), "joint_names: .*expected those of arm"),
    ):
        with pytest.raises(InvalidArgument, match=message):
            WRITERS[kind][0](tmp_path / "outside", trajectory, arm)
    assert not (tmp_path / "outside").exists()


@pytest.mark.parametrize("kind", ["yaml", "bag"])
def test_ros_trajectories_end_at_rest_and_begin_after_now(kind, tmp_path):
    moving = reach()
    moving.velocity[-1, 4] = 0.2
    with pytest.raises(InvalidArgument, match=r"velocity\[80, 4\]: 0\.2 rad/s of joint 'e' at the end, expected 0"):
        WRITERS[kind][0](tmp_path / "m", moving)
    with pytest.raises(InvalidArgument, match="lead: 0, expected"):
        WRITERS[kind][0](tmp_path / "m", reach(), lead=0)


def test_the_goal_of_an_action_has_tolerances_and_says_how_it_is_sent(tmp_path):
    yaml = pytest.importorskip("yaml")
    pytest.importorskip("pybullet_data")
    arm = arms.find("iiwa")
    written = reach(arm.joint_names)
    export.write_ros2_goal(tmp_path / "goal.yaml", written, arm, lead=3.0)
    text = (tmp_path / "goal.yaml").read_text()
    goal = yaml.safe_load(text)
    assert list(goal) == ["trajectory", "path_tolerance", "goal_tolerance", "goal_time_tolerance"]
    assert [one["name"] for one in goal["path_tolerance"]] == list(arm.joint_names)
    assert {one["position"] for one in goal["goal_tolerance"]} == {0.01}
    assert goal["trajectory"]["points"][0]["time_from_start"] == {"sec": 3, "nanosec": 0}
    first, second = text.splitlines()[:2]
    near = sending.farthest(arm, 3.0)
    assert f"3 s after the controller gets this. The robot must stand within {near:.2g} rad" in first
    assert second.startswith("# ros2 action send_goal /joint_trajectory_controller/follow_joint_trajectory ")
    way = sending.approach(arm, np.zeros(7), np.full(7, near))
    assert way.time[-1] == pytest.approx(3.0, abs=0.02)


@pytest.mark.parametrize("line", ["junk", "- positions: [1, x]", "- positions: [1.0]", "points: 3"])
def test_a_damaged_yaml_is_refused(line, tmp_path):
    path = tmp_path / "m.yaml"
    export.write_ros2_yaml(path, reach())
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:20], line, *lines[20:]]))
    with pytest.raises(InvalidArgument, match=r"m\.yaml: "):
        export.read_ros2_yaml(path)


@pytest.mark.parametrize("period", [0.002, 0.008, 0.013])
def test_servoj_follows_the_motion_at_even_steps_to_its_last_joints(period, tmp_path):
    written = reach()
    export.write_urscript(tmp_path / "m.script", written, period=period)
    read, joints = export.read_urscript(tmp_path / "m.script")
    assert read == period
    time = np.minimum(np.arange(len(joints)) * period, 2.0)
    assert time[-1] == 2.0 and len(joints) == math.ceil(2.0 / period - 1e-9) + 1
    s = time / 2.0
    np.testing.assert_allclose(joints[:, 5], 0.3 * s**3 * (10 - 15 * s + 6 * s**2), atol=1e-7)
    lines = (tmp_path / "m.script").read_text().splitlines()
    assert lines[0].startswith("# First the robot goes straight in joint space, at 0.3 rad/s")
    assert lines[2] == "def dmpcpp_motion():" and lines[3].startswith("  movej([0.0, ")
    assert lines[-3:] == ["  stopj(2.0)", "end", "dmpcpp_motion()"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"period": 0.0}, r"period: 0\.0, expected 0\.002 to 0\.1"),
        ({"lookahead": 1.0}, r"lookahead: 1\.0, expected 0\.03 to 0\.2"),
        ({"gain": math.nan}, "gain: nan, expected 100 to 2000"),
        ({"name": "a b"}, "name: 'a b'"),
    ],
)
def test_servoj_parameters_outside_their_range_are_refused(options, message, tmp_path):
    with pytest.raises(InvalidArgument, match=message):
        export.write_urscript(tmp_path / "m.script", reach(), **options)
    with pytest.raises(InvalidArgument, match="joint_names: 7 joints, expected 6"):
        export.write_urscript(tmp_path / "m.script", reach(tuple("abcdefg")))
