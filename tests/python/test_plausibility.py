"""What cannot be the motion of a hand is refused before anything is searched, and inspection says so."""

from pathlib import Path

import numpy as np
import pytest
from dmpcpp import InvalidArgument, imitation, inspection, motion, teaching
from dmpcpp.recordings import Recording
from scipy.spatial.transform import Rotation

from tests.python.command import run
from tests.python.motions import screw


def moving(extent=0.3, turn=0.4, rate=100.0, duration=2.0, frequency=0.5):
    """A hand that sways along x and turns about z."""
    time = np.arange(int(rate * duration) + 1) / rate
    sway = 0.5 - 0.5 * np.cos(2 * np.pi * frequency * time)
    position = np.c_[extent * sway, 0.0 * time, 0.0 * time]
    return Recording(time, position, Rotation.from_rotvec(np.outer(turn * sway, [0, 0, 1])).as_matrix(), body="hand")


def table(path, recording, unit=1.0):
    quaternion = Rotation.from_matrix(recording.rotation).as_quat()
    values = np.c_[recording.time, unit * recording.position, quaternion]
    np.savetxt(path, values, delimiter=",", header="time,x,y,z,qx,qy,qz,qw", comments="")
    return path


STILL = moving(0.5e-3, np.radians(0.3))
FAST = moving(60.0)  # 0.6 m taken for 60: cm read as m


def test_a_hand_that_moves_is_taken_as_it_is():
    assert motion.implausible(moving()) == ""
    assert motion.plausible(screw()).history == screw().history


@pytest.mark.parametrize(("extent", "turn"), [(2e-3, 0.0), (0.0, np.radians(1.0)), (3e-3, 0.3)])
def test_a_little_motion_or_a_little_turn_is_enough(extent, turn):
    assert motion.implausible(moving(extent, turn)) == ""


def at_rest(noise, seed=0, duration=20.0, rate=100.0):
    """A hand at rest as a tracker sees it: white noise [m] in the positions, a tenth of a degree a mm in the turns."""
    rng = np.random.default_rng(seed)
    time = np.arange(int(rate * duration)) / rate
    position = [0.4, 0.1, 0.9] + noise * rng.standard_normal((len(time), 3))
    turn = Rotation.from_rotvec(np.radians(100.0 * noise) * rng.standard_normal((len(time), 3)))
    return Recording(time, position, turn.as_matrix(), body="hand")


@pytest.mark.parametrize("noise", [3e-4, 1e-3, 3e-3])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_noise_is_no_motion(noise, seed):
    assert "stands still: it stays within" in motion.implausible(at_rest(noise, seed))


@pytest.mark.parametrize("noise", [3e-4, 1e-3, 3e-3])
def test_a_short_or_small_motion_shows_among_noise(noise):
    rest = at_rest(noise)
    push = 20 * noise * np.exp(-(((rest.time - 10.0) / 0.2) ** 2))
    pushed = rest.with_("", position=rest.position + np.outer(push, [1, 0, 0]))
    assert motion.implausible(pushed) == ""
    swaying = rest.with_("", position=rest.position + np.outer(7 * noise * np.sin(rest.time), [0, 1, 0]))
    assert motion.implausible(swaying) == ""
    turned = Rotation.from_rotvec(np.outer(np.radians(20.0) * np.sin(rest.time), [0, 0, 1])).as_matrix()
    assert motion.implausible(rest.with_("", rotation=turned @ rest.rotation)) == ""


def test_who_turns_on_the_spot_is_taken_with_a_warning():
    history = motion.plausible(moving(0.4e-3, 1.0)).history
    assert history[-1] == "WARNING: moves over 0.4 mm only and turns by 57 deg: is the unit of its lengths right?"
    assert motion.plausible(moving(2e-3, 1.0)).history == ()


def test_who_neither_moves_nor_turns_stands_still():
    with pytest.raises(InvalidArgument, match=r"'hand' stands still: .* over 0\.5 mm and turns by 0\.3 deg in 2 s"):
        motion.plausible(STILL)


def test_no_hand_covers_more_than_30_metres_a_second():
    with pytest.raises(InvalidArgument, match=r"moves at 9\d\.\d m/s from .* s, expected at most 30 m/s.*unit='cm'"):
        motion.plausible(FAST)


def test_a_wrong_rate_is_seen_even_of_a_motion_in_a_small_place():
    waving = moving(0.4, duration=20.0)
    fast = waving.with_("read at a hundred times its rate", time=waving.time / 100)
    assert "expected at most 30 m/s" in motion.implausible(fast)


def test_a_recording_shorter_than_the_window_is_judged_as_a_whole():
    assert "moves at" in motion.implausible(moving(3.0, rate=1000.0, duration=0.03, frequency=20.0))
    assert motion.implausible(moving(0.3, rate=1000.0, duration=0.03, frequency=20.0)) == ""


@pytest.mark.parametrize("k", [0, 1, 100, 199, 200])
def test_one_sample_elsewhere_is_no_speed(k):
    position = moving().position.copy()
    position[k] += 50.0
    assert motion.implausible(moving().with_("glitch", position=position)) == ""


def test_noise_at_a_high_rate_is_no_speed():
    hand = moving(rate=1000.0)
    noise = np.random.default_rng(0).normal(0.0, 5e-3, hand.position.shape)
    assert motion.implausible(hand.with_("noise", position=hand.position + noise)) == ""


def test_lost_samples_do_not_hide_what_is_there():
    for recording, said in ((STILL, "stands still"), (FAST, "moves at"), (moving(), "")):
        position, rotation = recording.position.copy(), recording.rotation.copy()
        position[40:60], rotation[40:60] = np.nan, np.nan
        found = motion.implausible(recording.with_("lost", position=position, rotation=rotation))
        assert said in found and bool(found) == bool(said)


@pytest.mark.parametrize(("recording", "message"), [(STILL, "stands still"), (FAST, "no hand moves so fast")])
def test_it_is_refused_before_it_is_placed_or_learned(recording, message, panda):
    def place(*_, **__):
        raise AssertionError("searched for a placement")

    for refused in (
        lambda: imitation.imitate(recording, panda, place=place),
        lambda: teaching.teach([moving(), recording]),
        lambda: teaching.placed([moving(), recording], panda),
    ):
        with pytest.raises(InvalidArgument, match=message):
            refused()


@pytest.mark.parametrize(("recording", "message"), [(STILL, "stands still"), (FAST, "no hand moves so fast")])
def test_inspection_calls_it_a_problem_and_the_command_names_its_options(recording, message, tmp_path):
    path = table(tmp_path / "a.csv", recording)
    found = inspection.inspect(path, unit="m", up_axis="z")
    assert not found.ok and any(message in problem for problem in found.problems)
    said = run("inspect", path, "--unit", "m", "--up", "z", cwd=tmp_path)
    assert said.returncode == 3 and message in said.stdout and "unit='" not in said.stdout
    arm = Path(__file__).parents[2] / "examples" / "arm.urdf"
    for command in (("imitate", "--arm", arm), ("fit",)):
        done = run(*command, path, "--unit", "m", cwd=tmp_path)
        assert done.returncode == 2 and message in done.stderr and "unit='" not in done.stderr


def test_the_unit_once_stated_the_same_file_is_ready(tmp_path):
    assert inspection.inspect(table(tmp_path / "a.csv", moving(), unit=100.0), unit="cm", up_axis="z").ok
