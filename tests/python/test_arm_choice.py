"""Base and tip as a person would choose them, and a question where they would ask."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import Arm, InvalidArgument, arms
from scipy.spatial.transform import Rotation

from tests.python.command import run
from tests.python.urdfs import chain, jaw, joint, link, robot, slide


def chosen(text: str, base: str = "", tip: str = "") -> tuple[str, str, int]:
    arm = Arm.from_urdf(text, base, tip)
    return arm.base, arm.tip, arm.joint_count


def question(text: str, base: str = "") -> str:
    with pytest.raises(InvalidArgument, match="state one line of") as refused:
        Arm.from_urdf(text, base)
    return str(refused.value)


def fixed(parent: str, *children: str) -> str:
    return "".join(link(child, "") + joint(f"{child}_f", "fixed", parent, child) for child in children)


FINGERS = link("fl") + link("fr") + slide("one", "l6", "fl") + slide("other", "l6", "fr")


def test_a_jaw_is_no_joint_of_the_arm() -> None:
    text = robot(chain(6), link("jaw"), jaw("gripper", "l6", "jaw"))
    assert chosen(text) == ("base", "l6", 6)
    assert Arm.from_urdf(text).choice == "6 joints, j1 to j6; held still: gripper"


@pytest.mark.parametrize("name", ["left_finger", "Knuckle_joint", "thumb_1", "jaw", "claw", "GRIPPER"])
def test_joints_named_like_a_grippers_are_held(name: str) -> None:
    assert chosen(robot(chain(6), link("end"), jaw(name, "l6", "end", lower=-1.7))) == ("base", "l6", 6)


def test_links_named_like_a_gripper_tell_where_joints_are_numbered() -> None:
    names = [f"Revolute {k}" for k in range(1, 6)]
    text = robot(
        chain(5, names=names),
        fixed("l5", "gripper-static"),
        link("gripper-moving"),
        jaw("Revolute 6", "gripper-static", "gripper-moving"),
    )
    assert chosen(text) == ("base", "gripper-static", 5)


def test_a_last_joint_that_could_be_a_jaw_is_asked_about() -> None:
    text = robot(chain(5), link("part"), jaw("Revolute 6", "l5", "part"))
    asked = question(text)
    assert "'Revolute 6' could be a gripper's" in asked
    assert asked.splitlines()[1:] == [
        "  base='base' tip='l5' (5 joints, j1 to j5)",
        "  base='base' tip='part' (6 joints, j1 to Revolute 6)",
    ]
    assert chosen(text, tip="part") == ("base", "part", 6)
    named = text.replace('name="part"', 'name="tool0"').replace('link="part"', 'link="tool0"')
    assert chosen(named) == ("base", "tool0", 6)


def test_two_fingers_that_slide_are_held_and_the_tool_frame_taken() -> None:
    assert chosen(robot(chain(6), FINGERS, fixed("l6", "camera_tool", "hand_tcp"))) == ("base", "hand_tcp", 6)
    four = FINGERS.replace('"l6"', '"l4"')
    assert chosen(robot(chain(4), four)) == ("base", "l4", 4)


def test_a_long_slide_is_a_joint_of_the_arm() -> None:
    assert chosen(robot(chain(5), link("quill"), slide("z", "l5", "quill", 0.3))) == ("base", "quill", 6)


def test_a_mimic_joint_and_its_master_are_a_grippers() -> None:
    follower = slide("right", "l6", "fr", more='<mimic joint="left"/>')
    text = robot(chain(6), link("fl"), link("fr"), slide("left", "l6", "fl", 0.3), follower)
    assert chosen(text) == ("base", "l6", 6)


def test_a_master_in_the_middle_of_the_arm_stays_a_joint() -> None:
    rod = joint(
        "rod",
        "revolute",
        "l1",
        "rod_link",
        more='<limit lower="-2" upper="2" effort="9" velocity="1"/><mimic joint="j3"/>',
    )
    assert chosen(robot(chain(6), link("rod_link"), rod)) == ("base", "l6", 6)


def test_several_short_chains_are_a_hand() -> None:
    fingers = "".join(
        chain(3, "l6", prefix=f"{name}_").replace("0 0 0.33", "0 0 0.02").replace("0 0 0.1", "0 0 0.02")
        for name in ("a", "b", "c")
    )
    text = robot(chain(6), fingers, fixed("l6", "palm_frame"))
    assert chosen(text) == ("base", "palm_frame", 6)
    assert "a_j1, b_j1, c_j1" in Arm.from_urdf(text).choice


@pytest.mark.parametrize(
    ("frames", "tip"),
    [
        (("base_x", "tool0", "flange"), "tool0"),
        (("flange", "ee_link", "tool0", "tcp"), "tcp"),
        (("link_eef", "flange"), "link_eef"),
        (("end_effector_link", "tool_frame"), "tool_frame"),
        (("gripper_frame_link", "hand"), "gripper_frame_link"),
        (("left_gripper", "left_end"), "left_gripper"),  # le-ft_ is no ft_sensor
        (("tool_camera", "ft_sensor", "plain"), "plain"),
    ],
)
def test_of_the_frames_behind_the_last_joint_the_name_decides(frames: tuple[str, ...], tip: str) -> None:
    assert chosen(robot(chain(6), fixed("base", "ros_base"), fixed("l6", *frames))) == ("base", tip, 6)


def test_without_a_telling_name_the_last_frame_is_taken() -> None:
    assert chosen(robot(chain(6), fixed("l6", "a"), fixed("a", "b"))) == ("base", "b", 6)


TORSO = link("torso") + joint(
    "waist", "revolute", "base", "torso", more='<limit lower="-1" upper="1" effort="9" velocity="1"/>'
)
TWO_ARMS = TORSO + chain(6, "torso", prefix="left_") + chain(6, "torso", prefix="right_")


def test_two_arms_are_asked_about_with_one_line_each() -> None:
    asked = question(robot(TWO_ARMS))
    assert asked.splitlines()[1:] == [
        "  base='torso' tip='left_l6' (6 joints, left_j1 to left_j6)",
        "  base='torso' tip='right_l6' (6 joints, right_j1 to right_j6)",
    ]
    assert chosen(robot(TWO_ARMS), "torso", "left_l6") == ("torso", "left_l6", 6)
    assert chosen(robot(TWO_ARMS), tip="right_l6") == ("base", "right_l6", 7)


def test_legs_are_listed_behind_longer_arms() -> None:
    legs = chain(5, prefix="leg_l_") + chain(5, prefix="leg_r_")
    assert [line.split("tip=")[1].split()[0] for line in question(robot(TWO_ARMS, legs)).splitlines()[1:]] == [
        "'left_l6'",
        "'right_l6'",
        "'leg_l_l5'",
        "'leg_r_l5'",
    ]


def test_short_legs_and_a_head_do_not_put_an_arm_in_doubt() -> None:
    legs = "".join(chain(3, prefix=f"leg{k}_") for k in range(4))
    assert chosen(robot(chain(6), legs, chain(2, prefix="head_"))) == ("base", "l6", 6)


def test_the_base_is_below_a_floating_joint() -> None:
    floating = link("body") + joint("free", "floating", "world", "body")
    text = robot(floating, chain(6, "body"), root="world", body="")
    assert chosen(text) == ("body", "l6", 6)
    assert chosen(text, tip="l3") == ("body", "l3", 3)


def test_what_is_stated_always_wins() -> None:
    text = robot(chain(6), link("jaw"), jaw("gripper", "l6", "jaw"))
    assert chosen(text, tip="l3") == ("base", "l3", 3)
    assert chosen(text, tip="jaw") == ("base", "jaw", 7)
    assert chosen(text, base="l2") == ("l2", "l6", 4)
    assert Arm.from_urdf(text, "base", "l3").choice == ""
    with pytest.raises(InvalidArgument, match="tip: no link 'l9'"):
        Arm.from_urdf(text, tip="l9")
    with pytest.raises(InvalidArgument, match="base: no link 'l9'"):
        Arm.from_urdf(text, base="l9")


def test_a_robot_that_does_not_move_is_refused() -> None:
    with pytest.raises(InvalidArgument, match="no moving joint"):
        Arm.from_urdf(robot(fixed("base", "plate")))


def test_a_tool_is_a_frame_fixed_to_the_tip() -> None:
    text, q = robot(chain(6)), np.linspace(-0.6, 0.9, 6)
    arm = Arm.from_urdf(text)
    tool = np.eye(4)
    tool[:3, :3] = Rotation.from_euler("xyz", [0.1, -0.2, 1.3]).as_matrix()
    tool[:3, 3] = 0.02, -0.03, 0.15
    longer = arm.with_tool(tool)
    assert (longer.tip, longer.base, longer.joint_names) == ("l6_tool", arm.base, arm.joint_names)
    np.testing.assert_allclose(longer.forward_kinematics(q), arm.forward_kinematics(q) @ tool, atol=1e-14)
    again = Arm.from_urdf(longer.urdf, tip=longer.tip)
    np.testing.assert_allclose(again.forward_kinematics(q), longer.forward_kinematics(q), atol=1e-14)
    twice = longer.with_tool(tool)
    np.testing.assert_allclose(twice.forward_kinematics(q), longer.forward_kinematics(q) @ tool, atol=1e-14)
    assert arm.with_tool(tool).with_tool(tool).tip == "l6_tool_tool"
    with pytest.raises(InvalidArgument, match="tool"):
        arm.with_tool(np.zeros((4, 4)))


def test_a_tool_is_stated_as_an_origin_of_a_urdf(tmp_path: Path) -> None:
    path = tmp_path / "own.urdf"
    path.write_text(robot(chain(6)))
    q = np.full(6, 0.3)
    tip = arms.load(path).forward_kinematics(q)
    frame = np.eye(4)
    frame[:3, :3] = Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_matrix()
    frame[:3, 3] = 0.1, 0.2, 0.3
    for tool in (frame, [0.1, 0.2, 0.3, 0.1, 0.2, 0.3]):
        np.testing.assert_allclose(arms.load(path, tool=tool).forward_kinematics(q), tip @ frame, atol=1e-12)
    with pytest.raises(InvalidArgument, match=r"tool: shape \(2,\)"):
        arms.load(path, tool=[0, 1])


def test_the_command_line_asks_with_options(tmp_path: Path) -> None:
    path = tmp_path / "two.urdf"
    path.write_text(robot(TWO_ARMS))
    asked = run("demo", "--arm", path, "--out", "out", cwd=tmp_path)
    assert asked.returncode == 2
    assert re.search(r"--base torso --tip left_l6 \(6 joints", asked.stderr)
    told = run("check-urdf", path, "--base", "torso", "--tip", "left_l6", cwd=tmp_path)
    assert "'left_l6' follows the hand, in the frame of 'torso' (6 joints)" in told.stdout
    refused = run("demo", "--arm", path, "--tool", "1,2", cwd=tmp_path)
    assert refused.returncode == 2
    assert "--tool: '1,2', expected 3 or 6 finite numbers" in refused.stderr
