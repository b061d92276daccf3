"""One injected fault of every kind, each caught by the check that is there for it; and paths looked at beforehand."""

import json
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from dmpcpp import Arm, arms, simulation
from dmpcpp.errors import InvalidArgument
from dmpcpp.simulation import Box, Bullet, Check, Disturbance, MuJoCo, PathTolerances

from benchmarks.joint_motions import HOME, PENDULUM, reach, swing, trajectory

PANDA = arms.find("panda")
FOLDED = [0.0, -0.3, 0.0, -2.0, 0.0, 0.0, 0.8]  # the hand against the forearm
LOW = [0.0, 0.9, 0.0, -1.75, 0.0, 2.55, 0.8]  # the hand in the floor


def in_the_way(centre=None, size=0.1):
    """A box where the hand is in the middle of a swing."""
    middle = swing(PANDA).position[50]
    centre = PANDA.forward_kinematics(middle)[:3, 3] if centre is None else centre
    return Box("crate", (size, size, size), tuple(centre))


def run(joints=None, arm=PANDA, **options):
    return simulation.execute(arm, swing(arm) if joints is None else joints, **options)


def with_residual(kind, size):
    errors = {"position_error": np.zeros(101), "angle_error": np.zeros(101)}
    errors[f"{kind}_error"][40] = size
    log = run()
    return replace(log, joints=replace(log.joints, report=SimpleNamespace(**errors)))


def stretched_swing(factor):
    joints = swing(PANDA)
    return trajectory(PANDA, joints.time / factor, joints.position)


class NotANumber(Bullet):
    def inverse_dynamics(self, *state):
        self.calls = getattr(self, "calls", 0) + 1
        return super().inverse_dynamics(*state) * (np.nan if self.calls > 500 else 1.0)


class WrongTool(Bullet):
    def tool_pose(self):
        pose = super().tool_pose()
        pose[0, 3] += 1e-3
        return pose


class Lighter(Bullet):
    def inverse_dynamics(self, *state):
        return 0.999 * super().inverse_dynamics(*state)


def impossible_inertia():
    arm = Arm.from_urdf(PENDULUM.format(ixx=1.0), base="base", tip="rod")  # 0.03 + 0.03 < 1.0
    return run(reach(arm, [0.5]), arm)


def weak():
    return run(arm=PANDA.with_limits(effort=[87.0, 20.0, 87.0, 87.0, 12.0, 12.0, 12.0]))


def narrow():
    return run(arm=PANDA.with_limits(upper=PANDA.upper - [2.8, 0, 0, 0, 0, 0, 0]))


def too_fast():
    return run(reach(PANDA, np.add(HOME["panda"], [1.2, 0, 0, 0, 0, 0, 0]), 0.8))


def too_sudden():
    return run(reach(PANDA, np.add(HOME["panda"], [0.0, 0.3, 0, 0, 0, 0, 0]), 0.4))  # 10.8 rad/s^2; Franka allows 7.5


def too_jerky():
    return run(arm=PANDA.with_limits(jerk=[1.0] * 7))


def too_fast_a_tool():
    return run(arm=PANDA.with_limits(tool_speed=0.05))


HEAVY = Disturbance(payload=3.0)
SOFT = {"kp": 100.0, "kd": 20.0}
FAULTS = {
    "tracking_position_rmse": lambda: run(disturbance=HEAVY, **SOFT),
    "tracking_position_max": lambda: run(disturbance=HEAVY, **SOFT),
    "tracking_angle_rmse": lambda: run(disturbance=HEAVY, **SOFT),
    "tracking_angle_max": lambda: run(disturbance=HEAVY, **SOFT),
    "settle_error": lambda: run(disturbance=HEAVY, **SOFT),
    "torque_ratio": weak,
    "torque_clipped": weak,
    "velocity_ratio": too_fast,
    "acceleration_ratio": too_sudden,
    "jerk_ratio": too_jerky,
    "joint_margin": narrow,
    "self_collision": lambda: run(reach(PANDA, FOLDED, 2.0)),
    "floor_contact": lambda: run(reach(PANDA, LOW, 2.0)),
    "object_contact": lambda: run(simulator=partial(Bullet, obstacles=[in_the_way()])),
    "ik_position_residual": lambda: with_residual("position", 1e-4),
    "ik_angle_residual": lambda: with_residual("angle", 1e-3),
    "inertia": impossible_inertia,
    "finite": lambda: run(simulator=NotANumber),
    "kinematics_mismatch": lambda: run(simulator=WrongTool),
    "dynamics_mismatch": lambda: run(simulator=Lighter),
}
WITHOUT_A_MOMENT = {"tracking_position_rmse", "tracking_angle_rmse", "dynamics_mismatch"}


@pytest.fixture(scope="module")
def sound():
    return with_residual("position", 0.0)


IN_BULLET = {"object_contact", "finite", "kinematics_mismatch"}  # its obstacles, or a class derived from it


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_of_each_kind_is_caught_with_its_value_limit_unit_and_moment(name, sound):
    if name in IN_BULLET:
        pytest.importorskip("pybullet", reason="the extra `sim`")
    assert sound.verdict[name].ok
    log = FAULTS[name]()
    check = log.verdict[name]
    assert not check.ok
    assert not log.verdict.ok
    assert check.result == (
        "not judged" if name == "inertia" else "fails"
    )  # nobody knows the inertia of an impossible one
    if name == "inertia":
        return
    beyond = check.value < check.limit if name == "joint_margin" else check.value > check.limit
    assert beyond
    assert check.unit in {"m", "rad", "1", "steps", "links"}
    if name not in WITHOUT_A_MOMENT:
        assert log.time[0] <= check.time <= log.time[-1]
    json.dumps(check.to_dict(), allow_nan=False)


def test_there_is_a_fault_for_every_check(sound):
    assert {check.name for check in sound.verdict.checks} == set(FAULTS)


def test_a_sound_run_of_either_engine_fails_nothing(sound):
    assert sound.verdict.failed == ()
    pytest.importorskip("mujoco")
    assert run(simulator=MuJoCo).verdict.failed == ()


def test_the_acceleration_that_was_too_much_is_named_and_measured():
    check = too_sudden().verdict["acceleration_ratio"]
    assert check.value == pytest.approx(10 / np.sqrt(3) * 0.3 / 0.4**2 / 7.5, rel=1e-3)  # of a minimum-jerk reach
    assert check.detail == "panda_joint2"


@pytest.mark.usefixtures("needs_bullet")
def test_an_obstacle_that_is_hit_is_named():
    check = FAULTS["object_contact"]().verdict["object_contact"]
    assert "crate" in check.detail and "mm deep" in check.detail


# ---- before execution -------------------------------------------------------------------------------------------


@pytest.fixture(params=["bullet", "mujoco"])
def engine(request):
    pytest.importorskip({"bullet": "pybullet", "mujoco": "mujoco"}[request.param])
    return simulation.ENGINES[request.param]


def path(joints, engine, tolerances=None, **world):
    checks = simulation.path_checks(PANDA, joints, tolerances, simulator=partial(engine, **world))
    return {check.name: check for check in checks}


def test_a_free_path_has_its_clearances_stated(engine):
    found = path(swing(PANDA), engine)
    assert set(found) == {"path_self_clearance", "path_floor_clearance"}
    assert all(check.ok and 0.0 < check.value < 0.3 for check in found.values())


@pytest.mark.parametrize("kind, target", [("self", FOLDED), ("floor", LOW)])
def test_a_path_into_itself_or_the_floor_is_seen_before_it_is_executed(engine, kind, target):
    check = path(reach(PANDA, target, 2.0), engine)[f"path_{kind}_clearance"]
    assert not check.ok
    assert check.value < 0.0
    assert check.time > 1.0


def test_a_path_through_an_obstacle_is_seen_and_one_beside_it_measured(engine):
    joints = swing(PANDA)
    through = path(joints, engine, obstacles=[in_the_way()])["path_object_clearance"]
    assert not through.ok and "crate" in through.detail
    assert through.time == pytest.approx(0.5, abs=0.3)
    highest = max(PANDA.forward_kinematics(q)[2, 3] for q in joints.position)
    above = in_the_way((0.3, 0.0, highest + 0.5))
    beside = path(joints, engine, obstacles=[above])["path_object_clearance"]
    assert beside.ok and beside.value > 0.1


def test_a_clearance_to_the_floor_is_the_height_of_the_lowest_point(engine):
    joints = swing(PANDA)
    low = path(joints, engine, floor=0.0)["path_floor_clearance"]
    lower = path(joints, engine, floor=-0.1)["path_floor_clearance"]
    assert lower.value - low.value == pytest.approx(0.1, abs=1e-3)


def test_more_distance_can_be_asked_for(engine):
    found = path(swing(PANDA), engine, PathTolerances(floor_clearance=0.5))
    assert not found["path_floor_clearance"].ok
    assert found["path_self_clearance"].ok
    assert isinstance(found["path_floor_clearance"], Check)


@pytest.mark.parametrize("wrong", [{"size": (0.1, 0.0, 0.1)}, {"centre": (0.0, np.nan, 0.0)}, {"size": (1.0, 1.0)}])
def test_a_box_that_is_none_is_refused(wrong):
    with pytest.raises(InvalidArgument, match="of box 'crate'"):
        Box(**{"name": "crate", "size": (0.1, 0.1, 0.1), "centre": (0.0, 0.0, 0.0), **wrong})


@pytest.mark.parametrize("names", [["floor"], ["panda_link3"], ["crate", "crate"]])
def test_a_box_with_the_name_of_something_else_is_refused(engine, names):
    boxes = [Box(name, (0.1, 0.1, 0.1), (2.0, k, 0.5)) for k, name in enumerate(names)]
    with pytest.raises(InvalidArgument, match=rf"obstacles\[{len(names) - 1}\].name: '{names[-1]}' is a link"):
        engine(PANDA, 1e-3, obstacles=boxes)
