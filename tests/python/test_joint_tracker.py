"""Joints that go along with a pose, on the arms that PyBullet ships."""

import copy

import numpy as np
import pytest
from dmpcpp import IkStatus, InverseKinematics, JointTracker, TrackOptions, arms

pytest.importorskip("pybullet_data")

DT = 0.01  # s
ARMS = ["panda", "iiwa", "xarm6"]


def path(arm, count=400):
    """Poses along slow joints in the middle of the limits, and the joints at the first of them."""
    phase = np.linspace(0.0, 2 * np.pi, count)[:, None]
    middle = InverseKinematics(arm).middle + 0.4
    joints = middle + 0.2 * (np.sin(phase + np.arange(arm.joint_count)) - np.sin(np.arange(arm.joint_count)))
    return arm.forward_kinematics(joints), joints[0]


@pytest.mark.parametrize("name", ARMS)
def test_every_pose_is_met_to_a_micrometre_within_the_limits_of_position_and_speed(name):
    arm = arms.find(name)
    poses, start = path(arm)
    tracker = JointTracker(arm, start)
    joints = [start]
    for pose in poses:
        assert tracker.track(pose, DT) == IkStatus.ok
        assert tracker.position_error < 1e-6 and tracker.angle_error < 1e-6
        joints.append(tracker.joints)
    found = np.array(joints)
    assert np.abs(arm.forward_kinematics(found[1:]) - poses)[:, :3, 3].max() < 1e-6
    assert np.all((found >= arm.lower) & (found <= arm.upper))
    assert np.all(np.abs(np.diff(found, axis=0)) <= arm.velocity_limit * DT * (1 + 1e-12))
    np.testing.assert_allclose(tracker.velocity, (found[-1] - found[-2]) / DT, atol=1e-12)


def test_a_copy_goes_its_own_way_and_the_same_way():
    arm = arms.find("panda")
    poses, start = path(arm)
    one = JointTracker(arm, start)
    one.track(poses[1], DT)
    other = copy.deepcopy(one)
    for pose in poses[2:50]:
        one.track(pose, DT)
    for pose in poses[2:50]:
        other.track(pose, DT)
    np.testing.assert_array_equal(one.joints, other.joints)


def test_the_robot_may_stand_elsewhere_and_options_are_keywords():
    arm = arms.find("xarm6")
    _, start = path(arm)
    tracker = JointTracker(arm, start, TrackOptions(), position_tolerance=1e-3)
    tracker.joints = start + 0.1
    np.testing.assert_array_equal(tracker.joints, start + 0.1)
    assert tracker.options.position_tolerance == 1e-3
    with pytest.raises(ValueError, match="joints"):
        tracker.joints = np.full(6, 99.0)


def test_what_is_no_pose_or_time_is_a_value_error():
    arm = arms.find("panda")
    poses, start = path(arm)
    tracker = JointTracker(arm, start)
    with pytest.raises(ValueError, match="pose"):
        tracker.track(np.full((4, 4), np.nan), DT)
    with pytest.raises(ValueError, match="dt"):
        tracker.track(poses[0], 0.0)
    with pytest.raises(ValueError, match="start"):
        JointTracker(arm, np.full(7, 99.0))
    np.testing.assert_array_equal(tracker.joints, start)
