"""The URDF as it goes to an engine: meshes found, inertias that a rigid body can have."""

import numpy as np
import pytest
from dmpcpp import Arm, arms
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._description import describe, find_mesh
from dmpcpp.robot._inertia import is_physical, nearest_physical
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

URDF = """<robot name="r"><link name="base"/><link name="tool"><inertial><mass value="1"/>{inertia}</inertial>
  <collision><geometry><mesh filename="{mesh}"/></geometry></collision></link>
  <joint name="j" type="revolute"><parent link="base"/><child link="tool"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>"""
SOUND = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'

points = arrays(np.float64, (6, 3), elements=st.floats(-2.0, 2.0, width=16))
symmetric = arrays(np.float64, (3, 3), elements=st.floats(-5.0, 5.0, width=16)).map(lambda a: a + a.T)


def inertia_of(points):
    """Of unit masses at these points, by the definition."""
    centred = points - points.mean(axis=0)
    return sum(np.dot(p, p) * np.eye(3) - np.outer(p, p) for p in centred)


@given(points)
def test_the_inertia_of_any_set_of_masses_is_physical_and_stays(points):
    inertia = inertia_of(points) + 0.01 * np.eye(3)
    assert is_physical(inertia)
    assert np.allclose(nearest_physical(inertia), inertia, rtol=1e-3)


@given(symmetric)
def test_the_nearest_physical_inertia_is_physical(inertia):
    assert is_physical(nearest_physical(inertia))


@pytest.mark.parametrize(
    "moments, physical",
    [((1, 1, 1), True), ((1, 1, 2), True), ((1, 1, 2.1), False), ((-1, 1, 1), False), ((0, 0, 0), False)],
)
def test_the_principal_moments_hold_the_triangle_inequality(moments, physical):
    assert is_physical(np.diag(np.array(moments, dtype=float))) is physical


def test_the_two_bad_inertias_of_the_xarm6_are_found_and_only_those(tmp_path):
    pytest.importorskip("pybullet_data")
    assert describe(arms.find("xarm6"), tmp_path).repaired_links == ("link2", "link3")
    assert describe(arms.find("panda"), tmp_path).repaired_links == ()
    assert describe(arms.find("iiwa"), tmp_path).repaired_links == ()


def test_links_joined_rigidly_or_by_one_joint_are_neighbours(tmp_path):
    pytest.importorskip("pybullet_data")
    neighbours = describe(arms.find("panda"), tmp_path).neighbours
    assert frozenset(("panda_link7", "panda_hand")) in neighbours  # rigid, over the bare link8
    assert frozenset(("panda_link6", "panda_hand")) in neighbours  # on either side of joint 7
    assert frozenset(("panda_link5", "panda_hand")) not in neighbours


@pytest.mark.parametrize(
    "mesh", ["meshes/tool.obj", "package://some_package/meshes/tool.obj", "package://meshes/tool.obj"]
)
def test_a_mesh_is_found_from_the_folder_of_the_urdf(tmp_path, mesh):
    (tmp_path / "some_package" / "urdf").mkdir(parents=True)
    (tmp_path / "some_package" / "meshes").mkdir()
    target = tmp_path / "some_package" / "meshes" / "tool.obj"
    target.write_text("")
    path = tmp_path / "some_package" / "urdf" / "r.urdf"
    path.write_text(URDF.format(inertia=SOUND, mesh=mesh))
    assert find_mesh(mesh, Arm.from_urdf_file(str(path)).folder) == target


def test_a_mesh_that_is_nowhere_is_named(tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text(URDF.format(inertia=SOUND, mesh="package://gone/tool.obj"))
    with pytest.raises(InvalidArgument, match=r"link 'tool': no mesh 'package://gone/tool\.obj'"):
        describe(Arm.from_urdf_file(str(path)), tmp_path)


def test_an_inertia_that_is_not_numbers_is_named(tmp_path):
    text = URDF.format(inertia=SOUND.replace('izz="1"', 'izz="nan"'), mesh="x.obj")
    text = text.replace('<collision><geometry><mesh filename="x.obj"/></geometry></collision>', "")
    with pytest.raises(InvalidArgument, match="link 'tool'"):
        describe(Arm.from_urdf(text), tmp_path)
