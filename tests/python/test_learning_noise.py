"""Preparing and learning noisy recordings: what is taken out is told, and the noise found is what is judged by."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import learning, motion
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion import Preparation, prepare

from tests.python.motions import lose, reaches, screw


def noisy(sigma: float):
    clean = reaches(1)
    return clean.with_("", position=clean.position + np.random.default_rng(4).normal(0.0, sigma, clean.position.shape))


def learned(recording, **options):
    return learning.learn(motion.demonstration(recording), **options)


def test_noise_is_smoothed_out_in_learning_and_clean_motions_are_not_touched():
    for sigma, derivatives in ((0.0, "interpolate"), (0.02e-3, "smooth"), (0.3e-3, "smooth"), (2e-3, "smooth")):
        model = learned(noisy(sigma))
        assert model.options.derivatives.name == derivatives
        assert model.options.basis_count <= 100
    errors = learning.reproduction(model, motion.demonstration(reaches(1)))
    assert errors.position_rmse < 1e-3  # of the truth: less than half the noise of one axis


def test_noise_that_makes_the_accelerations_is_smoothed_out_however_small():
    """An arm can be as fast as the accelerations allow: noise of 0.2 mm would slow a calm reach down many times."""
    truth = motion.demonstration(reaches(1))
    calm, shaken = learned(noisy(0.2e-3)), learned(noisy(0.2e-3), basis_count=200, smooth=False)
    peak = {
        name: np.abs(model.rollout(dt=0.01).acceleration[:, :3]).max()
        for name, model in (("calm", calm), ("shaken", shaken), ("true", learning.learn(truth)))
    }
    assert peak["calm"] < 1.1 * peak["true"]
    assert peak["shaken"] > 3.0 * peak["true"]
    assert learning.reproduction(calm, truth).position_rmse < 0.15e-3
    assert learned(noisy(0.2e-3), basis_count=60).options.derivatives.name == "smooth"


def test_several_takes_are_smoothed_if_one_of_them_has_to_be():
    clean = reaches(1)
    other = clean.with_(
        "", position=clean.position + np.random.default_rng(5).normal(0.0, 0.2e-3, clean.position.shape)
    )
    for takes in ((noisy(0.2e-3), other), (clean, other), (other, clean)):
        lesson = learning.teach(takes, keep_rests=True)
        assert lesson.model.options.derivatives.name == "smooth"
        assert lesson.fit.rmse[:3].max() < 0.3e-3


def test_smoothing_can_be_forbidden():
    for count in (None, 100):
        assert learned(noisy(2e-3), basis_count=count, smooth=False).options.derivatives.name == "interpolate"


def test_a_reproduction_is_judged_without_the_noise_that_was_taken_out():
    demonstration = motion.demonstration(noisy(2e-3))
    found = learning.evidence(demonstration)
    assert found.smoothed and found.position.sigma == pytest.approx(2e-3, rel=0.15)
    position, angle = learning.reproduction_checks(learning.learn(demonstration), found)
    assert position.ok and angle.ok and position.limit == 1e-3
    assert position.value < 0.3e-3 and position.detail.endswith("mm of noise taken out")
    few = learning.learn(demonstration, 3)
    assert not learning.reproduction_checks(few, found)[0].ok


def test_evidence_is_a_sentence_and_numbers():
    found = learning.evidence(motion.demonstration(noisy(1e-3)))
    assert found.sentence.startswith("Noise of ") and found.sentence.endswith("smoothed out.")
    assert json.loads(json.dumps(found.to_dict()))["position"]["kind"] == "white"
    clean = learning.evidence(motion.demonstration(reaches(1)))
    assert not clean.smoothed and clean.sentence.startswith("No measurement noise")
    kept = learning.evidence(motion.demonstration(noisy(1e-3)), smooth=False)
    assert kept.sentence.endswith("learned with the motion.")


def test_a_take_that_does_not_belong_to_the_others_is_named():
    takes = [reaches(1).with_("", source=f"take{k}") for k in range(5)]
    takes = [
        take.with_("", position=take.position + 1e-3 * np.sin((k + 1) * take.time)[:, None])
        for k, take in enumerate(takes)
    ]
    assert learning.teach(takes).checks == ()
    away = 0.2 * np.sin(np.pi * takes[2].time / takes[2].duration)[:, None]
    other = takes[2].with_("", position=takes[2].position + away)
    checks = learning.teach([*takes[:2], other, *takes[3:]]).checks
    assert {check.name for check in checks} == {"take_3_position_rmse"}
    assert checks[0].detail == "take 3 (take2) against the model of the others"
    (named,) = learning.teach([*takes[:2], other, *takes[3:]], numbers=["1", "2", "4.1", "5", "6"]).checks
    assert named.name == "take_4.1_position_rmse" and "take 4.1 (take2)" in named.detail


def test_by_default_gaps_and_outliers_are_filled_and_nothing_else():
    recording = screw()
    assert prepare(recording) is recording
    position = recording.position.copy()
    position[100] += 0.2
    corrected = prepare(lose(recording.with_("hit", position=position), 50, 51))
    np.testing.assert_allclose(corrected.position, recording.position, atol=1e-3)
    assert [line.split(" ")[1] for line in corrected.history[2:]] == ["gaps", "outliers", "gaps"]
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
    assert summary["recording"]["evidence"]["smoothed"]
    assert summary["recording"]["evidence"]["sentence"].startswith("Noise of")
    assert summary["checks"][0]["limit"] == 1e-3
