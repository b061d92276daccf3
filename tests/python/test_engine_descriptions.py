"""What others put into a URDF that an engine stumbles over: both engines load it, and simulate the same masses."""

from functools import partial

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

pytest.importorskip("pybullet", reason="the extra `sim`")
pytest.importorskip("mujoco")

from dmpcpp import Arm, simulation
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot._convex_pieces import convex_pieces, read_mesh
from dmpcpp.robot._description import describe
from dmpcpp.simulation import Bullet, MuJoCo
from dmpcpp.simulation._dynamics_check import dynamics_mismatch

from benchmarks.joint_motions import reach
from tests.python.small_arms import BOX, INERTIA, LIMIT, six_axis

TURNED = f'<inertial><origin xyz="0.1 0 0.04" rpy="0.3 0.5 0.7"/><mass value="1"/>{INERTIA}</inertial>'
LONG = (
    '<inertial><origin xyz="0.1 0 0.04" rpy="0.3 0.5 0.7"/><mass value="3"/>'
    '<inertia ixx="0.05" ixy="0.004" ixz="0.003" iyy="0.04" iyz="0.002" izz="0.03"/></inertial>'
)
HEAVY = (  # Bullet's own inverse dynamics finds its two halves to differ by 7e-15
    '<inertial><origin xyz="0.25 0.1 -0.39"/><mass value="253.5"/>'
    '<inertia ixx="44.99" ixy="-6.18" ixz="-4.93" iyy="74.0" iyz="-2.97" izz="75.22"/></inertial>'
)
STAND = (
    '<link name="stand"/><joint name="on" type="fixed"><parent link="stand"/><child link="base"/>'
    '<origin rpy="0.3 0.2 0" xyz="0 0 0.3"/></joint>'
)
FINGER = (
    '<link name="finger"><inertial><mass value="0.4"/>'
    + INERTIA
    + '</inertial></link><joint name="jaw" type="prismatic">'
    '<parent link="l6"/><child link="finger"/><axis xyz="1 0 0"/><limit lower="0" upper="0.2" velocity="1" effort="9"/>'
    "</joint>"
)
ODD = {
    "friction without damping": six_axis(limit=LIMIT + '<dynamics friction="0.7"/>'),
    "damping and friction": six_axis(limit=LIMIT + '<dynamics damping="0.3" friction="0.7"/>'),
    "elements of others": six_axis(
        extra='<mujoco><compiler balanceinertia="true"/></mujoco><gazebo reference="l1"><a/></gazebo>'
        '<transmission name="t"/>'
    ),
    "attributes of others": six_axis(
        robot='<robot name="six" xmlns:drake="https://drake.mit.edu">',
        limit=LIMIT.replace("<limit ", '<limit drake:acceleration="5" '),
    ),
    "leftovers of xacro": six_axis(extra='<xacro:property name="a" value="1"/><gazebo><ros:x y:z="2"/></gazebo>'),
    "an empty axis of a fixed joint": six_axis(
        extra='<link name="l7"/><joint name="f" type="fixed"><parent link="l6"/><child link="l7"/><axis/></joint>'
    ),
    "shapes of one name": six_axis(shape=BOX.replace("<collision>", '<collision name="shape">')),
    "one line": six_axis(inertial=LONG).replace("\n", " "),
    "turned inertias": six_axis(inertial=TURNED),
    "a turned inertia of the root": six_axis(inertials={"base": TURNED.replace('"1"', '"40"')}),
    "large inertias": six_axis(inertials={"l2": HEAVY}),
    "two frames between joints": six_axis(inertials={"l4": "", "l5": ""}, shapes={"l4": "", "l5": ""}),
    "a frame at the first joint": six_axis(inertials={"l1": ""}, shapes={"l1": ""}),
    "the root is called world": six_axis().replace('"base"', '"world"'),
    "a moving link is called world": six_axis().replace('"l3"', '"world"'),
    "the tip is called world": six_axis().replace('"l6"', '"world"'),
    "a name longer than a line": six_axis().replace('"l3"', f'"{"x" * 9000}"'),
    "a name with signs": six_axis().replace('"l3"', '"a/b c&amp;d"'),
    "a base that stands askew": six_axis(extra=STAND),
    "a finger": six_axis(extra=FINGER),
    "many frames": six_axis(
        extra="".join(
            f'<link name="f{k}"/><joint name="g{k}" type="fixed"><parent link="l{1 + k % 6}"/>'
            f'<child link="f{k}"/></joint>'
            for k in range(150)
        )
    ),
}


def arm_of(text: str, **options: str) -> Arm:
    base = "base" if '<link name="base"' in text else "world"
    tip = "l6" if '<link name="l6"' in text else "world"
    return Arm.from_urdf(text, base=base, tip=tip, **options)


@pytest.mark.parametrize("name", ODD)
@pytest.mark.parametrize("engine", [Bullet, MuJoCo])
def test_both_engines_load_it_with_the_masses_and_gravity_of_the_description(name, engine):
    arm = arm_of(ODD[name])
    with engine(arm, 1e-3) as world:
        found = dynamics_mismatch(world, arm)
        assert found.value <= 1e-9, found.detail
        # and the same with speed and acceleration, which inertias decide on
        q, speed, acceleration = np.full(6, 0.3), np.linspace(-0.5, 0.5, 6), np.linspace(1.0, -1.0, 6)
        world.reset(q, speed)
        damping = 0.3 if name == "damping and friction" else 0.0
        expected = arm.inverse_dynamics(q, speed, acceleration) + damping * speed
        assert world.inverse_dynamics(acceleration) == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["two frames between joints", "large inertias", "a moving link is called world"])
def test_both_engines_execute_it_alike(name):
    arm = arm_of(ODD[name]).with_limits(effort=[5e3] * 6)
    joints = reach(arm, [0.3, 0.4, 0.3, 0.2, 0.3, 0.2], 1.0, [0.1] * 6)
    logs = [simulation.execute(arm, joints, simulator=engine, settle=0.1) for engine in (Bullet, MuJoCo)]
    assert all(log.verdict.ok for log in logs), [log.verdict.failed for log in logs]
    assert all(check.ok for check in simulation.agreement(*logs))


def test_where_bullets_inverse_dynamics_fails_another_stands_in_and_the_name_says_so(capfd):
    with Bullet(arm_of(ODD["large inertias"]), 1e-3) as world:
        assert "inverse dynamics by KDL" in world.name
    with Bullet(arm_of(six_axis()), 1e-3) as world:
        assert "KDL" not in world.name
    assert capfd.readouterr() == ("", "")


def test_contacts_name_the_links_of_the_description():
    text = ODD["a moving link is called world"].replace('<box size="0.05 0.05 0.05"/>', '<box size="0.3 0.3 0.05"/>')
    arm = arm_of(text)
    for engine in (Bullet, MuJoCo):
        with engine(arm, 1e-3) as world:
            found = world.contacts_at(np.array([0.0, 1.2, 2.6, 0.0, 0.0, 0.0]))
        names = {name for contact in found for name in (contact.link, contact.other)}
        assert names and all(not name.startswith("dmpcpp") for name in names)


def test_what_engines_read_is_written_an_element_a_line_and_nothing_else(tmp_path):
    text = describe(arm_of(ODD["elements of others"]), tmp_path).text
    assert not any(word in text for word in ("mujoco", "gazebo", "transmission", "dynamics"))
    assert max(map(len, text.splitlines())) < 200


def test_an_engine_that_lost_a_mass_is_found():
    arm = arm_of(six_axis())

    class Lost(MuJoCo):
        def masses(self):
            return {**super().masses(), "l5": 0.5}

    with Lost(arm, 1e-3) as world:
        found = dynamics_mismatch(world, arm)
    assert found.value == pytest.approx(0.5) and found.detail == "l5: 0.5 kg, in the URDF 1"


# ---- inverse dynamics of the arm itself -------------------------------------------------------------------------


def test_gravity_of_a_base_that_stands_askew_is_turned():
    down = Rotation.from_euler("xyz", [0.3, 0.2, 0.0]).inv().apply([0.0, 0.0, -9.81])
    assert arm_of(ODD["a base that stands askew"]).gravity == pytest.approx(down)


def test_a_finger_weighs_in_the_middle_of_its_range():
    stretched = np.array([[0.0, np.pi / 2, 0.0, 0.0, 0.0, np.pi / 2]])
    with_finger, without = (arm_of(text).gravity_effort(stretched)[0] for text in (ODD["a finger"], six_axis()))
    # 0.4 kg at 0.3 + 0.15 + 0.2 + 0.12 m from joint 2; its 0.1 m to the side lie across, along joint 2's axis
    assert with_finger[1] - without[1] == pytest.approx(-0.4 * 9.81 * 0.77, rel=1e-9)
    q = np.array([[0.0, np.pi / 2, 0.0, 0.0, np.pi / 2, 0.0]])
    with_finger, without = (arm_of(text).gravity_effort(q)[0] for text in (ODD["a finger"], six_axis()))
    assert with_finger[4] - without[4] == pytest.approx(0.4 * 9.81 * 0.1, rel=1e-9)


# ---- meshes -----------------------------------------------------------------------------------------------------

CORNERS = np.array([[0, 0, 0], [30, 0, 0], [0, 30, 0], [0, 0, 30]], dtype=float)
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


def write_ply(path, corners):
    rows = [f"{x} {y} {z}" for x, y, z in corners] + [f"3 {a} {b} {c}" for a, b, c in FACES]
    head = (
        f"ply\nformat ascii 1.0\nelement vertex {len(corners)}\nproperty float x\nproperty float y\nproperty float z\n"
    )
    path.write_text(
        head
        + f"element face {len(FACES)}\nproperty list uchar int vertex_indices\nend_header\n"
        + "\n".join(rows)
        + "\n"
    )


def write_dae(path, corners, unit):
    numbers, indices = (" ".join(str(x) for row in rows for x in row) for rows in (corners, FACES))
    parts = (
        '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">',
        f'<asset><unit meter="{unit}"/><up_axis>Z_UP</up_axis></asset>',
        f'<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="12">{numbers}',
        '</float_array><technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>',
        '<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>',
        '<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="4">',
        f'<input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles></mesh></geometry>',
        '</library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>',
        '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>',
    )
    path.write_text("".join(parts))


def write_glb(path, corners):
    trimesh = pytest.importorskip("trimesh")
    trimesh.Trimesh(corners, FACES).export(path)


MESHES = {
    "part.ply": (write_ply, CORNERS, 1e-3),
    "part.dae": (partial(write_dae, unit=1e-3), CORNERS, 1.0),
    "part.glb": (write_glb, CORNERS * 1e-3, 1.0),
}


@pytest.mark.parametrize("name", MESHES)
def test_meshes_of_other_kinds_become_convex_pieces_in_metres(name, tmp_path):
    pytest.importorskip("trimesh")
    write_mesh, corners, scale = MESHES[name]
    write_mesh(tmp_path / name, corners)
    assert scale * read_mesh(tmp_path / name).reshape(-1, 3).max(axis=0) == pytest.approx([0.03] * 3, rel=1e-5)
    shape = f'<collision><geometry><mesh filename="{name}" scale="{scale} {scale} {scale}"/></geometry></collision>'
    arm = arm_of(six_axis(shape=shape), folder=str(tmp_path))
    below = np.array([0.0, 1.4, 0.6, 0.0, 0.0, 0.0])
    found = []
    for engine in (Bullet, MuJoCo):
        with engine(arm, 1e-3, floor=-0.5) as world:
            near = [c for c in world.clearances_at(below, 1.0) if (c.link, c.other) == ("l6", "floor")]
            found.append(near[0].distance)
    # the tip's own corners: the lowest is 0 or 0.03 m along an axis of its frame
    pose = arm.forward_kinematics(below)
    lowest = (pose[:3, :3] @ (1e-3 * CORNERS).T + pose[:3, 3:])[2].min()
    assert found == pytest.approx([lowest + 0.5] * 2, abs=2.5e-3)  # Bullet's margins are 2 mm


def test_a_flat_mesh_becomes_a_thin_plate(tmp_path):
    (tmp_path / "flat.obj").write_text("v 0 0 1\nv 2 0 1\nv 0 3 1\nv 2 3 1\nf 1 2 3\nf 2 4 3\n")
    (piece,) = convex_pieces(tmp_path / "flat.obj")
    corners = np.array([line.split()[1:] for line in piece.splitlines() if line.startswith("v ")], dtype=float)
    assert np.ptp(corners, axis=0) == pytest.approx([2.0, 3.0, 0.006], rel=0.01)


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("empty.obj", "# nothing\n", "link 'l2': collision mesh 'empty.obj' holds no triangles"),
        ("broken.ply", "ply\nnonsense\n", "link 'l2': collision mesh 'broken.ply' cannot be read"),
        ("part.step", "ISO-10303-21;", r"'part.step' cannot be read as a mesh .* Convert it to .obj or .stl"),
    ],
)
def test_a_mesh_that_cannot_be_read_is_named_with_its_link_and_the_way_out(name, content, words, tmp_path):
    (tmp_path / name).write_text(content)
    shape = f'<collision><geometry><mesh filename="{name}"/></geometry></collision>'
    arm = arm_of(six_axis(shapes={"l2": shape}), folder=str(tmp_path))
    for engine in (Bullet, MuJoCo):
        with pytest.raises(InvalidArgument, match=words), engine(arm, 1e-3):
            pass
