"""Rests before and behind a motion are found, named and left out; a gentle start is none; rest alone is refused."""

import numpy as np
import pytest
from dmpcpp import learning, motion, recordings
from dmpcpp.errors import InvalidArgument
from dmpcpp.imitation._calmer import calmer
from dmpcpp.recordings import Recording
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation


def reach(before, duration, behind, *, rate=100.0, sigma=0.0, seed=0, turn=0.5, quantum=0.0):
    """A minimum-jerk reach of 0.39 m with rests, at even times."""
    rng = np.random.default_rng(seed)
    time = np.arange(round((before + duration + behind) * rate) + 1) / rate
    s = np.clip((time - before) / duration, 0.0, 1.0)
    course = (s**3 * (10.0 - 15.0 * s + 6.0 * s**2))[:, None]
    position = course * [0.3, -0.2, 0.15] + sigma * rng.normal(size=(len(time), 3))
    if quantum:
        position = np.round(position / quantum) * quantum
    turns = course * [0.0, 0.0, turn] + 3.0 * sigma * rng.normal(size=(len(time), 3))
    return Recording(time, position, Rotation.from_rotvec(turns).as_matrix())


@pytest.mark.parametrize("rate", [30.0, 60.0, 200.0])
@pytest.mark.parametrize(
    "kind", [{}, {"sigma": 1e-4}, {"sigma": 2e-3}, {"quantum": 1e-3}], ids=["clean", "0.1 mm", "2 mm", "rounded"]
)
def test_rests_are_measured_to_a_tenth_of_a_second(rate, kind):
    assert motion.rests(reach(0.0, 2.0, 0.0, rate=rate, **kind)) == (0.0, 0.0)
    assert motion.rests(reach(2.0, 2.0, 1.0, rate=rate, **kind)) == pytest.approx((2.0, 1.0), abs=0.1)
    assert motion.rests(reach(0.0, 2.0, 1.0, rate=rate, **kind)) == pytest.approx((0.0, 1.0), abs=0.1)


def test_a_slow_start_is_no_rest_however_long_the_motion_takes():
    assert motion.rests(reach(0.0, 60.0, 0.0, rate=30.0)) == (0.0, 0.0)


def test_a_turn_on_the_spot_is_a_motion():
    turning = reach(1.0, 2.0, 1.0)
    still = turning.with_("on the spot", position=np.zeros((len(turning), 3)))
    assert motion.rests(still) == pytest.approx((1.0, 1.0), abs=0.1)


def test_a_pause_in_the_middle_stays():
    there, back = reach(1.0, 1.0, 1.0), reach(0.0, 1.0, 1.0)
    position = np.concatenate([there.position, there.position[-1] - back.position[1:]])
    rotation = np.concatenate([there.rotation, there.rotation[-1] @ np.swapaxes(back.rotation[1:], 1, 2)])
    both = Recording(np.arange(len(position)) / 100.0, position, rotation)
    assert motion.rests(both) == pytest.approx((1.0, 1.0), abs=0.1)


def test_what_is_learned_begins_and_ends_with_the_motion_and_says_so():
    lesson = learning.teach([reach(2.0, 2.0, 1.0, sigma=5e-4)])
    assert 2.0 < lesson.model.duration < 2.4
    history = " ".join(lesson.recordings[0].history)
    assert "rests of" in history and "before and" in history and "behind the motion left out" in history
    assert lesson.model.options.basis_count <= 50 and lesson.ok
    ((position, orientation),) = lesson.fit.ends  # as calm as the samples
    assert 0.0 < position.start < position.start_samples and 0.0 < orientation.goal < orientation.goal_samples
    assert lesson.summary()["fit"]["ends"][0][0]["goal"] == position.goal
    velocity = lesson.model.rollout().twist
    assert np.linalg.norm(velocity[0, :3]) < 0.05 * np.linalg.norm(velocity[:, :3], axis=1).max()
    whole = learning.teach([reach(2.0, 2.0, 1.0, sigma=5e-4)], keep_rests=True)
    assert whole.model.duration == pytest.approx(5.0)


def test_noise_that_wanders_is_taken_out_while_the_rest_still_shows_it():
    clean = reach(1.5, 3.0, 1.5, rate=60.0)
    band = butter(2, [3.0, 8.0], "bandpass", fs=60.0, output="sos")
    wobble = sosfiltfilt(band, np.random.default_rng(1).normal(size=(len(clean), 3)), axis=0)
    wobble *= 3e-3 / wobble.std()
    shown = clean.with_("as a tracker shows it", position=clean.position + wobble)
    settled = motion.without_rests(shown)
    assert "wanders" in " ".join(settled.history) and settled.duration < 4.0
    assert motion.without_rests(shown, smooth=False).duration > settled.duration
    first = next(float(line.split("rests of ")[1].split(" s")[0]) for line in settled.history if "rests of" in line)
    begin = round(60.0 * (first - 0.1))
    away = [
        np.sqrt(np.mean((settled.position - clean.position[k : k + len(settled)]) ** 2))
        for k in range(begin - 6, begin + 7)
    ]
    assert min(away) < 1.5e-3  # to the two digits that the history says


@pytest.mark.parametrize("samples", [8, 12, 30, 100, 1000, 20000])
@pytest.mark.parametrize("sigma", [0.0, 1e-4, 1e-3])
def test_a_recording_that_is_only_rest_is_refused_whatever_its_length(samples, sigma):
    for seed in range(3):
        still = reach(samples / 100.0, 1.0, 0.0, sigma=sigma, seed=seed).part(slice(0, samples), "its rest")
        with pytest.raises(InvalidArgument, match="stands still"):
            learning.learnable(still)


def test_samples_that_were_filled_in_are_known_to_the_fit():
    shown = reach(0.0, 3.0, 0.0, sigma=1e-3)
    lost = np.zeros(len(shown), dtype=bool)
    lost[np.random.default_rng(2).choice(np.arange(3, len(shown) - 3), 30, replace=False)] = True
    position, rotation = shown.position.copy(), shown.rotation.copy()
    position[lost], rotation[lost] = np.nan, np.nan
    filled = motion.prepare(shown.with_("lost", position=position, rotation=rotation))
    assert np.array_equal(~filled.measured, lost)
    found = motion.demonstration(filled).noise_estimates()[0]
    assert found.measured == len(shown) - lost.sum()
    assert found.sigma == pytest.approx(1e-3, rel=0.15)
    twice = motion.resample(filled, 200.0)
    assert 0.05 < np.mean(~twice.measured) < 0.15
    assert motion.crop(filled, 0.5, 2.0).measured.sum() == (~lost[50:201]).sum()
    with pytest.raises(InvalidArgument, match=r"measured: shape \(2,\)"):
        shown.with_("wrong", measured=np.ones(2, dtype=bool))


def wobbling(kind=""):
    """A reach of 3 s at 60 Hz with 4 mm of wobble at 5 to 8 Hz, and no rest that shows it."""
    clean = reach(0.0, 3.0, 0.0, rate=60.0)
    band = butter(2, [5.0, 8.0], "bandpass", fs=60.0, output="sos")
    wobble = sosfiltfilt(band, np.random.default_rng(1).normal(size=(len(clean), 3)), axis=0)
    return clean, clean.with_("wobbles", position=clean.position + 4e-3 * wobble / wobble.std(), kind=kind)


@pytest.mark.parametrize("kind", ["tracker", "video"])
def test_what_a_tracker_or_a_video_shows_above_4_hz_is_left_out_and_said(kind):
    clean, shown = wobbling(kind)
    prepared = motion.prepare(shown)
    assert np.sqrt(np.mean((prepared.position - clean.position) ** 2)) < 2e-3
    assert f"recorded by a {kind}" in " ".join(prepared.history)
    for how in ({"keep_noise": True}, {"kind": "capture"}, {"low_pass": 20.0}):
        kept = motion.prepare(shown, motion.Preparation(outliers=False, **how))
        assert np.sqrt(np.mean((kept.position - shown.position) ** 2)) < 1e-3
    same = motion.prepare(wobbling()[1], motion.Preparation(kind=kind))
    np.testing.assert_allclose(same.position, prepared.position)
    with pytest.raises(InvalidArgument, match="kind: 'film', expected capture, tracker, video"):
        shown.with_("wrong", kind="film")


def test_a_motion_that_is_slow_for_its_wobble_is_told_the_option_with_both_durations():
    _, shown = wobbling()
    learned = motion.demonstration(shown)
    found = calmer(shown, learned, 5.0, lambda model: 2.0 * model.duration)
    assert found.sharpness > 3.0 and found.duration == pytest.approx(15.0) and found.instead == pytest.approx(6.0)
    assert "Executed in 15 s; low_pass=4 makes it 6 s" in found.describe()
    assert calmer(shown, learned, 2.9, lambda model: 1.0) is None
    assert calmer(shown, learned, 5.0, lambda model: 99.0) is None
    calm = reach(0.0, 3.0, 0.0, rate=60.0)
    assert calmer(calm, motion.demonstration(calm), 5.0, lambda model: 1.0) is None


def test_poses_found_in_a_video_say_so_by_their_header(tmp_path):
    rows = [f"{k},{0.1 + 0.001 * k},{0.2},{0.3},1" for k in range(40)]
    names = ["scorer,net,net,net,net", "bodyparts,hand,hand,hand,hand", "coords,x,y,z,likelihood"]
    path = tmp_path / "poses.csv"
    path.write_text("\n".join([*names, *rows]))
    found = recordings.load(
        path, rate=30.0, fixed_orientation=True, unit="m", columns={"x": "hand_x", "y": "hand_y", "z": "hand_z"}
    )
    assert found.kind == "video"
