"""Execution under physics: accuracy, closed forms, and a verdict that catches one fault of each kind."""

import json
import subprocess
import sys
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from benchmarks.joint_motions import HOME, PENDULUM, Joints, reach, swing, trajectory

pytest.importorskip("pybullet", reason="the extra `sim`")

from dmpcpp import Arm, InverseKinematics, arms, duration_factor, simulation, stretched
from dmpcpp.errors import InvalidArgument, MissingDependency
from dmpcpp.metrics import position_errors
from dmpcpp.simulation import _reference as reference
from dmpcpp.simulation._bullet import Bullet


@pytest.fixture(scope="module")
def panda():
    return arms.find("panda")


@pytest.fixture(scope="module")
def panda_log(panda):
    return simulation.execute(panda, swing(panda))


# ---- accuracy -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["panda", "iiwa", "xarm6"])
def test_computed_torque_follows_to_a_micrometre(name):
    arm = arms.find(name)
    log = simulation.execute(arm, swing(arm, 2.0))
    assert log.errors.position_max <= 1e-6
    assert log.errors.angle_max <= np.radians(0.001)
    assert {check.name for check in log.verdict.failed} <= ({"inertia"} if name == "xarm6" else set())


@pytest.mark.parametrize("name", ["panda", "iiwa", "xarm6"])
def test_with_the_derivatives_of_the_spline_it_follows_to_a_twentieth_of_a_millimetre(name):
    arm = arms.find(name)
    log = simulation.execute(arm, reach(arm, np.add(HOME[name], 0.4), 3.0), consistent=False)
    assert log.errors.position_rmse <= 0.05e-3
    assert log.errors.position_max <= 0.1e-3
    assert log.errors.angle_max <= np.radians(0.01)


def test_the_engines_own_motors_follow_as_well_and_the_log_says_what_they_cannot_show(panda):
    log = simulation.execute(panda, swing(panda), mode="position")
    assert log.errors.position_max <= 1e-5
    assert log.mode == "position"
    assert "only kinematics" in log.verdict.caveat


def test_two_runs_are_bit_identical(panda, panda_log):
    again = simulation.execute(panda, swing(panda))
    for name in ("time", "position", "velocity", "torque", "torque_demand", "tool_pose", "desired_tool_pose"):
        assert getattr(again, name).tobytes() == getattr(panda_log, name).tobytes(), name


def test_two_worlds_at_once_do_not_touch_each_other(panda):
    there = np.add(HOME["panda"], 0.2)
    with Bullet(panda, 1e-3) as one, Bullet(panda, 1e-3) as other:
        one.reset(np.array(HOME["panda"]), np.zeros(7))
        other.reset(there, np.zeros(7))
        other.step()
        assert np.array_equal(one.state()[0], HOME["panda"])
        assert not np.array_equal(other.state()[0], there)


@pytest.mark.parametrize("name", ["panda", "iiwa"])
def test_a_circle_goes_through_inverse_kinematics_and_both_time_scalings_to_a_sound_execution(name):
    arm = arms.find(name)
    time = np.linspace(0.0, 1.5, 301)
    turn = 2 * np.pi * (10 * (time / 1.5) ** 3 - 15 * (time / 1.5) ** 4 + 6 * (time / 1.5) ** 5)
    poses = np.tile(arm.forward_kinematics(np.array(HOME[name])), (301, 1, 1))
    poses[:, :3, 3] += 0.08 * np.column_stack([np.cos(turn) - 1.0, np.sin(turn), 0.5 * np.sin(turn)])
    joints = InverseKinematics(arm).follow(poses, times=time)
    joints = stretched(joints, duration_factor(joints, 0.95 * arm.velocity_limit, arm.acceleration_limit))
    joints = stretched(joints, max(1.0, simulation.torque_duration_factor(arm, joints)))
    log = simulation.execute(arm, joints)
    assert log.verdict.ok, log.verdict.failed
    assert log.verdict["ik_position_residual"].value <= 1e-5
    at_samples = np.searchsorted(log.time, joints.time - 1e-9)
    inside = np.flatnonzero(np.abs(log.time[at_samples] - joints.time) < 1e-9)
    assert position_errors(poses[inside], log.tool_pose[at_samples[inside]]).max() <= 2e-5


# ---- closed forms -------------------------------------------------------------------------------------


def test_the_torque_of_a_pendulum_is_its_equation_of_motion():
    arm = Arm.from_urdf(PENDULUM.format(ixx=0.02), base="base", tip="rod")
    log = simulation.execute(arm, trajectory(arm, np.linspace(0, 2, 201), np.sin(np.linspace(0, 4, 201))[:, None]))
    inertia, weight, damping = 0.03 + 2 * 0.4**2, 2 * 9.81 * 0.4, 0.7
    acceleration = np.gradient(log.velocity[:, 0], 1e-3)
    expected = inertia * acceleration - weight * np.cos(log.position[:, 0]) + damping * log.velocity[:, 0]
    middle = log.motion.start + 100, log.motion.stop - 100
    assert np.allclose(log.torque[slice(*middle), 0], expected[slice(*middle)], atol=0.02)
    assert log.torque[-1, 0] == pytest.approx(-weight * np.cos(log.position[-1, 0]), abs=1e-4)


def test_a_pendulum_that_is_let_go_swings_with_its_own_period():
    arm = Arm.from_urdf(PENDULUM.format(ixx=0.02).replace('damping="0.7"', 'damping="0"'), base="base", tip="rod")
    with Bullet(arm, 1e-4) as world:
        world.reset(np.array([np.pi / 2 - 0.05]), np.zeros(1))  # the rod hangs down at +90 degrees
        angles = []
        for _ in range(30_000):
            world.step()
            angles.append(world.state()[0][0] - np.pi / 2)
    crossings = np.flatnonzero(np.diff(np.sign(angles)) != 0)
    period = 2e-4 * float(np.mean(np.diff(crossings)))
    assert period == pytest.approx(2 * np.pi * np.sqrt((0.03 + 2 * 0.16) / (2 * 9.81 * 0.4)), rel=1e-3)
    assert max(angles[-12_000:]) == pytest.approx(0.05, rel=1e-2)  # and nothing damps it


def test_bullets_kinematics_are_those_of_the_arm(panda):
    rng = np.random.default_rng(0)
    with Bullet(panda, 1e-3) as world:
        for q in panda.lower + (panda.upper - panda.lower) * rng.random((50, 7)):
            world.reset(q, np.zeros(7))
            assert np.allclose(world.tool_pose(), panda.forward_kinematics(q), atol=1e-6)


def test_an_arm_that_is_a_part_of_the_robot_is_measured_from_its_own_base():
    whole = arms.find("panda")
    path = arms._pybullet_data() / arms.KNOWN["panda"].urdf
    part = arms.load(path, base="panda_link2", tip="panda_link8")
    log = simulation.execute(part, swing(part, centre=HOME["panda"][2:]))
    assert whole.joint_count == part.joint_count + 2
    assert log.errors.position_max <= 1e-5


def test_fingers_are_held_still(panda):
    with Bullet(panda, 1e-3) as world:
        world.reset(np.array(HOME["panda"]), np.zeros(7))
        before = list(world._held_state[0])
        for _ in range(200):
            world.apply_torque(world.inverse_dynamics(np.array([3.0, -3.0, 3.0, -3.0, 3.0, -3.0, 3.0])))
            world.step()
        assert len(before) == 2
        assert np.allclose(world._held_state[0], before, atol=1e-4)


# ---- from rest to rest --------------------------------------------------------------------------------


def test_a_motion_cut_in_mid_swing_is_led_in_from_rest_and_out_to_rest(panda, panda_log):
    log = panda_log
    assert not log.velocity[0].any()
    assert np.abs(log.velocity[-1]).max() < 1e-6
    assert log.time[0] < 0.0
    assert log.time[log.motion][[0, -1]] == pytest.approx([0.0, 1.0], abs=1e-12)
    assert np.abs(log.velocity[log.motion][0]).max() > 0.4
    assert np.allclose(log.desired_position[log.motion][::10], log.joints.position, atol=1e-12)


def test_lead_in_and_lead_out_join_without_a_jump_and_stay_gentle(panda):
    joints = swing(panda)
    sampled = reference.sample(panda, joints, 1000.0, settle=0.2, from_rest=True, consistent=False)
    step = np.diff(sampled.position, axis=0) * 1000.0
    assert np.allclose(step, 0.5 * (sampled.velocity[1:] + sampled.velocity[:-1]), atol=1e-4)
    outside = np.r_[sampled.acceleration[: sampled.motion.start], sampled.acceleration[sampled.motion.stop :]]
    assert np.abs(outside).max() <= reference.LEAD_ACCELERATION * (1 + 1e-9)
    assert not sampled.velocity[-200:].any()


def test_a_lead_in_stays_inside_the_joint_limits_where_it_can(panda):
    centre = np.array(HOME["panda"])
    centre[0] = panda.upper[0] - 0.31  # at speed beside the limit
    sampled = reference.sample(panda, swing(panda, centre=centre), 1000.0, settle=0.2, from_rest=True, consistent=True)
    assert (sampled.position <= panda.upper + 1e-9).all()


def test_the_reference_between_samples_is_the_quintic_through_them(panda):
    polynomial = np.polynomial.Polynomial([0.1, -0.2, 0.3, 0.5, -0.7, 0.2])
    time = np.array([0.0, 0.3, 0.35, 1.0])
    values = [np.tile(polynomial.deriv(k)(time)[:, None] if k else polynomial(time)[:, None], 7) for k in range(3)]
    joints = Joints(time, *values, list(panda.joint_names))
    sampled = reference.sample(panda, joints, 1000.0, settle=0.0, from_rest=True, consistent=False)
    inside = sampled.time[sampled.motion]
    for order, state in enumerate((sampled.position, sampled.velocity, sampled.acceleration)):
        expected = polynomial.deriv(order)(inside) if order else polynomial(inside)
        assert np.allclose(state[sampled.motion], expected[:, None], atol=1e-10)


def test_consistent_references_are_met_by_semi_implicit_steps(panda):
    sampled = reference.sample(panda, swing(panda), 500.0, settle=0.1, from_rest=True, consistent=True)
    q, qd = sampled.position[0].copy(), sampled.velocity[0].copy()
    for k in range(len(sampled.time) - 1):
        qd += sampled.acceleration[k] / 500.0
        q += qd / 500.0
        assert np.allclose(q, sampled.position[k + 1], atol=1e-9)


def test_started_in_flight_there_is_no_lead_in(panda):
    log = simulation.execute(panda, swing(panda, 0.3), from_rest=False)
    assert log.time[0] == 0.0
    assert log.errors.position_max <= 1e-5


# ---- one fault of each kind is caught -----------------------------------------------------------------


class WrongMasses(Bullet):
    """A controller that believes in masses 20 % too small."""

    def inverse_dynamics(self, *state):
        return 0.8 * super().inverse_dynamics(*state)


class WrongTool(Bullet):
    """A tool mounted 1 mm off."""

    def tool_pose(self):
        pose = super().tool_pose()
        pose[0, 3] += 1e-3
        return pose


def failed(log):
    return {check.name for check in log.verdict.failed}


def test_a_sound_execution_fails_no_check(panda_log):
    assert panda_log.verdict.ok
    assert not panda_log.verdict.failed
    assert len(panda_log.verdict.checks) >= 12


def test_wrong_masses_are_caught_by_tracking_and_settling(panda):
    log = simulation.execute(panda, swing(panda), kp=400.0, kd=40.0, simulator=WrongMasses)
    assert {"tracking_position_rmse", "tracking_position_max", "settle_error"} <= failed(log)


def test_position_mode_is_blind_to_wrong_masses_and_the_look_at_the_engine_is_not(panda):
    log = simulation.execute(panda, swing(panda), simulator=WrongMasses, mode="position")
    assert failed(log) == {"dynamics_mismatch"}


def test_a_tool_that_is_not_where_the_arms_model_says_is_caught(panda):
    log = simulation.execute(panda, swing(panda), simulator=WrongTool)
    assert "kinematics_mismatch" in failed(log)
    assert log.verdict["kinematics_mismatch"].value == pytest.approx(1e-3, rel=1e-3)


def test_a_weak_motor_is_caught_by_the_torque_and_named(panda):
    weak = panda.with_limits(effort=[87.0, 20.0, 87.0, 87.0, 12.0, 12.0, 12.0])
    log = simulation.execute(weak, swing(weak))
    check = log.verdict["torque_ratio"]
    assert {"torque_ratio", "torque_clipped"} <= failed(log)
    assert (check.detail, check.ok) == ("panda_joint2", False)
    assert np.abs(log.torque[:, 1]).max() == 20.0
    assert check.value == pytest.approx(np.abs(log.torque_demand[:, 1]).max() / 20.0)


def test_a_motion_too_fast_for_a_joint_is_caught_and_its_moment_named(panda):
    log = simulation.execute(panda, reach(panda, np.add(HOME["panda"], [1.2, 0, 0, 0, 0, 0, 0]), 0.8))
    check = log.verdict["velocity_ratio"]
    assert "velocity_ratio" in failed(log)
    assert check.value == pytest.approx(1.875 * 1.2 / 0.8 / 2.175, rel=1e-3)
    assert (check.detail, check.time) == ("panda_joint1", pytest.approx(0.4, abs=2e-3))


def test_a_joint_beyond_its_limit_is_caught(panda):
    narrow = panda.with_limits(upper=panda.upper - [2.8, 0, 0, 0, 0, 0, 0])
    log = simulation.execute(narrow, swing(narrow))
    assert failed(log) == {"joint_margin"}
    assert log.verdict["joint_margin"].value == pytest.approx(narrow.upper[0] - log.position[:, 0].max())


def test_a_hand_folded_onto_the_forearm_is_caught_as_self_collision(panda):
    folded = np.array(HOME["panda"])
    folded[5] = 0.0
    log = simulation.execute(panda, reach(panda, folded, 2.0))
    check = log.verdict["self_collision"]
    assert "self_collision" in failed(log)
    assert "floor_contact" not in failed(log)
    assert "panda_link5" in check.detail
    assert check.time > 1.0


def test_the_iiwas_wrist_turns_over_its_whole_range_without_touching_the_forearm():
    arm = arms.find("iiwa")
    wrist = np.tile(HOME["iiwa"], (41, 1))
    wrist[:, 5] = np.linspace(arm.lower[5], arm.upper[5], 41)
    assert simulation.contacts_along(arm, wrist) == []


def test_a_hand_on_the_floor_is_caught(panda):
    log = simulation.execute(panda, reach(panda, [0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8], 2.0))
    assert "floor_contact" in failed(log)
    assert "floor" in log.verdict["floor_contact"].detail
    without = simulation.execute(panda, log.joints, simulator=partial(Bullet, floor=None))
    assert "floor_contact" not in failed(without)


def test_an_inexact_inverse_kinematics_is_caught(panda, panda_log):
    for name, size in (("position", 1e-4), ("angle", 1e-3)):
        errors = {"position_error": np.zeros(101), "angle_error": np.zeros(101)}
        errors[f"{name}_error"][40] = size
        log = replace(panda_log, joints=replace(panda_log.joints, report=SimpleNamespace(**errors)))
        assert failed(log) == {f"ik_{name}_residual"}
        assert log.verdict[f"ik_{name}_residual"].time == pytest.approx(0.4)


def test_an_inertia_that_no_body_has_is_caught_replaced_and_named():
    arm = Arm.from_urdf(PENDULUM.format(ixx=1.0), base="base", tip="rod")  # 0.03 + 0.03 < 1.0
    log = simulation.execute(arm, reach(arm, [0.5]))
    assert failed(log) == set() and not log.verdict.ok
    assert log.verdict["inertia"].result == "not judged"  # 31 % from the nearest possible
    assert "rod" in log.verdict["inertia"].detail
    assert log.errors.position_max < 1e-6
    accepted = simulation.judge(log, simulation.Tolerances(repaired_inertias=1))
    assert accepted.ok


class Breaks(Bullet):
    """A controller that divides by zero after half a second."""

    def inverse_dynamics(self, *state):
        self.calls = getattr(self, "calls", 0) + 1
        return super().inverse_dynamics(*state) * (np.nan if self.calls > 500 else 1.0)


def test_a_state_that_leaves_the_finite_numbers_stops_the_run_and_is_caught(panda):
    log = simulation.execute(panda, swing(panda), simulator=Breaks)
    check = log.verdict["finite"]
    assert not check.ok
    assert (len(log.time), check.value) == (491, log.planned_steps - 491)
    assert check.time == log.time[-1]
    assert np.isfinite(log.position).all()
    json.dumps([each.to_dict() for each in log.verdict.checks], allow_nan=False)


def test_a_run_that_stops_before_its_motion_began_has_a_verdict_too(panda):
    log = simulation.execute(panda, swing(panda, centre=HOME["panda"]), simulator=Breaks)
    early = replace(log, motion=slice(900, 1900))
    assert {"finite", "tracking_position_rmse", "tracking_position_max"} <= failed(early)
    json.dumps([each.to_dict() for each in early.verdict.checks], allow_nan=False)


def test_every_check_is_json_and_can_be_asked_for_by_name(panda_log):
    text = json.dumps([check.to_dict() for check in panda_log.verdict.checks], allow_nan=False)
    assert {"name", "ok", "result", "value", "limit", "unit", "time", "detail"} == set(json.loads(text)[0])
    with pytest.raises(KeyError, match="the checks are finite"):
        panda_log.verdict["torque"]


def test_a_check_made_of_numpy_numbers_is_json_too():
    check = simulation.Check("a", np.bool_(True), np.float64(1.5), np.int64(2), "1")
    assert json.loads(json.dumps(check.to_dict()))["ok"] is True


def test_tighter_tolerances_fail_what_the_defaults_pass(panda_log):
    strict = simulation.judge(panda_log, simulation.Tolerances(velocity_ratio=0.1))
    assert [check.name for check in strict.failed] == ["velocity_ratio"]


def slower(joints, factor):
    return replace(
        joints,
        time=joints.time * factor,
        velocity=joints.velocity / factor,
        acceleration=joints.acceleration / factor**2,
    )


def test_a_motion_too_fast_for_the_motors_is_slowed_just_enough_by_the_torque_factor(panda):
    fast = reach(panda, np.add(HOME["panda"], [0.0, 0.5, 0.0, 0.5, 0.5, -0.5, 0.5]), 0.35)
    factor = simulation.torque_duration_factor(panda, fast, share=0.9)
    before = simulation.execute(panda, fast).verdict["torque_ratio"].value
    after = simulation.execute(panda, slower(fast, factor)).verdict["torque_ratio"].value
    assert before > 1.0 and factor > 1.0
    assert after == pytest.approx(0.9, abs=0.01)
    assert simulation.torque_duration_factor(panda, slower(fast, factor), share=0.9) == pytest.approx(1.0)


def test_the_torque_factor_of_a_damped_pendulum_is_its_closed_form():
    arm = Arm.from_urdf(PENDULUM.format(ixx=0.02), base="base", tip="rod")
    one = np.ones((2, 1))
    joints = Joints(np.arange(2.0), np.pi / 2 * one, 30.0 * one, 100.0 * one, list(arm.joint_names))  # hanging down
    factor = simulation.torque_duration_factor(arm, joints, share=1.0)
    assert 0.35 * 100.0 / factor**2 + 0.7 * 30.0 / factor == pytest.approx(50.0)


def test_a_pose_that_cannot_be_held_has_no_finite_torque_factor(panda):
    weak = panda.with_limits(effort=[87.0, 10.0, 87.0, 87.0, 12.0, 12.0, 12.0])
    assert simulation.torque_duration_factor(weak, swing(weak)) == np.inf


def test_contacts_along_a_path_are_found_without_moving(panda):
    path = np.linspace(HOME["panda"], [0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8], 40)
    found = simulation.contacts_along(panda, path)
    assert {contact.other for _, contact in found} == {"floor"}
    assert [k for k, _ in found] == sorted(k for k, _ in found)
    assert found[0][0] > 20
    assert simulation.contacts_along(panda, path[:20]) == []


# ---- manners ------------------------------------------------------------------------------------------


def test_nothing_is_printed(panda, capfd):
    simulation.execute(arms.find("xarm6"), swing(arms.find("xarm6"), 0.1))
    simulation.execute(panda, swing(panda, 0.1))
    assert capfd.readouterr() == ("", "")


def test_nothing_is_printed_into_a_pipe_either():
    program = (
        "from dmpcpp import arms; from dmpcpp.simulation import Bullet\nwith Bullet(arms.find('panda'), 1e-3): pass"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_progress_goes_up_to_the_whole(panda):
    seen = []
    log = simulation.execute(panda, swing(panda), progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (len(log.time), len(log.time))
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)
    assert len(seen) > 5


def test_without_pybullet_the_error_says_what_to_install(panda, monkeypatch):
    monkeypatch.setitem(sys.modules, "pybullet", None)
    with pytest.raises(MissingDependency, match=r"dmpcpp\[bullet\].*mujoco"):
        simulation.execute(panda, swing(panda, 0.1), simulator=simulation.Bullet)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"mode": "torque"}, "mode: 'torque', expected one of computed_torque, position"),
        ({"rate": 1.0}, "rate: 1.0, expected 10 to 100000 Hz"),
        ({"rate": float("nan")}, "rate: nan"),
        ({"kp": -1.0}, "kp: -1.0, expected a number >= 0"),
        ({"settle": float("inf")}, "settle: inf"),
    ],
)
def test_an_option_out_of_range_is_refused(panda, options, message):
    with pytest.raises(InvalidArgument, match=message):
        simulation.execute(panda, swing(panda, 0.1), **options)


def test_a_trajectory_that_does_not_fit_the_arm_is_refused(panda):
    joints = swing(panda, 0.1)
    with pytest.raises(InvalidArgument, match=r"joints\.joint_names: .*Solve the inverse kinematics with this arm"):
        simulation.execute(arms.find("iiwa"), joints)
    with pytest.raises(InvalidArgument, match=r"joints\.position\[3\]: not finite"):
        broken = joints.position.copy()
        broken[3, 2] = np.nan
        simulation.execute(panda, replace(joints, position=broken))
    with pytest.raises(InvalidArgument, match=r"joints: 1 sample\(s\), expected at least 2"):
        one = {name: getattr(joints, name)[:1] for name in ("time", "position", "velocity", "acceleration")}
        simulation.execute(panda, replace(joints, **one))


def test_a_step_back_in_time_is_refused(panda):
    joints = swing(panda, 0.1)
    with pytest.raises(InvalidArgument, match=r"joints\.time\[5\]: .*runs backwards"):
        time = joints.time.copy()
        time[5] = time[3]
        simulation.execute(panda, replace(joints, time=time))


def test_measured_poses_are_poses(panda_log):
    rotations = panda_log.tool_pose[:, :3, :3]
    assert np.allclose(rotations @ rotations.transpose(0, 2, 1), np.eye(3), atol=1e-12)
    assert position_errors(panda_log.tool_pose, panda_log.desired_tool_pose).shape == panda_log.time.shape
