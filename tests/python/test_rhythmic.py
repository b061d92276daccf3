"""Rhythmic motions from Python: found in a recording, learned, led for some cycles from rest to rest."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import InvalidArgument, motion, planning, so3
from dmpcpp.recordings import Recording

PERIOD = 1.2


def stirring(duration: float = 9.0, rate: float = 100.0, wander: float = 0.1) -> tuple[np.ndarray, np.ndarray]:
    """Times and poses of a hand that stirs, its tempo wandering, turning about the vertical."""
    time = np.arange(int(duration * rate) + 1) / rate
    phase = 2 * np.pi * (time / PERIOD + wander * np.sin(0.8 * time))
    poses = np.tile(np.eye(4), (len(time), 1, 1))
    poses[:, :3, :3] = [so3.exp([0.1 * np.cos(p), 0.1 * np.sin(p), 0.3 * np.sin(p)]) for p in phase]
    poses[:, :3, 3] = np.c_[0.45 + 0.05 * np.cos(phase), 0.05 * np.sin(phase), 0.3 + 0.01 * np.sin(2 * phase)]
    return time, poses


@pytest.fixture(scope="module")
def found():
    return dmpcpp.find_cycle(dmpcpp.PoseDemonstration(*stirring()))


@pytest.fixture(scope="module")
def model(found):
    return dmpcpp.PoseDmp.fit(found.demonstration, motion="rhythmic")


def test_the_cycle_and_its_period_are_found(found):
    assert found.period == pytest.approx(PERIOD, rel=0.1)
    assert len(found.lengths) >= 6 and found.lengths.std() > 0.02
    assert found.unexplained < 0.02
    np.testing.assert_array_equal(found.demonstration.pose[0], found.demonstration.pose[-1])
    radius = np.linalg.norm(found.demonstration.pose[:, :2, 3] - [0.45, 0.0], axis=1)
    np.testing.assert_allclose(radius, 0.05, atol=1e-3)


def test_a_model_goes_round_and_says_so(model, tmp_path):
    assert model.options.motion is dmpcpp.Motion.rhythmic
    first, later = (model.rollout_at([t, t + 0.3]) for t in (0.0, 4 * model.duration))
    np.testing.assert_allclose(first.pose, later.pose, atol=1e-5)
    dmpcpp.save(model, tmp_path / "stir.json")
    again = dmpcpp.load(tmp_path / "stir.json")
    assert again.options == model.options and dmpcpp.to_json(again) == dmpcpp.to_json(model)


def test_tempo_amplitude_and_centre_change_on_the_way(model):
    run = dmpcpp.PoseRun(model)
    run.step(0.5)
    run.amplitude, run.duration = 0.5, 0.6
    centre = model.goal.copy()
    centre[0, 3] += 0.1
    run.goal = centre
    run.step(3.0)
    radii = []
    for _ in range(60):
        assert run.step(0.01)
        radii.append(np.linalg.norm(run.position[:2] - centre[:2, 3]))
    np.testing.assert_allclose(radii, 0.025, atol=1e-3)
    assert run.amplitude == 0.5
    for value in (-1.0, np.nan, np.inf):
        with pytest.raises(InvalidArgument, match="amplitude"):
            run.amplitude = value


def test_cycles_go_from_rest_to_rest_on_the_path(model):
    led = planning.Cycles(model, 4)
    moved = led.rollout(dt=1e-3)
    assert moved.time[-1] == pytest.approx(5 * model.duration, abs=1e-3)
    for end in (0, -1):
        np.testing.assert_allclose(moved.twist[end], 0, atol=1e-4)
        np.testing.assert_allclose(moved.acceleration[end], 0, atol=0.05)
    np.testing.assert_allclose(moved.pose[0], moved.pose[-1], atol=1e-3)
    between = np.gradient(moved.position, moved.time, axis=0)[5:-5]
    np.testing.assert_allclose(between, moved.twist[5:-5, :3], atol=1e-3)
    faster = np.gradient(moved.twist, moved.time, axis=0)[5:-5]
    np.testing.assert_allclose(faster, moved.acceleration[5:-5], atol=0.05)
    angle = np.unwrap(np.arctan2(moved.position[:, 1], moved.position[:, 0] - 0.45))
    assert abs(angle[-1] - angle[0]) == pytest.approx(4 * 2 * np.pi, abs=0.05)
    slow = led.rollout(duration=2 * led.duration, dt=2e-3)
    np.testing.assert_allclose(slow.pose, moved.pose, atol=1e-6)


def test_cycles_of_what_does_not_go_round_are_refused(model):
    time = np.linspace(0, 1, 50)
    poses = np.tile(np.eye(4), (50, 1, 1))
    poses[:, 0, 3] = time
    straight = dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses))
    with pytest.raises(InvalidArgument, match="discrete"):
        planning.Cycles(straight, 4)
    with pytest.raises(InvalidArgument, match="count: 1"):
        planning.Cycles(model, 1)
    with pytest.raises(InvalidArgument, match="via"):
        planning.Cycles(model, 3).rollout(via=[dmpcpp.Via(0.5, np.eye(4))])


def test_a_recording_becomes_one_cycle_and_says_how():
    time, poses = stirring()
    recording = Recording(time, poses[:, :3, 3], poses[:, :3, :3])
    cycle = motion.one_cycle(recording)
    assert len(cycle) == 201 and cycle.duration == pytest.approx(PERIOD, rel=0.1)
    assert "one cycle of 1." in cycle.history[-1] and "unexplained" in cycle.history[-1]


@pytest.mark.parametrize("kind", [dmpcpp.Demonstration, dmpcpp.OrientationDemonstration, dmpcpp.PoseDemonstration])
def test_what_has_no_period_is_refused(kind):
    time = np.linspace(0, 2, 200)
    rotation = np.array([so3.exp([0.5 * t, 0, 0]) for t in time])
    poses = np.tile(np.eye(4), (200, 1, 1))
    poses[:, :3, :3], poses[:, 0, 3] = rotation, time
    values = {
        dmpcpp.Demonstration: np.c_[time, time**2],
        dmpcpp.OrientationDemonstration: rotation,
        dmpcpp.PoseDemonstration: poses,
    }
    with pytest.raises(InvalidArgument, match="recording: .*Expected a motion that repeats"):
        dmpcpp.find_cycle(kind(time, values[kind]))


@pytest.mark.parametrize(("minimum_period", "harmonics"), [(-1.0, 8), (np.nan, 8), (0.0, 0), (0.0, 41)])
def test_options_of_a_search_are_checked(minimum_period, harmonics):
    with pytest.raises(InvalidArgument):
        dmpcpp.find_cycle(dmpcpp.PoseDemonstration(*stirring()), minimum_period, harmonics)


def test_a_cycle_that_does_not_close_is_refused_with_the_way_out():
    time, poses = stirring(1.0)
    with pytest.raises(InvalidArgument, match="find_cycle"):
        dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses), motion="rhythmic")


def test_an_arm_stirs_as_recorded_verified():
    pytest.importorskip("mujoco")
    from dmpcpp import arms, imitation

    time, poses = stirring(6.0, rate=60.0)
    recording = Recording(time, poses[:, :3, 3], poses[:, :3, :3], up_axis="z")
    run = imitation.imitate(recording, arms.find("panda"), cycles=3, simulator="mujoco")
    assert run.model.options.motion is dmpcpp.Motion.rhythmic
    assert run.ok, [check.name for check in run.failed]
    assert run.plan.time[-1] >= 3 * run.model.duration
