"""From a model to joints: what is met, what is kept, and what a plan that fails is."""

import json

import numpy as np
import pytest
from dmpcpp import (
    Arm,
    JointTrajectory,
    PoseDemonstration,
    PoseDmp,
    PoseDmpSequence,
    Via,
    duration_factor,
    planning,
)
from dmpcpp.checks import Series
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import LimitUse

LINK = """<link name="{name}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
</inertial></link>"""
JOINT = """<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>
<origin xyz="{x} {y} {z}"/><axis xyz="{axis}"/><limit lower="-2.5" upper="2.5" velocity="3" effort="100"/></joint>"""


def six_joints(limit: float = 2.5) -> Arm:
    """A wrist on a shoulder: six turning joints, 0.8 m long."""
    return Arm.from_urdf(six_urdf(limit))


def six_urdf(limit: float = 2.5) -> str:
    axes = ("0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0")
    origins = ((0, 0, 0.2), (0, 0, 0.1), (0, 0, 0.3), (0.1, 0, 0), (0.2, 0, 0), (0.1, 0, 0))
    parts = [LINK.format(name=f"l{k}") for k in range(7)]
    for k, (axis, (x, y, z)) in enumerate(zip(axes, origins, strict=True)):
        parts.append(JOINT.format(name=f"j{k}", parent=f"l{k}", child=f"l{k + 1}", x=x, y=y, z=z, axis=axis))
    return f"<robot name='six'>{''.join(parts)}</robot>".replace('"2.5"', f'"{limit}"').replace('"-2.5"', f'"-{limit}"')


HOME = np.array([0.2, 0.4, 0.6, 0.3, -0.5, 0.2])
THERE = np.array([0.7, 0.7, 0.3, -0.2, -0.8, 0.5])


def swing(arm: Arm, duration: float = 2.0, first: np.ndarray = HOME, last: np.ndarray = THERE) -> PoseDmp:
    """A model of the tip's way while the joints go from one posture to another."""
    time = np.linspace(0.0, duration, 81)
    share = 10 * (time / duration) ** 3 - 15 * (time / duration) ** 4 + 6 * (time / duration) ** 5
    return PoseDmp.fit(PoseDemonstration(time, arm.forward_kinematics(first + np.outer(share, last - first))))


@pytest.fixture(scope="module")
def arm() -> Arm:
    return six_joints()


@pytest.fixture(scope="module")
def model(arm: Arm) -> PoseDmp:
    return swing(arm)


def test_the_joints_meet_the_model_at_every_sample(arm, model):
    found = planning.solve(model, arm)
    assert found.joints.report.complete and found.slowdown == 1.0
    assert len(found.joints.time) == len(found.motion.time) >= 1001
    np.testing.assert_allclose(arm.forward_kinematics(found.joints.position), found.motion.pose, atol=2e-5)
    np.testing.assert_allclose(found.motion.time, found.joints.time, atol=1e-9)


def test_a_path_has_ten_samples_a_kernel_and_a_thousand_at_least(arm, model):
    many = PoseDmp.fit(PoseDemonstration(model.rollout(dt=0.01).time, model.rollout(dt=0.01).pose), basis_count=150)
    assert len(planning.solve(many, arm).joints.time) == 1501
    assert len(planning.solve(model, arm).joints.time) == 1 + max(1000, 10 * model.options.basis_count)


def test_a_fast_motion_is_slowed_to_its_limits_with_two_percent_to_spare(arm, model):
    found = planning.solve(model, arm, duration=0.2)
    factor = duration_factor(found.joints, arm.velocity_limit, arm.acceleration_limit)
    assert found.slowdown > 2.0
    assert factor == pytest.approx(1 / 1.02, rel=1e-3)
    assert found.motion.time[-1] == pytest.approx(0.2 * found.slowdown)
    assert found.joints.time[-1] == pytest.approx(0.2 * found.slowdown)


def test_a_motion_that_may_not_be_slowed_fails_its_check(arm, model):
    found = planning.plan(model, arm, duration=0.2, slow_down=False)
    assert found.slowdown == 1.0 and found.joints.time[-1] == pytest.approx(0.2)
    assert {check.name for check in found.failed} == {"velocity_ratio", "acceleration_ratio", "robot_ready"}


def test_joints_keep_two_milliradians_off_their_limits_where_the_path_allows():
    wide = six_joints()
    edge = np.array([0.2, 0.4, 0.6, 0.3, -0.5, 2.4999])
    model = swing(wide, last=edge)
    found = planning.solve(model, wide)
    limited = planning.solve(swing(wide), wide)
    assert limited.joints.report.complete
    assert LimitUse.of(wide, *_motion(limited.joints)).margin.min() >= 2e-3 - 1e-9
    assert LimitUse.of(wide, *_motion(found.joints)).margin.min() >= -1e-6


def test_a_plan_that_misses_its_path_is_not_ok_and_sends_nothing_to_a_robot(tmp_path, arm, model):
    narrow = arm.with_limits(lower=HOME - 0.05, upper=HOME + 0.05)
    planning.write(planning.plan(model, arm), tmp_path)
    assert (tmp_path / "joints.csv").exists()
    found = planning.plan(model, narrow, start=HOME)
    assert not found.ok
    assert {"ik_position_residual", "ik_angle_residual"} <= {check.name for check in found.failed}
    worst = found["ik_position_residual"]
    assert worst.value == pytest.approx(found.joints.report.position_error.max())
    assert worst.time == pytest.approx(found.joints.time[np.argmax(found.joints.report.position_error)])
    planning.write(found, tmp_path)
    assert not (tmp_path / "joints.csv").exists()
    assert json.loads((tmp_path / "summary.json").read_text())["verdict"] == "fail"


def test_a_plan_begins_where_the_arm_stands(arm, model):
    found = planning.plan(model, arm, start=HOME)
    np.testing.assert_allclose(found.joints.position[0], HOME, atol=1e-3)
    assert found.ok


@pytest.mark.parametrize(
    ("options", "argument"),
    [
        ({"start": [0.0, 1.0]}, "start"),
        ({"duration": 0.0}, "duration"),
        ({"duration": np.inf}, "duration"),
        ({"goal": np.diag([1.0, 1.0, 1.0, 1.0]) + np.pad([[9.0]], ((0, 3), (3, 0)))}, "goal"),
        ({"goal": np.eye(3)}, "goal"),
    ],
)
def test_what_cannot_be_planned_is_refused_by_its_argument(arm, model, options, argument):
    with pytest.raises(InvalidArgument) as refused:
        planning.plan(model, arm, **options)
    assert refused.value.argument == argument


def test_a_plan_passes_a_place_that_is_set_for_it_and_keeps_its_ends(arm, model):
    plain = planning.plan(model, arm)
    place = model.rollout_at([0.5 * model.duration]).pose[0][:3, 3] + [0.02, -0.02, 0.03]
    found = planning.plan(model, arm, via=planning.at_phases(model, [(0.5, place)]))
    middle = len(found.motion.time) // 2
    np.testing.assert_allclose(found.motion.position[middle], place, atol=1e-8)
    np.testing.assert_allclose(found.motion.rotation[middle], plain.motion.rotation[middle], atol=1e-8)
    np.testing.assert_allclose(found.motion.pose[[0, -1]], plain.motion.pose[[0, -1]], atol=1e-12)
    assert found.ok and found.summary()["via"][0]["phase"] == 0.5
    reached = arm.forward_kinematics(found.joints.position)[middle]
    np.testing.assert_allclose(reached[:3, 3], place, atol=1e-4)


@pytest.mark.parametrize(
    ("via", "words"),
    [
        (Via(0.5, np.eye(3)), r"via\[0\].point"),
        (Via(0.5, np.diag([1.0, 1.0, 1.0, 1.0]) + np.pad([[9.0]], ((0, 3), (3, 0)))), r"via\[0\].point.*stretched out"),
        (Via(1.0, np.eye(4)), r"via\[0\].phase: 1, expected 0.01 to 0.99"),
    ],
)
def test_via_points_that_cannot_be_planned_are_refused_by_name(arm, model, via, words):
    with pytest.raises(InvalidArgument, match=words):
        planning.plan(model, arm, via=[via])


def test_velocities_of_via_points_slow_down_with_the_plan(arm, model):
    pose = model.rollout_at([0.5 * model.duration]).pose[0]
    twist = np.array([0.5, 0, 0, 0, 0, 0])
    found = planning.plan(model, arm, duration=0.2, via=[Via(0.5, pose, twist)])
    assert found.slowdown > 1.5
    middle = len(found.motion.time) // 2
    np.testing.assert_allclose(found.motion.twist[middle] * found.tempo.pace.slowdown[middle], twist, atol=1e-6)


def test_a_sequence_is_planned_like_a_model(arm, model):
    back = swing(arm, first=THERE, last=HOME)
    found = planning.plan(PoseDmpSequence([model, back], leave=[0.9, 1.0], reach=0.3), arm)
    assert found.ok
    assert found.motion.time[-1] == pytest.approx(found.slowdown * (0.9 * model.duration + back.duration))
    np.testing.assert_allclose(found.motion.pose[-1], back.goal, atol=1e-3)
    with pytest.raises(InvalidArgument, match="via: of a sequence"):
        planning.plan(PoseDmpSequence([model, back]), arm, via=planning.at_phases(model, [(0.5, [0.3, 0, 0.4])]))


def test_another_branch_is_taken_where_the_first_is_not_accepted():
    arm = six_joints(6.0)
    model = swing(arm)
    first = planning.solve(model, arm).joints
    asked = []

    def accept(joints: JointTrajectory) -> bool:
        asked.append(joints)
        return bool(np.abs(joints.position[0] - first.position[0]).max() > 0.5)

    other = planning.solve(model, arm, accept=accept).joints
    assert len(asked) >= 2 and other.report.complete
    assert np.abs(other.position[0] - first.position[0]).max() > 0.5
    refused = planning.solve(model, arm, accept=lambda joints: False).joints
    np.testing.assert_array_equal(refused.position, first.position)


def test_a_suggested_start_from_which_nothing_leads_on_is_dropped(arm, model):
    found = planning.solve(model, arm, start=-HOME)
    assert found.joints.report.complete


def test_slowing_down_names_what_no_duration_is_enough_for(arm, model):
    joints = planning.solve(model, arm).joints
    unlimited = arm.with_limits(velocity=np.full(6, np.inf), acceleration=np.full(6, np.inf))
    slow = planning.slowed(unlimited, joints)
    assert (slow.factor, slow.possible) == (1.0, True)
    assert planning.limit_factor(unlimited, joints) == 0.0


def test_the_use_of_limits_is_a_share_joint_by_joint(arm):
    time = np.array([0.0, 1.0])
    position = np.array([[0.0] * 6, [0, 0, 2.4, 0, 0, 0]])
    velocity = np.array([[0.0] * 6, [0, -1.5, 0, 0, 0, 0]])
    acceleration = np.array([[0, 0, 0, 0, 12.0, 0]])
    use = LimitUse.of(arm, time, position, velocity, acceleration)
    assert use.margin.min() == pytest.approx(0.1)
    assert use.velocity.max() == pytest.approx(0.5) and use.acceleration.max() == pytest.approx(1.2)
    assert not use.within
    margin, speed, rate = use.checks()
    assert (margin.ok, margin.detail, margin.time) == (True, "j2", 1.0)
    assert (speed.ok, speed.detail, speed.value) == (True, "j1", pytest.approx(0.5))
    assert (rate.ok, rate.detail, rate.time) == (False, "j4", 1.0)
    assert [check.ok for check in use.checks(margin=0.2, velocity=0.4, acceleration=1.3)] == [False, False, True]


@pytest.mark.parametrize(("value", "ok"), [(1.0, True), (1.0 + 1e-7, True), (1.0 + 1e-5, False), (np.nan, False)])
def test_a_limit_forgives_rounding_and_no_more(value, ok):
    series = Series(np.array([0.0, 1.0]), np.array([0.5, value]))
    assert series.at_most("ratio", 1.0, "1").ok is ok
    if np.isfinite(value):
        assert Series(series.time, -series.values).at_least("margin", -1.0, "rad").ok is (value <= 1.0 + 1e-6)


def test_nothing_executed_is_no_pass():
    check = Series(np.zeros(0), np.zeros((0, 2)), ("a", "b")).at_most("ratio", 1.0, "1")
    assert not check.ok and np.isnan(check.value) and check.detail == "nothing was executed"


def _motion(joints):
    return joints.time, joints.position, joints.velocity, joints.acceleration


def test_a_plan_goes_to_a_new_goal_by_the_scaling_that_is_named_and_says_why(arm, model):
    goal = np.array(model.goal)
    goal[:3, 3] += 0.3 * (np.array(model.start)[:3, 3] - goal[:3, 3])
    usual = planning.plan(model, arm, goal=goal)
    assert usual.scaling.name == "advance" and "the model was learned" in usual.scaling.reason
    assert usual.summary()["scaling"] == {"name": "advance", "reason": usual.scaling.reason, "notes": []}
    stated = planning.plan(model, arm, goal=goal, scaling="none")
    assert stated.scaling.name == "none" and stated.scaling.reason.startswith("as stated")
    assert not np.allclose(stated.motion.pose[400], usual.motion.pose[400], atol=1e-4)
    np.testing.assert_allclose(stated.motion.pose[-1], usual.motion.pose[-1], atol=1e-3)
    older = model.with_scaling("none")
    assert np.array_equal(planning.plan(older, arm, goal=goal).motion.pose, stated.motion.pose)
    assert "scaling='advance'" in planning.plan(older, arm, goal=goal).scaling.describe()
    with pytest.raises(InvalidArgument) as refused:
        planning.plan(model, arm, scaling="wide")
    assert refused.value.argument == "scaling"


def test_a_plan_says_where_the_guard_of_a_scaling_steps_in(arm, model):
    far = np.array(model.goal)
    ways = far[:3, 3] - np.array(model.start)[:3, 3]
    axis = int(np.argmax(np.abs(ways)))
    found = planning.with_scaling(model, "per_axis_relative", far)[1]
    far[axis, 3] += 4.0 * ways[axis]
    farther = planning.with_scaling(model, "per_axis_relative", far)[1]
    assert any(f"axis {axis} goes" in note for note in farther.notes)
    assert not any("more than 4 times" in note for note in found.notes)
