"""Seeded series of motions, small: noise is not learned, clean motions are not touched, the benchmark says so."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import Demonstration
from scipy.signal import butter, sosfiltfilt

from benchmarks import peers, robustness, series

SEEDS = 12


@pytest.mark.parametrize("kind", series.NOISY)
def test_noise_is_not_learned_whatever_the_recording_system_does(kind):
    learned, closest, *_ = robustness.noise(kind, SEEDS)
    assert learned.value == 0.0
    assert closest.value <= 1.1


@pytest.mark.parametrize("kind", series.CLEAN)
def test_clean_motions_are_learned_as_they_are(kind):
    assert robustness.clean(kind, SEEDS)[0].ok
    one = series.shown(kind, 0)
    demonstration = Demonstration(one.time, one.value)
    assert np.array_equal(demonstration.denoised().position, one.value)


def test_noise_that_wanders_is_found_where_a_rest_shows_it():
    """Vibrations of 3 to 8 Hz, 3 mm, as a tracker makes them; a motion that vibrates all along is none."""
    time = np.arange(400) / 60.0
    band = butter(2, [3.0, 8.0], "bandpass", fs=60.0, output="sos")
    wobble = sosfiltfilt(band, np.random.default_rng(1).normal(size=(400, 3)), axis=0)
    wobble *= 3e-3 / wobble.std()
    s = np.clip((time - 1.5) / 3.0, 0.0, 1.0)
    truth = (s**3 * (10 - 15 * s + 6 * s**2))[:, None] * [0.3, -0.2, 0.4]
    found = Demonstration(time, truth + wobble).noise_estimate()
    assert found.kind.name == "coloured" and found.sigma == pytest.approx(3e-3, rel=0.4)
    smooth = Demonstration(time, truth + wobble).denoised().position
    assert np.linalg.norm(smooth - truth) < 0.3 * np.linalg.norm(wobble)
    assert not Demonstration(time, 20.0 * wobble).noise_estimate().found


def test_samples_that_were_filled_in_show_no_noise():
    one = series.shown("10 % lost", 0)
    told = Demonstration(one.time, one.value).with_measured(one.measured).noise_estimate()
    assert told.measured == int(one.measured.sum())
    assert told.sigma == pytest.approx(one.sigma, rel=0.2)


def test_turns_stay_calm_wherever_they_are_led():
    assert all(figure.ok for figure in robustness.turns())


def test_the_command_says_what_is_missed(monkeypatch):
    monkeypatch.setattr(peers, "installed", lambda: dict.fromkeys(peers.PACKAGES))
    done = CliRunner().invoke(robustness.main, ["--seeds", "4", "--json"])
    figures = json.loads(done.stdout)["figures"]
    assert done.exit_code == (0 if all(figure["ok"] for figure in figures) else 3)
    assert len(figures) > 30 and any("noise learned" in figure["name"] for figure in figures)
