"""Inertias of rigid bodies: which ones a body can have, the nearest of these, and how far that is."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from dmpcpp._typing import Array

__all__ = ["InertiaRepair", "is_physical", "moment_change", "nearest_physical", "repaired_links"]


@dataclass(frozen=True)
class InertiaRepair:
    """A link whose mass or inertia is not the one of its body.

    Attributes
    ----------
    link : str
    change : float
        The largest change of a principal moment over the largest moment. Where nothing is stated that could be
        changed, what the link weighs at most over the mass of what it is rigid with; infinite where that is unknown.
    missing : bool
        Whether it is a body without mass, or a mass without inertia.
    """

    link: str
    change: float
    missing: bool = False

    def __str__(self) -> str:
        """Name and size."""
        size = f"{100.0 * self.change:.2g} %"
        if not self.missing:
            return f"{self.link} ({size})"
        return f"{self.link} (states none{f': at most {size} of its body' if math.isfinite(self.change) else ''})"


def repaired_links(repairs: Iterable[InertiaRepair]) -> tuple[str, ...]:
    """Return the links whose inertia was replaced by another."""
    return tuple(repair.link for repair in repairs if not repair.missing)


def is_physical(inertia: Array, tolerance: float = 1e-9) -> bool:
    """Whether a rigid body can have this inertia (3, 3) [kg m^2] about its centre of mass.

    It can when the inertia is positive definite and its principal moments hold the triangle inequality
    a + b >= c: when the second moment of mass ``tr(I)/2 1 - I`` has no negative eigenvalue (Wensing, Kim and
    Slotine, "Linear Matrix Inequalities for Physically-Consistent Inertial Parameter Identification", RA-L
    2018).
    """
    scale = float(np.trace(inertia))
    if not scale > 0.0:
        return False
    moments = np.linalg.eigvalsh(inertia)
    return bool(moments[0] > 0.0 and np.linalg.eigvalsh(_second_moment(inertia))[0] >= -tolerance * scale)


def nearest_physical(inertia: Array) -> Array:
    """The physical inertia (3, 3) nearest to ``inertia`` in the Frobenius norm: the same axes with other moments.

    Moments are sums of two second moments of mass each, which a floor of 1e-4 of the largest keeps off the edge,
    where engines differ in what they accept. The nearest such moments are a least-squares problem with bounds.
    """
    moments, axes = np.linalg.eigh(0.5 * (inertia + inertia.T))
    floor = 1e-4 * max(0.5 * float(moments.sum()) - float(moments[0]), 1e-9)
    sums = np.ones((3, 3)) - np.eye(3)
    above, _ = nnls(sums, moments - sums @ np.full(3, floor))
    return np.asarray(axes @ np.diag(sums @ (above + floor)) @ axes.T)


def moment_change(before: Array, after: Array) -> float:
    """Return the largest change of a principal moment over the largest moment before; infinite without one."""
    old, new = np.linalg.eigvalsh(before), np.linalg.eigvalsh(after)
    largest = float(np.abs(old).max())
    return float(np.abs(new - old).max()) / largest if largest > 0.0 else math.inf


def _second_moment(inertia: Array) -> Array:
    return np.asarray(0.5 * np.trace(inertia) * np.eye(3) - inertia)
