"""What of a hand's pose is followed: all, the position and one axis of the tool, or the position alone."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import Arm, InvalidArgument, export, imitation, load, planning, simulation
from dmpcpp.recordings import Recording
from dmpcpp.robot import Follow, following
from dmpcpp.show.view._session import Session
from scipy.spatial.transform import Rotation

from tests.python.command import run, write_hand
from tests.python.urdfs import chain, robot


def arm_of(count: int) -> Arm:
    return Arm.from_urdf(robot(chain(count)), tip=f"l{count}")


@pytest.mark.parametrize(
    ("text", "weight"),
    [
        ("pose", [1, 1, 1, 1, 1, 1]),
        ("position", [1, 1, 1, 0, 0, 0]),
        ("axis", [1, 1, 1, 1, 1, 0]),
        ("axis:x", [1, 1, 1, 0, 1, 1]),
        ("axis:y", [1, 1, 1, 1, 0, 1]),
    ],
)
def test_what_is_stated_is_what_counts(text: str, weight: list[int]) -> None:
    follow = Follow.of(text)
    np.testing.assert_array_equal(follow.weight, weight)
    assert follow.directions == sum(weight)
    assert Follow.of(str(follow)) == follow


@pytest.mark.parametrize("text", ["", "axes", "axis:w", "axis:", "pose:z", "position:x", "z"])
def test_another_word_is_refused_with_those_there_are(text: str) -> None:
    with pytest.raises(InvalidArgument, match="expected position, axis, axis:x"):
        Follow.of(text)


def test_angles_are_judged_as_far_as_they_are_followed() -> None:
    poses = np.tile(np.eye(4), (3, 1, 1))
    turned = poses.copy()
    turned[:, :3, :3] = Rotation.from_euler("z", 0.4).as_matrix() @ Rotation.from_euler("x", 0.1).as_matrix()
    assert Follow.of("position").angle_errors(poses, turned) is None
    np.testing.assert_allclose(Follow.of("axis:z").angle_errors(poses, turned), 0.1, atol=1e-12)
    x = Follow.of("axis:x").angle_errors(poses, turned)
    np.testing.assert_allclose(x, 0.4, atol=1e-12)
    assert (Follow.of("pose").angle_errors(poses, turned) > 0.4).all()
    np.testing.assert_allclose(Follow.of("axis").angle_errors(poses, poses), 0.0)


@pytest.mark.parametrize(
    ("count", "message"),
    [
        (5, "5 joints cannot follow position and orientation; choose follow=position or follow=axis:z"),
        (4, "4 joints cannot follow position and orientation; choose follow=position"),
    ],
)
def test_fewer_than_six_joints_stop_at_once_with_the_way_out(count: int, message: str) -> None:
    with pytest.raises(InvalidArgument) as refused:
        following(arm_of(count), None)
    assert str(refused.value) == message


def test_what_is_stated_goes_as_far_as_the_joints_do() -> None:
    assert following(arm_of(5), "pose").kind == "pose"  # poses that the arm itself made
    assert following(arm_of(5), "axis").kind == "axis"
    assert following(arm_of(6), None).kind == "pose"
    with pytest.raises(InvalidArgument, match="4 joints cannot follow position and an axis; choose follow=position"):
        following(arm_of(4), "axis:x")


def hand(samples: int = 60) -> Recording:
    time = np.linspace(0.0, 2.0, samples)
    position = np.c_[0.15 * np.sin(time), 0.12 * np.cos(time), 0.06 * time]
    turn = Rotation.from_euler("zy", np.c_[0.6 * np.sin(time), 0.3 * time])
    return Recording(time, position, turn.as_matrix(), source="own", body="hand", up_axis="z")


@pytest.mark.parametrize(("count", "follow"), [(5, "position"), (5, "axis:z"), (4, "position")])
def test_an_arm_of_few_joints_carries_what_it_can(count: int, follow: str, tmp_path: Path) -> None:
    run = imitation.imitate(hand(), arm_of(count), follow=follow, simulator="bullet")
    assert run.ok, [str(check) for check in run.checks if not check.ok]
    names = {check.name for check in run.checks}
    assert {"ik_position_residual", "tracking_position_max"} <= names
    assert ("ik_angle_residual" in names) == (follow != "position")
    assert ("tracking_angle_max" in names) == (follow != "position")
    assert run["ik_position_residual"].value < 1e-5
    imitation.write(run, tmp_path)
    assert json.loads((tmp_path / "summary.json").read_text())["follow"] == follow
    assert export.read_plan(tmp_path / "plan.npz").follow == follow
    again = planning.plan(load(tmp_path / "model.json"), arm_of(count), follow=follow, simulator=simulation.Bullet)
    assert again.ok
    assert again.summary()["follow"] == follow
    assert planning.solve(load(tmp_path / "model.json"), arm_of(count), follow=follow).joints.report.complete
    if follow == "axis:z":
        made = run.log.arm.forward_kinematics(run.joints.position)
        assert Follow.of(follow).angle_errors(run.plan.pose, made).max() < 1e-5
        assert Follow.of("pose").angle_errors(run.plan.pose, made).max() > 0.1


def test_every_way_into_the_joints_asks() -> None:
    five, recording = arm_of(5), hand()
    for way in (
        lambda: imitation.imitate(recording, five),
        lambda: planning.place(recording, five),
        lambda: planning.placed([recording], five),
        lambda: planning.anchor_within_reach(recording, five, [0.3, 0, 0.4]),
    ):
        with pytest.raises(InvalidArgument, match="5 joints cannot follow position and orientation"):
            way()


def test_an_anchored_motion_and_the_page_follow_a_position(tmp_path: Path) -> None:
    five = arm_of(5)
    anchored = partial(planning.anchor_within_reach, at=[0.35, 0.0, 0.45], follow="position", scale=(0.2, 0.5))
    run = imitation.imitate(hand(), five, place=anchored, follow="position", simulator="bullet")
    assert run["ik_position_residual"].ok
    with pytest.raises(InvalidArgument, match="5 joints"):
        Session(run.model, five)
    session = Session(run.model, five, "position")
    assert session.update(session.demonstrated).joints.report.complete


def test_the_command_line_stops_at_once_and_takes_the_option(tmp_path: Path) -> None:
    (tmp_path / "five.urdf").write_text(robot(chain(5)))
    write_hand(tmp_path / "hand.npz")
    reading = ("--body", "pose", "--up-axis", "z", "--quat-order", "xyzw", "--unit", "m")
    for command in (("demo",), ("imitate", "hand.npz", *reading), ("fit", "hand.npz", *reading)):
        done = run(*command, "--arm", "five.urdf", cwd=tmp_path)
        assert done.returncode == 2, done.stdout + done.stderr
        assert (
            "5 joints cannot follow position and orientation; choose --follow position or --follow axis:z"
            in done.stderr
        )
    done = run("demo", "--arm", "five.urdf", "--follow", "sideways", cwd=tmp_path)
    assert "--follow: 'sideways', expected position, axis" in done.stderr
    fitted = run("fit", "hand.npz", *reading, "--arm", "five.urdf", "--follow", "position", cwd=tmp_path)
    assert fitted.returncode == 0, fitted.stdout + fitted.stderr
    planned = run("plan", "model.json", "--arm", "five.urdf", "--follow", "position", cwd=tmp_path)
    assert planned.returncode == 0, planned.stdout + planned.stderr
    assert "the orientation is not judged" in planned.stdout.replace("\n", " ")
    assert 'follow = "position"' in (tmp_path / "dmpcpp-plan" / "config.toml").read_text()


def test_a_grasp_needs_the_hands_direction(tmp_path: Path) -> None:
    done = run("grasp", "--follow", "position", cwd=tmp_path)
    assert done.returncode == 2
    assert "--follow: 'position', expected axis:x, axis:y, axis:z or pose" in done.stderr
