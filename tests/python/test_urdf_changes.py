"""Changes to a URDF that every engine sees alike."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from dmpcpp import Arm
from dmpcpp.robot._urdf_changes import add_payload, freeze, scale_masses

ROBOT = """<robot name="r"><link name="base"/>
  <link name="a"><inertial><mass value="2"/>
    <inertia ixx="0.1" ixy="0.01" ixz="0" iyy="0.2" iyz="0" izz="0.2"/></inertial></link>
  <link name="b"/><link name="c"/><link name="d"/>
  <joint name="j1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  <joint name="j2" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0.1 0.2 0.3" rpy="0.3 -0.2 0.5"/>
    <axis xyz="0.6 0.8 0"/><limit lower="0.2" upper="{upper}" velocity="1" effort="1"/></joint>
  <joint name="j3" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0 0.1 0" rpy="1 0.1 0.2"/>
    <axis xyz="0 0.6 0.8"/><limit lower="0" upper="0.08" velocity="1" effort="1"/></joint>
  <joint name="j4" type="fixed"><parent link="c"/><child link="d"/><origin xyz="0 0 0.1"/></joint></robot>"""


@pytest.mark.parametrize("upper", [1.0, 1.7, 0.2 + np.pi])
def test_frozen_joints_stand_in_the_middle_of_their_range(upper):
    text = ROBOT.format(upper=upper)
    robot = ET.fromstring(text)
    freeze(robot, ["j1"])
    frozen, whole = Arm.from_urdf(ET.tostring(robot, encoding="unicode")), Arm.from_urdf(text)
    assert frozen.joint_names == ["j1"]
    middle = [0.5 * (0.2 + upper), 0.04]
    expected = whole.forward_kinematics(np.array([0.7, *middle]))
    assert np.allclose(frozen.forward_kinematics(np.array([0.7])), expected, atol=1e-12)


def test_in_gimbal_lock_it_is_the_same_rotation_without_a_warning():
    text = ROBOT.format(upper=1.0).replace('rpy="0.3 -0.2 0.5"', 'rpy="0 0 0"').replace('"0.6 0.8 0"', '"0 1 0"')
    text = text.replace('lower="0.2" upper="1.0"', f'lower="0" upper="{np.pi}"')
    robot = ET.fromstring(text)
    freeze(robot, ["j1"])
    frozen, whole = Arm.from_urdf(ET.tostring(robot, encoding="unicode")), Arm.from_urdf(text)
    expected = whole.forward_kinematics(np.array([0.1, np.pi / 2, 0.04]))
    assert np.allclose(frozen.forward_kinematics(np.array([0.1])), expected, atol=1e-7)


def test_mass_and_inertia_are_scaled_together():
    robot = ET.fromstring(ROBOT.format(upper=1.0))
    scale_masses(robot, {"a": 1.5})
    assert float(robot.find("link[@name='a']/inertial/mass").get("value")) == 3.0
    inertia = robot.find("link[@name='a']/inertial/inertia")
    assert [float(inertia.get(name)) for name in ("ixx", "ixy", "iyy")] == pytest.approx([0.15, 0.015, 0.3])


def test_a_payload_is_a_link_at_the_tip_that_touches_nothing():
    robot = ET.fromstring(ROBOT.format(upper=1.0))
    add_payload(robot, "d", 0.5, (0.0, 0.0, 0.1))
    payload = robot.findall("link")[-1]
    assert float(payload.find("inertial/mass").get("value")) == 0.5
    assert payload.find("collision") is None
    joint = robot.findall("joint")[-1]
    assert (joint.find("parent").get("link"), joint.find("origin").get("xyz")) == ("d", "0.0 0.0 0.1")
