"""Robots that are not the three known arms: joints that slide, turn without end, follow, or are not the arm's."""

import numpy as np
import pytest

pytest.importorskip("pybullet", reason="the extra `sim`")
pytest.importorskip("mujoco", reason="the extra `mujoco`")

from dmpcpp import Arm, simulation
from dmpcpp.errors import InvalidArgument
from dmpcpp.simulation import Bullet, MuJoCo

from benchmarks.joint_motions import reach

LIMIT = '<limit lower="-1" upper="1" effort="200" velocity="2"/>'
SHORT = '<limit lower="-0.2" upper="0.4" effort="300" velocity="1"/>'
ENDLESS = '<limit effort="100" velocity="3"/>'


def link(name, mass=1.0):
    return f"""<link name="{name}"><inertial><origin xyz="0 0 0.1"/><mass value="{mass}"/>
      <inertia ixx="0.01" iyy="0.02" izz="0.015" ixy="0" ixz="0" iyz="0"/></inertial></link>"""


def joint(name, kind, parent, child, axis="0 1 0", limit=LIMIT, more=""):
    return f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
      <origin xyz="0.02 0 0.2"/><axis xyz="{axis}"/>{limit}{more}</joint>"""


def robot(*parts):
    return f'<robot name="odd">{"".join(parts)}</robot>'


SHOULDER = link("base"), link("a"), joint("j1", "revolute", "base", "a")
ARMS = {
    "slides and turns without end": (
        robot(
            *SHOULDER,
            link("b"),
            link("c"),
            joint("j2", "continuous", "a", "b", "0 0 1", ENDLESS),
            joint("slide", "prismatic", "b", "c", "1 0 0", SHORT),
        ),
        "base",
        "c",
    ),
    "axes longer than 1": (
        robot(
            link("base"),
            link("a"),
            link("b"),
            joint("j1", "revolute", "base", "a", "0 2 0"),
            joint("slide", "prismatic", "a", "b", "0 0 3", SHORT),
        ),
        "base",
        "b",
    ),
    "other joints before and between its own": (
        robot(
            link("base"),
            link("head"),
            link("a"),
            link("hose"),
            link("b"),
            joint("pan", "revolute", "base", "head", "0 0 1"),
            joint("j1", "revolute", "base", "a"),
            joint("bend", "revolute", "a", "hose", "1 0 0"),
            joint("j2", "revolute", "a", "b"),
        ),
        "base",
        "b",
    ),
    "its base on a lift": (
        robot(link("root"), *SHOULDER, joint("lift", "prismatic", "root", "base", "0 0 1", SHORT)),
        "base",
        "a",
    ),
    "its base mounted upside down": (
        robot(
            link("root"),
            *SHOULDER,
            '<joint name="mount" type="fixed"><parent link="root"/><child link="base"/>'
            '<origin xyz="0.1 0 2" rpy="3.14159265 0 0.4"/></joint>',
        ),
        "base",
        "a",
    ),
    "a finger that follows another": (
        robot(
            *SHOULDER,
            link("f", 0.1),
            link("g", 0.1),
            joint("left", "prismatic", "a", "f", "0 1 0", SHORT),
            joint("right", "prismatic", "a", "g", "0 -1 0", SHORT, '<mimic joint="left"/>'),
        ),
        "base",
        "a",
    ),
    "a hand on a planar joint": (
        robot(*SHOULDER, link("b", 0.2), joint("plane", "planar", "a", "b", "0 0 1", "")),
        "base",
        "a",
    ),
    "a hand on a floating joint": (
        robot(*SHOULDER, link("b", 0.2), joint("free", "floating", "a", "b", "0 0 1", "")),
        "base",
        "a",
    ),
}


@pytest.mark.parametrize("name", ARMS)
def test_both_engines_drive_it_alike_and_where_its_kinematics_say(name, capfd):
    urdf, base, tip = ARMS[name]
    arm = Arm.from_urdf(urdf, base=base, tip=tip)
    joints = reach(arm, np.full(arm.joint_count, 0.3))
    logs = [simulation.execute(arm, joints, simulator=engine, settle=0.1) for engine in (Bullet, MuJoCo)]
    for log in logs:
        assert log.verdict.failed == ()
    others = "lift" in name  # a motor holds the lift in Bullet, in MuJoCo it is fixed
    assert logs[0].errors.position_max < (1e-5 if others else 1e-6)
    assert all(check.ok for check in simulation.agreement(*logs)), simulation.agreement(*logs)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("engine", [Bullet, MuJoCo])
def test_a_mass_below_zero_is_refused_with_its_link(engine):
    arm = Arm.from_urdf(robot(link("base"), link("a", -1.0), joint("j1", "revolute", "base", "a")))
    with pytest.raises(InvalidArgument, match=r"link 'a': <mass>: -1.0 kg, expected 0 or more"):
        engine(arm, 1e-3)


@pytest.mark.parametrize("engine", [Bullet, MuJoCo])
def test_a_joint_of_the_arm_that_follows_another_is_refused_with_its_name(engine):
    follower = joint("j2", "revolute", "a", "b", more='<mimic joint="j1"/>')
    arm = Arm.from_urdf(robot(*SHOULDER, link("b"), follower), base="base", tip="b")
    with pytest.raises(InvalidArgument, match="joint 'j2' between 'base' and 'b' mimics another"):
        engine(arm, 1e-3)


@pytest.mark.parametrize("engine", [Bullet, MuJoCo])
def test_an_arm_without_a_mass_beyond_its_last_joint_is_refused(engine):
    frames = '<link name="b"/><link name="c"/>', joint("j2", "revolute", "a", "b"), joint("flange", "fixed", "b", "c")
    arm = Arm.from_urdf(robot(*SHOULDER, *frames), base="base", tip="c")
    with pytest.raises(InvalidArgument, match=r"no link beyond joint 'j2' has a mass.* Give b, c an <inertial>"):
        engine(arm, 1e-3)
