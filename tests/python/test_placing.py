"""Where a motion shall stand, and what the robot is sent, as the command line takes it."""

import json
import re
from importlib.metadata import PackageNotFoundError, files

import click
import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import arms, export, imitation, retarget
from dmpcpp.cli import main
from dmpcpp.cli._options import placing_options, taken_placing
from dmpcpp.errors import InvalidArgument
from scipy.spatial.transform import Rotation

from tests.python.motions import reaches


def taken(*arguments, seed=3):
    """What the options become."""
    found = {}

    @click.command()
    @placing_options
    def command(**options):
        found.update(taken_placing({**options, "seed": seed}))

    done = CliRunner().invoke(command, arguments, catch_exceptions=True)
    if isinstance(done.exception, InvalidArgument):
        raise done.exception
    assert done.exit_code == 0, done.output
    return found


def test_without_an_anchor_a_placement_is_searched_in_a_range_of_scale():
    assert taken() == {"place": True, "scale": None}
    assert taken("--scale", "0.5") == {"place": True, "scale": (0.5, 0.5)}
    assert taken("--scale", "0.4:0.8") == {"place": True, "scale": (0.4, 0.8)}
    assert taken("--no-place")["place"] is False


@pytest.mark.parametrize("anchor", ["start", "goal"])
def test_an_anchor_is_a_point_or_a_pose(anchor):
    point = taken(f"--anchor-{anchor}", "-0.4,0,0.5", "--scale", "0.5:0.9", "--yaw", "-90")["place"].keywords
    np.testing.assert_array_equal(point["at"], [-0.4, 0.0, 0.5])
    assert (point["on"], point["scale"], point["seed"]) == (anchor, (0.5, 0.9), 3)
    assert point["yaw"] == pytest.approx(-np.pi / 2) and point["tool_rotation"] is None
    pose = taken(f"--anchor-{anchor}", "0.4,0,0.5,0,180,0")["place"].keywords["at"]
    np.testing.assert_allclose(pose, [[-1, 0, 0, 0.4], [0, 1, 0, 0], [0, 0, -1, 0.5], [0, 0, 0, 1]], atol=1e-15)


def test_a_shoulder_is_put_where_it_shall_be_and_the_tool_turned():
    keywords = taken(
        *("--anchor-shoulder", "0,0,0.333", "--shoulder", "1,2,3", "--tool-rotation", "0,0,90", "--yaw", "0")
    )["place"].keywords
    np.testing.assert_array_equal(keywords["on"], [1.0, 2.0, 3.0])
    np.testing.assert_array_equal(keywords["at"], [0.0, 0.0, 0.333])
    np.testing.assert_allclose(keywords["tool_rotation"], [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-15)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--scale", "big"], "--scale: 'big', expected a number such as 0.5"),
        (["--anchor-start", "1,2"], "--anchor-start: '1,2', expected 3 or 6 numbers"),
        (["--anchor-goal", "1,2,nan"], "--anchor-goal: '1,2,nan', expected 3 or 6 numbers"),
        (["--anchor-start", "a,b,c"], "--anchor-start: 'a,b,c', expected 3 or 6"),
        (["--anchor-start", "1,2,3", "--anchor-goal", "1,2,3"], "--anchor-start and --anchor-goal: expected one"),
        (["--anchor-start", "1,2,3", "--no-place"], "--anchor-start: not together with --no-place"),
        (["--scale", "0.5", "--no-place"], "--scale: not together with --no-place"),
        (["--anchor-shoulder", "1,2,3"], "--anchor-shoulder and --shoulder: expected both"),
        (["--anchor-start", "1,2,3", "--shoulder", "1,2,3"], "--anchor-shoulder and --shoulder: expected both"),
        (
            ["--anchor-shoulder", "1,2,3,4,5,6", "--shoulder", "1,2,3"],
            "--anchor-shoulder: '1,2,3,4,5,6', expected 3 nu",
        ),
        (["--yaw", "10"], "--yaw: of an anchored motion; state --anchor-start, --anchor-goal, --anchor-shoulder"),
        (["--tool-rotation", "0,0,90"], "--tool-rotation: of an anchored motion"),
        (["--anchor-start", "1,2,3,0,0,0", "--tool-rotation", "0,0,90"], "--tool-rotation: --anchor-start has an ori"),
    ],
)
def test_options_without_sense_are_refused_by_name(arguments, message):
    with pytest.raises(InvalidArgument, match=re.escape(message)):
        taken(*arguments)


def test_a_policy_places_the_motion_and_is_told_what_the_arm_may_do():
    pytest.importorskip("pybullet_data")
    told = {}

    def policy(recording, arm, *, accept):
        told.update(samples=len(recording), arm=arm.name, accept=accept)
        found = retarget.anchor_within_reach(recording, arm, [0.45, 0.1, 0.5], accept=accept)
        told["start"] = found.start
        return found

    run = imitation.imitate(reaches(1), arms.find("panda"), place=policy)
    assert run.ok and (told["samples"], told["arm"]) == (len(run.recording), "panda") and callable(told["accept"])
    np.testing.assert_allclose(run.recording.position[0], [0.45, 0.1, 0.5], atol=1e-12)
    np.testing.assert_allclose(run.joints.position[0], told["start"], atol=1e-3)


def hand(folder):
    """The recording of a hand as a file."""
    motion = reaches(1)
    pose = np.tile(np.eye(4), (len(motion), 1, 1))
    pose[:, :3, :3], pose[:, :3, 3] = motion.rotation, motion.position
    np.savez(folder / "hand.npz", time=motion.time, pose=pose)
    return folder / "hand.npz"


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def test_a_motion_ends_where_its_goal_was_anchored_and_the_robot_is_sent_what_was_simulated(tmp_path):
    pytest.importorskip("pybullet_data")
    pytest.importorskip("rosbags")
    out = tmp_path / "out"
    stated = ("imitate", hand(tmp_path), "--anchor-goal", "0.45,-0.1,0.5,180,0,0", "--out", out)
    done = run(*stated, "--export", "ros2", "--export", "ros2-bag", "--json")
    assert done.exit_code == 0, done.output
    arm = arms.find("panda")
    end = arm.forward_kinematics(export.read_joints(out / "joints.csv").of_motion().position[-1])
    np.testing.assert_allclose(end[:3, 3], [0.45, -0.1, 0.5], atol=2e-4)
    assert Rotation.from_matrix(end[:3, :3].T @ np.diag([1.0, -1.0, -1.0])).magnitude() < 1e-3

    sent = export.read_ros2_yaml(out / "joints.yaml")
    bag = export.read_ros2_bag(out / "joints_bag")
    planned = export.read_joints(out / "joints.csv").of_motion()
    export.check_limits(sent, arm)
    for samples in (sent, bag):
        assert not samples.velocity[[0, -1]].any() and not samples.acceleration[[0, -1]].any()  # from rest to rest
        np.testing.assert_allclose(np.diff(samples.time), 0.008, atol=2e-9)
    between = np.linspace(0.1, 0.9, 9) * planned.time[-1]
    lead = sent.time[-1] - planned.time[-1]
    tracked = [np.interp(between, planned.time, q) for q in planned.position.T]
    shifts = np.arange(0.0, lead + 0.004, 0.004)  # how long the arm runs up is not told by the file
    off = [
        np.abs([np.interp(between + s, sent.time, q) for q in sent.position.T] - np.array(tracked)).max()
        for s in shifts
    ]
    assert min(off) < 5e-3

    # Another run into the same folder leaves nothing behind that is not its own.
    assert run(*stated, "--json").exit_code == 0
    assert not (out / "joints.yaml").exists() and not (out / "joints_bag").exists()


def test_a_robot_is_sent_nothing_that_is_not_verified(tmp_path):
    pytest.importorskip("pybullet_data")
    out = tmp_path / "out"
    done = run(
        "imitate", hand(tmp_path), "--anchor-start", "0.9,0,0.6", "--scale", "1", "--export", "ros2", "--out", out
    )
    assert done.exit_code == 3, done.output
    assert "for the robot: nothing, as it is not verified" in done.output
    assert json.loads((out / "summary.json").read_text())["verdict"] == "fail"
    assert any(
        "no candidate could be followed" in line
        for line in json.loads((out / "summary.json").read_text())["recording"]["history"]
    )
    assert not (out / "joints.yaml").exists()


@pytest.mark.parametrize("anchor", ["start", "goal"])
def test_an_anchor_beyond_the_arm_is_refused_with_its_distance(anchor, tmp_path):
    pytest.importorskip("pybullet_data")
    done = run("imitate", hand(tmp_path), f"--anchor-{anchor}", "450,0,500", "--out", tmp_path / "out")
    assert done.exit_code == 2, done.output
    assert (
        f"the {anchor} of the motion at (450, 0, 500) m lies 672 m from the first joint of arm 'panda'" in done.output
    )
    assert "is 0.986 m long stretched out" in done.output and not (tmp_path / "out").exists()


def test_urscript_is_refused_for_seven_joints_before_anything_runs(tmp_path):
    pytest.importorskip("pybullet_data")
    done = run("imitate", hand(tmp_path), "--export", "urscript", "--out", tmp_path / "out")
    assert done.exit_code == 2 and "7 joints, expected 6 for URScript" in done.output
    assert not (tmp_path / "out").exists()


def ur5():
    try:
        found = [file.locate() for file in files("example-robot-data") or [] if file.name == "ur5_robot.urdf"]
    except PackageNotFoundError:
        found = []
    return found[0] if found else pytest.skip("example-robot-data is not installed")


def test_a_universal_robot_is_sent_a_script(tmp_path):
    pytest.importorskip("pybullet_data")
    robot = ("--arm", ur5(), "--base", "base_link", "--tip", "tool0")
    out = tmp_path / "out"
    done = run("imitate", hand(tmp_path), *robot, "--accept", "inertia", "--export", "urscript", "--out", out)
    assert done.exit_code == 0, done.output
    assert "for the robot: joints.csv, joints.script" in done.output
    period, joints = export.read_urscript(out / "joints.script")
    assert period == 0.008
    planned = export.read_joints(out / "joints.csv").of_motion().position
    assert (
        np.abs(joints - planned[0]).sum(axis=1).min() < 0.02 and np.abs(joints - planned[-1]).sum(axis=1).min() < 0.02
    )


def test_an_unknown_format_is_refused():
    pytest.importorskip("pybullet_data")
    with pytest.raises(InvalidArgument, match="export: 'gcode', expected one of ros2, ros2-bag, urscript"):
        export.chosen(["gcode"], arms.find("panda"))
