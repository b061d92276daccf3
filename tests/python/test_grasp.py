"""A bottle grasped with one human reach: planned without contact, held by friction alone, judged honestly."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import arms, grasp
from dmpcpp.errors import InvalidArgument
from dmpcpp.grasp import Bottle, Planner
from dmpcpp.grasp._reach import laid, longest_reach, resting
from dmpcpp.grasp._task import hand_pose
from dmpcpp.grasp._verdict import GraspTolerances
from dmpcpp.recordings import Recording
from dmpcpp.robot import Surroundings, obstacles_of
from dmpcpp.simulation import PANDA_HAND, Cylinder, Friction, GraspWorld
from scipy.spatial.transform import Rotation

pytest.importorskip("pybullet")

SLIPPERY = Cylinder(friction=Friction(0.3, spinning=1e-3, rolling=1e-4))


@pytest.fixture(scope="module")
def planner():
    return Planner(grasp.default_reach(), arms.find("panda"))


@pytest.fixture(scope="module")
def held(planner):
    return grasp.grasp(planner, Bottle())


def recording(position, rotation=None, duration=2.0):
    count = len(position)
    turns = (
        rotation if rotation is not None else Rotation.from_rotvec(np.outer(np.linspace(0, 1, count), [0.3, 0.2, 0.5]))
    )
    return Recording(np.linspace(0.0, duration, count), position, turns.as_matrix(), up_axis="y")


def hand_that_reaches():
    """Still for 0.5 s, 0.4 m along x from 0.5 to 1.3 s, back by 0.2 m until 2 s."""
    time = np.linspace(0.0, 2.0, 201)

    def step(begin, end):
        u = np.clip((time - begin) / (end - begin), 0.0, 1.0)
        return u**3 * (10 - 15 * u + 6 * u**2)

    x = 0.4 * step(0.5, 1.3) - 0.2 * step(1.3, 2.0)
    return recording(np.column_stack([x, 0.05 * np.sin(np.pi * x / 0.4), 0 * x]))


# ---- the reach --------------------------------------------------------------------------------------------


def test_the_reach_is_found_between_two_pauses():
    found = longest_reach(hand_that_reaches())
    assert found.position[-1, 0] - found.position[0, 0] == pytest.approx(0.4, abs=0.005)
    assert found.history[-1].startswith("cropped to")


def test_a_recording_without_a_reach_is_refused():
    angle = np.linspace(0.0, 20.0, 200)
    with pytest.raises(InvalidArgument, match=r"no reach of at least 0\.15 m.*state where it starts"):
        longest_reach(recording(0.05 * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])))


def test_a_resting_reach_keeps_its_path_and_stands_still_at_both_ends():
    moving = recording(np.column_stack([np.linspace(0, 0.5, 60), np.zeros(60), np.zeros(60)]))
    rested = resting(moving)
    speed = np.gradient(rested.position[:, 0], rested.time, edge_order=2)
    assert abs(speed[0]) < 1e-3 and abs(speed[-1]) < 1e-3
    assert speed[len(speed) // 2] == pytest.approx(0.25, rel=1e-6)  # the recorded speed in the middle
    assert np.allclose(rested.position[[0, -1]], moving.position[[0, -1]], atol=1e-12)
    assert (np.diff(rested.position[:, 0]) >= 0.0).all()


def test_a_reach_is_laid_by_a_similarity_that_meets_start_and_goal():
    moved = hand_that_reaches()
    start, goal = np.array([0.3, 0.1, 0.6]), hand_pose(np.array([0.5, 0.0, 0.4]), 0.2, 0.1, 0.2)
    for roll in (0.0, 1.0, 4.0):
        placed = laid(moved, start, goal, roll)
        assert np.allclose(placed.recording.position[0], start, atol=1e-12)
        assert np.allclose(placed.recording.position[-1], goal[:3, 3], atol=1e-12)
        assert np.allclose(placed.recording.rotation[-1], goal[:3, :3], atol=1e-9)
        before, after = (np.linalg.norm(p - p[50], axis=1) for p in (moved.position, placed.recording.position))
        assert np.allclose(after, placed.scale * before, atol=1e-12)
        turned = [Rotation.from_matrix(r[0].T @ r[-1]).magnitude() for r in (moved.rotation, placed.recording.rotation)]
        assert turned[0] == pytest.approx(turned[1])


def test_at_roll_zero_the_recordings_up_stays_up():
    moved = longest_reach(hand_that_reaches())  # along x, arched along its up axis y
    placed = laid(moved, np.array([0.3, 0.0, 0.5]), hand_pose(np.array([0.7, 0.0, 0.5]), 0.0, 0.0, 0.0))
    assert placed.recording.position[:, 2].max() > 0.5 + 0.8 * 0.05 * placed.scale
    assert np.abs(placed.recording.position[:, 1]).max() < 1e-9


def test_a_hand_pose_grips_the_point_with_level_fingers():
    point = np.array([0.5, 0.1, 0.3])
    for turned in (False, True):
        pose = hand_pose(point, 0.4, 0.3, 0.105, turned)
        assert np.allclose(pose[:3, 3] + 0.105 * pose[:3, 2], point)
        assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)
        assert pose[2, 1] == 0.0
        assert np.arctan2(pose[1, 2], pose[0, 2]) == pytest.approx(0.4)
        assert np.arcsin(-pose[2, 2]) == pytest.approx(0.3)


# ---- the plan ---------------------------------------------------------------------------------------------


def test_the_plan_approaches_along_the_tools_axis_and_ends_around_the_bottle(held):
    plan, arm = held.plan, held.arm
    poses = arm.forward_kinematics(plan.joints.position)
    time, begins = plan.joints.time, plan.phases
    approach = poses[(time >= begins["approach"] - 1e-9) & (time <= begins["close"] + 1e-9)]
    way = approach[-1, :3, 3] - approach[:, :3, 3]
    axis = approach[-1, :3, 2]
    assert np.linalg.norm(way[0]) == pytest.approx(0.12, abs=1e-3)
    assert np.linalg.norm(way - (way @ axis)[:, None] * axis, axis=1).max() < 1e-4
    assert np.allclose(approach[-1, :3, 3] + PANDA_HAND.depth * axis, plan.bottle.grasp_point, atol=1e-5)
    assert poses[-1, 2, 3] - approach[-1, 2, 3] == pytest.approx(0.1, abs=1e-4)


def test_one_model_is_led_to_every_bottle_by_its_goal(planner, held):
    other = planner.plan(Bottle(x=0.52, y=-0.05, yaw=0.1))
    assert np.array_equal(other.model.weights, held.plan.model.weights)
    reached = other.model.rollout(goal=other.poses[120]).pose[-1]
    assert np.abs(reached - other.poses[120]).max() < 2e-3


def test_the_plan_keeps_the_limits_of_the_joints_and_its_distance_from_the_bottle(held):
    plan, arm = held.plan, held.arm
    assert (np.abs(plan.joints.velocity) <= arm.velocity_limit).all()
    assert (np.abs(plan.joints.acceleration) <= arm.acceleration_limit * (1 + 1e-9)).all()
    assert (plan.joints.position > arm.lower).all() and (plan.joints.position < arm.upper).all()
    assert 0.005 <= plan.clearance <= 0.010
    assert plan.position_error < 1e-5


def test_a_bottle_out_of_reach_is_refused_with_what_stood_in_the_way(planner):
    with pytest.raises(
        InvalidArgument, match=r"no way to x 2, .* 10 were tried, most often the bottle is out of the arm's reach"
    ):
        planner.plan(Bottle(x=2.0))


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"yaw": float("nan")}, "yaw: nan, expected a finite number"),
        ({"height": -0.1}, r"height: -0\.1 m, expected 0"),
        ({"grasp_height": 0.2}, r"grasp_height: 0\.2 m"),
        ({"misjudged": (0.0, 0.0)}, "misjudged: .* three finite numbers"),
    ],
)
def test_a_place_that_is_none_is_refused(wrong, message):
    with pytest.raises(InvalidArgument, match=message):
        Bottle(**wrong)


def test_a_body_that_is_none_is_refused():
    with pytest.raises(InvalidArgument, match="mass: 0"):
        Cylinder(mass=0.0)
    with pytest.raises(InvalidArgument, match="lateral: -1"):
        Friction(-1.0)


def test_an_arm_without_the_grippers_fingers_is_refused():
    with pytest.raises(InvalidArgument, match=r"gripper\.joints: 'panda_finger_joint1' is no joint of"):
        GraspWorld(arms.find("iiwa"), 1e-3, PANDA_HAND, Cylinder(), np.array([0.5, 0.0, 0.25]))


# ---- the world --------------------------------------------------------------------------------------------


def test_the_bottle_has_the_inertia_of_a_solid_cylinder_and_stands():
    place = np.array([0.5, 0.1, 0.2])
    with GraspWorld(arms.find("panda"), 1e-3, PANDA_HAND, Cylinder(0.03, 0.16, 0.3), place) as world:
        info = world._p.getDynamicsInfo(world._object, -1, physicsClientId=world._client)
        assert info[0] == pytest.approx(0.3)
        across, along = 0.3 * (3 * 0.03**2 + 0.16**2) / 12, 0.3 * 0.03**2 / 2
        assert info[2] == pytest.approx((across, across, along))
        for _ in range(500):
            world.step()
        assert np.allclose(world.object_pose()[:3, 3], [0.5, 0.1, 0.28], atol=2e-4)
        assert world._p.getNumConstraints(physicsClientId=world._client) == 1  # the fingers' gear, and nothing else


def test_clearance_is_the_distance_to_the_closest_link():
    place = np.array([0.0, 0.6, 0.0])  # beside a Panda stretched straight up: far away
    arm = arms.find("panda")
    with GraspWorld(arm, 1e-3, PANDA_HAND, Cylinder(radius=0.05, height=0.3), place) as world:
        assert world.contacts_at(np.array([0.0, 0.0, 0.0, -0.1, 0.0, 1.5, 0.0])) == []
        distance, link = world.clearance(0.6)
        assert link in {"panda_link0", "panda_link1", "panda_link2"}
        assert 0.6 - 0.05 - 0.15 < distance < 0.6 - 0.05 - 0.05  # the links there are 5 to 15 cm thick
        assert world.clearance(0.1) == (0.1, "")


@pytest.mark.parametrize("place", [[0.5, 0.0, 0.25], [0.5, 0.3, 0.0]])
def test_whatever_is_touched_has_its_name_the_floor_too(place):
    low = np.array([0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8])  # the hand in the floor
    with GraspWorld(arms.find("panda"), 1e-3, PANDA_HAND, Cylinder(), np.array(place)) as world:
        touched = {contact.other for contact in world.contacts_at(low)}
    assert "floor" in touched and touched <= {"floor", "stand", "bottle"}


# ---- the grasp --------------------------------------------------------------------------------------------


def test_the_bottle_is_held_up(held):
    assert held.ok, [check for check in held.checks if not check.ok]
    assert held["rise"].value == pytest.approx(0.1, abs=0.005)
    assert held["slip"].value <= 0.2e-3
    assert held["torque_clipped"].value == 0


def test_two_grasps_are_the_same_bit_for_bit(planner, held):
    again = grasp.grasp(planner, Bottle())
    assert np.array_equal(again.log.object_pose, held.log.object_pose)
    assert np.array_equal(again.log.position, held.log.position)


def test_the_log_says_when_the_bottle_left_its_stand(held):
    log = held.log
    height = log.object_pose[:, 2, 3] - log.object_pose[0, 2, 3]
    first = log.time[np.argmax(height > 1e-3)]
    assert log.phases["lift"] < first < log.phases["hold"]
    assert np.abs(height[log.during("reach", "approach")]).max() < 1e-3
    assert log.opening[log.during("reach", "approach")].min() > 0.038
    assert log.opening[log.during("hold")] == pytest.approx(0.03, abs=2e-3)  # the bottle's radius


FAULTS = {
    "no friction": (Bottle(cylinder=replace(Cylinder(), friction=Friction(0.0))), {"rise", "slip"}),
    "too heavy for the fingers": (Bottle(cylinder=Cylinder(mass=6.0)), {"rise"}),
    "taken to be 3 cm beside itself": (Bottle(misjudged=(0.0, 0.03, 0.0)), set()),
    "taken to be 4 cm further away": (Bottle(misjudged=(0.05, 0.0, 0.0)), {"hand_on_bottle"}),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_goes_wrong_is_caught(planner, name):
    bottle, expected = FAULTS[name]
    run = grasp.grasp(planner, bottle)
    failed = {check.name for check in run.checks if not check.ok}
    assert not run.ok and expected <= failed, failed


def test_a_weak_grip_drops_the_bottle_so_nothing_else_holds_it(planner, held):
    log = grasp.carry_out(held.plan, planner.arm, replace(PANDA_HAND, force=0.0))
    assert not {check.name: check for check in grasp.judge(log, planner.arm)}["rise"].ok
    assert log.object_pose[-1, 2, 3] - log.object_pose[0, 2, 3] < 1e-3


def test_clipped_motors_and_touched_things_fail_the_verdict(held, planner):
    for change, name in (({"clipped_steps": 3}, "torque_clipped"), ({"steps": held.log.steps - 1}, "finite")):
        checks = grasp.judge(replace(held.log, **change), planner.arm)
        assert [check.name for check in checks if not check.ok] == [name]


def test_tighter_tolerances_fail_what_the_defaults_pass(held, planner):
    strict = grasp.judge(held.log, planner.arm, GraspTolerances(tilt=0.0, rise=0.2))
    assert {check.name for check in strict if not check.ok} == {"tilt", "rise"}


def test_the_rate_is_checked(held, planner):
    with pytest.raises(InvalidArgument, match=r"rate: 5, expected 100 to 10000 Hz"):
        grasp.carry_out(held.plan, planner.arm, PANDA_HAND, rate=5)


def test_random_bottles_lie_within_their_ranges_and_repeat_with_the_seed():
    bottles = [grasp.random_bottle(np.random.default_rng([3, k])) for k in range(200)]
    assert bottles[7] == grasp.random_bottle(np.random.default_rng([3, 7]))
    values = np.array([(b.x, b.y, b.yaw, *b.misjudged) for b in bottles])
    low, high = [0.4, -0.25, -0.25, *[-0.004] * 3], [0.6, 0.25, 0.25, *[0.004] * 3]
    assert (values >= low).all() and (values <= high).all()
    assert (np.ptp(values, axis=0) > 0.9 * np.subtract(high, low)).all()


@pytest.mark.slow
def test_fifty_bottles_at_random_are_held_up_and_hardly_slip(planner):
    runs = [grasp.grasp(planner, grasp.random_bottle(np.random.default_rng([1, k]))) for k in range(50)]
    failed = {k: [check.name for check in run.checks if not check.ok] for k, run in enumerate(runs) if not run.ok}
    assert failed == {}
    assert np.percentile([run["slip"].value for run in runs], 95) <= 0.2e-3
    assert sum(run.log.clipped_steps for run in runs) == 0


@pytest.mark.slow
def test_little_friction_is_enough():
    hand = replace(PANDA_HAND, friction=Friction(0.5))
    careful = Planner(grasp.default_reach(), arms.find("panda"), hand)
    for k in range(10):
        assert grasp.grasp(careful, grasp.random_bottle(np.random.default_rng([2, k]), SLIPPERY)).ok


# ---- the command line ---------------------------------------------------------------------------------------


def run(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "dmpcpp", "grasp", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, timeout=300)
    assert "Traceback" not in done.stderr + done.stdout
    return done


def test_the_command_prints_json_and_draws_the_phases(tmp_path):
    image = pytest.importorskip("PIL.Image")
    done = run("--x", 0.48, "--yaw", 5, "--json", "--video", "grasp.png", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    assert summary["verdict"] == "pass" and summary["bottle"]["x"] == 0.48
    with image.open(tmp_path / "grasp.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    assert pixels.shape == (384, 5 * 512, 3)
    panels = np.hsplit(pixels, 5)
    assert all(np.ptp(panel, axis=(0, 1)).min() > 100 for panel in panels)
    assert np.abs(panels[2] - panels[4]).max() > 50  # lifted


def test_a_film_is_an_mp4(tmp_path):
    pytest.importorskip("imageio_ffmpeg")
    from dmpcpp.grasp._film import _write_mp4

    colours = (np.full((384, 512, 3), 25 * k, dtype=np.uint8) for k in range(10))
    _write_mp4(tmp_path / "film.mp4", colours)
    assert (tmp_path / "film.mp4").read_bytes()[4:8] == b"ftyp"


@pytest.mark.slow
def test_the_command_films_a_grasp_as_gif(tmp_path):
    image = pytest.importorskip("PIL.Image")
    done = run("--video", "grasp.gif", cwd=tmp_path)
    assert done.returncode == 0 and "held up" in done.stdout
    with image.open(tmp_path / "grasp.gif") as film:
        assert film.n_frames > 60


def test_a_recording_of_ones_own_leads_the_hand(tmp_path):
    reach = hand_that_reaches()
    quaternion = Rotation.from_matrix(reach.rotation).as_quat()
    np.savetxt(tmp_path / "hand.tum", np.c_[reach.time, reach.position, quaternion])
    done = run("--recording", "hand.tum", "--format", "tum", "--up-axis", "y", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["recording"]["source"] == "hand.tum"


def test_a_dropped_bottle_is_status_3(tmp_path):
    done = run("--friction", 0, "--json", cwd=tmp_path)
    assert done.returncode == 3
    assert json.loads(done.stdout)["verdict"] == "fail"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--video", "grasp.avi"], "expected a name that ends in .mp4, .gif, .png"),
        (["--unit", "mm"], "--unit: it describes a recording; state --recording FILE"),
        (["--x", "3"], "no way to x 3"),
        (["--mass", "-1"], "mass: -1.0, expected a positive number"),
        (["--recording", "nowhere.csv"], "nowhere.csv"),
    ],
)
def test_wrong_usage_is_one_clear_error_and_status_2(arguments, message, tmp_path):
    done = run(*arguments, cwd=tmp_path)
    assert done.returncode == 2 and message in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_among_posts_the_bottle_is_held_up_without_touching_one():
    bottle = Bottle()
    posts = grasp.clutter(4, bottle, np.random.default_rng(5))
    around = Surroundings(obstacles=posts)
    run = grasp.grasp(Planner(grasp.default_reach(), arms.find("panda"), surroundings=around), bottle)
    assert run.ok, [check.name for check in run.failed]
    assert run["arm_contact"].value == 0
    assert len(run.summary()["obstacles"]) == 4
    hand = run.plan.poses[:, :3, 3]
    assert min(post.shape.distance(hand).min() for post in posts) > around.margin


def test_what_stands_around_the_bottle_and_leaves_no_way_is_named():
    wall = obstacles_of("box:0.36,0,0.4,0.02,1.2,1.6")
    planner = Planner(grasp.default_reach(), arms.find("panda"), surroundings=Surroundings(obstacles=wall))
    with pytest.raises(InvalidArgument, match="most often .* (touch|within 10 mm of) obstacle"):
        planner.plan(Bottle())


def test_clutter_is_drawn_by_its_seed_and_leaves_room():
    bottle = Bottle(x=0.5, y=0.1)
    posts = grasp.clutter(20, bottle, np.random.default_rng(1))
    again = grasp.clutter(20, bottle, np.random.default_rng(1))
    assert [post.text() for post in posts] == [post.text() for post in again]
    assert len({post.name for post in posts}) == 20
    axis = np.c_[np.full(50, 0.5), np.full(50, 0.1), np.linspace(0, 1, 50)]
    assert min(post.shape.distance(axis).min() for post in posts) > 0.09
