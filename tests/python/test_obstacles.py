"""What stands around an arm is read from text and files, is a body in both engines, and a motion is led around it."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Capsule, InvalidArgument, Sphere, arms, imitation, planning, recordings, simulation
from dmpcpp.errors import FileError
from dmpcpp.planning import _avoidance
from dmpcpp.robot import Surroundings, obstacles_of

BALL_ARM = """<robot name="ball"><link name="a"/><link name="b"><collision><geometry><sphere radius="0.05"/></geometry>
  </collision><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><origin xyz="0 0 1"/>
  <limit lower="-1" upper="1" velocity="1" effort="100"/></joint></robot>"""
SCENE = """<robot name="scene">
  <link name="table"><collision><origin xyz="0 0 -0.1"/><geometry><box size="2 1 0.2"/></geometry></collision></link>
  <link name="post"><collision><geometry><cylinder radius="0.1" length="0.6"/></geometry></collision></link>
  <link name="bulb"><collision><geometry><sphere radius="0.07"/></geometry></collision></link>
  <joint name="p" type="fixed"><parent link="table"/><child link="post"/><origin xyz="0.5 0 0.3" rpy="0 0 0.3"/></joint>
  <joint name="q" type="fixed"><parent link="post"/><child link="bulb"/><origin xyz="0 0 0.4"/></joint></robot>"""


def test_shapes_as_text_are_what_they_say_and_come_back():
    texts = [
        "sphere:0.4,0.1,0.3,0.08",
        "box:0.5,0,0.2,0.1,0.2,0.4",
        "box:0,0,0,0.2,0.4,0.6,0.7071067812,0,0,0.7071067812",
        "capsule:0,0,0,0,0,0.5,0.05",
        "plane:0,0,0.1,0,0,1",
    ]
    ball, box, turned, capsule, plane = obstacles_of(texts)
    assert [one.name for one in (ball, box, turned)] == ["obstacle", "obstacle_2", "obstacle_3"]
    assert isinstance(ball.shape, Sphere)
    np.testing.assert_allclose(box.shape.half_sizes, [0.05, 0.1, 0.2])
    assert turned.shape.distance([0.3, 0, 0]) == pytest.approx(0.1)  # turned by 90 deg about z
    assert isinstance(capsule.shape, Capsule)
    assert plane.shape.distance([5, 5, 0.4]) == pytest.approx(0.3)
    assert [one.text() for one in (ball, box, turned, capsule, plane)] == texts
    around = Surroundings("auto", (), (ball, turned), 0.03)
    back = Surroundings.of(around.to_dict())
    assert (back.margin, [one.text() for one in back.obstacles]) == (0.03, [texts[0], texts[2]])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("sphere:1,2,3", "expected sphere:X,Y,Z,R"),
        ("box:1,2,3", r"expected box:X,Y,Z,SX,SY,SZ\[,QW"),
        ("sphere:1,2,3,nan", "finite numbers"),
        ("sphere:1,2,3,0", "R: 0, expected lengths above 0"),
        ("box:0,0,0,1,1,1,0,0,0,0", "expected a quaternion"),
        ("plane:0,0,0,0,0,0", "normal: expected a direction"),
        ("cone:1,2,3", "expected sphere:X,Y,Z,R, box:.* or a .yaml or .urdf file"),
    ],
)
def test_text_that_is_no_shape_is_refused_with_what_was_expected(text, expected):
    with pytest.raises(InvalidArgument, match=expected) as refused:
        obstacles_of(text)
    assert text in str(refused.value)


def test_a_yaml_file_lists_shapes_with_names(tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(
        "obstacles:\n  - {sphere: [0.4, 0.1, 0.3, 0.08], name: ball}\n  - box: [0.5, 0, 0.2, 0.1, 0.2, 0.4]\n"
    )
    assert [one.name for one in obstacles_of(str(path))] == ["ball", "obstacle"]
    for content in ("- sphere: [1, 2]", "- ball: [1, 2, 3, 4]", "[]", "a: [", "- sphere: 3"):
        path.write_text(content)
        with pytest.raises(FileError, match=r"scene\.yaml"):
            obstacles_of(str(path))
    with pytest.raises(FileError, match="cannot be read"):
        obstacles_of(str(tmp_path / "none.yaml"))


def test_a_scene_is_read_from_a_urdf_and_what_is_no_box_says_so(tmp_path):
    path = tmp_path / "scene.urdf"
    path.write_text(SCENE)
    table, post, bulb = obstacles_of(str(path))
    assert [one.name for one in (table, post, bulb)] == ["table", "post", "bulb"]
    assert table.shape.distance([0, 0, 0.3]) == pytest.approx(0.3)
    np.testing.assert_allclose(bulb.shape.center, [0.5, 0, 0.7])
    assert post.shape.distance([0.5, 0, 0.65]) == pytest.approx(0.05)
    assert "'post' is a cylinder" in post.note
    path.write_text("<robot name='empty'><link name='a'/></robot>")
    with pytest.raises(FileError, match="no link has a collision shape"):
        obstacles_of(str(path))


@pytest.mark.parametrize("engine", simulation.ENGINES.values(), ids=simulation.ENGINES)
def test_obstacles_are_bodies_in_every_engine_as_far_away_as_they_say(engine):
    obstacles = obstacles_of(
        [
            "sphere:0.6,0.2,1.1,0.1",
            "box:-0.4,0.3,0.8,0.2,0.1,0.3,0.9,0.1,0.3,-0.2",
            "capsule:0.9,-0.3,0.5,0.6,-0.3,1.4,0.04",
            "plane:0,0.7,0,0,-1,0.2",
        ]
    )
    arm = dmpcpp.Arm.from_urdf(BALL_ARM)
    with Surroundings(None, (), obstacles).in_world(engine)(arm, 1e-3) as world:
        for q in (-0.2, 0.1, 0.4):
            found = {near.other: near.distance for near in world.clearances_at(np.array([q]), 2.0)}
            for one in obstacles:
                assert found[one.name] == pytest.approx(one.shape.distance([q, 0, 1]) - 0.05, abs=2e-3)


def reach(offset=0.0):
    """A reach across the workspace of the panda, the hand downwards."""
    time = np.linspace(0.0, 2.0, 101)
    s = time / 2.0
    poses = np.tile(np.diag([1.0, -1.0, -1.0, 1.0]), (101, 1, 1))
    poses[:, 0, 3] = 0.45 + offset
    poses[:, 1, 3] = -0.25 + 0.5 * s**3 * (10 - 15 * s + 6 * s**2)
    poses[:, 2, 3] = 0.45
    return dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses))


def test_a_plan_is_led_around_what_is_in_the_way_of_tool_and_arm():
    around = Surroundings("auto", (), obstacles_of("sphere:0.45,0,0.42,0.05"), 0.015)
    arm = arms.find("panda")
    found = planning.plan(reach(), arm, simulator=simulation.default_simulator, surroundings=around)
    assert found.ok, [check for check in found.failed]
    assert found["path_object_clearance"].value >= 0.0149
    np.testing.assert_allclose(found.motion.pose[[0, -1], :3, 3], [[0.45, -0.25, 0.45], [0.45, 0.25, 0.45]], atol=1e-3)
    assert found.detour.names == ("obstacle",)
    assert found.detour.clearance >= 0.015
    assert found.summary()["detour"]["obstacles"] == ["obstacle"]
    joints = arm.forward_kinematics(found.joints.position)[:, :3, 3]
    assert around.obstacles[0].shape.distance(joints).min() > 0.015


def test_what_is_not_in_the_way_changes_nothing():
    model, arm = reach(), arms.find("panda")
    around = Surroundings("auto", (), obstacles_of("sphere:-0.5,0,0.3,0.05"))
    free = planning.plan(model, arm, simulator=simulation.default_simulator)
    found = planning.plan(model, arm, simulator=simulation.default_simulator, surroundings=around)
    assert found.detour is None
    np.testing.assert_array_equal(found.joints.position, free.joints.position)
    assert found["path_object_clearance"].ok


def test_without_an_engine_the_tool_is_led_around_and_the_arm_is_not_judged():
    around = Surroundings("auto", (), obstacles_of("sphere:0.45,0,0.45,0.05"))
    found = planning.plan(reach(), arms.find("panda"), surroundings=around)
    assert around.obstacles[0].shape.distance(found.motion.pose[:, :3, 3]).min() > 0.01
    assert not found["path_object_clearance"].judged
    assert not found.ok


@pytest.mark.parametrize(
    ("obstacle", "expected"),
    [
        ("sphere:0.45,-0.25,0.45,0.05", "the start of the motion lies 50 mm inside 'obstacle'"),
        ("box:0.45,0.25,0.45,0.1,0.1,0.1", "the goal of the motion lies 50 mm inside 'obstacle'"),
        ("box:0.45,0,0.45,2,0.02,2", "'obstacle' in the way, and no bump of up to 50 cm keeps the tool 10 mm away"),
    ],
)
def test_where_there_is_no_way_around_one_plain_line_says_so(obstacle, expected):
    around = Surroundings("auto", (), obstacles_of(obstacle))
    with pytest.raises(InvalidArgument, match=expected) as refused:
        planning.plan(reach(), arms.find("panda"), surroundings=around)
    assert "\n" not in str(refused.value)


def test_planes_and_boxes_are_moved_into_the_frame_of_the_base():
    base = np.eye(4)
    base[:3, 3] = 0.1, 0.2, 0.3
    base[:3, :3] = dmpcpp.so3.exp([0.3, -0.2, 0.5])
    point = np.array([0.4, -0.1, 0.2])
    there = base[:3, :3] @ point + base[:3, 3]
    for text in (
        "sphere:1,0,0,0.1",
        "box:1,0,0,1,2,1,0.9,0.1,0,0.2",
        "capsule:1,0,0,1,1,0,0.1",
        "plane:1,0,0,-1,0,0.3",
    ):
        [one] = obstacles_of(text)
        moved = _avoidance._moved(one, np.linalg.inv(base))
        assert moved.distance(point) == pytest.approx(one.shape.distance(there))


def test_a_fixed_motion_is_imitated_around_an_obstacle_under_physics():
    time = np.linspace(0.0, 2.0, 101)
    pose = reach().rollout_at(time).pose
    recording = recordings.Recording(time, pose[:, :3, 3], pose[:, :3, :3], source="reach", body="hand", up_axis="z")
    around = Surroundings("auto", (), obstacles_of("sphere:0.45,0,0.42,0.05"))
    run = imitation.imitate(recording, arms.find("panda"), place=False, surroundings=around)
    assert run.ok, [check for check in run.failed]
    assert run["object_contact"].value == 0
    assert run["path_object_clearance"].value >= 0.0099
    assert run.detour.names == ("obstacle",)
    assert any("led around 'obstacle'" in note for note in run.recording.history)
    assert run.summary()["obstacles"] == [{"name": "obstacle", "shape": "sphere:0.45,0,0.42,0.05"}]
    kept = around.obstacles[0].shape.distance(run.log.tool_pose[:, :3, 3])
    assert kept.min() > 0.01


def straight(axes=3):
    """A straight reach of 0.6 m as a model of positions."""
    time = np.linspace(0.0, 1.0, 101)
    path = np.zeros((101, axes))
    path[:, 0] = 0.6 * time**3 * (10 - 15 * time + 6 * time**2)
    return dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, path))


@pytest.mark.parametrize(
    "text", ["sphere:0.3,0,0,0.08", "box:0.25,0.02,0,0.04,0.2,0.3", "capsule:0.3,-1,0,0.3,1,0,0.05"]
)
def test_a_path_is_planned_clear_with_its_ends_kept_and_the_proof_holds(text):
    [obstacle] = obstacles_of(text)
    model = straight()
    detour = planning.clear_path(model, [obstacle.shape], margin=0.02)
    moved = model.rollout(dt=1e-4, via=[detour.via])
    finely = obstacle.shape.distance(moved.position).min()
    assert 0.02 <= detour.clearance <= finely + 1e-9
    np.testing.assert_allclose(moved.position[[0, -1]], model.rollout().position[[0, -1]], atol=1e-9)
    run = dmpcpp.Run(model)
    run.via(detour.via.phase, detour.via.point, reach=detour.via.reach)
    nearest = np.inf
    while run.step(1e-3):
        nearest = min(nearest, obstacle.shape.distance(run.position))
    assert nearest >= 0.02


def test_a_new_goal_is_planned_for_anew_and_a_clear_path_needs_nothing():
    model = straight()
    [ball] = obstacles_of("sphere:0.3,0.15,0,0.06")
    assert planning.clear_path(model, [ball.shape]) is None
    assert planning.clear_path(model, []) is None
    goal = [0.5, 0.3, 0.0]
    detour = planning.clear_path(model, [ball.shape], goal=goal)
    assert ball.shape.distance(model.rollout(goal, via=[detour.via]).position).min() >= 0.01
    with pytest.raises(InvalidArgument, match="the goal of the motion lies"):
        planning.clear_path(model, [ball.shape], goal=[0.3, 0.15, 0.0])
