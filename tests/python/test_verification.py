"""Logs of an arm, made by simulation with a known lag and known faults, held against their plan."""

import csv
import io
import json
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import arms, export, sending, simulation, verification
from dmpcpp.cli import main
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.simulation import Bullet, Disturbance, Tolerances
from dmpcpp.verification import JointLog

from benchmarks.joint_motions import HOME, reach, swing, trajectory

PANDA = arms.find("panda")
NAMES = tuple(PANDA.joint_names)


@pytest.fixture(scope="module")
def plan():
    return reach(PANDA, np.add(HOME["panda"], 0.3), 2.0)


def recorded(log, lag=0.0, every=1, noise=0.0, seed=0, velocity=True, torque=True):
    """The log of an arm whose clock shows ``lag`` when the plan begins."""
    keep = slice(None, None, every)
    shake = noise * np.random.default_rng(seed).standard_normal(log.position[keep].shape)
    return JointLog(
        log.time[keep] + lag,
        log.position[keep] + shake,
        log.velocity[keep] if velocity else None,
        log.torque[keep] if torque else None,
        NAMES,
        "robot.csv",
    )


@pytest.fixture(scope="module")
def executed(plan):
    return simulation.execute(PANDA, plan)


@pytest.mark.parametrize("lag", [-3.2, 0.0, 0.0137, 0.25, 1.76e9])
@pytest.mark.parametrize("every", [1, 4, 8])
def test_the_lag_is_found_between_the_samples_on_any_clock(plan, executed, lag, every):
    found = verification.estimate_lag(plan, recorded(executed, lag, every))
    assert found == pytest.approx(lag, abs=2e-5, rel=1e-15)


def test_the_lag_is_found_under_encoder_noise(plan, executed):
    log = recorded(executed, 0.0423, every=4, noise=1e-4)
    assert verification.estimate_lag(plan, log) == pytest.approx(0.0423, abs=2e-4)


def test_a_joint_that_is_mounted_off_does_not_move_the_lag(plan, executed):
    log = recorded(executed, 0.031)
    off = replace(log, position=log.position + np.linspace(0.0, 0.02, 7))
    assert verification.estimate_lag(plan, off) == pytest.approx(0.031, abs=2e-5)


def test_of_the_cycles_of_a_repeated_motion_the_lag_that_covers_all_is_found():
    time = np.linspace(0.0, 6.0, 601)
    joints = trajectory(PANDA, time, np.array(HOME["panda"]) + 0.2 * np.sin(np.pi * time)[:, None])
    log = JointLog(time + 5.0, joints.position, None, None, NAMES)
    assert verification.estimate_lag(joints, log) == pytest.approx(5.0, abs=1e-5)


@pytest.mark.usefixtures("needs_bullet")
def test_a_sound_run_is_verified_with_the_measures_of_the_simulated_one(plan, executed):
    result = verification.verify(PANDA, plan, recorded(executed, 0.0137), simulator=Bullet)
    assert result.ok, [check for check in result.checks if not check.ok]
    assert result.lag == pytest.approx(0.0137, abs=1e-5)
    assert result.comparison.errors.position_max <= 5e-6  # what the lag's last microseconds leave
    simulated = {check.name: check.value for check in executed.verdict.checks}
    found = {check.name: check.value for check in result.checks}
    for name in ("torque_ratio", "joint_margin", "velocity_ratio"):
        assert found[name] == pytest.approx(simulated[name], rel=1e-2)
    assert {"log_coverage", "log_gap", "path_self_clearance", "path_floor_clearance"} <= set(found)
    assert result.log.mode == "recorded" and "by the robot" in result.log.caveat
    assert result.velocity_margin == pytest.approx(1.0 - found["velocity_ratio"], rel=1e-9)
    json.dumps(result.summary(), allow_nan=False)


def test_only_what_is_followed_is_judged(plan):
    executed = simulation.execute(PANDA, plan, follow="position")
    result = verification.verify(PANDA, plan, recorded(executed), follow="position")
    for checks in (executed.verdict.checks, result.checks):
        names = {check.name for check in checks}
        assert "tracking_position_max" in names and "tracking_angle_max" not in names
    for judge in (
        partial(simulation.execute, PANDA, plan),
        partial(verification.verify, PANDA, plan, recorded(executed)),
    ):
        with pytest.raises(InvalidArgument, match="follow: 'tip', expected position, axis"):
            judge(follow="tip")


def test_without_velocity_and_torque_the_first_is_derived_and_the_second_not_judged(plan, executed):
    whole = verification.verify(PANDA, plan, recorded(executed))
    bare = verification.verify(PANDA, plan, recorded(executed, velocity=False, torque=False))
    values = [{check.name: check.value for check in each.checks} for each in (whole, bare)]
    assert values[0]["velocity_ratio"] == pytest.approx(values[1]["velocity_ratio"], rel=1e-3)
    assert set(values[0]) - set(values[1]) == {"torque_ratio", "torque_clipped"}
    assert bare.torque_margin is None


def test_encoder_noise_is_no_acceleration(plan, executed):
    log = recorded(executed, noise=1e-5, velocity=False)
    result = verification.verify(PANDA, plan, log, tolerances=Tolerances(acceleration_ratio=1.0))
    assert {check.name: check.ok for check in result.checks}["acceleration_ratio"]
    raw = verification.verify(PANDA, plan, log, cutoff=400.0)
    assert not {check.name: check.ok for check in raw.checks}["acceleration_ratio"]


SOFT = {"kp": 100.0, "kd": 20.0}


def heavy(plan):
    return recorded(simulation.execute(PANDA, plan, disturbance=Disturbance(payload=3.0), **SOFT))


def cut(plan):
    log = recorded(simulation.execute(PANDA, plan))
    keep = log.time < 1.5
    return JointLog(log.time[keep], log.position[keep], log.velocity[keep], log.torque[keep], NAMES)


def silent(plan):
    log = recorded(simulation.execute(PANDA, plan))
    keep = (log.time < 0.5) | (log.time > 0.7)
    return JointLog(log.time[keep], log.position[keep], log.velocity[keep], log.torque[keep], NAMES)


def strained(plan):
    log = recorded(simulation.execute(PANDA, plan))
    torque = log.torque.copy()
    torque[400, 2] = 90.0
    return replace(log, torque=torque)


@pytest.mark.parametrize(
    "fault, names",
    [
        (heavy, {"tracking_position_rmse", "tracking_position_max", "settle_error"}),
        (cut, {"log_coverage"}),
        (silent, {"log_gap"}),
        (strained, {"torque_ratio", "torque_clipped"}),
    ],
)
def test_a_fault_in_the_log_is_caught(plan, fault, names):
    result = verification.verify(PANDA, plan, fault(plan))
    failed = {check.name for check in result.checks if not check.ok}
    assert names <= failed
    assert not result.ok


@pytest.mark.usefixtures("needs_bullet")
def test_an_arm_in_the_floor_is_seen_in_the_geometry():
    joints = reach(PANDA, [0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8], 3.0)
    log = JointLog(joints.time, joints.position, None, None, NAMES)
    result = verification.verify(PANDA, joints, log, simulator=Bullet)
    assert "path_floor_clearance" in {check.name for check in result.checks if not check.ok}


def test_joints_are_found_by_name_in_any_order_among_others(plan, executed):
    log = recorded(executed, 0.1)
    order = [3, 1, 6, 0, 2, 5, 4]
    finger = np.zeros((len(log.time), 1))
    mixed = JointLog(
        log.time,
        np.hstack([log.position[:, order], finger]),
        None,
        None,
        (*(NAMES[k] for k in order), "panda_finger_joint1"),
    )
    assert np.array_equal(mixed.of(NAMES).position, log.position)
    assert verification.verify(PANDA, plan, mixed).ok


# ---- files ------------------------------------------------------------------------------------------------------


def write_csv(path, log, scale=1.0, velocity="_vel", torque="_torque"):
    header = ["time", *NAMES, *(n + velocity for n in NAMES), *(n + torque for n in NAMES)]
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(np.column_stack([log.time * scale, log.position, log.velocity, log.torque]).tolist())
    return path


@pytest.mark.parametrize("torque", ["_torque", "_effort", "_eff"])
def test_a_csv_is_read_as_it_was_written(tmp_path, executed, torque):
    log = recorded(executed, 12.5, every=10)
    read = verification.read_log(write_csv(tmp_path / "robot.csv", log, 1e3, torque=torque), time_unit="ms")
    assert read.joint_names == NAMES
    assert np.allclose(read.time, log.time, atol=1e-12)
    for name in ("position", "velocity", "torque"):
        assert np.array_equal(getattr(read, name), getattr(log, name)), name


def test_the_plan_itself_is_a_log_without_torque(tmp_path, plan):
    export.write_joints(tmp_path / "joints.csv", plan)
    read = verification.read_log(tmp_path / "joints.csv")
    assert read.joint_names == NAMES
    assert read.torque is None
    assert np.array_equal(read.velocity, plan.velocity)


@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_a_table_is_read_whatever_separates_it(tmp_path, executed, delimiter):
    log = recorded(executed, every=50)
    path = write_csv(tmp_path / "robot.csv", log)
    path.write_text(path.read_text().replace(",", delimiter))
    assert np.array_equal(verification.read_log(path).position, log.position)


def test_degrees_and_milliseconds_are_read_as_such(tmp_path, plan, executed):
    log = recorded(executed)
    in_degrees = replace(log, position=np.degrees(log.position), velocity=np.degrees(log.velocity))
    path = write_csv(tmp_path / "robot.csv", in_degrees, scale=1e3)
    read = verification.read_log(path, time_unit="ms", angle_unit="deg")
    assert np.allclose(read.position, log.position, atol=1e-12) and np.allclose(read.velocity, log.velocity, atol=1e-12)
    assert np.array_equal(read.torque, log.torque)
    with pytest.raises(InvalidArgument, match=r"robot.csv: 'panda_joint\d' is at -?\d+.* rad, far beyond .*degrees"):
        verification.verify(PANDA, plan, verification.read_log(path, time_unit="ms"))
    with pytest.raises(InvalidArgument, match=r"of its samples lie within the plan's 2 s, .* 1 s apart.*time_unit"):
        verification.verify(PANDA, plan, verification.read_log(path, angle_unit="deg"))
    with pytest.raises(InvalidArgument, match="angle_unit: 'grad', expected one of rad, deg"):
        verification.read_log(path, angle_unit="grad")


def test_of_samples_with_one_time_the_last_is_kept_and_it_is_said(tmp_path, plan, executed):
    log = recorded(executed, every=4)
    twice = np.repeat(np.arange(len(log.time)), 2)
    doubled = replace(
        executed, **{n: getattr(executed, n)[::4][twice] for n in ("time", "position", "velocity", "torque")}
    )
    stale = doubled.position.copy()
    stale[::2] += 0.01
    rows = SimpleNamespace(time=doubled.time, position=stale, velocity=doubled.velocity, torque=doubled.torque)
    read = verification.read_log(write_csv(tmp_path / "robot.csv", rows))
    assert np.array_equal(read.position, log.position) and np.array_equal(read.torque, log.torque)
    result = verification.verify(PANDA, plan, read)
    assert result.ok
    assert result.notes == (f"{len(log.time)} samples with the time of another left out",)


def test_a_silence_before_the_motion_hides_nothing_and_changes_no_rate(plan, executed):
    log = recorded(executed, every=4)
    early = JointLog(
        np.append(log.time[0] - 3600.0, log.time), np.vstack([log.position[:1], log.position]), None, None, NAMES
    )
    result = verification.verify(PANDA, plan, early)
    assert result.ok, [check for check in result.checks if not check.ok]
    assert result.log.rate == pytest.approx(250.0, rel=1e-9)


def test_a_silence_after_the_motion_hides_nothing(plan, executed):
    log = recorded(executed, every=4)
    late = JointLog(
        np.append(log.time, log.time[-1] + 3600.0), np.vstack([log.position, log.position[-1:]]), None, None, NAMES
    )
    result = verification.verify(PANDA, plan, late)
    assert result.ok, [check for check in result.checks if not check.ok]


def test_a_silence_within_the_motion_fails(plan, executed):
    log = recorded(executed)
    middle = (log.time > 0.8) & (log.time < 1.1)
    holed = JointLog(log.time[~middle], log.position[~middle], None, None, NAMES)
    result = verification.verify(PANDA, plan, holed)
    assert [check.name for check in result.failed if "gap" in check.name] != []


def test_a_plan_may_begin_at_any_time(plan, executed):
    later = export.JointSamples(plan.time + 5.0, plan.position, plan.velocity, plan.acceleration, NAMES)
    moved, usual = (verification.verify(PANDA, each, recorded(executed, 0.25)) for each in (later, plan))
    assert moved.ok
    assert [check.ok for check in moved.checks] == [check.ok for check in usual.checks]
    assert moved["tracking_position_rmse"].value == pytest.approx(usual["tracking_position_rmse"].value, abs=1e-9)


def write_bag(path, log, topics=("/joint_states",), again=0, stamped=True, gripper=False):
    rosbags = pytest.importorskip("rosbags.rosbag2")
    from rosbags.typesys import Stores, get_typestore

    types = get_typestore(Stores.ROS2_HUMBLE)
    names = ("sensor_msgs/msg/JointState", "std_msgs/msg/Header", "builtin_interfaces/msg/Time")
    state, header, stamp = (types.types[name] for name in names)
    with rosbags.Writer(path, version=9) as writer:
        connections = [writer.add_connection(topic, state.__msgtype__, typestore=types) for topic in topics]
        for k in [*range(len(log.time)), *range(again)]:
            now = round(1e9 * log.time[k])
            told = now if stamped else 0
            head = header(stamp=stamp(sec=told // 10**9, nanosec=told % 10**9), frame_id="")
            order = np.arange(7) if k % 2 else np.arange(7)[::-1]  # a publisher may change it
            values = {
                "position": log.position[k, order],
                "velocity": log.velocity[k, order],
                "effort": log.torque[k, order],
            }
            message = state(header=head, name=[NAMES[i] for i in order], **values)
            finger = state(header=head, name=["finger"], position=np.zeros(1), velocity=np.zeros(0), effort=np.zeros(0))
            for connection in connections:
                for content in [finger, message] if gripper else [message]:
                    writer.write(connection, now, types.serialize_cdr(content, state.__msgtype__))
    return path


def test_a_gripper_on_the_same_topic_is_left_out(tmp_path, executed):
    log = recorded(executed, 10.0, every=50)
    bag = write_bag(tmp_path / "bag", log, gripper=True)
    read = verification.read_log(bag, joints=NAMES)
    assert np.array_equal(read.of(NAMES).position, log.position)
    assert read.notes[0] == f"{len(log.time)} messages of other joints left out"
    with pytest.raises(InvalidArgument, match="expected of"):
        verification.read_log(bag)


def test_messages_without_a_stamp_are_timed_by_the_bag(tmp_path, executed):
    log = recorded(executed, 10.0, every=50)
    read = verification.read_log(write_bag(tmp_path / "bag", log, stamped=False))
    assert np.allclose(read.time, log.time - log.time[0], atol=1e-6)
    assert "no message has a stamp" in read.notes[0]


def test_a_ros_2_bag_of_joint_states_is_read(tmp_path, plan, executed):
    log = recorded(executed, 1.76e9, every=4)
    read = verification.read_log(write_bag(tmp_path / "bag", log, again=3))
    assert set(read.joint_names) == set(NAMES)
    assert np.allclose(read.time, log.time - log.time[0], atol=1e-6)
    for name in ("position", "velocity", "torque"):
        assert np.array_equal(getattr(read.of(NAMES), name), getattr(log, name)), name
    assert "3 messages" in read.notes[1]
    result = verification.verify(PANDA, plan, read)
    assert result.ok, [check for check in result.checks if not check.ok]
    assert result.lag == pytest.approx(-executed.time[0], abs=1e-4)


def test_of_several_topics_one_is_chosen(tmp_path, executed):
    log = recorded(executed, 10.0, every=50)
    bag = write_bag(tmp_path / "bag", log, ("/left/joint_states", "/right/joint_states"))
    with pytest.raises(InvalidArgument, match="joint states are on /left/joint_states, /right/joint_states"):
        verification.read_log(bag)
    with pytest.raises(InvalidArgument, match="'/up' has no joint states"):
        verification.read_log(bag, topic="/up")
    assert len(verification.read_log(bag, topic="/right/joint_states").time) == len(log.time)


@pytest.mark.parametrize(
    "text, message",
    [
        ("", "log.csv: line 1: '', expected a header"),
        ("a,b\n1,2\n", "log.csv: line 1: 'a,b', expected a header: time,<joints>"),
        ("time\n1\n", "line 1, no column of a joint"),
        ("time,a\n0,1\n1\n", "line 3, 1 cells, expected 2"),
        ("time,a\n0,1\n1,x\n", "log.csv: line 3, a: 'x', expected a number"),
        ("time,a\n0,1\n1,nan\n", "line 3, a: nan, expected a finite number"),
        ("time,a\n0,1\n1,1\n2,1\n", r"3 sample\(s\), expected at least 4"),
        ("time,a\n0,1\n1,1\n0.5,1\n2,1\n", r"log.csv: time\[2\]: 0.5 s after 1 s, expected later"),
        ("time;a\n0;1,5\n", "log.csv: line 2, a: '1,5', expected a number"),
        ("time,a\n\0\n", "log.csv: line 2: binary content"),
        ("time,a,a\n0,1,1\n", "each name once"),
    ],
)
def test_a_damaged_csv_is_refused_with_its_line(tmp_path, text, message):
    path = tmp_path / "log.csv"
    path.write_text(text)
    with pytest.raises(InvalidArgument, match=message):
        verification.read_log(path)


def test_what_is_no_bag_and_what_is_not_there_are_refused(tmp_path):
    pytest.importorskip("rosbags")
    (tmp_path / "x.db3").write_bytes(b"nothing")
    with pytest.raises((InvalidArgument, FileError), match=r"x\.db3"):
        verification.read_log(tmp_path / "x.db3")
    with pytest.raises(FileError, match="no such file"):
        verification.read_log(tmp_path / "none.csv")


def test_what_does_not_fit_is_refused(plan, executed):
    log = recorded(executed)
    with pytest.raises(InvalidArgument, match="no joint 'lbr_iiwa_joint_1'; the log has panda_joint1"):
        log.of(arms.find("iiwa").joint_names)
    with pytest.raises(InvalidArgument, match=r"expected those of the arm"):
        verification.verify(arms.find("iiwa"), plan, log)
    with pytest.raises(InvalidArgument, match="expected at least half of the plan's 2 s"):
        short = log.time < log.time[0] + 0.5
        verification.verify(PANDA, plan, JointLog(log.time[short], log.position[short], None, None, NAMES))
    with pytest.raises(InvalidArgument, match="the plan does not move"):
        still = replace(plan, position=np.tile(plan.position[0], (len(plan.time), 1)))
        still = replace(still, velocity=0 * plan.velocity, acceleration=0 * plan.acceleration)
        verification.verify(PANDA, still, log)
    with pytest.raises(InvalidArgument, match="cutoff: 0"):
        verification.verify(PANDA, plan, log, cutoff=0.0)


# ---- the command line -------------------------------------------------------------------------------------------


@pytest.fixture
def files(tmp_path, plan, executed):
    export.write_joints(tmp_path / "joints.csv", plan)
    log = write_csv(tmp_path / "robot.csv", recorded(executed, 0.0137))
    return SimpleNamespace(folder=tmp_path, plan=tmp_path / "joints.csv", log=log)


def command(*words):
    return CliRunner().invoke(main, ["verify", *map(str, words)])


def test_the_command_verifies_and_states_the_lag(files):
    for plan in (files.plan, files.folder):
        result = command(plan, files.log)
        assert result.exit_code == 0, result.output
        assert "plan starts at 0.0137 s" in result.output
        assert "verified" in result.output and "recorded by the robot" in " ".join(result.output.split())


def test_arm_limits_and_what_is_followed_are_those_of_the_run_unless_stated(files):
    config = (
        '[demo]\narm = "panda"\nvelocity = "0.01"\ntool-speed = 1.5\nignore-contact = ["panda_link1,panda_link3"]\n'
    )
    (files.folder / "config.toml").write_text(config + 'follow = "position"\nseed = 4\nsimulator = "both"\n')
    quiet = ("--simulator", "none", "--json")
    summary = json.loads(command(files.folder, files.log, *quiet).stdout)
    assert summary["limits"]["velocity"] == {"values": [0.01] * 7, "sources": ["user"] * 7}
    assert summary["limits"]["tool_speed"] == 1.5 and summary["verdict"] == "fail"
    assert not any(check["name"].startswith("tracking_angle") for check in summary["checks"])
    shown = command(files.plan, files.log, "--simulator", "none")
    said = (
        "as in the run: --velocity 0.01, --tool-speed 1.5, --ignore-contact panda_link1,panda_link3, --follow position"
    )
    assert said in shown.output
    for stated in (("--velocity", "3"), ("--arm", "panda", "--velocity", "3")):
        summary = json.loads(command(files.folder, files.log, *quiet, *stated).stdout)
        assert summary["limits"]["velocity"]["values"] == [3.0] * 7 and summary["limits"]["tool_speed"] == 1.5
    (files.folder / "config.toml").write_text(config.replace("panda", "iiwa"))
    assert json.loads(command(files.folder, files.log, *quiet, "--arm", "panda").stdout)["limits"]["tool_speed"] is None
    assert command(files.folder, files.log).exit_code == 2  # the arm of the run has other joints


def test_a_folder_with_a_config_that_is_none_is_refused_by_name(files):
    (files.folder / "config.toml").write_text("[demo\n")
    result = command(files.folder, files.log)
    assert result.exit_code == 2 and "config.toml: not TOML" in result.output


def test_the_joint_concerned_is_named_in_full_however_narrow_the_terminal():
    from dmpcpp.cli._tables import print_checks
    from dmpcpp.simulation import Check
    from rich.console import Console

    console = Console(width=60, record=True, file=io.StringIO())
    print_checks(console, [Check("acceleration_ratio", False, 1.5, 1.0, "1", 0.25, "panda_joint4")])
    cells = [line.split("│")[-2] for line in console.export_text().splitlines() if line.count("│") > 2]
    assert "".join(cell.strip() for cell in cells).endswith("panda_joint4")


def test_its_json_is_the_summary(files):
    result = command(files.plan, files.log, "--json", "--simulator", "none")
    summary = json.loads(result.stdout)
    assert summary["verdict"] == "pass"
    assert summary["lag"] == pytest.approx(0.0137, abs=1e-5)
    assert {"errors", "dtw", "frechet", "sparc"} <= set(summary["comparison"])


def test_a_limit_that_is_not_kept_is_exit_status_3(files):
    result = command(files.plan, files.log, "--simulator", "none", "--check-limit", "velocity_ratio=0.01")
    assert result.exit_code == 3
    assert "not verified" in result.output and "velocity_ratio" in result.output


def test_the_old_name_of_check_limit_works_with_a_word(files):
    result = command(files.plan, files.log, "--simulator", "none", "--tolerance", "velocity_ratio=0.01")
    assert result.exit_code == 3 and "--tolerance is --check-limit now" in result.output


@pytest.mark.parametrize(
    "words, message",
    [
        (("--check-limit", "speed=1"), "expected NAME=VALUE with a NAME of position_rmse"),
        (("--check-limit", "position_max=x"), "expected a number after '='"),
        (("--time-unit", "h"), "--time-unit: 'h', expected one of s, ms, us, ns"),
        (("--arm", "iiwa"), "expected those of the arm"),
        (("--low-pass", "-1"), "--low-pass: -1.0"),
    ],
)
def test_wrong_usage_is_one_line_and_exit_status_2(files, words, message):
    result = command(files.plan, files.log, *words)
    assert result.exit_code == 2
    assert message in result.output
    assert "Traceback" not in result.output


# ---- logs of other programs ------------------------------------------------------------------------------


def test_a_log_of_libfranka_is_read_by_its_columns(tmp_path):
    names = [f"fr3_joint{k + 1}" for k in range(7)]
    time = np.arange(50)  # ms
    q, dq, tau = (np.outer(time, np.arange(1.0, 8.0)) * size for size in (1e-3, 1.0, 0.1))
    header = ["time", "success_rate"] + [f"state.{what}[{k}]" for what in ("q", "q_d", "dq", "tau_J") for k in range(7)]
    rows = np.column_stack([time, np.ones(50), q, q + 1.0, dq, tau])
    lines = [",".join(header), *(",".join(map(repr, row)) for row in rows.tolist())]
    (tmp_path / "log.csv").write_text("\n".join(lines))
    log = verification.read_log(tmp_path / "log.csv", joints=names)
    np.testing.assert_allclose(log.time, 1e-3 * time)
    for read, written in ((log.position, q), (log.velocity, dq), (log.torque, tau)):
        np.testing.assert_array_equal(read, written)
    assert log.joint_names == tuple(names) and "times in ms" in log.notes[0]
    with pytest.raises(InvalidArgument, match="7 joints without names"):
        verification.read_log(tmp_path / "log.csv", joints=names[:6])


def test_planned_joints_are_said_to_be_no_recording(tmp_path):
    sent = sending.from_rest_to_rest(PANDA, swing(PANDA, 1.0))
    export.write_joints(tmp_path / "joints.csv", sent)
    log = verification.read_log(tmp_path / "joints.csv")
    assert log.joint_names == NAMES
    assert any("planned joints, nothing that was recorded" in note for note in log.notes)
    plan = export.read_joints(tmp_path / "joints.csv")
    verified = verification.verify(PANDA, plan, log)
    assert verified.lag == pytest.approx(0.0, abs=1e-6)  # of the motion's first sample, behind the lead-in
    inside = verified.log.time[verified.log.motion]
    assert inside[0] >= -1e-9 and inside[-1] <= plan.of_motion().time[-1] + 1e-9
    assert verified["settle_error"].value < 1e-6  # at the end of the lead-out, where the arm stands
