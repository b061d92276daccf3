"""Limits and a payload from the user: by number, list, name, file and option."""

import importlib.util
import json

import numpy as np
import pytest
from dmpcpp import Arm, LimitSource, arms
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.robot import limits_summary, random_postures

from tests.python.command import run
from tests.python.small_arms import LIMIT, arm, six_axis, write

BARE = '<limit lower="-2.8" upper="2.8" velocity="0" effort="0"/>'


@pytest.mark.parametrize("kind", ["velocity", "acceleration", "jerk", "effort"])
def test_a_number_a_list_and_names_are_taken_and_their_source_is_the_user(kind):
    bare = arm(limit=BARE)
    for stated, expected in ((2.5, [2.5] * 6), ([1, 2, 3, 4, 5, 6], [1, 2, 3, 4, 5, 6])):
        changed = arms.with_stated(bare, **{kind: stated})
        assert getattr(changed, f"{kind}_limit").tolist() == expected
        assert set(changed.limit_sources[kind]) == {LimitSource.user}
    some = arms.with_stated(bare, **{kind: {"j2": 7.0, "j5": 8.0}})
    assert [getattr(some, f"{kind}_limit")[k] for k in (1, 4)] == [7.0, 8.0]
    assert [source == LimitSource.user for source in some.limit_sources[kind]] == [k in (1, 4) for k in range(6)]
    assert getattr(some, f"{kind}_limit")[0] == getattr(bare, f"{kind}_limit")[0]


@pytest.mark.parametrize(
    ("stated", "words"),
    [
        ({"velocity": [1.0, 2.0]}, "velocity: 2 values, expected one for all joints or 6"),
        ({"velocity": -1.0}, "velocity: -1.0 of joint 'j1', expected a positive rad/s"),
        ({"effort": {"j9": 1.0}}, "effort: no joint 'j9', expected some of j1, j2"),
        ({"jerk": float("inf")}, "jerk: inf of joint 'j1'"),
        ({"tool_speed": 0.0}, "tool_speed: 0.0, expected a positive number of m/s"),
        ({"payload": [-1.0]}, "payload: -1.0"),
        ({"position": 1.0}, "limits: 'position', expected some of velocity"),
    ],
)
def test_what_is_no_limit_is_refused_by_name(stated, words):
    with pytest.raises(InvalidArgument, match=words):
        arms.with_stated(arm(), **stated)


# ---- payload ----------------------------------------------------------------------------------------------------


def test_a_payload_changes_the_gravity_torques_by_the_closed_form():
    robot, mass, at = arm(), 1.7, np.array([0.03, -0.02, 0.11])
    loaded = arms.with_payload(robot, mass, at)
    for q in random_postures(robot, 20):
        jacobian, pose = robot.jacobian(q), robot.forward_kinematics(q)
        arm_of_force = pose[:3, :3] @ at
        # of the payload's centre: the tip's velocity plus what its turning adds
        lifted = jacobian[2] + jacobian[3] * arm_of_force[1] - jacobian[4] * arm_of_force[0]
        change = loaded.gravity_effort(q) - robot.gravity_effort(q)
        assert np.abs(change - mass * 9.81 * lifted).max() <= 1e-9
        assert (loaded.forward_kinematics(q) == pose).all()


def test_a_payload_keeps_limits_and_sources_and_is_replaced_by_another():
    robot = arms.with_stated(arm(), velocity=1.5, tool_speed=0.7)
    loaded = arms.with_payload(arms.with_payload(robot, 3.0), 2.0, (0.0, 0.0, 0.05))
    assert loaded.velocity_limit.tolist() == [1.5] * 6 and loaded.tool_speed_limit == 0.7
    assert loaded.limit_sources == robot.limit_sources
    assert limits_summary(loaded)["payload"] == 2.0
    q = np.array([0.0, np.pi / 2, 0.0, 0.0, 0.0, 0.0])
    change = loaded.gravity_effort(q) - robot.gravity_effort(q)
    assert change[1] == pytest.approx(-2.0 * 9.81 * (0.3 + 0.15 + 0.2 + 0.12 + 0.05), abs=1e-9)
    assert arms.with_payload(loaded, 0.0).gravity_effort(q) == pytest.approx(robot.gravity_effort(q))


def test_the_engines_carry_the_payload():
    pytest.importorskip("pybullet")
    from dmpcpp import simulation
    from dmpcpp.simulation._dynamics_check import dynamics_mismatch

    loaded = arms.with_payload(arm(), 2.0, (0.0, 0.0, 0.05))
    for engine in simulation.ENGINES.values():
        with engine(loaded, 1e-3) as world:
            assert dynamics_mismatch(world, loaded).value <= 1e-9


# ---- files ------------------------------------------------------------------------------------------------------

MOVEIT = """
default_velocity_scaling_factor: 0.1
joint_limits:
  j1:
    has_velocity_limits: true
    max_velocity: 1.25
    has_acceleration_limits: true
    max_acceleration: 4
  j2:
    has_velocity_limits: false
    max_velocity: 9
    has_position_limits: true
    min_position: -1.0
    max_position: 99
    has_jerk_limits: true
    max_jerk: 500
  elsewhere:
    max_velocity: 1
cartesian_limits:
  max_trans_vel: 0.8
"""


def test_moveits_joint_limits_are_read_as_they_are(tmp_path):
    pytest.importorskip("yaml")
    (tmp_path / "joint_limits.yaml").write_text(MOVEIT)
    limited = arms.with_stated(arm(), file=tmp_path / "joint_limits.yaml")
    assert limited.velocity_limit.tolist() == [1.25, 2.0, 2.0, 2.0, 2.0, 2.0]
    assert limited.acceleration_limit[:2].tolist() == [4.0, 10.0] and limited.jerk_limit[1] == 500.0
    assert (limited.lower[1], limited.upper[1]) == (-1.0, 2.8)  # a file does not widen a range
    assert limited.limit_sources["velocity"][:2] == (LimitSource.user, LimitSource.urdf)
    assert limited.limit_sources["acceleration"][1] == LimitSource.assumed
    assert limited.tool_speed_limit == 0.8
    assert arms.with_stated(arm(), file=tmp_path / "joint_limits.yaml", velocity=1.0).velocity_limit[0] == 1.0


def test_the_same_tables_as_toml_and_json(tmp_path):
    (tmp_path / "limits.toml").write_text("[joint_limits.j3]\nmax_effort = 12\n")
    (tmp_path / "limits.json").write_text(json.dumps({"joint_limits": {"j3": {"max_effort": 12}}}))
    for name in ("limits.toml", "limits.json"):
        assert arms.with_stated(arm(), file=tmp_path / name).effort_limit[2] == 12.0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[joint_limits.other]\nmax_velocity = 1\n", "states limits of none of the joints j1, j2"),
        ("joint_limits = 3\n", "states limits of none"),
        ("[joint_limits.j1]\nmax_velocity = 'fast'\n", "max_velocity of 'j1' is 'fast', expected a number"),
        ("[joint_limits\n", "cannot be read"),
        ("joint_limits = {j1 = 2}\n", "joint 'j1' is 2, expected a table"),
    ],
)
def test_a_file_without_limits_is_refused(text, words, tmp_path):
    (tmp_path / "limits.toml").write_text(text)
    with pytest.raises(InvalidArgument, match=words):
        arms.with_stated(arm(), file=tmp_path / "limits.toml")


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(FileError, match=r"none\.yaml: cannot be read"):
        arms.with_stated(arm(), file=tmp_path / "none.yaml")


# ---- URDF 1.1 and 1.2 -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("version", ["1.1", "1.2"])
def test_acceleration_and_jerk_of_a_newer_urdf_are_read(version):
    limit = LIMIT.replace("/>", ' acceleration="3" deceleration="2.5" jerk="50"/>')
    text = six_axis(limits={"j2": limit}, robot=f"<?xml version='1.0'?>\n<robot name='six' version='{version}'>")
    robot = Arm.from_urdf(text, base="base", tip="l6")
    assert robot.acceleration_limit.tolist() == [10.0, 2.5, 10.0, 10.0, 10.0, 10.0]
    assert robot.jerk_limit[1] == 50.0 and np.isinf(robot.jerk_limit[0])
    sources = robot.limit_sources
    assert sources["acceleration"][:2] == (LimitSource.assumed, LimitSource.urdf)
    assert sources["jerk"][:2] == (LimitSource.unstated, LimitSource.urdf)
    assert robot.urdf == text


@pytest.mark.parametrize("value", ["0", "-1", "much", "inf"])
def test_an_acceleration_that_is_none_is_assumed(value):
    limit = LIMIT.replace("/>", f' acceleration="{value}"/>')
    assert arm(limit=limit, robot='<robot name="six" version="1.2">').acceleration_limit.tolist() == [10.0] * 6


def test_a_version_that_nobody_knows_is_still_refused():
    with pytest.raises(InvalidArgument, match="version"):
        arm(robot='<robot name="six" version="2.0">')


# ---- options ----------------------------------------------------------------------------------------------------


def test_a_run_is_judged_by_the_limits_of_its_options(tmp_path):
    pytest.importorskip("pybullet")
    write(tmp_path, limit=BARE)
    done = run(
        *(
            "demo",
            "--arm",
            "six.urdf",
            "--velocity",
            "2",
            "--effort",
            "80,80,80,80,80,80",
            "--acceleration",
            "j1=5,j2=5",
        ),
        *("--payload", "0.5,0,0,0.05", "--no-report", "--out", "out", "--json"),
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads(done.stdout)
    ratios = {check["name"]: check["value"] for check in summary["checks"] if check["name"].endswith("_ratio")}
    assert summary["verdict"] == "pass" and all(0.0 < value <= 1.0 + 1e-6 for value in ratios.values())
    assert summary["limits"]["velocity"] == {"values": [2.0] * 6, "sources": ["user"] * 6}
    assert summary["limits"]["payload"] == 0.5
    assert summary["assumed"] == ["acceleration limit 10 rad/s^2 of j3, j4, j5, j6"]
    assert 'velocity = "2"' in (tmp_path / "out" / "config.toml").read_text()


def test_a_run_is_judged_by_the_limits_of_a_file_and_options_beside_it_win(tmp_path):
    pytest.importorskip("pybullet")
    write(tmp_path, limit=BARE)
    joint = "{max_velocity: 1.5, max_acceleration: 6, max_effort: 70, max_jerk: 900}"
    lines = [f"  j{k}: {joint}" for k in range(1, 7)]
    name, text = (
        "joint_limits.yaml",
        "joint_limits:\n" + "\n".join(lines) + "\ncartesian_limits: {max_trans_vel: 0.4}\n",
    )
    if importlib.util.find_spec("yaml") is None:
        rows = "".join(f"j{k} = {{{joint[1:-1].replace(':', ' =')}}}\n" for k in range(1, 7))
        name, text = "limits.toml", f"[cartesian_limits]\nmax_trans_vel = 0.4\n[joint_limits]\n{rows}"
    (tmp_path / name).write_text(text)
    stated = ("--limits", name, "--velocity", "j1=1.25", "--no-report", "--out", "out", "--json")
    done = run("demo", "--arm", "six.urdf", *stated, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads(done.stdout)
    assert summary["verdict"] == "pass" and summary["assumed"] == [] and summary["not_judged"] == []
    assert summary["limits"]["velocity"] == {"values": [1.25] + [1.5] * 5, "sources": ["user"] * 6}
    for kind, value in (("acceleration", 6.0), ("effort", 70.0), ("jerk", 900.0)):
        assert summary["limits"][kind] == {"values": [value] * 6, "sources": ["user"] * 6}
    found = {check["name"]: check for check in summary["checks"]}
    assert 0.0 < found["tool_speed"]["value"] <= found["tool_speed"]["limit"] == 0.4
    assert 0.0 < found["jerk_ratio"]["value"] <= 1.0
    done = run("verify", "out", "out/joints.csv", "--json", cwd=tmp_path)  # the plan as its own log
    assert json.loads(done.stdout)["limits"]["jerk"]["values"] == [900.0] * 6, done.stderr


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--velocity", "fast"), "--velocity: 'fast', expected a number such as 2"),
        (("--effort", "1,2"), "--effort: 2 values, expected one for all joints or 6"),
        (("--acceleration", "j9=2"), "--acceleration: no joint 'j9'"),
        (("--payload", "1,2"), "--payload: '1,2', expected kg"),
        (("--limits", "none.yaml"), "none.yaml"),
    ],
)
def test_an_option_that_cannot_be_used_is_named(options, words, tmp_path):
    write(tmp_path)
    done = run("demo", "--arm", "six.urdf", *options, cwd=tmp_path)
    assert done.returncode == 2 and words in done.stderr
