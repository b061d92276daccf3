"""
Rotations: SO(3), its exponential and logarithm, Euler angles. Matrices map body to world; angles in rad.
"""
from __future__ import annotations
import numpy
import numpy.typing
import typing
__all__: list[str] = ['distance', 'exp', 'from_euler', 'hat', 'left_jacobian', 'log', 'to_euler']
def distance(a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> float:
    """
    The angle in rad (0 to pi) of the rotation between a and b (3, 3).
    """
def exp(v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    The rotation (3, 3) by |v| rad about v (3,). Exact to rounding for every |v|.
    """
def from_euler(angles: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], convention: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    The rotation (3, 3) of three Euler angles (3,) in rad. `convention` names the axes in the order of the angles: upper case about the moving axes ("ZYX": Rz(a) Ry(b) Rx(c)), lower case about the fixed ones ("xyz": Rz(c) Ry(b) Rx(a)); "source" is the passive product Rz(a)^T Ry(b)^T Rx(c)^T of the thesis proposal of 2019.
    """
def hat(v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    [v]x (3, 3), the matrix with [v]x b = v x b.
    """
def left_jacobian(v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    J_l(v) (3, 3): omega = J_l(v) vd for R = exp(v), world frame.
    """
def log(r: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    The rotation vector (3,) with exp(v) = r (3, 3) and |v| <= pi, exact to rounding, at pi too: there the sign with the first component that is not zero positive.
    """
def to_euler(r: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], convention: str) -> numpy.typing.NDArray[numpy.float64]:
    """
    The inverse of from_euler: angles (3,) in rad, the middle one in [-pi/2, pi/2] (three axes) or [0, pi] (first axis repeated). At gimbal lock the third angle is 0.
    """
