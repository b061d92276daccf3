"""A long recording cut where it rests, or into whole cycles."""

import re

import numpy as np
import pytest
from dmpcpp import motion
from dmpcpp.errors import InvalidArgument
from scipy.spatial.transform import Rotation

from tests.python.motions import reaches, screw


def test_the_speed_of_a_screw_is_its_closed_form():
    np.testing.assert_allclose(
        motion.speed(screw(spin=1.5), angle_weight=0.2), np.hypot(2.0, 0.1) + 0.2 * 1.5, rtol=2e-3
    )
    np.testing.assert_allclose(motion.speed(screw(spin=1.5), angle_weight=0.0), np.hypot(2.0, 0.1), rtol=2e-3)


def test_rests_cut_a_reach_and_its_return_apart():
    parts = motion.segments(reaches(3))
    assert len(parts) == 6
    starts = [float(part.history[-1].split(": ")[1].split(" ..")[0]) for part in parts]
    np.testing.assert_allclose(starts, [0.3, 1.8, 3.1, 4.6, 5.9, 7.4], atol=0.12)
    assert all(part.time[0] == 0.0 and 0.75 < part.duration < 1.0 for part in parts)
    assert parts[1].history[-1].startswith("segment 2 of 6 by speed: ")


def test_a_pause_shorter_than_stated_does_not_cut():
    assert len(motion.segments(reaches(3), pause=0.5)) == 4  # the rests at home are shorter, those away are not
    assert len(motion.segments(reaches(3), pause=0.7)) == 1
    assert motion.segments(reaches(3), shortest=5.0) == []


def test_cycles_are_whole_reaches_whatever_rests_within_them():
    parts = motion.cycles(reaches(4))
    assert len(parts) == 4
    for part in parts:
        assert 2.3 < part.duration < 2.6
        assert np.linalg.norm(part.position[[0, -1]], axis=1).max() < 0.01
        assert np.linalg.norm(part.position, axis=1).max() > 0.3
    assert parts[2].history[-1].startswith("cycle 3 of 4: ")


def test_cycles_without_a_rest_at_home_are_cut_at_the_slowest_moment():
    ellipse = screw(rate=100.0, duration=10.0)
    angle = 2 * np.pi * ellipse.time / 2.5
    round_ = np.column_stack([0.3 * (1 - np.cos(angle)), 0.1 * np.sin(angle), 0 * angle])
    parts = motion.cycles(ellipse.with_("", position=round_))
    assert len(parts) == 4
    np.testing.assert_allclose([part.duration for part in parts], 2.5, atol=0.02)


def test_an_excursion_without_return_is_no_cycle():
    assert len(motion.cycles(motion.crop(reaches(3), 0.0, 7.0))) == 2


def test_home_may_be_stated_where_the_recording_starts_elsewhere():
    late = motion.crop(reaches(4), 1.5, 11.0)
    assert len(motion.cycles(late, home=[0.0, 0.0, 0.0])) == 3


@pytest.mark.parametrize(("position", "angle"), [(2e-4, 0.05), (1e-3, 0.1), (3e-3, 0.3)])
@pytest.mark.parametrize("rate", [30.0, 100.0, 1000.0])
def test_noise_does_not_hide_the_rests(position, angle, rate):
    still = motion.resample(reaches(4), rate)
    random = np.random.default_rng(0)
    turn = Rotation.from_rotvec(random.normal(0.0, np.radians(angle), (len(still), 3)))
    noisy = still.with_(
        "noise added",
        position=still.position + random.normal(0.0, position, still.position.shape),
        rotation=(Rotation.from_matrix(still.rotation) * turn).as_matrix(),
    )
    for cut in (motion.segments, motion.cycles):
        expected, found = cut(still), cut(noisy)
        assert len(found) == len(expected)
        np.testing.assert_allclose([part.duration for part in found], [p.duration for p in expected], atol=0.2)
    kept = found[0]  # as recorded, not as filtered
    first = int(np.argmin(np.linalg.norm(noisy.position - kept.position[0], axis=1)))
    np.testing.assert_array_equal(noisy.position[first : first + len(kept)], kept.position)


def test_the_history_says_when_noise_was_taken_out_to_find_rests():
    noisy = reaches(4)
    noise = np.random.default_rng(0).normal(0.0, 1e-3, noisy.position.shape)
    part = motion.segments(noisy.with_("noise added", position=noisy.position + noise))[0]
    assert re.match(
        r"segment 1 of 8 by speed below [\d.]+ Hz, as noise of \S+ mm and .* deg per axis", part.history[-1]
    )


def test_a_hand_that_never_leaves_makes_no_cycle():
    still = reaches(1)
    still = still.with_("still", position=0 * still.position)
    assert motion.cycles(still) == []


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: motion.segments(screw(), rest=1.0), "rest: 1, expected a share of the peak below 1"),
        (lambda: motion.segments(screw(), rest=0.0), "rest: 0.0, expected a positive number"),
        (lambda: motion.cycles(screw(), home=[0.0, 1.0]), "home: "),
    ],
)
def test_options_without_sense_are_refused(call, message):
    with pytest.raises(InvalidArgument, match=message):
        call()
