"""Placing a motion: the transform by its definition, the search by what an arm can then do."""

import numpy as np
import pytest
from dmpcpp import motion, recordings
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._placement import to_follow
from dmpcpp.recordings import Recording
from dmpcpp.retarget import Placement, place
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

angle = st.floats(-3.0, 3.0)
vector = st.tuples(angle, angle, angle).map(np.array)
placements = st.builds(
    Placement,
    position=vector,
    yaw=angle,
    scale=st.floats(0.1, 2.0),
    tool_rotation=vector.map(lambda v: Rotation.from_rotvec(v).as_matrix()),
    up_axis=st.sampled_from("xyz"),
    centre=vector,
)


def swing() -> Recording:
    time = np.linspace(0.0, 1.0, 31)
    turn = Rotation.from_rotvec(np.outer(np.sin(3 * time), [0.3, 1.0, -0.5]))
    path = np.column_stack([np.sin(3 * time), np.cos(2 * time), time])
    return Recording(time=time, position=path, rotation=turn.as_matrix(), up_axis="y")


# ---------------------------------------------------------------- the transform


def test_the_default_placement_changes_nothing():
    poses = motion.poses(swing())
    np.testing.assert_array_equal(Placement(np.zeros(3)).apply(poses), poses)


@pytest.mark.parametrize(("axis", "up"), [("x", [1, 0, 0]), ("y", [0, 1, 0]), ("z", [0, 0, 1])])
def test_what_is_up_in_the_recording_is_up_for_the_robot(axis, up):
    for yaw in (0.0, 1.0, -2.5):
        placement = Placement(np.zeros(3), yaw=yaw, up_axis=axis)
        np.testing.assert_allclose(placement.rotation @ up, [0.0, 0.0, 1.0], atol=1e-15)
        assert np.linalg.det(placement.rotation) == pytest.approx(1.0)


@given(placement=placements)
def test_the_centre_comes_to_lie_at_the_position(placement):
    pose = np.eye(4)
    pose[:3, 3] = placement.centre
    np.testing.assert_allclose(placement.apply(pose)[:3, 3], placement.position, atol=1e-12)


@given(placement=placements)
def test_positions_scale_and_rotations_do_not(placement):
    recording = swing()
    placed = placement.apply(motion.poses(recording))
    steps = np.linalg.norm(np.diff(recording.position, axis=0), axis=1)
    placed_steps = np.linalg.norm(np.diff(placed[:, :3, 3], axis=0), axis=1)
    np.testing.assert_allclose(placed_steps, placement.scale * steps, atol=1e-12)
    turned = Rotation.from_matrix(placed[:, :3, :3])
    np.testing.assert_allclose((turned[:-1].inv() * turned[1:]).magnitude(), motion.turn_angles(recording), atol=1e-7)


@given(placement=placements)
def test_a_turn_of_the_body_about_a_world_axis_stays_a_turn_about_the_carried_axis(placement):
    turn = Rotation.from_rotvec([0.0, 0.4, 0.0]).as_matrix()
    before, after = np.eye(4), np.eye(4)
    after[:3, :3] = turn
    relative = placement.apply(after)[:3, :3] @ placement.apply(before)[:3, :3].T
    np.testing.assert_allclose(relative, placement.rotation @ turn @ placement.rotation.T, atol=1e-12)


def test_the_tool_rotation_is_constant_in_the_frame_of_the_body():
    tool = Rotation.from_rotvec([0.0, 0.0, 0.7]).as_matrix()
    poses = motion.poses(swing())
    with_tool = Placement(np.zeros(3), tool_rotation=tool).apply(poses)
    np.testing.assert_allclose(with_tool[:, :3, :3], poses[:, :3, :3] @ tool, atol=1e-15)
    np.testing.assert_array_equal(with_tool[:, :3, 3], poses[:, :3, 3])


def test_a_placed_recording_holds_the_placed_poses_and_says_so():
    recording = swing()
    placement = Placement([0.4, 0.0, 0.5], yaw=0.3, scale=0.5, up_axis="y", centre=[0.1, 0.2, 0.3])
    placed = placement.apply_to(recording)
    np.testing.assert_allclose(motion.poses(placed), placement.apply(motion.poses(recording)), atol=1e-15)
    assert placed.up_axis == "z"
    assert placed.history[-1] == placement.describe()
    assert placement.describe().startswith("placed at (400, 0, 500) mm, yaw 17.2 deg, scale 0.500, tool")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"position": [0.0, np.nan, 0.0]}, r"position: .*expected \(3,\) finite numbers"),
        ({"centre": [0.0, 0.0]}, "centre: "),
        ({"scale": 0.0}, "scale: 0.0, expected a number above 0"),
        ({"scale": np.inf}, "scale: inf"),
        ({"yaw": np.nan}, "yaw: nan"),
        ({"up_axis": "-z"}, "up_axis: '-z', expected 'x', 'y' or 'z'"),
        ({"tool_rotation": -np.eye(3)}, "tool_rotation: not a proper rotation"),
        ({"tool_rotation": 1.1 * np.eye(3)}, "tool_rotation: not a proper rotation"),
    ],
)
def test_a_placement_without_sense_is_refused(changes, message):
    with pytest.raises(InvalidArgument, match=message):
        Placement(**{"position": np.zeros(3), **changes})


def test_only_poses_can_be_placed():
    with pytest.raises(InvalidArgument, match=r"poses: shape \(3,\), expected"):
        Placement(np.zeros(3)).apply(np.zeros(3))


# ---------------------------------------------------------------- the search


def test_a_long_recording_of_many_samples_is_followed_at_fifty_a_second():
    time = np.arange(20001) / 1000.0
    path = np.column_stack([0.2 * np.sin(time), 0.1 * np.cos(0.5 * time), 0.0 * time])
    turn = Rotation.from_rotvec(np.outer(np.sin(time), [0.3, 0.0, 0.5])).as_matrix()
    followed = to_follow(Recording(time=time, position=path, rotation=turn))
    assert len(followed) == 1001 and followed.duration == time[-1]
    np.testing.assert_allclose(followed.position, path[::20], atol=1e-12)
    short = to_follow(Recording(time=time[:5000], position=path[:5000], rotation=turn[:5000]))
    assert len(short) == 5000


def test_a_fast_stretch_of_a_long_recording_keeps_its_density():
    time = np.arange(6001) / 1000.0
    path = np.column_stack([np.where(time < 5.0, 0.0, 2.0 * (time - 5.0)), 0.0 * time, 0.0 * time])
    followed = to_follow(Recording(time=time, position=path, rotation=np.tile(np.eye(3), (6001, 1, 1))))
    steps = np.linalg.norm(np.diff(followed.position, axis=0), axis=1)
    assert steps.max() < 0.035  # refined where 20 samples move 40 mm


ARMS = {
    "panda": ("franka_panda/panda.urdf", "panda_link0", "panda_hand"),
    "iiwa": ("kuka_iiwa/model.urdf", "lbr_iiwa_link_0", "lbr_iiwa_link_7"),
}


@pytest.fixture(scope="module", params=ARMS)
def arm(request):
    dmpcpp = pytest.importorskip("dmpcpp")
    pytest.importorskip("pybullet_data")
    data = recordings.clip_path("walk").parents[2]
    file, base, tip = ARMS[request.param]
    return dmpcpp.Arm.from_urdf_file(str(data / file), base=base, tip=tip)


def follow(arm, placement, recording, spacing):
    import dmpcpp

    placed = motion.refine(placement.apply_to(recording), distance=spacing, angle=5 * spacing)
    poses = motion.poses(placed)
    joints = dmpcpp.InverseKinematics(arm).follow(poses, times=placed.time, start=placement.start)
    return poses, joints


@pytest.mark.parametrize("clip", ["dance_b", "punch", "getup_faceup"])
def test_the_arm_carries_the_whole_motion_where_it_was_placed(arm, clip):
    recording = recordings.clip(clip)
    placement = place(recording, arm, seed=0)
    for spacing in (0.02, 0.005):  # from the start joints on, the path does not depend on the sampling
        poses, joints = follow(arm, placement, recording, spacing)
        assert joints.report.complete
        np.testing.assert_allclose(arm.forward_kinematics(joints.position), poses, atol=2e-5)
        assert (joints.position >= arm.lower).all()
        assert (joints.position <= arm.upper).all()
        assert poses[:, 2, 3].min() >= 0.15 - 1e-3
    assert 0.25 <= placement.scale <= 1.0
    assert f"carries all {len(recording)} samples" in placement.describe()


def test_the_caller_has_the_last_word_on_the_joints(arm):
    punch = recordings.clip("punch")
    seen = []

    def accept(joints):
        seen.append(joints)
        return joints.position[:, 1].max() < 0.8 * arm.upper[1]

    placement = place(punch, arm, candidates=600, accept=accept)
    assert all(joints.report.complete for joints in seen)
    _, joints = follow(arm, placement, punch, 0.02)
    assert joints.position[:, 1].max() < 0.81 * arm.upper[1]
    with pytest.raises(InvalidArgument, match="what the joints could follow was not accepted"):
        place(punch, arm, candidates=100, accept=lambda joints: False)


def test_the_same_seed_finds_the_same_placement(arm):
    punch = recordings.clip("punch")
    first, second = (place(punch, arm, seed=4, candidates=200) for _ in range(2))
    np.testing.assert_array_equal(first.position, second.position)
    np.testing.assert_array_equal(first.tool_rotation, second.tool_rotation)
    assert (first.scale, first.yaw, first.note) == (second.scale, second.yaw, second.note)


def test_a_motion_stands_in_front_of_the_arm_unless_told_otherwise(arm):
    punch = recordings.clip("punch")
    aside = place(punch, arm, candidates=300, in_front=False)
    front = place(punch, arm, candidates=300)
    away, near = (abs(np.arctan2(p.position[1], p.position[0])) for p in (aside, front))
    assert near < 1e-9 or near <= 0.76 * away  # all of the way, or as much of it as the first joint lets
    assert np.linalg.norm(front.position[:2]) == pytest.approx(np.linalg.norm(aside.position[:2]), rel=1e-12)
    assert front.position[2] == aside.position[2] and front.scale == aside.scale
    assert follow(arm, front, punch, 0.02)[1].report.complete


@pytest.mark.parametrize("tilt", [0.0, 0.5])
def test_the_tool_is_turned_in_the_hand_by_no_more_than_stated(arm, tilt):
    punch = recordings.clip("punch")
    placement = place(punch, arm, candidates=1000, tool_tilt=tilt)
    assert Rotation.from_matrix(placement.tool_rotation).magnitude() <= tilt + 1e-9
    assert follow(arm, placement, punch, 0.02)[1].report.complete


def test_a_tilt_that_is_no_angle_is_refused(arm):
    with pytest.raises(InvalidArgument, match="tool_tilt: -0.1, expected an angle"):
        place(swing(), arm, tool_tilt=-0.1)


def test_a_motion_too_large_for_the_arm_is_refused_with_the_share_it_carries(arm):
    with pytest.raises(
        InvalidArgument,
        match=r"carries [\d.]+ % of it and first misses the pose at frame \d+ \(.* s\), by .* mm.*: .*smaller scale",
    ):
        place(recordings.clip("dance_b"), arm, scale=(3.0, 4.0), candidates=200)


def test_a_scale_or_a_count_without_sense_is_refused(arm):
    dance = recordings.clip("dance_b")
    for scale in ((0.0, 1.0), (1.0, 0.5), (0.5, np.inf), (np.nan, 1.0)):
        with pytest.raises(InvalidArgument, match="scale: "):
            place(dance, arm, scale=scale)
    with pytest.raises(InvalidArgument, match="candidates: 0, expected at least 1"):
        place(dance, arm, candidates=0)
