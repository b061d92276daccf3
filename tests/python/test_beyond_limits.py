"""A robot whose encoders read a little beyond a joint's limit is taken as it stands, and brought back."""

import numpy as np
import pytest
from dmpcpp import InverseKinematics, JointTracker
from dmpcpp.errors import InvalidArgument

from tests.python.small_arms import arm

ARM = arm()
MIDDLE = np.array([0.1, 0.3, 0.8, 0.1, 0.7, 0.1])


def beyond(by, joint=3, side=1):
    q = MIDDLE.copy()
    q[joint] = (ARM.upper if side > 0 else ARM.lower)[joint] + side * by
    return q


@pytest.mark.parametrize("by", [1e-9, 1.3e-4, 9.9e-4])
@pytest.mark.parametrize("side", [1, -1])
def test_a_start_a_little_beyond_a_limit_is_taken_reported_and_steps_lead_inwards(by, side):
    tracker = JointTracker(ARM, beyond(by, side=side))
    assert tracker.limit_excess == pytest.approx(by, rel=1e-6)
    assert (tracker.joints >= ARM.lower).all() and (tracker.joints <= ARM.upper).all()
    goal = ARM.forward_kinematics(beyond(-0.1, side=side))
    before = tracker.joints[3]
    tracker.track(goal, 0.01)
    assert side * (tracker.joints[3] - before) <= 0.0
    other = JointTracker(ARM, MIDDLE)
    assert other.limit_excess == 0.0
    other.joints = beyond(by, side=side)
    assert other.limit_excess == pytest.approx(by, rel=1e-6)
    assert (other.joints >= ARM.lower).all() and (other.joints <= ARM.upper).all()


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
