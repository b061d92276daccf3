"""A motion hung up at its start, its goal or the shoulder; and how much of it an arm then reaches."""

import numpy as np
import pytest
from dmpcpp import Arm, arms, motion, retarget
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._reach import farthest_reach
from scipy.spatial.transform import Rotation

from tests.python.motions import angle_between, reaches, screw

POSE = np.eye(4)
POSE[:3, :3] = Rotation.from_rotvec([3.0, 0.2, -0.1]).as_matrix()
POSE[:3, 3] = [0.4, -0.1, 0.5]


@pytest.mark.parametrize(("on", "sample"), [("start", 0), ("goal", -1)])
@pytest.mark.parametrize("yaw", [0.0, 2.0])
def test_a_pose_is_met_at_the_anchor_whatever_scale_and_yaw(on, sample, yaw):
    placed = retarget.anchor(screw(), POSE, on=on, scale=0.4, yaw=yaw).apply_to(screw())
    np.testing.assert_allclose(placed.position[sample], POSE[:3, 3], atol=1e-12)
    assert angle_between(placed.rotation[[sample]], POSE[None, :3, :3]) < 1e-7
    span = np.linalg.norm(placed.position[-1] - placed.position[0])
    assert span == pytest.approx(0.4 * np.linalg.norm(screw().position[-1] - screw().position[0]))


def test_a_shoulder_comes_to_lie_at_the_robots_with_the_ratio_of_the_arms():
    shoulder, base = np.array([-0.1, 0.2, 0.4]), np.array([0.0, 0.0, 0.333])
    placement = retarget.anchor(screw(), base, on=shoulder, scale=0.8)
    placed = placement.apply_to(screw())
    np.testing.assert_allclose(placed.position - base, 0.8 * (screw().position - shoulder), atol=1e-12)
    np.testing.assert_allclose(placed.rotation, screw().rotation, atol=1e-12)


def test_a_tool_rotation_turns_the_tool_alone():
    tool = Rotation.from_rotvec([0.0, 1.0, 0.0]).as_matrix()
    placed = retarget.anchor(screw(), [0.4, 0.0, 0.5], tool_rotation=tool).apply_to(screw())
    np.testing.assert_allclose(placed.rotation, screw().rotation @ tool, atol=1e-12)
    np.testing.assert_allclose(placed.position[0], [0.4, 0.0, 0.5], atol=1e-12)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"at": [0.0, 1.0]}, r"at: shape \(2,\)"),
        ({"at": POSE, "on": [0.0, 0.0, 0.0]}, "at: a pose, expected a point"),
        ({"at": POSE, "tool_rotation": np.eye(3)}, "at: a pose, expected a point"),
        ({"at": POSE, "on": "middle"}, "on: 'middle', expected 'start', 'goal' or a point"),
        ({"at": [0.0, 0.0, np.nan]}, "position: "),
        ({"at": POSE, "scale": 0.0}, r"scale: 0\.0"),
    ],
)
def test_anchors_without_sense_are_refused(options, message):
    at = options.pop("at")
    with pytest.raises(InvalidArgument, match=message):
        retarget.anchor(screw(), at, **options)


def test_the_share_that_an_arm_reaches_is_stated_and_counted_pose_by_pose():
    pytest.importorskip("pybullet_data")
    arm = arms.find("panda")
    near = retarget.anchor(reaches(1), POSE)
    assert retarget.reach(near, reaches(1), arm).share == 1.0
    far = retarget.anchor(reaches(1), POSE, scale=2.0)
    found = retarget.reach(far, reaches(1), arm)
    away = np.linalg.norm(far.apply(motion.poses(reaches(1)))[:, :3, 3] - [0.0, 0.0, 0.333], axis=1)
    assert 0.0 < found.share < 1.0 and found.first_missed <= np.argmax(away > 0.95)
    assert found.describe() == (
        f"{found.solved} of {len(reaches(1))} poses ({100 * found.share:.1f} %) within reach and joint limits, "
        f"the first that is not: {found.first_missed}"
    )


@pytest.mark.parametrize("at", [POSE, POSE[:3, 3]], ids=["pose", "point"])
def test_the_search_turns_an_anchored_motion_into_reach(at):
    pytest.importorskip("pybullet_data")
    arm = arms.find("panda")
    wide = reaches(1).with_("", position=3.0 * reaches(1).position)  # 0.9 m away from the base, unless turned or scaled
    found = retarget.anchor_within_reach(wide, arm, at)
    assert retarget.reach(found, wide, arm).share == 1.0
    assert f"{len(wide)} of {len(wide)} poses (100.0 %) within reach" in found.describe()
    np.testing.assert_allclose(found.apply_to(wide).position[0], POSE[:3, 3], atol=1e-12)
    assert found.start is not None  # one path for all of them
    with pytest.raises(InvalidArgument, match=r"scale: \(0\.9, 0\.5\), expected"):
        retarget.anchor_within_reach(wide, arm, at, scale=(0.9, 0.5))


def test_what_is_given_is_not_searched_and_what_is_not_accepted_not_taken():
    pytest.importorskip("pybullet_data")
    arm = arms.find("panda")
    tool = Rotation.from_rotvec([0.0, np.pi, 0.0]).as_matrix()
    given = {"scale": (0.8, 0.8), "yaw": 0.3, "tool_rotation": tool}
    found = retarget.anchor_within_reach(reaches(1), arm, POSE[:3, 3], **given)
    assert (found.scale, found.yaw) == (0.8, 0.3) and np.array_equal(found.tool_rotation, tool)
    assert found.start is not None and "followed" not in found.note
    refused = retarget.anchor_within_reach(reaches(1), arm, POSE[:3, 3], **given, accept=lambda joints: False)
    assert refused.start is None and "no candidate could be followed from end to end" in refused.note


@pytest.mark.parametrize("on", ["start", "goal"])
@pytest.mark.parametrize("at", [[0.0, 2.0, 0.5], POSE + np.outer([0, 1, 0, 0], [0, 0, 0, 2.0])], ids=["point", "pose"])
def test_an_anchor_farther_away_than_the_arm_is_long_is_refused_without_a_search(on, at, panda):
    with pytest.raises(
        InvalidArgument, match=rf"at: the {on} of the motion at .* lies .* m from the first joint of arm"
    ):
        retarget.anchor_within_reach(reaches(1), panda, at, on=on)


def test_a_shoulder_may_lie_anywhere(panda):
    motion_of_the_hand = reaches(1)
    shoulder = motion_of_the_hand.position[0] + [2.0, 0.0, 0.0]
    found = retarget.anchor_within_reach(
        motion_of_the_hand, panda, [2.4, 0.0, 0.5], on=shoulder, yaw=0.0, scale=(1.0, 1.0)
    )
    assert found.start is not None


SLIDER = """<robot name="slider"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
  <joint name="f" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 0 0" rpy="0 0 1.5707963"/></joint>
  <joint name="s" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="2 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-0.5" upper="0.3" velocity="1" effort="1"/></joint>
  <joint name="r" type="revolute"><parent link="c"/><child link="d"/><origin xyz="0 0 0.4"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint></robot>"""


def test_the_farthest_reach_of_a_sliding_arm_is_its_stroke_and_its_links():
    centre, radius = farthest_reach(Arm.from_urdf(SLIDER))
    np.testing.assert_allclose(centre, [1.0, 2.0, 0.0], atol=1e-6)
    assert radius == pytest.approx(0.9)


def test_no_place_of_the_tip_lies_beyond_the_farthest_reach(arm):
    centre, radius = farthest_reach(arm)
    random = np.random.default_rng(0)
    joints = random.uniform(arm.lower, arm.upper, (20000, arm.joint_count))
    away = np.linalg.norm(arm.forward_kinematics(joints)[:, :3, 3] - centre, axis=1)
    assert 0.7 * radius < away.max() <= radius + 1e-9
