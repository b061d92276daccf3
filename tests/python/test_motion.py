"""Cleaning and cutting: every step against a closed form or exact property, and its line in the history."""

import numpy as np
import pytest
from dmpcpp import motion, recordings
from dmpcpp.errors import InvalidArgument
from scipy.spatial.transform import Rotation

from tests.python.motions import angle_between, screw


def test_poses_are_homogeneous_matrices_of_rotation_and_position():
    recording = screw()
    pose = motion.poses(recording)
    assert pose.shape == (201, 4, 4)
    np.testing.assert_array_equal(pose[:, :3, :3], recording.rotation)
    np.testing.assert_array_equal(pose[:, :3, 3], recording.position)
    np.testing.assert_array_equal(pose[:, 3], np.tile([0.0, 0.0, 0.0, 1.0], (201, 1)))


def test_a_constant_spin_turns_by_the_same_angle_every_sample():
    np.testing.assert_allclose(motion.turn_angles(screw(spin=1.5)), 0.015, atol=1e-12)


def test_continuity_is_confirmed_in_the_history_and_a_jump_is_named():
    smooth = motion.continuous(screw(spin=np.radians(100.0)))
    assert smooth.history == ("orientation continuous: at most 1.0 deg a sample",)
    rotation = screw().rotation.copy()
    rotation[50:] = rotation[50:] @ Rotation.from_rotvec([0.0, 2.0, 0.0]).as_matrix()
    with pytest.raises(InvalidArgument, match=r"rotation\[50\]: turned by 114\.6 deg in 0\.01 s at 0\.5 s"):
        motion.continuous(screw().with_("broken", rotation=rotation))


def test_a_crop_keeps_both_ends_and_counts_time_anew():
    recording = screw()
    cut = motion.crop(recording, 0.3, 0.7)
    assert len(cut) == 41
    assert cut.time[0] == 0.0
    np.testing.assert_array_equal(cut.position, recording.position[30:71])
    assert cut.history == ("cropped to 0.3 .. 0.7 s",)


@pytest.mark.parametrize(
    ("start", "end", "message"),
    [
        (0.7, 0.3, r"0\.7 \.\. 0\.3 s, expected a start before the end"),
        (0.3, 0.35, r"6 samples within 0\.3 \.\. 0\.35 s, expected at least 8; the recording lasts 2 s"),
        (5.0, 6.0, "0 samples within 5 .. 6 s"),
        (np.nan, 1.0, "expected a start before the end"),
    ],
)
def test_a_crop_that_leaves_nothing_is_refused(start, end, message):
    with pytest.raises(InvalidArgument, match=message):
        motion.crop(screw(), start, end)


def test_resampling_follows_the_motion_between_the_samples():
    coarse, fine = screw(rate=50.0), screw(rate=1000.0)
    resampled = motion.resample(coarse, 1000.0)
    np.testing.assert_allclose(resampled.time, fine.time, atol=1e-12)
    np.testing.assert_allclose(resampled.position, fine.position, atol=2e-6)
    assert angle_between(resampled.rotation, fine.rotation) < 1e-9
    assert resampled.history == ("resampled from 50 to 1000 Hz",)


def test_resampling_to_its_own_rate_changes_nothing():
    recording = screw()
    again = motion.resample(recording, 100.0)
    np.testing.assert_allclose(again.position, recording.position, atol=1e-12)
    assert angle_between(again.rotation, recording.rotation) < 1e-7


def test_resampling_evens_out_irregular_times():
    recording = screw(rate=200.0)
    kept = np.sort(np.random.default_rng(3).permutation(401)[:250])
    kept[0] = 0
    uneven = recording.with_(
        "thinned",
        time=recording.time[kept],
        position=recording.position[kept],
        rotation=recording.rotation[kept],
    )
    even = motion.resample(uneven, 100.0)
    np.testing.assert_allclose(np.diff(even.time), 0.01, atol=1e-12)
    np.testing.assert_allclose(even.position[:, 0], np.sin(2 * even.time), atol=1e-5)


@pytest.mark.parametrize("rate", [0.0, -3.0, np.nan, np.inf, 2.0, 1e9])
def test_a_rate_without_sense_is_refused(rate):
    with pytest.raises(InvalidArgument, match="rate: "):
        motion.resample(screw(), rate)


def test_the_low_pass_damps_by_the_butterworth_gain_squared_and_without_delay():
    time = np.arange(1001) / 100.0
    cutoff = 5.0
    for frequency in (1.0, 5.0, 10.0):
        wave = np.cos(2 * np.pi * frequency * time)
        recording = screw(duration=10.0).with_("waves", position=np.column_stack([wave, wave, wave]))
        filtered = motion.low_pass(recording, cutoff).position[300:700, 0]
        # bilinear transform: the digital filter's frequencies are tan-warped
        warped = np.tan(np.pi * frequency / 100.0) / np.tan(np.pi * cutoff / 100.0)
        np.testing.assert_allclose(filtered, wave[300:700] / (1.0 + warped**4), atol=1e-3)


def test_the_low_pass_keeps_rotations_proper_and_removes_their_noise():
    clean = screw(rate=100.0, duration=4.0)
    noise = Rotation.from_rotvec(np.random.default_rng(1).normal(0.0, 0.02, (len(clean), 3)))
    noisy = clean.with_("noise", rotation=clean.rotation @ noise.as_matrix())
    filtered = motion.low_pass(noisy, 4.0)
    middle = slice(50, -50)
    assert angle_between(filtered.rotation[middle], clean.rotation[middle]) < 0.35 * angle_between(
        noisy.rotation[middle], clean.rotation[middle]
    )


def test_the_low_pass_reports_the_rms_change():
    recording = screw()
    filtered = motion.low_pass(recording, 6.0)
    moved = np.sqrt(np.mean(np.sum((filtered.position - recording.position) ** 2, axis=1)))
    assert f"low-pass 6 Hz: positions changed by {1e3 * moved:.3g} mm rms" in filtered.history[-1]


def test_the_low_pass_wants_even_steps_enough_samples_and_a_cutoff_below_nyquist():
    recording = screw()
    with pytest.raises(InvalidArgument, match="cutoff: 50 Hz, expected less than half the rate of 100 Hz"):
        motion.low_pass(recording, 50.0)
    with pytest.raises(InvalidArgument, match="8 samples, a filter of order 2 needs more than 9"):
        motion.low_pass(motion.crop(recording, 0.0, 0.07), 5.0)
    kept = np.delete(np.arange(201), 77)
    gap = recording.with_(
        "gap", time=recording.time[kept], position=recording.position[kept], rotation=recording.rotation[kept]
    )
    with pytest.raises(InvalidArgument, match=r"time\[77\]: 20 ms after the sample before.*Resample first"):
        motion.low_pass(gap, 5.0)


def test_relative_motion_composes_back_to_the_motion_in_the_world():
    hand, chest = screw(spin=1.5), screw(spin=-0.7).with_("elsewhere", body="chest")
    local = motion.relative_to(hand, chest)
    np.testing.assert_allclose(motion.poses(chest) @ motion.poses(local), motion.poses(hand), atol=1e-12)
    assert local.history == ("relative to chest",)
    with pytest.raises(InvalidArgument, match="reference: its times"):
        motion.relative_to(hand, screw(rate=50.0))


def test_the_punch_in_the_chest_frame_stays_within_an_arms_length():
    pytest.importorskip("pybullet_data")
    hand, chest = recordings.clip("punch"), recordings.clip("punch", "chest")
    shoulder = np.array([-0.02405, 0.2435, 0.18311])
    reach = np.linalg.norm(motion.relative_to(hand, chest).position - shoulder, axis=1)
    assert 0.2 < reach.min() < reach.max() < 0.534


def test_history_grows_by_one_line_a_step():
    recording = motion.low_pass(motion.crop(motion.resample(screw(), 120.0), 0.2, 1.2), 8.0)
    assert [step.split()[0] for step in recording.history] == ["resampled", "cropped", "low-pass"]


def test_the_hand_held_camera_loses_little_but_noise(recorded):
    truth = recordings.load(recorded / "tum_evo" / "freiburg1_xyz-groundtruth.txt")
    with pytest.raises(InvalidArgument, match=r"time\[1018\]: 110\.1 ms after the sample before"):
        motion.low_pass(truth, 6.0)
    filtered = motion.low_pass(motion.resample(truth, 100.0), 6.0)
    assert "positions changed by 0.21 mm rms" in filtered.history[-1]


def test_refining_keeps_the_samples_and_fills_what_lies_far_apart():
    coarse, fine = screw(rate=20.0), screw(rate=1000.0)
    refined = motion.refine(coarse, distance=0.03, angle=0.05)
    assert set(coarse.time) <= set(refined.time)
    assert motion.turn_angles(refined).max() <= 0.05 + 1e-9
    assert np.linalg.norm(np.diff(refined.position, axis=0), axis=1).max() <= 0.031
    np.testing.assert_allclose(refined.position[:, 0], np.sin(2 * refined.time), atol=1e-4)
    assert refined.history == (f"refined from 41 to {len(refined)} samples",)
    assert len(motion.refine(fine, distance=1.0, angle=1.0)) == len(fine)
    with pytest.raises(InvalidArgument, match="distance: 0, expected a positive number"):
        motion.refine(coarse, distance=0, angle=0.1)


def test_a_recording_becomes_a_demonstration_to_learn_from():
    recording = screw()
    demonstration = motion.demonstration(recording)
    np.testing.assert_array_equal(demonstration.time, recording.time)
    np.testing.assert_allclose(demonstration.pose, motion.poses(recording), atol=1e-12)


def test_an_end_that_repeats_its_neighbour_in_motion_is_left_out_and_a_rest_is_kept():
    moving = screw()
    assert motion.without_repeated_ends(moving) is moving
    for end, name in ((0, "first"), (-1, "last")):
        position, rotation = moving.position.copy(), moving.rotation.copy()
        neighbour = 1 if end == 0 else -2
        position[end], rotation[end] = position[neighbour], rotation[neighbour]
        shown = moving.with_("shown twice", position=position, rotation=rotation)
        left = motion.without_repeated_ends(shown)
        assert len(left) == len(moving) - 1 and left.time[0] == 0.0
        assert left.history[-1].startswith(f"{name} sample left out")
    position, rotation = moving.position.copy(), moving.rotation.copy()
    position[-20:], rotation[-20:] = position[-20], rotation[-20]
    resting = moving.with_("rests", position=position, rotation=rotation)
    assert motion.without_repeated_ends(resting) is resting
