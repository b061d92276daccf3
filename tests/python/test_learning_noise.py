"""Preparing and learning noisy recordings: what is taken out is told, and the noise found is what is judged by."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import learning, motion, teaching
from dmpcpp.errors import InvalidArgument
from dmpcpp.metrics import StageErrors
from dmpcpp.motion import Noise, Preparation, prepare

from tests.python.motions import lose, reaches, screw


def noisy(sigma: float):
    clean = reaches(1)
    return clean.with_("", position=clean.position + np.random.default_rng(4).normal(0.0, sigma, clean.position.shape))


def test_noise_is_smoothed_out_in_learning_and_clean_motions_are_not_touched():
    for sigma, derivatives in ((0.0, "interpolate"), (0.02e-3, "interpolate"), (0.3e-3, "smooth"), (2e-3, "smooth")):
        recording = noisy(sigma)
        model = learning.learn(motion.demonstration(recording), noise=motion.noise(recording))
        assert model.options.derivatives.name == derivatives
    errors = learning.reproduction(model, motion.demonstration(reaches(1)))
    assert errors.position_rmse < 2e-3  # of the truth: less than the noise of one axis


def test_noise_that_makes_the_accelerations_is_smoothed_out_however_small():
    """An arm can be as fast as the accelerations allow: noise of 0.2 mm would slow a calm reach down many times."""
    truth = motion.demonstration(reaches(1))
    recording = noisy(0.2e-3)
    found, demonstration = motion.noise(recording), motion.demonstration(recording)
    calm = learning.learn(demonstration, noise=found)
    shaken = learning.learn(demonstration, noise=found, smooth=False)
    peak = {
        name: np.abs(model.rollout(dt=0.01).acceleration[:, :3]).max()
        for name, model in (("calm", calm), ("shaken", shaken), ("true", learning.learn(truth)))
    }
    assert peak["calm"] < 1.5 * peak["true"]
    assert peak["shaken"] > 5.0 * peak["true"]
    assert learning.reproduction(calm, truth).position_rmse < 0.2e-3
    assert learning.learn(demonstration, 60, noise=found).options.derivatives.name == "smooth"


def test_several_takes_are_smoothed_if_one_of_them_has_to_be():
    clean = reaches(1)
    other = clean.with_(
        "", position=clean.position + np.random.default_rng(5).normal(0.0, 0.2e-3, clean.position.shape)
    )
    for takes in ((noisy(0.2e-3), other), (clean, other), (other, clean)):
        lesson = teaching.teach(takes)
        assert lesson.model.options.derivatives.name == "smooth"
        assert lesson.fit.rmse[:3].max() < 0.3e-3


def test_smoothing_can_be_forbidden():
    recording = noisy(2e-3)
    for count in (None, 100):
        model = learning.learn(motion.demonstration(recording), count, noise=motion.noise(recording), smooth=False)
        assert model.options.derivatives.name == "interpolate"


def test_a_reproduction_is_judged_by_the_noise_found_or_by_1_mm():
    errors = StageErrors(2.5e-3, 9e-3, 0.01, 0.05)
    position, angle = learning.reproduction_checks(errors, Noise(1e-3, 1e-4))
    assert position.ok and position.limit == pytest.approx(3e-3) and position.detail == "noise 1 mm"
    assert not angle.ok and angle.limit == pytest.approx(np.radians(0.5))
    position, angle = learning.reproduction_checks(errors, Noise(1e-4, 0.004))
    assert not position.ok and position.limit == 1e-3
    assert angle.ok and angle.limit == pytest.approx(0.012) and angle.detail == "noise 0.23 deg"


def test_noise_excuses_no_more_than_8_mm():
    position, angle = learning.reproduction_checks(StageErrors(9e-3, 9e-3, 0.03, 0.05), Noise(10e-3, 0.1))
    assert not position.ok and position.limit == pytest.approx(8e-3)
    assert not angle.ok and angle.limit == pytest.approx(np.radians(1.5))


def test_by_default_gaps_and_outliers_are_mended_and_nothing_else():
    recording = screw()
    assert prepare(recording) is recording
    position = recording.position.copy()
    position[100] += 0.2
    mended = prepare(lose(recording.with_("hit", position=position), 50, 51))
    np.testing.assert_allclose(mended.position, recording.position, atol=1e-3)
    assert [line.split(" ")[1] for line in mended.history[2:]] == ["gaps", "outliers", "gaps"]
    kept = prepare(recording.with_("hit", position=position), Preparation(outliers=False))
    np.testing.assert_array_equal(kept.position, position)


def test_every_step_of_a_preparation_stands_in_the_history_in_order():
    how = Preparation(start=0.1, end=11.0, repetition=2, resample=50.0, low_pass=8.0, smooth=True)
    prepared = prepare(reaches(4), how)
    assert [line.split(" ")[0] for line in prepared.history] == [
        "cropped",
        "cycle",
        "resampled",
        "low-pass",
        "smoothed:",
    ]
    assert prepared.rate == pytest.approx(50.0) and 2.3 < prepared.duration < 2.6


def test_a_low_pass_resamples_uneven_recordings_by_itself():
    even = screw()
    uneven = even.with_("jitter", time=even.time + 0.003 * np.sin(np.arange(201)))
    prepared = prepare(uneven, Preparation(low_pass=6.0))
    assert prepared.history[-2].startswith("resampled") and prepared.history[-1].startswith("low-pass 6 Hz")


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ({"segment": 9}, "segment: 9, expected 1 to 6"),
        ({"repetition": 4}, "repetition: 4, expected 1 to 3"),
        ({"segment": 1, "repetition": 1}, "segment, repetition: both"),
        ({"longest_gap": 0.0}, "longest: 0.0"),
        ({"start": 3.0, "end": 2.0}, "start, end: 3 .. 2 s"),
    ],
)
def test_preparations_without_sense_are_refused(how, message):
    with pytest.raises(InvalidArgument, match=message):
        prepare(reaches(3), Preparation(**how))


def test_no_cycle_to_choose_is_said_so():
    still = reaches(1)
    with pytest.raises(InvalidArgument, match="repetition: 1, expected none: there is not one in this recording"):
        prepare(still.with_("still", position=0 * still.position), Preparation(repetition=1))


def test_the_command_line_prepares_and_writes_the_history(tmp_path):
    pytest.importorskip("pybullet_data")
    from dmpcpp.cli._imitation import imitate

    recording = noisy(2e-3)
    recording = recording.with_("", time=recording.time)
    np.savez(tmp_path / "reach.npz", time=recording.time, pose=motion.poses(recording))
    done = CliRunner().invoke(
        imitate,
        [
            str(tmp_path / "reach.npz"),
            "--repetition",
            "1",
            "--scale",
            "0.5:0.7",
            "--out",
            str(tmp_path / "o"),
            "--json",
        ],
    )
    assert done.exit_code == 0, done.output
    summary = json.loads((tmp_path / "o" / "summary.json").read_text())
    history = summary["recording"]["history"]
    assert any(line.startswith("cycle 1 of 1") for line in history)
    assert any("learned with its noise smoothed out: " in line for line in history)
    scale = next(float(line.split("scale ")[1].split(",")[0]) for line in history if "scale " in line)
    assert 0.5 <= scale <= 0.7
    assert summary["recording"]["noise"]["position"] == pytest.approx(2e-3 * scale, rel=0.3)
    assert summary["checks"][0]["limit"] == pytest.approx(3 * summary["recording"]["noise"]["position"])
