"""Measures of how far motions are apart, against closed forms and independent definitions."""

from functools import cache

import numpy as np
import pytest
from dmpcpp import comparison, metrics
from dmpcpp.errors import InvalidArgument
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation


def poses(positions, rotations=None):
    stacked = np.tile(np.eye(4), (len(positions), 1, 1))
    stacked[:, :3, 3] = positions
    if rotations is not None:
        stacked[:, :3, :3] = rotations.as_matrix()
    return stacked


def minimum_jerk_speed(duration=1.0, rate=1000.0, distance=1.0):
    u = np.linspace(0.0, 1.0, round(duration * rate) + 1)
    return 30.0 * distance / duration * (u * (1.0 - u)) ** 2


def test_a_constant_offset_is_the_error_at_every_sample():
    a = poses(np.random.default_rng(1).normal(size=(50, 3)))
    b = a.copy()
    b[:, :3, 3] += [0.003, 0.0, 0.004]
    errors = metrics.compare(a, b)
    assert errors.position_rmse == pytest.approx(0.005, rel=1e-12)
    assert errors.position_max == pytest.approx(0.005, rel=1e-12)
    assert errors.angle_max == 0.0


def test_rmse_and_max_of_one_outlier():
    a = poses(np.zeros((100, 3)))
    b = a.copy()
    b[7, 0, 3] = 0.01
    errors = metrics.compare(a, b)
    assert errors.position_max == 0.01
    assert errors.position_rmse == pytest.approx(0.01 / np.sqrt(100))


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-7, 0.3, 2.0, np.pi - 1e-6, np.pi])
def test_the_angle_is_geodesic_and_keeps_its_digits_at_both_ends(angle):
    axis = np.array([1.0, -2.0, 2.0]) / 3.0
    random = Rotation.random(20, random_state=3)
    turned = random * Rotation.from_rotvec(angle * axis)
    zero = np.zeros((20, 3))
    measured = metrics.angle_errors(poses(zero, random), poses(zero, turned))
    assert np.allclose(measured, angle, atol=1e-15 + 2e-8 * (angle > 3.0) + 1e-15)


def test_angles_agree_with_scipys_magnitude():
    a, b = Rotation.random(200, random_state=1), Rotation.random(200, random_state=2)
    zero = np.zeros((200, 3))
    measured = metrics.angle_errors(poses(zero, a), poses(zero, b))
    assert np.allclose(measured, (a.inv() * b).magnitude(), atol=1e-12)


def test_the_error_does_not_depend_on_the_frame_it_is_seen_from():
    rng = np.random.default_rng(4)
    a = poses(rng.normal(size=(30, 3)), Rotation.random(30, random_state=5))
    b = poses(rng.normal(size=(30, 3)), Rotation.random(30, random_state=6))
    frame = poses([[1.0, 2.0, 3.0]], Rotation.random(1, random_state=7))[0]
    here, there = metrics.compare(a, b), metrics.compare(frame @ a, frame @ b)
    assert np.allclose(list(here.to_dict().values()), list(there.to_dict().values()), atol=1e-12)


def test_final_error_compares_the_last_poses_of_series_of_any_length():
    a, b = poses(np.zeros((5, 3))), poses(np.ones((9, 3)))
    assert metrics.final_error(a, b) == metrics.PoseError(pytest.approx(np.sqrt(3.0)), 0.0)


@pytest.mark.parametrize("lag", [-0.2, -0.0137, 0.0, 0.0137, 0.1, 0.2])
def test_a_delay_is_found_between_samples_too(lag):
    time = np.arange(0.0, 4.0, 0.01)
    path = lambda t: np.column_stack([np.sin(2 * t), np.cos(1.3 * t), 0.3 * t])  # noqa: E731
    assert metrics.best_lag(path(time), path(time - lag), dt=0.01) == pytest.approx(lag, abs=2e-4)


def test_log_dimensionless_jerk_of_a_minimum_jerk_reach_is_its_closed_form():
    # speed 30 u^2 (1-u)^2: peak 1.875, integral of its second derivative squared 720
    assert metrics.log_dimensionless_jerk(minimum_jerk_speed(), 1000.0) == pytest.approx(
        -np.log(720.0 / 1.875**2), abs=2e-3
    )


def test_smoothness_depends_neither_on_size_nor_on_duration():
    once = minimum_jerk_speed(1.0, 1000.0, 1.0)
    other = minimum_jerk_speed(2.0, 500.0, 0.3)
    assert metrics.log_dimensionless_jerk(other, 500.0) == pytest.approx(
        metrics.log_dimensionless_jerk(once, 1000.0), abs=1e-9
    )
    assert metrics.sparc(0.3 * once, 1000.0) == pytest.approx(metrics.sparc(once, 1000.0), abs=1e-12)


def test_sparc_is_the_arc_length_of_the_normalised_spectrum():
    speed = minimum_jerk_speed(0.8, 200.0) + 0.3 * minimum_jerk_speed(0.8, 200.0)[::-1] ** 2
    count = 2 ** (int(np.ceil(np.log2(len(speed)))) + 4)
    spectrum = [abs(np.sum(speed * np.exp(-2j * np.pi * k * np.arange(len(speed)) / count))) for k in range(300)]
    spectrum = np.array(spectrum) / max(spectrum)
    hertz = np.arange(300) * 200.0 / count
    last = max(k for k in range(300) if hertz[k] <= 10.0 and spectrum[k] >= 0.05)
    arc = sum(np.hypot((hertz[k + 1] - hertz[k]) / hertz[last], spectrum[k + 1] - spectrum[k]) for k in range(last))
    assert metrics.sparc(speed, 200.0) == pytest.approx(-arc, abs=1e-10)


def test_tremor_makes_a_motion_less_smooth_by_both_measures():
    time = np.arange(1001) / 1000.0
    calm = minimum_jerk_speed()
    shaky = calm + 0.4 * (1.0 + np.sin(2 * np.pi * 8.0 * time)) * (calm > 0.0)
    assert metrics.sparc(shaky, 1000.0) < metrics.sparc(calm, 1000.0) - 0.05
    assert metrics.log_dimensionless_jerk(shaky, 1000.0) < metrics.log_dimensionless_jerk(calm, 1000.0) - 1.0


def frechet_by_its_recursion(p, q):
    @cache
    def leash(i, j):
        here = float(np.linalg.norm(p[i] - q[j]))
        if i == 0 and j == 0:
            return here
        before = [(i - 1, j), (i - 1, j - 1), (i, j - 1)]
        return max(here, min(leash(a, b) for a, b in before if a >= 0 and b >= 0))

    return leash(len(p) - 1, len(q) - 1)


points = arrays(np.float64, st.tuples(st.integers(1, 12), st.just(2)), elements=st.floats(-5, 5))


@settings(deadline=None, max_examples=200)
@given(points, points)
def test_frechet_is_the_recursion_of_eiter_and_mannila(p, q):
    assert metrics.frechet(p, q) == pytest.approx(frechet_by_its_recursion(p, q), rel=1e-12, abs=1e-300)
    assert metrics.frechet(p, q) == metrics.frechet(q, p)


def test_frechet_sees_an_offset_but_neither_tempo_nor_lag():
    u = np.linspace(0.0, 1.0, 200)
    path = np.column_stack([np.cos(3 * u), np.sin(3 * u), u])
    assert metrics.frechet(path, path + np.array([0.005, 0.0, 0.0])) == pytest.approx(0.005)
    assert metrics.frechet(path, path[::2]) < 0.02


def paths(count, other, seed):
    random = np.random.default_rng(seed)
    return random.normal(size=(count, 3)).cumsum(axis=0), random.normal(size=(other, 3)).cumsum(axis=0)


@pytest.mark.parametrize("count, other", [(1, 1), (1, 7), (30, 30), (45, 80)])
def test_dtw_and_frechet_are_those_of_similaritymeasures(count, other):
    oracle = pytest.importorskip("similaritymeasures")
    p, q = paths(count, other, seed=8)
    assert metrics.dtw(p, q) * max(count, other) == pytest.approx(oracle.dtw(p, q)[0], rel=1e-9)
    assert metrics.frechet(p, q) == pytest.approx(oracle.frechet_dist(p, q), rel=1e-9)


@pytest.mark.parametrize("count, other", [(2, 2), (40, 25), (60, 61)])
def test_dtw_is_that_of_dtaidistance_with_euclidean_steps(count, other):
    oracle = pytest.importorskip("dtaidistance.dtw_ndim")
    p, q = paths(count, other, seed=9)
    expected = oracle.distance(p, q, inner_dist="euclidean") / max(count, other)
    assert metrics.dtw(p, q) == pytest.approx(expected, rel=1e-9)


def test_rmse_is_the_root_of_the_mean_squared_error_of_similaritymeasures():
    oracle = pytest.importorskip("similaritymeasures")
    p, q = paths(200, 200, seed=10)
    squared = 3 * oracle.mse(p, q)  # theirs is the mean over the numbers, ours over the points
    assert metrics.compare(poses(p), poses(q)).position_rmse == pytest.approx(np.sqrt(squared), rel=1e-9)


def test_dtw_sees_an_offset_but_no_lag():
    u = np.linspace(0.0, 1.0, 200)
    path = np.column_stack([np.cos(3 * u), np.sin(3 * u), u])
    late = np.vstack([np.tile(path[:1], (20, 1)), path])
    assert metrics.dtw(path, late) == 0.0
    assert 0.003 < metrics.dtw(path, path + np.array([0.005, 0.0, 0.0])) <= 0.005 * (1 + 1e-9)


def test_a_margin_is_what_is_left_of_the_nearest_limit():
    values = np.array([[0.5, -1.0], [0.2, 3.0]])
    assert metrics.margin(values, [1.0, 4.0]) == pytest.approx(0.25)
    assert metrics.margin(values, 2.0) == pytest.approx(-0.5)
    assert metrics.margin(np.zeros((3, 2)), 1.0) == 1.0


def reach_poses(duration=1.0, rate=200.0, noise=0.0):
    u = np.linspace(0.0, 1.0, round(duration * rate) + 1)
    blend = 10 * u**3 - 15 * u**4 + 6 * u**5
    shake = noise * np.random.default_rng(3).normal(size=(len(u), 3))
    return poses(blend[:, None] * np.array([0.3, 0.1, 0.2]) + shake, Rotation.from_rotvec(blend[:, None] * [0, 0, 1.0]))


def test_a_comparison_has_every_measure_and_each_is_its_own_function():
    a, b = reach_poses(), reach_poses(noise=1e-4)
    found = comparison.compare_motions(a, b, 200.0)
    p, q = a[:, :3, 3], b[:, :3, 3]
    assert found.errors == metrics.compare(a, b)
    assert found.final == metrics.final_error(a, b)
    assert (found.dtw, found.frechet) == (metrics.dtw(p, q), metrics.frechet(p, q))
    speeds = [np.linalg.norm(np.gradient(x, 0.005, axis=0), axis=1) for x in (p, q)]
    assert found.sparc == pytest.approx(metrics.sparc(speeds[1], 200.0) - metrics.sparc(speeds[0], 200.0), abs=1e-12)
    assert found.log_dimensionless_jerk < -1.0  # noise: much rougher


def test_a_motion_compared_with_itself_differs_in_nothing():
    found = comparison.compare_motions(reach_poses(), reach_poses(), 200.0)
    assert set(found.to_dict()["errors"].values()) == {0.0}
    assert (found.dtw, found.frechet, found.sparc, found.log_dimensionless_jerk) == (0.0, 0.0, 0.0, 0.0)
    assert found.lag == pytest.approx(0.0, abs=1e-12)


def test_a_lag_is_found_by_the_comparison():
    long = np.vstack([np.tile(reach_poses()[:1], (40, 1, 1)), reach_poses(), np.tile(reach_poses()[-1:], (40, 1, 1))])
    late = np.vstack([long[:1].repeat(10, axis=0), long[:-10]])
    assert comparison.compare_motions(long, late, 200.0).lag == pytest.approx(0.05, abs=1e-4)


def test_what_stands_still_has_no_smoothness():
    still = np.tile(np.eye(4), (10, 1, 1))
    found = comparison.compare_motions(still, still, 100.0)
    assert (found.sparc, found.log_dimensionless_jerk) == (None, None)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: metrics.dtw(np.zeros((2, 2)), np.zeros((2, 3))), "expected 2 as in a"),
        (lambda: metrics.margin([[1.0, 2.0]], [1.0]), "limit: .*expected 2 positive"),
        (lambda: metrics.margin([[1.0]], 0.0), "limit: 0.0, expected 1 positive"),
        (lambda: comparison.compare_motions(np.zeros((2, 4, 4)), np.zeros((2, 4, 4)), 1.0), "expected at least 3"),
        (lambda: metrics.compare(np.eye(4), np.eye(4)), r"reference: shape \(4, 4\), expected \(T, 4, 4\)"),
        (lambda: metrics.compare(np.zeros((2, 4, 4)), np.zeros((3, 4, 4))), "differ"),
        (lambda: metrics.compare(np.zeros((0, 4, 4)), np.zeros((0, 4, 4))), "no samples"),
        (lambda: metrics.sparc([1.0, np.nan, 1.0], 100.0), r"speed\[1\]: not finite"),
        (lambda: metrics.sparc([0.0, 0.0], 100.0), "speed: all zero"),
        (lambda: metrics.sparc([1.0, 2.0], 0.0), "rate: 0.0, expected a positive number"),
        (lambda: metrics.log_dimensionless_jerk([1.0, 2.0], 1.0), "expected at least 3"),
        (lambda: metrics.frechet(np.zeros((2, 2)), np.zeros((2, 3))), "expected 2 as in a"),
        (lambda: metrics.best_lag([[1.0]], [[1.0]], 0.1), "expected at least 2"),
    ],
)
def test_what_cannot_be_measured_is_refused_with_the_reason(call, message):
    with pytest.raises(InvalidArgument, match=message):
        call()


@pytest.mark.parametrize("limit", [0.0, -1.0, [1.0, 0.0], [1.0, 2.0, 3.0], np.nan])
def test_the_margin_to_a_limit_that_is_none_is_refused(limit):
    with pytest.raises(InvalidArgument, match="limit: "):
        metrics.margin(np.zeros((3, 2)), limit)
