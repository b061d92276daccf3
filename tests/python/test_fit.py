"""Joints fitted to the arm within a tolerance of the learned path: faster, and as near as was asked for."""

import json

import numpy as np
import pytest
from dmpcpp import Arm, PoseDmp, fit_path, metrics, planning, tip_motion
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning import Tolerance, taken_tolerance
from dmpcpp.robot import POSE, Follow

from tests.python.test_planning import six_joints, swing


@pytest.fixture(scope="module")
def arm() -> Arm:
    """An arm whose motors are no limit: accelerations are."""
    return six_joints().with_limits(effort=np.full(6, 1e4))


@pytest.fixture(scope="module")
def fast(arm: Arm) -> PoseDmp:
    """A model that needs about three times its duration."""
    return swing(arm, duration=0.3)


def test_a_fitted_motion_is_faster_and_within_the_tolerance(arm, fast):
    exact = planning.solve(fast, arm, tolerance=None)
    loose = planning.solve(fast, arm, tolerance="20mm,5deg")
    assert exact.fit is None and loose.fit is not None
    assert loose.slowdown < 0.97 * exact.slowdown
    assert loose.fit.after < loose.fit.before
    far = metrics.position_errors(loose.learned.pose, loose.motion.pose).max()
    turned = metrics.angle_errors(loose.learned.pose, loose.motion.pose).max()
    assert far <= loose.fit.position_max + 1e-9 <= 20e-3 + 1e-9
    assert turned <= loose.fit.angle_max + 1e-9 <= np.radians(5.0) + 1e-9
    np.testing.assert_allclose(arm.forward_kinematics(loose.joints.position), loose.motion.pose, atol=1e-9)
    np.testing.assert_array_equal(loose.motion.time, loose.joints.time)
    np.testing.assert_array_equal(loose.learned.time, loose.joints.time)


def test_the_same_model_gives_the_same_joints(arm, fast):
    one, other = (planning.solve(fast, arm, tolerance=(5e-3, 0.05)) for _ in range(2))
    np.testing.assert_array_equal(one.joints.position, other.joints.position)


def test_no_tolerance_is_the_learned_path(arm, fast):
    for none in (None, "0", "0.0"):
        found = planning.solve(fast, arm, tolerance=none)
        assert found.fit is None and found.motion is found.learned
        np.testing.assert_allclose(arm.forward_kinematics(found.joints.position), found.motion.pose, atol=2e-5)


def test_a_calm_motion_is_not_fitted(arm):
    calm = planning.solve(swing(arm, duration=5.0), arm)
    assert calm.fit is None and calm.slowdown == 1.0


def test_a_plan_from_stated_joints_follows_the_path_itself(arm, fast):
    start = planning.solve(fast, arm).joints.position[0]
    assert planning.plan(fast, arm, start=planning.solve(fast, arm, tolerance=None).joints.position[0]).fit is None
    assert start.shape == (6,)


def test_a_plan_checks_its_deviation_and_says_it(arm, fast):
    found = planning.plan(fast, arm, tolerance="20mm,5deg")
    assert found.fit is not None and found.ok
    check = found["fitted_position_max"]
    assert check.ok and check.limit == pytest.approx(0.02) and check.value == found.fit.position_max
    assert found["fitted_angle_max"].unit == "rad"
    summary = json.loads(json.dumps(found.summary()))
    assert summary["fitted"]["position_max"] == found.fit.position_max
    assert "20 mm, 5 deg" in found.fit.describe()
    position_only = found.fit.checks(Follow("position"))
    assert [check.name for check in position_only] == ["fitted_position_max"]


def test_what_the_last_word_refuses_is_not_taken(arm, fast):
    exact = planning.solve(fast, arm, slow_down=False)
    asked = []
    refuse = lambda joints: asked.append(joints) is not None  # noqa: E731
    fit = planning.fitted(arm, exact.learned, exact.joints, Tolerance(0.02, 0.1), POSE, refuse, None)
    assert fit is None and asked


def test_position_alone_leaves_the_orientation_free(arm, fast):
    exact = planning.solve(fast, arm, slow_down=False)
    whole, free = (
        planning.fitted(arm, exact.motion, exact.joints, Tolerance(5e-3, 0.01), follow, None, None)
        for follow in (POSE, Follow("position"))
    )
    assert whole is None or free.after < whole.after
    assert metrics.position_errors(exact.motion.pose, free.motion.pose).max() <= 5e-3 + 1e-9
    assert metrics.angle_errors(exact.motion.pose, free.motion.pose).max() > 0.01


def test_the_tip_moves_as_its_joints_do(arm):
    joints = planning.solve(swing(arm), arm, slow_down=False).joints
    tip = tip_motion(arm, joints)
    np.testing.assert_allclose(tip.pose, arm.forward_kinematics(joints.position))
    speed = np.gradient(tip.position, tip.time, axis=0)
    np.testing.assert_allclose(tip.twist[2:-2, :3], speed[2:-2], atol=1e-4)
    gain = np.gradient(tip.twist, tip.time, axis=0)
    np.testing.assert_allclose(tip.acceleration[2:-2], gain[2:-2], atol=1e-2)


@pytest.mark.parametrize(
    ("text", "metres", "radians"),
    [("1mm,0.5deg", 1e-3, np.radians(0.5)), ("0.5 cm, 0.1rad", 5e-3, 0.1), ("1e-3m,5DEG", 1e-3, np.radians(5.0))],
)
def test_a_tolerance_is_a_length_and_an_angle(text, metres, radians):
    found = taken_tolerance(text)
    assert (found.position, found.angle) == pytest.approx((metres, radians))
    assert taken_tolerance((metres, radians)) == Tolerance(metres, radians)


@pytest.mark.parametrize("text", ["1mm", "0.5deg,1mm", "1,0.5", "1mm,0.5deg,2", "", "-1mm,1deg", "1 inch,1deg"])
def test_another_text_is_refused_with_an_example(text):
    with pytest.raises(InvalidArgument, match=r"tolerance: .*1mm,0.5deg"):
        taken_tolerance(text)


@pytest.mark.parametrize("values", [(0.0, 0.1), (1e-3, 0.0), (float("inf"), 0.1), (float("nan"), 0.1)])
def test_a_tolerance_of_one_zero_is_refused(values):
    with pytest.raises(InvalidArgument, match="tolerance"):
        taken_tolerance(values)


def test_arguments_of_the_fit_are_refused_by_name(arm, fast):
    path = planning.solve(fast, arm, slow_down=False)
    time, pose, joints = path.motion.time, path.motion.pose, path.joints.position
    with pytest.raises(InvalidArgument, match="position_tolerance: 0"):
        fit_path(arm, time, pose, joints, position_tolerance=0.0)
    with pytest.raises(InvalidArgument, match="poses: 3, expected"):
        fit_path(arm, time, pose[:3], joints)
    with pytest.raises(InvalidArgument, match=r"weight|turns"):
        fit_path(arm, time, pose, joints, weight=np.zeros(6))
