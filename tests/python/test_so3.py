"""SO(3) against mpmath (60 digits) and scipy."""

import mpmath
import numpy as np
import pytest
from dmpcpp import InvalidArgument, so3
from scipy.spatial.transform import Rotation

ANGLES = [
    1e-300,
    1e-12,
    1e-8,
    1e-4,
    0.2499,
    0.2501,
    1.0,
    3.0,
    *(np.pi - 10.0**-k for k in range(1, 16)),
    np.pi,
]


def axes(count: int) -> np.ndarray:
    vectors = np.random.default_rng(0).normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def exact_exp(v: np.ndarray) -> np.ndarray:
    """Rodrigues' formula with 60 digits, rounded once."""
    with mpmath.workdps(60):
        x = [mpmath.mpf(float(c)) for c in v]
        angle = mpmath.sqrt(sum(c * c for c in x))
        k = mpmath.matrix([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])
        r = mpmath.eye(3) + mpmath.sin(angle) / angle * k + (1 - mpmath.cos(angle)) / angle**2 * k * k
        return np.array(r.tolist(), dtype=float).reshape(3, 3)


def exact_log(r: np.ndarray) -> np.ndarray:
    """The logarithm of the rounded matrix with 60 digits, from its largest quaternion component."""
    with mpmath.workdps(60):
        m = [[mpmath.mpf(float(c)) for c in row] for row in r]
        trace = m[0][0] + m[1][1] + m[2][2]
        pivots = [trace, m[0][0], m[1][1], m[2][2]]
        p = pivots.index(max(pivots))
        if p == 0:
            q = [1 + trace, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]]
        else:
            i = p - 1
            j, k = (i + 1) % 3, (i + 2) % 3
            q = [m[k][j] - m[j][k], 0, 0, 0]
            q[1 + i] = 1 + m[i][i] - m[j][j] - m[k][k]
            q[1 + j] = m[j][i] + m[i][j]
            q[1 + k] = m[k][i] + m[i][k]
        if q[0] < 0:
            q = [-c for c in q]
        n = mpmath.sqrt(sum(c * c for c in q[1:]))
        factor = 2 * mpmath.atan2(n, q[0]) / n
        return np.array([float(c * factor) for c in q[1:]])


@pytest.mark.parametrize("angle", ANGLES)
def test_exp_is_exact_to_rounding(angle):
    for axis in axes(10):
        assert np.abs(so3.exp(angle * axis) - exact_exp(angle * axis)).max() < 1e-15


@pytest.mark.parametrize("angle", ANGLES)
def test_log_is_exact_to_rounding_up_to_pi(angle):
    for axis in axes(10):
        r = exact_exp(angle * axis)
        expected = exact_log(r)
        found = so3.log(r)
        if found @ expected < 0:  # the cut: both signs are logarithms
            assert angle > np.pi - 1e-15
            expected = -expected
        assert np.abs(found - expected).max() < 1e-15


@pytest.mark.parametrize("convention", ["ZYX", "XYZ", "YXZ", "ZYZ", "XZX", "xyz", "zyx", "yzx", "zxz"])
def test_euler_angles_are_scipys(convention):
    for angles in np.random.default_rng(1).uniform(-1.5, 1.5, (50, 3)):
        expected = Rotation.from_euler(convention, angles).as_matrix()
        assert np.abs(so3.from_euler(angles, convention) - expected).max() < 1e-15
        assert np.allclose(so3.to_euler(expected, convention), Rotation.from_matrix(expected).as_euler(convention))


def test_the_sources_product_is_the_passive_one():
    a, b, g = 0.3, -0.2, 0.5
    passive = (Rotation.from_euler("x", g) * Rotation.from_euler("y", b) * Rotation.from_euler("z", a)).inv()
    assert np.abs(so3.from_euler([a, b, g], "source") - passive.as_matrix()).max() < 1e-15


@pytest.mark.parametrize("bad", [[1.0, 2.0], [[1.0, 2.0, 3.0]], 1.0, [np.nan, 0, 0, 0]])
def test_a_vector_of_another_shape_is_refused(bad):
    with pytest.raises(InvalidArgument, match="^v: "):
        so3.exp(bad)


def test_an_unknown_convention_is_refused_with_what_there_is():
    with pytest.raises(InvalidArgument, match=r"convention: 'ABC' is unknown.*\"ZYX\""):
        so3.from_euler([0, 0, 0], "ABC")
