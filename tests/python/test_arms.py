"""Arms by name."""

import importlib.util
import math

import numpy as np
import pytest
from dmpcpp import arms
from dmpcpp.errors import InvalidArgument, MissingDependency

pytest.importorskip("pybullet_data", reason="the URDFs of the known arms come with pybullet")


@pytest.mark.parametrize(
    "name, joints, tip", [("panda", 7, "panda_hand"), ("iiwa", 7, "lbr_iiwa_link_7"), ("xarm6", 6, "link6")]
)
def test_a_known_arm_is_found_by_name(name, joints, tip):
    arm = arms.find(name)
    assert arm.joint_count == joints
    assert arm.tip == tip
    assert np.isfinite([arm.lower, arm.upper, arm.velocity_limit, arm.effort_limit]).all()


def test_the_iiwa_has_the_limits_of_the_real_machine_not_the_placeholders_of_its_urdf():
    arm = arms.find("iiwa")
    assert np.allclose(np.degrees(arm.velocity_limit), [85, 85, 100, 75, 130, 135, 135])
    assert np.allclose(arm.effort_limit, [320, 320, 176, 176, 110, 40, 40])


def test_the_iiwas_links_are_those_of_the_r820_that_its_limits_are_taken_from():
    arm = arms.find("iiwa")
    # Stretched out the flange stands 0.36 + 0.42 + 0.40 m above the base, and 0.081 m of the hand.
    assert arm.forward_kinematics(np.zeros(7))[2, 3] == pytest.approx(0.36 + 0.42 + 0.40 + 0.081, abs=1e-9)


def test_limits_live_in_the_arm_and_say_where_they_come_from():
    panda, iiwa = arms.find("panda"), arms.find("iiwa")
    assert np.array_equal(panda.acceleration_limit, [15, 7.5, 10, 12.5, 15, 20, 20])
    assert np.array_equal(panda.jerk_limit, [7500, 3750, 5000, 6250, 7500, 10000, 10000])
    assert np.array_equal(iiwa.acceleration_limit, np.full(7, arms.DEFAULT_ACCELERATION))
    assert np.array_equal(iiwa.jerk_limit, np.full(7, np.inf))
    sources = {name: {source.name for source in each} for name, each in panda.limit_sources.items()}
    assert sources == {
        "position": {"urdf"},
        "velocity": {"urdf"},
        "acceleration": {"maker"},
        "jerk": {"maker"},
        "effort": {"urdf"},
    }
    sources = {name: {source.name for source in each} for name, each in iiwa.limit_sources.items()}
    assert sources == {
        "position": {"urdf"},
        "velocity": {"maker"},
        "acceleration": {"assumed"},
        "jerk": {"unstated"},
        "effort": {"maker"},
    }


def test_a_robots_name_brings_no_limits():
    known = arms.KNOWN["panda"]
    file = arms.load(arms._pybullet_data() / known.urdf, base=known.base, tip=known.tip)
    assert file.name == arms.find("panda").name
    assert np.array_equal(file.acceleration_limit, np.full(7, arms.DEFAULT_ACCELERATION))


def test_the_function_of_the_acceleration_limits_is_a_property_now():
    with pytest.warns(DeprecationWarning, match="arm.acceleration_limit now"):
        assert np.array_equal(arms.acceleration_limit(arms.find("iiwa")), np.full(7, 10.0))


def test_an_unknown_name_is_refused_with_the_nearest_ones():
    with pytest.raises(InvalidArgument, match=r"'pandda' is not known. Nearest are panda \(pybullet_data\).*\.urdf"):
        arms.load("pandda")


def test_a_urdf_file_is_loaded_by_its_path():
    known = arms.KNOWN["panda"]
    path = arms._pybullet_data() / known.urdf
    arm = arms.load(path, base="panda_link0", tip="panda_link8")
    assert (arm.tip, arm.joint_count) == ("panda_link8", 7)
    assert math.isclose(arm.velocity_limit[0], 2.175)


def test_base_and_tip_of_a_named_arm_can_be_stated():
    arm = arms.load("panda", base="panda_link1", tip="panda_link8")
    assert (arm.base, arm.tip, arm.joint_count) == ("panda_link1", "panda_link8", 6)
    assert np.array_equal(arm.acceleration_limit, [7.5, 10, 12.5, 15, 20, 20])


def test_without_pybullet_data_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingDependency, match=r"dmpcpp fetch"):
        arms.find("panda")
