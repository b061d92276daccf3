"""Reports, spread and averages as Python sees them."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Dmp, InvalidArgument, PoseDmp


def noisy(seed: int, sigma: float = 1e-3, duration: float = 2.0) -> dmpcpp.Demonstration:
    time = np.linspace(0, duration, 401)
    s = time / duration
    clean = np.c_[0.1 * np.sin(6 * s), 0.1 * np.cos(6 * s), 0.3 * s]
    return dmpcpp.Demonstration(time, clean + np.random.default_rng(seed).normal(0, sigma, clean.shape))


def test_a_report_finds_noise_and_says_what_smoothing_removed():
    demonstration = noisy(0)
    report = dmpcpp.assess(Dmp.fit(demonstration, derivatives="smooth"), [demonstration], position=3e-3)
    assert report.noise == pytest.approx([1e-3] * 3, rel=0.2)
    assert report.removed == pytest.approx([1e-3] * 3, rel=0.2)
    assert report.rmse.shape == report.largest.shape == (3,)
    assert report.suggested_basis_count > 0 and report.condition > 1 and report.largest_log == 0


def test_demonstrations_together_are_closer_to_the_truth_than_one():
    time = np.linspace(0, 2, 401)
    truth = np.c_[0.1 * np.sin(3 * time), 0.1 * np.cos(3 * time), 0.15 * time]
    demonstrations = [noisy(seed) for seed in range(20)]

    def error(model: Dmp) -> float:
        return float(np.sqrt(np.mean((model.rollout_at(time).position - truth) ** 2)))

    together = error(Dmp.fit(demonstrations, derivatives="smooth"))
    alone = np.mean([error(Dmp.fit(one, derivatives="smooth")) for one in demonstrations])
    assert together <= 0.13e-3 < alone
    average = dmpcpp.average([Dmp.fit(one, derivatives="smooth") for one in demonstrations])
    assert error(average) == pytest.approx(together, rel=0.01)


def test_the_spread_is_the_covariance_at_equal_phase():
    demonstrations = [noisy(seed, duration=1 + seed / 10) for seed in range(30)]
    band = dmpcpp.spread(demonstrations, count=11)
    assert band.phase.shape == (11,) and band.mean.shape == (11, 3) and band.covariance.shape == (11, 3, 3)
    at = np.array([one.at(band.phase * one.duration).position for one in demonstrations])
    assert np.allclose(band.mean, at.mean(axis=0))
    assert np.allclose(band.covariance[5], np.cov(at[:, 5].T))


def test_poses_spread_in_six_dimensions():
    time = np.linspace(0, 1, 50)
    poses = np.tile(np.eye(4), (50, 1, 1))
    poses[:, 0, 3] = time
    moved = poses.copy()
    moved[:, 1, 3] += 0.1
    band = dmpcpp.spread([dmpcpp.PoseDemonstration(time, p) for p in (poses, moved)])
    assert band.covariance.shape == (101, 6, 6)
    assert band.covariance[50, 1, 1] == pytest.approx(0.1**2 / 2)
    model = PoseDmp.fit([dmpcpp.PoseDemonstration(time, p) for p in (poses, moved)])
    assert model.start[1, 3] == pytest.approx(0.05)


def test_models_that_differ_are_not_averaged():
    with pytest.raises(InvalidArgument, match=r"models\[1\]: options.alpha is 30"):
        dmpcpp.average([Dmp.fit(noisy(0)), Dmp.fit(noisy(0), alpha=30.0)])
    with pytest.raises(InvalidArgument, match="demonstrations: none"):
        dmpcpp.assess(Dmp.fit(noisy(0)), [])
