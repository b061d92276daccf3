"""Lost samples and outliers: what is filled is close to the truth, what cannot be known is refused or cut out."""

import numpy as np
import pytest
from dmpcpp import motion, recordings
from dmpcpp.errors import InvalidArgument
from scipy.spatial.transform import Rotation

from tests.python.motions import angle_between, lose, screw


def test_a_recording_without_gaps_stays_as_it_is():
    recording = screw()
    assert motion.gaps(recording) == ()
    assert motion.fill(recording) is recording
    assert motion.split(recording) == [recording]


def test_a_short_gap_is_filled_close_to_the_truth_and_the_rest_is_untouched():
    truth = screw()
    filled = motion.fill(lose(truth, *range(50, 60), 120))
    np.testing.assert_array_equal(filled.time, truth.time)
    np.testing.assert_allclose(filled.position, truth.position, atol=2e-3)
    assert angle_between(filled.rotation, truth.rotation) < 1e-9
    kept = np.delete(np.arange(201), [*range(50, 60), 120])
    np.testing.assert_array_equal(filled.position[kept], truth.position[kept])
    assert filled.history[-1] == "2 gaps filled with 11 samples; the longest, 0.11 s, at 0.49 s"


def test_samples_that_were_never_written_are_a_gap_too():
    truth = screw()
    kept = np.delete(np.arange(201), range(50, 60))
    sparse = truth.with_("", time=truth.time[kept], position=truth.position[kept], rotation=truth.rotation[kept])
    (gap,) = motion.gaps(sparse)
    assert (gap.first, gap.last, gap.start, gap.end) == (49, 50, 0.49, 0.6)
    filled = motion.fill(sparse)
    np.testing.assert_allclose(filled.time, truth.time, atol=1e-12)
    np.testing.assert_allclose(filled.position, truth.position, atol=2e-3)


def test_a_long_gap_is_refused_with_its_time_and_cut_out_by_split():
    truth = screw()
    broken = lose(truth, *range(80, 110), 150)
    with pytest.raises(
        InvalidArgument, match=r"position\[80\]: missing from 0\.79 to 1\.1 s, 0\.31 s, expected gaps of at most 0\.2 s"
    ):
        motion.fill(broken)
    assert not motion.fill(broken, longest=0.4).missing.any()
    first, second = motion.split(broken)
    np.testing.assert_array_equal(first.position, truth.position[:80])
    np.testing.assert_array_equal(second.position[:40], truth.position[110:150])
    assert second.time[0] == 0.0 and len(second) == 91 and not second.missing.any()
    assert second.history[-2] == "split at 1 gaps longer than 0.2 s: from 1.1 s"


def test_parts_too_short_to_be_a_motion_are_left_out_and_told():
    parts = motion.split(lose(screw(), *range(30, 60), *range(65, 100)))
    assert [len(part) for part in parts] == [30, 101]
    assert "1 of fewer than 8 samples left out" in parts[0].history[-1]


def test_missing_ends_are_cut_off_not_invented():
    filled = motion.fill(lose(screw(), 0, 1, 2, 199, 200))
    assert len(filled) == 196 and filled.time[0] == 0.0
    assert filled.history[-1] == "5 missing samples cut off the ends: from 0.03 s"
    with pytest.raises(InvalidArgument, match="7 known samples, expected at least 8"):
        motion.fill(lose(screw(), *range(7, 201)))


@pytest.mark.parametrize(
    "step",
    [
        motion.poses,
        motion.demonstration,
        motion.continuous,
        motion.quaternions,
        motion.smooth,
        motion.speed,
        motion.cycles,
        motion.outliers,
        lambda r: motion.low_pass(r, 5.0),
        lambda r: motion.resample(r, 50.0),
        lambda r: motion.refine(r, 0.1, 0.1),
        lambda r: motion.relative_to(r, screw()),
        lambda r: motion.mean([r, r]),
        lambda r: motion.aligned([r, r]),
    ],
)
def test_every_other_step_asks_for_whole_recordings(step):
    with pytest.raises(
        InvalidArgument, match=r"position\[5\]: missing at 0\.05 s, one of 2 of 201 samples.*motion\.fill"
    ):
        step(lose(screw(), 5, 80))


def test_a_lost_sample_is_cropped_with_the_others():
    assert motion.crop(lose(screw(), 5), 0.2, 1.0).missing.sum() == 0


def spoiled(indices, by=0.05, turn=0.0):
    clean = screw(duration=3.0)
    noise = np.random.default_rng(5).normal(0.0, 2e-4, clean.position.shape)
    position, rotation = clean.position + noise, clean.rotation.copy()
    position[indices] += [0.0, by, 0.0]
    rotation[indices] = rotation[indices] @ Rotation.from_rotvec([0.0, turn, 0.0]).as_matrix()
    return clean.with_("spoiled", position=position, rotation=rotation)


@pytest.mark.parametrize("indices", [[40], [40, 41, 42], [10, 90, 200, 201], [5, 295]])
@pytest.mark.parametrize(("by", "turn"), [(0.05, 0.0), (-0.03, 0.0), (0.0, 0.2)])
def test_outliers_are_found_and_nothing_else(indices, by, turn):
    marked = motion.outliers(spoiled(indices, by, turn))
    assert np.flatnonzero(marked.missing).tolist() == indices
    assert f"{len(indices)} outliers taken out, the first at {indices[0] / 100:.4g} s" in marked.history[-1]
    filled = motion.fill(marked)
    assert np.abs(filled.position - screw(duration=3.0).position).max() < 2e-3


def test_a_motion_without_outliers_stays_as_it_is():
    clean = spoiled([])
    assert motion.outliers(clean) is clean


def test_people_have_no_outliers_where_recordings_are_good(recorded):
    pytest.importorskip("pybullet_data")
    for name in ("dance_b", "punch", "getup_faceup", "backflip", "cartwheel"):
        clip = recordings.clip(name)
        assert motion.outliers(clip) is clip
    for name in ("groundtruth", "rgbdslam"):
        camera = recordings.load(recorded / "tum_evo" / f"freiburg1_xyz-{name}.txt")
        assert motion.outliers(camera) is camera


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"half_width": 1}, "half_width: 1, expected 2 or more"),
        ({"half_width": 200}, "a window of 401 within 201 samples"),
        ({"threshold": 0.0}, "threshold: 0.0, expected a positive number"),
        ({"distance": np.nan}, "distance: nan"),
        ({"angle": -1.0}, "angle: -1.0"),
    ],
)
def test_options_of_outliers_without_sense_are_refused(options, message):
    with pytest.raises(InvalidArgument, match=message):
        motion.outliers(screw(), **options)


@pytest.mark.parametrize("longest", [0.0, -0.1, np.nan, np.inf])
@pytest.mark.parametrize("act", [motion.fill, motion.split])
def test_a_longest_gap_that_is_no_duration_is_refused(act, longest):
    with pytest.raises(InvalidArgument, match="longest: .* expected a positive"):
        act(lose(screw(), 10, 11), longest)
