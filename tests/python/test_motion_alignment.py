"""Demonstrations brought to one tempo, their mean on SE(3) and their spread."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import motion, recordings
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings import Recording
from scipy.spatial.transform import Rotation

from tests.python.motions import angle_between, screw


def gesture(tempo: float, duration: float = 2.0, offset: float = 0.0, count: int = 201) -> Recording:
    """One shape, gone through at an uneven tempo."""
    share = np.linspace(0.0, 1.0, count)
    at = share + tempo * np.sin(2 * np.pi * share) / (2 * np.pi)
    return Recording(
        time=duration * share,
        position=np.column_stack([0.3 * np.sin(4 * at), 0.2 * np.cos(5 * at) + offset, 0.3 * at]),
        rotation=Rotation.from_rotvec(np.outer(at, [0.5, -1.0, 2.0])).as_matrix(),
    )


def test_different_tempi_of_one_shape_align_to_almost_nothing():
    apart = [gesture(0.5), gesture(-0.4), gesture(0.0)]
    together = motion.aligned(apart)
    before, after = motion.spread(apart), motion.spread(together)
    assert before.position > 0.02
    assert after.position < 0.03 * before.position and after.angle < 0.03 * before.angle
    assert "aligned to their mean in 3 rounds, 3 recordings: " in together[0].history[-1]
    assert together[0].history[-2].startswith("warped in time: ")


def test_the_result_has_the_mean_duration_and_keeps_both_ends():
    apart = [gesture(0.3, duration=1.5), gesture(0.0, duration=2.5, count=251)]
    for recording, warped in zip(apart, motion.aligned(apart), strict=True):
        assert warped.duration == pytest.approx(2.0)
        np.testing.assert_allclose(warped.position[[0, -1]], recording.position[[0, -1]], atol=1e-9)
        assert angle_between(warped.rotation[[0, -1]], recording.rotation[[0, -1]]) < 1e-7


def test_a_reference_sets_the_tempo():
    reference = gesture(0.0)
    (warped,) = motion.aligned([gesture(0.5)], reference)
    assert np.linalg.norm(warped.position - reference.position, axis=1).max() < 3e-3
    assert "aligned to the reference" in warped.history[-1]


def test_warped_motions_stay_smooth():
    def roughness(recording):
        return np.abs(np.diff(recording.position, n=2, axis=0)).max()

    together = motion.aligned([gesture(0.4), gesture(-0.4)])
    assert max(map(roughness, together)) < 4 * roughness(gesture(0.4))


def test_the_medoid_is_the_one_in_the_middle():
    assert motion.medoid([gesture(0.0, offset=0.1), gesture(0.2), gesture(0.0, offset=-0.15)]) == 1


def test_the_mean_of_positions_and_rotations_is_the_closed_form():
    up, down = screw(), screw()
    lift = Rotation.from_rotvec([0.0, 0.4, 0.0]).as_matrix()
    up = up.with_("", position=up.position + 0.01, rotation=up.rotation @ lift)
    down = down.with_("", position=down.position - 0.01, rotation=down.rotation @ lift.T)
    middle = motion.mean([up, down])
    np.testing.assert_allclose(middle.position, screw().position, atol=1e-14)
    assert angle_between(middle.rotation, screw().rotation) < 1e-7
    found = motion.spread([up, down])
    assert found.position == pytest.approx(0.01 * np.sqrt(3))
    assert found.angle == pytest.approx(0.4)
    assert middle.history[-1] == "mean of 2 recordings: 17.3 mm and 22.9 deg rms from their mean"


def test_the_mean_rotation_leaves_no_mean_rotation_vector():
    one = screw(duration=0.2)
    random = np.random.default_rng(2)
    scattered = [
        one.with_("", rotation=one.rotation @ Rotation.from_rotvec(random.normal(0, 0.7, (21, 3))).as_matrix())
        for _ in range(5)
    ]
    middle = Rotation.from_matrix(motion.mean(scattered).rotation)
    residual = np.mean([(middle.inv() * Rotation.from_matrix(s.rotation)).as_rotvec() for s in scattered], axis=0)
    assert np.abs(residual).max() < 1e-9


def test_quaternions_have_one_sign_within_and_across_recordings():
    turns = [screw(spin=9.0), screw(spin=-9.0), screw(spin=0.5)]
    for quaternion, recording in zip(motion.quaternions(*turns), turns, strict=True):
        assert (np.einsum("ij,ij->i", quaternion[1:], quaternion[:-1]) > 0).all()
        assert angle_between(Rotation.from_quat(quaternion).as_matrix(), recording.rotation) < 1e-7
    starts = [quaternion[0] for quaternion in motion.quaternions(*turns)]
    assert all(start @ starts[0] > 0 for start in starts)


def test_only_recordings_of_the_same_times_have_a_mean():
    with pytest.raises(InvalidArgument, match=r"recordings\[1\]: its times are not those of recordings\[0\]"):
        motion.mean([screw(), screw(rate=50.0)])
    for call in (motion.mean, motion.aligned, motion.medoid):
        with pytest.raises(InvalidArgument, match="recordings: none"):
            call([])
    with pytest.raises(InvalidArgument, match="rounds: 0"):
        motion.aligned([screw()], rounds=0)


def test_smoothing_takes_white_noise_out_and_says_how_much_there_was():
    random = np.random.default_rng(8)
    clean = screw(duration=4.0)
    noisy = clean.with_(
        "",
        position=clean.position + random.normal(0, 1e-3, clean.position.shape),
        rotation=clean.rotation @ Rotation.from_rotvec(random.normal(0, 0.01, (401, 3))).as_matrix(),
    )
    found = motion.noise(noisy)
    assert found.position == pytest.approx(1e-3, rel=0.15)
    assert found.angle == pytest.approx(0.01, rel=0.15)
    calm = motion.smooth(noisy)
    assert np.std(calm.position - clean.position) < 0.35e-3
    assert calm.history[-1].startswith(f"smoothed: noise of {found.describe()} found; positions changed by 1.")
    np.testing.assert_allclose(motion.demonstration(noisy).noise()[:3], 1e-3, rtol=0.2)


def test_the_noise_is_found_at_uneven_times_too_and_a_smooth_motion_has_none():
    random = np.random.default_rng(9)
    time = np.concatenate([[0.0], np.cumsum(random.uniform(0.005, 0.02, 600))])
    clean = Recording(
        time=time,
        position=np.column_stack([np.sin(2 * time), np.cos(2 * time), 0.1 * time]),
        rotation=Rotation.from_rotvec(np.outer(time, [1.5, 0.0, 0.0])).as_matrix(),
    )
    assert motion.noise(clean).position < 1e-9 and motion.noise(clean).angle < 1e-9
    noisy = clean.with_(
        "",
        position=clean.position + random.normal(0, 2e-3, (601, 3)),
        rotation=clean.rotation @ Rotation.from_rotvec(random.normal(0, 0.02, (601, 3))).as_matrix(),
    )
    assert motion.noise(noisy).position == pytest.approx(2e-3, rel=0.15)
    assert motion.noise(noisy).angle == pytest.approx(0.02, rel=0.15)


def test_a_fixed_frame_is_a_moving_one_that_stands_still():
    recording = screw()
    frame = np.eye(4)
    frame[:3, :3] = Rotation.from_rotvec([0.3, 0.1, -0.4]).as_matrix()
    frame[:3, 3] = [1.0, 2.0, 3.0]
    stands = recording.with_("", position=np.tile(frame[:3, 3], (201, 1)), rotation=np.tile(frame[:3, :3], (201, 1, 1)))
    local = motion.relative_to_pose(recording, frame, "the table")
    moving = motion.relative_to(recording, stands)
    np.testing.assert_allclose(local.position, moving.position, atol=1e-12)
    np.testing.assert_allclose(local.rotation, moving.rotation, atol=1e-12)
    assert local.history == ("relative to the table",) and local.up_axis is None
    with pytest.raises(InvalidArgument, match=r"pose: shape \(3, 3\)"):
        motion.relative_to_pose(recording, np.eye(3))
    with pytest.raises(InvalidArgument, match="pose: its rotation is not proper"):
        motion.relative_to_pose(recording, -np.eye(4))


def test_nine_pourings_come_within_25_mm_of_their_mean(recorded):
    pourings = [
        recordings.load(recorded / "robotasks_clfd" / "pouring.npy", rate=100, quat_order="wxyz", unit="cm", index=k)
        for k in range(9)
    ]
    assert motion.spread(pourings).position == pytest.approx(34.9e-3, abs=0.05e-3)
    together = motion.aligned(pourings)
    assert motion.spread(together).position <= 25e-3
    dmpcpp.PoseDmp.fit([motion.demonstration(recording) for recording in together])
