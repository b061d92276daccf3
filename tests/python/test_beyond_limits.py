"""Joints a little beyond their limits are taken and brought back; paths take the whole turns that leave most room."""

import copy

import numpy as np
import pytest
from dmpcpp import Arm, IkStatus, InverseKinematics, JointTracker
from dmpcpp.errors import InvalidArgument

from tests.python.small_arms import arm, six_axis

ARM = arm()
MIDDLE = np.array([0.1, 0.3, 0.8, 0.1, 0.7, 0.1])


def beyond(by, joint=3, side=1):
    q = MIDDLE.copy()
    q[joint] = (ARM.upper if side > 0 else ARM.lower)[joint] + side * by
    return q


@pytest.mark.parametrize("by", [1e-9, 1.3e-4, 9.9e-4])
@pytest.mark.parametrize("side", [1, -1])
def test_a_start_a_little_beyond_a_limit_is_taken_and_reported(by, side):
    tracker = JointTracker(ARM, beyond(by, side=side))
    assert tracker.limit_excess == pytest.approx(by, rel=1e-6)
    assert (tracker.joints == beyond(by, side=side)).all() and not tracker.velocity.any()
    other = JointTracker(ARM, MIDDLE)
    assert other.limit_excess == 0.0
    other.joints = beyond(by, side=side)
    assert other.limit_excess == pytest.approx(by, rel=1e-6)
    assert (other.joints == beyond(by, side=side)).all()


@pytest.mark.parametrize("dt", [1e-4, 1e-3, 0.01])
@pytest.mark.parametrize("side", [1, -1])
def test_a_joint_beyond_a_limit_comes_back_within_its_velocity_limit(dt, side):
    """At 2 rad/s the way of 9e-4 rad takes 4.5 steps of 0.1 ms, or a part of one of 1 ms."""
    tracker, by = JointTracker(ARM, beyond(9e-4, side=side)), 9e-4
    goal = ARM.forward_kinematics(beyond(0.0, side=side))  # on the limit
    for _ in range(8):
        before, by = tracker.joints, max(0.0, by - 2.0 * dt)
        status = tracker.track(goal, dt)
        assert (np.abs(tracker.joints - before) <= ARM.velocity_limit * dt * (1 + 1e-9)).all()
        assert tracker.velocity == pytest.approx((tracker.joints - before) / dt)
        assert side * (tracker.joints[3] - beyond(0.0, side=side)[3]) == pytest.approx(by, abs=1e-9)
        assert (status == IkStatus.ok) == (by == 0.0)  # the others cannot make up for it within 1e-6
        if by:
            assert status == IkStatus.step_limited and tracker.angle_error == pytest.approx(by, rel=1e-2)
    assert tracker.limit_excess == pytest.approx(9e-4)  # of what was read


def test_the_way_back_is_the_first_part_of_a_step_and_the_pose_gets_the_rest():
    tracker = JointTracker(ARM, beyond(5e-4))
    tracker.track(ARM.forward_kinematics(beyond(-0.5)), 1e-3)
    assert tracker.joints[3] == pytest.approx(ARM.upper[3] + 5e-4 - 2e-3, abs=1e-9)
    copied = copy.copy(JointTracker(ARM, beyond(5e-4)))
    copied.track(ARM.forward_kinematics(beyond(-0.5)), 1e-3)
    assert (copied.joints == tracker.joints).all()


def test_a_path_may_start_a_little_beyond_a_limit():
    joints = np.linspace(beyond(0.0), beyond(-0.5), 40)
    poses = ARM.forward_kinematics(joints)
    found = InverseKinematics(ARM).follow(poses, times=np.linspace(0.0, 2.0, 40), start=beyond(1.3e-4))
    assert found.report.complete
    assert (found.position <= ARM.upper).all()


@pytest.mark.parametrize("by", [1.1e-3, 0.1])
def test_farther_beyond_joint_value_and_limit_are_named(by):
    q = beyond(by)
    words = rf"joint 'j4' at {q[3]:.6f}, expected within the limits -2\.800000 to 2\.800000"
    tracker = JointTracker(ARM, MIDDLE)
    with pytest.raises(InvalidArgument, match=rf"start\[3\]: {words}"):
        JointTracker(ARM, q)
    with pytest.raises(InvalidArgument, match=rf"joints\[3\]: {words}"):
        tracker.joints = q
    assert (tracker.joints == MIDDLE).all()
    with pytest.raises(InvalidArgument, match=words):
        InverseKinematics(ARM).follow(ARM.forward_kinematics(np.array([MIDDLE, MIDDLE])), times=[0.0, 1.0], start=q)


def test_the_number_of_joints_is_still_named():
    tracker = JointTracker(ARM, MIDDLE)
    with pytest.raises(InvalidArgument, match="joints: 5 values, expected 6 finite values"):
        tracker.joints = MIDDLE[:5]


# ---- whole turns ------------------------------------------------------------------------------------------------


def turning(kind, limit):
    text = six_axis(limits={"j1": limit, "j4": limit, "j6": limit})
    for name in ("j1", "j4", "j6"):
        text = text.replace(f'<joint name="{name}" type="revolute">', f'<joint name="{name}" type="{kind}">')
    return Arm.from_urdf(text, base="base", tip="l6")


ENDLESS = turning("continuous", '<limit velocity="2" effort="80"/>')
THREE_TURNS = turning("revolute", '<limit lower="-2" upper="17" velocity="2" effort="80"/>')


@pytest.mark.parametrize("seed", range(6))
def test_a_path_is_found_with_the_whole_turns_that_leave_the_most_room(seed):
    random = np.random.default_rng(seed)
    swept = np.linspace(0.0, 1.0, 50)[:, None] * random.uniform(-0.6, 0.6, 6) + MIDDLE + random.uniform(-0.4, 0.4, 6)
    for robot, middle in ((ENDLESS, 0.0), (THREE_TURNS, 7.5)):
        found = InverseKinematics(robot).follow(robot.forward_kinematics(swept), times=np.linspace(0.0, 3.0, 50))
        assert found.report.complete
        assert np.abs(robot.forward_kinematics(found.position) - robot.forward_kinematics(swept)).max() < 1e-5
        ranges = 0.5 * (found.position.min(axis=0) + found.position.max(axis=0))
        assert (np.abs(ranges[[0, 3, 5]] - middle) <= np.pi + 1e-9).all()
        limits = np.minimum(found.position - robot.lower, robot.upper - found.position)
        assert found.report.limit_margin == pytest.approx(limits.min())


def test_a_path_from_where_the_robot_stands_keeps_its_turns():
    stand = MIDDLE + [4 * np.pi, 0, 0, -6 * np.pi, 0, 2 * np.pi]
    swept = np.linspace(0.0, 0.5, 30)[:, None] * np.ones(6) + MIDDLE
    found = InverseKinematics(ENDLESS).follow(ENDLESS.forward_kinematics(swept), np.linspace(0.0, 2.0, 30), start=stand)
    assert np.abs(found.position[0] - stand).max() < 1e-4
