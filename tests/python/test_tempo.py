"""At what tempo a motion is carried out: the person's where the limits allow it, slower where they bind."""

import json

import numpy as np
import pytest
from dmpcpp import Arm, JointTrajectory, PoseDmp, duration_factor, export, planning
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning import Tempo, tempo_check

from tests.python.test_planning import six_joints, swing


@pytest.fixture(scope="module")
def arm() -> Arm:
    return six_joints()


@pytest.fixture(scope="module")
def model(arm: Arm) -> PoseDmp:
    return swing(arm)


def burst(arm) -> JointTrajectory:
    """Slow, but for a fast wave of the last joint in the middle; 4 s."""
    time = np.linspace(0.0, 4.0, 2001)
    position = np.zeros((len(time), arm.joint_count))
    position[:, 0] = 0.3 * np.sin(time)
    position[:, -1] = 0.4 * np.exp(-60.0 * (time - 2.0) ** 2) * np.sin(25.0 * time)
    return JointTrajectory.through(time, position)


def test_a_calm_motion_keeps_the_persons_tempo_exactly(arm, model):
    found = planning.solve(model, arm, tempo="person")
    assert found.slowdown == 1.0 and found.tempo.peak == 1.0 and found.tempo.kept == 1.0
    np.testing.assert_array_equal(found.joints.time, found.tempo.wanted)
    assert found.tempo.describe(arm.joint_names) == "Carried out at the person's tempo."


def test_a_fast_motion_is_slower_only_where_limits_bind(arm):
    joints = burst(arm)
    slow = planning.slowed(arm, joints, tempo="person")
    even = planning.slowed(arm, joints, tempo="uniform")
    assert even.factor > 2.0 and slow.tempo.slowdown < 0.6 * even.factor
    assert duration_factor(slow.joints, arm.velocity_limit, arm.acceleration_limit) <= 1 / 1.02 + 1e-9
    tempo = slow.tempo
    assert tempo.kept > 0.5 and tempo.peak > 2.0 and abs(tempo.peak_time - 2.0) < 0.3
    assert np.abs(tempo.pace.rate).max() <= np.log(2) / 0.2 * (1 + 1e-9)
    assert tempo.pace.slowdown.min() >= 1.0
    assert slow.factor == tempo.slowdown == pytest.approx(slow.joints.time[-1] / 4.0)
    assert "of 'j5'" in tempo.decided_by(arm.joint_names)
    assert f"{1 / tempo.slowdown:.2f} of the person's tempo, at its slowest" in tempo.describe(arm.joint_names)


def test_moments_of_the_recording_are_found_again_on_the_robots_clock(arm):
    joints = burst(arm)
    tempo = planning.slowed(arm, joints, tempo="person").tempo
    np.testing.assert_allclose(tempo.when(joints.time), tempo.pace.time)
    assert tempo.when(np.array(1.0)) < tempo.when(np.array(3.0)) - 2.0


def test_the_motion_and_its_joints_share_one_clock(arm):
    found = planning.solve(swing(arm), arm, duration=0.3)
    assert found.slowdown > 1.5
    np.testing.assert_array_equal(found.motion.time, found.joints.time)
    np.testing.assert_allclose(arm.forward_kinematics(found.joints.position), found.motion.pose, atol=2e-5)
    speed = np.linalg.norm(np.gradient(found.motion.position, found.motion.time, axis=0), axis=1)
    np.testing.assert_allclose(speed[5:-5], np.linalg.norm(found.motion.twist[5:-5, :3], axis=1), rtol=0.02, atol=1e-3)


def test_the_fastest_way_starts_and_ends_at_rest_within_the_limits(arm):
    found = planning.solve(swing(arm), arm, duration=6.0, tempo="fastest")
    assert found.slowdown < 0.5
    assert duration_factor(found.joints, arm.velocity_limit, arm.acceleration_limit) <= 1 / 1.02 + 1e-9
    np.testing.assert_allclose(found.joints.velocity[[0, -1]], 0.0, atol=1e-12)


def test_jerk_and_tool_speed_are_kept_at_the_persons_tempo_too(arm):
    limited = arm.with_limits(jerk=np.full(6, 2000.0), tool_speed=0.1)
    slow = planning.slowed(limited, burst(arm), tempo="person")
    assert planning.limit_factor(limited, slow.joints) <= 1 / 1.02 + 1e-9
    assert slow.tempo.slowdown > planning.slowed(arm, burst(arm), tempo="person").tempo.slowdown


def test_a_plan_says_its_tempo_and_writes_the_wanted_time(tmp_path, arm, model):
    found = planning.plan(model, arm, duration=0.3)
    told = found.summary()["tempo"]
    assert told["policy"] == "person" and told["slowdown"] == found.slowdown
    assert told["decided_by"]["joint"] in arm.joint_names and told["decided_by"]["limit"] in (
        "velocity",
        "acceleration",
    )
    planning.write(found, tmp_path)
    json.loads((tmp_path / "summary.json").read_text())
    read = export.read_plan(tmp_path / "plan.npz")
    np.testing.assert_array_equal(read.wanted_time, found.tempo.wanted)
    np.testing.assert_array_equal(read.time, found.joints.time)


def test_plans_without_a_wanted_time_still_load(tmp_path, model: PoseDmp):
    export.write_plan(tmp_path / "plan.npz", model.rollout())
    assert export.read_plan(tmp_path / "plan.npz").wanted_time is None


def test_slower_than_asked_for_is_a_check(arm, model):
    fast = planning.plan(model, arm, duration=0.3, slowest=1.5)
    check = fast["slowdown"]
    assert not check.ok and check.limit == 1.5 and check.value == fast.slowdown
    assert planning.plan(model, arm, duration=0.3, slowest=50)["slowdown"].ok
    assert "slowdown" not in {check.name for check in planning.plan(model, arm).checks}
    unasked = planning.plan(model, arm, duration=0.02)
    assert unasked.slowdown > 10.0 and not unasked["slowdown"].ok and unasked["slowdown"].limit == 10.0


@pytest.mark.parametrize("slowest", [0.5, float("inf"), float("nan")])
def test_a_slowest_factor_below_one_is_refused(slowest):
    with pytest.raises(InvalidArgument, match="slowest"):
        tempo_check(Tempo.unchanged(np.linspace(0.0, 1.0, 3)), slowest)


def test_another_word_for_the_tempo_is_refused(arm, model):
    with pytest.raises(InvalidArgument, match=r"tempo: 'quick', expected one of person, uniform, fastest"):
        planning.plan(model, arm, tempo="quick")


def test_one_sample_has_its_own_tempo():
    still = Tempo.unchanged(np.zeros(1))
    assert still.slowdown == still.peak == still.kept == 1.0


def test_an_arm_without_enough_effort_is_not_possible_at_any_tempo(arm):
    from dmpcpp.simulation import default_simulator

    weak = arm.with_limits(effort=np.full(6, 1e-3))
    assert not planning.slowed(weak, burst(arm), default_simulator, tempo="person").possible
    assert planning.slowed(six_joints(), burst(arm), default_simulator, tempo="person").possible
