"""Dynamic time warping and the Frechet distance, against independent packages and definitions."""

import dmpcpp
import numpy as np
import pytest
from scipy.spatial.transform import Rotation


def walk(count: int, seed: int, columns: int = 3) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(size=(count, columns)), axis=0)


def poses(position: np.ndarray, rotation: Rotation) -> np.ndarray:
    stacked = np.tile(np.eye(4), (len(position), 1, 1))
    stacked[:, :3, 3] = position
    stacked[:, :3, :3] = rotation.as_matrix()
    return stacked


@pytest.mark.parametrize(("count", "other"), [(1, 5), (40, 40), (60, 35), (35, 60)])
def test_the_distance_is_that_of_similaritymeasures(count, other):
    measures = pytest.importorskip("similaritymeasures")
    a, b = walk(count, 1), walk(other, 2)
    assert dmpcpp.align(a, b).distance == pytest.approx(measures.dtw(a, b)[0], rel=1e-12)
    assert dmpcpp.frechet(a, b) == pytest.approx(measures.frechet_dist(a, b), rel=1e-12)


@pytest.mark.parametrize("band", [None, 0, 3, 10])
def test_the_distance_and_the_band_are_those_of_dtaidistance(band):
    dtw_ndim = pytest.importorskip("dtaidistance.dtw_ndim")
    a, b = walk(80, 3), walk(80, 4)
    window = None if band is None else band + 1
    expected = dtw_ndim.distance(a, b, inner_dist="euclidean", window=window, use_c=False)
    assert dmpcpp.align(a, b, band=band).distance == pytest.approx(expected, rel=1e-12)


def test_poses_are_warped_by_position_and_angle():
    a = poses(walk(30, 5), Rotation.random(30, random_state=1))
    b = poses(walk(25, 6), Rotation.random(25, random_state=2))
    turned = Rotation.from_matrix(a[:, None, :3, :3].repeat(25, 1).reshape(-1, 3, 3)).inv() * Rotation.from_matrix(
        b[None, :, :3, :3].repeat(30, 0).reshape(-1, 3, 3)
    )
    away = np.linalg.norm(a[:, None, :3, 3] - b[None, :, :3, 3], axis=2)
    cost = away + 0.5 * turned.magnitude().reshape(30, 25)
    total = np.full((31, 26), np.inf)
    total[0, 0] = 0.0
    for i in range(30):
        for j in range(25):
            total[i + 1, j + 1] = cost[i, j] + min(total[i, j], total[i, j + 1], total[i + 1, j])
    found = dmpcpp.align(a, b, angle_weight=0.5)
    assert found.distance == pytest.approx(total[-1, -1], rel=1e-9)
    assert cost[found.path[:, 0], found.path[:, 1]].sum() == pytest.approx(found.distance, rel=1e-9)


def test_the_path_undoes_a_change_of_tempo():
    late = lambda u: u + 0.1 * np.sin(2 * np.pi * u)  # noqa: E731
    u = np.linspace(0, 1, 400)
    shape = lambda s: np.column_stack([np.sin(5 * s), np.cos(4 * s), s])  # noqa: E731
    found = dmpcpp.align(shape(u), shape(late(u)))
    assert found.path.dtype == np.int64 and found.path.shape == (len(found), 2)
    assert np.abs(u[found.path[:, 0]] - late(u[found.path[:, 1]])).max() < 0.01


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: dmpcpp.align(np.zeros((3, 2)), [[0.0, 0.0], [np.nan, 0.0]]), r"b\[1\]: not finite"),
        (lambda: dmpcpp.align(np.zeros((3, 2)), np.zeros((3, 3))), "b: 3 columns, expected 2 as in a"),
        (lambda: dmpcpp.align(np.zeros((3, 4, 4)), np.zeros((3, 3))), "b: an array of shape"),
        (lambda: dmpcpp.align(np.zeros((0, 2)), np.zeros((3, 2))), "a: no samples"),
        (lambda: dmpcpp.align([1.0], [2.0], band=-2), "band: -2"),
        (lambda: dmpcpp.align(np.zeros((2, 4, 4)), np.tile(np.eye(4), (2, 1, 1))), r"a\[0\]"),
        (lambda: dmpcpp.frechet([1.0], [np.inf]), r"b\[0\]: not finite"),
    ],
)
def test_what_cannot_be_aligned_is_refused_with_the_place(call, message):
    with pytest.raises(dmpcpp.InvalidArgument, match=message):
        call()
