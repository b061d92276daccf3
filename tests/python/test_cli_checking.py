"""`dmpcpp check-urdf` and `dmpcpp doctor`: every defect named, and what to install."""

import json
import subprocess
import sys

import pytest
from dmpcpp import doctor, urdf_check

from tests.python.command import run

GOOD = """<robot name="two">
  <link name="base"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="upper"><inertial><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <link name="tool"><inertial><mass value="0.5"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" velocity="2" effort="20"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="tool"/><axis xyz="0 1 0"/>
    <origin xyz="0 0 0.3"/><limit lower="-1" upper="1" velocity="2" effort="20"/></joint>
</robot>"""

DEFECTS = {
    "not closed": ("</robot>", "", "not XML"),
    "no speed": (
        'velocity="2" effort="20"/></joint>\n  <joint',
        'effort="20"/></joint>\n  <joint',
        "velocity",
    ),
    "no torque": ('effort="20"/></joint>\n</robot>', 'effort="0"/></joint>\n</robot>', "effort"),
    "lower above upper": (
        'lower="-1" upper="1" velocity="2" effort="20"/></joint>\n</robot>',
        'lower="1" upper="-1" velocity="2" effort="20"/></joint>\n</robot>',
        "lower < upper",
    ),
    "an axis of nothing": ('xyz="0 0 1"', 'xyz="0 0 0"', "axis"),
    "an axis too long": ('xyz="0 0 1"', 'xyz="0 0 2"', "length 2"),
    "a type unheard of": ('name="elbow" type="revolute"', 'name="elbow" type="hinge"', "hinge"),
    "a parent that is not there": ('<parent link="upper"/>', '<parent link="uper"/>', "uper"),
    "a name twice": ('<link name="tool">', '<link name="upper">', "of this name"),
    "an inertia of no body": (
        'ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>\n  <joint',
        'ixx="0.1" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>\n  <joint',
        "inertia",
    ),
    "a negative mass": ('<mass value="1"/>', '<mass value="-1"/>', "mass"),
    "a mesh that is not there": ('<box size="0.1 0.1 0.1"/>', '<mesh filename="package://two/base.stl"/>', "base.stl"),
    "no shape to collide with": (
        '<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>',
        "",
        "collision",
    ),
}


def test_a_sound_urdf_has_no_defect(tmp_path):
    (tmp_path / "two.urdf").write_text(GOOD)
    done = run("check-urdf", "two.urdf", cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert "no defect" in done.stdout and "2 joints" in done.stdout


@pytest.mark.parametrize("name", DEFECTS)
def test_each_defect_is_named(name, tmp_path):
    before, after, word = DEFECTS[name]
    assert before in GOOD
    (tmp_path / "two.urdf").write_text(GOOD.replace(before, after, 1))
    report = urdf_check.check(tmp_path / "two.urdf")
    assert any(word in f"{d.where} {d.what} {d.to_do}" for d in report.defects), report.defects


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ('xyz="0 0 1"', 'xyz="0 0 1e-9"'),
        ("</joint>\n</robot>", '<mimic joint="nobody"/></joint>\n</robot>'),
    ],
)
def test_what_keeps_an_arm_from_loading_is_an_error_though_a_warning_names_the_joint_too(before, after, tmp_path):
    (tmp_path / "two.urdf").write_text(GOOD.replace(before, after, 1))
    report = urdf_check.check(tmp_path / "two.urdf")
    assert report.arm is None
    assert [defect.where for defect in report.defects if defect.fatal] == ["loading"]


def test_all_defects_are_named_at_once(tmp_path):
    broken = GOOD.replace('effort="20"', 'effort="0"').replace('xyz="0 0 1"', 'xyz="0 0 2"').replace("0.1 0.1 0.1", "x")
    broken = broken.replace('<mass value="1"/>', "")
    (tmp_path / "two.urdf").write_text(broken)
    done = run("check-urdf", "two.urdf", "--json", cwd=tmp_path)
    assert done.returncode == 3
    wheres = [defect["where"] for defect in json.loads(done.stdout)["defects"]]
    assert {"joint 'shoulder'", "joint 'elbow'", "link 'upper'"} <= set(wheres)
    assert wheres.count("joint 'shoulder'") == 2


def test_doctor_names_what_is_there_and_what_is_missing(tmp_path, monkeypatch):
    done = run("doctor", "--json", cwd=tmp_path)
    parts = {part["name"]: part for part in json.loads(done.stdout)["parts"]}
    assert parts["core"]["ok"] and parts["numpy"]["ok"]
    assert (done.returncode == 0) == all(part["ok"] for part in parts.values() if part["needed"])
    monkeypatch.setattr(doctor, "_PACKAGES", (("no_such_package", "no-such", "nothing", "sim", True),))
    found = doctor.examine()
    missing = next(part for part in found.parts if part.name == "no-such")
    assert not found.ok and not missing.ok and "dmpcpp[sim]" in missing.to_do


def test_a_reader_that_has_enough_ends_the_output_without_a_word(tmp_path):
    command = f"{sys.executable} -c 'from dmpcpp.cli import main; main()' arms | head -n 1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, cwd=tmp_path)
    assert len(done.stdout.splitlines()) == 1
    assert done.stderr == ""
