"""Least squares over a whole video: unknowns of neighbouring frames are coupled, and a few are shared by all.

The normal equations are banded with a border. They are solved by the banded Cholesky factor and the border's Schur
complement (G. H. Golub and C. F. Van Loan, Matrix Computations, 4th ed., 4.3), in time linear in the frames.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solveh_banded

from dmpcpp._typing import Array

__all__ = ["Normal"]

_REACH = 2  # frames that a term couples: second differences


class Normal:
    """Normal equations of N frames with six unknowns each, and M shared ones."""

    def __init__(self, frames: int, shared: int) -> None:
        """Begin with zeros."""
        self.blocks = np.zeros((_REACH + 1, frames, 6, 6))  # of frame i and i + d, under the diagonal
        self.border = np.zeros((frames, 6, shared))
        self.corner = np.zeros((shared, shared))
        self.gradient = np.zeros((frames, 6))
        self.shared_gradient = np.zeros(shared)

    def add(self, jacobian: Array, shared: Array | None, error: Array) -> None:
        """Add errors (N, E) of single frames, with Jacobians (N, E, 6) and (N, E, M)."""
        self.blocks[0] += np.einsum("nei,nej->nij", jacobian, jacobian)
        self.gradient += np.einsum("nei,ne->ni", jacobian, error)
        if shared is not None:
            self.border += np.einsum("nei,nem->nim", jacobian, shared)
            self.corner += np.einsum("nem,nek->mk", shared, shared)
            self.shared_gradient += np.einsum("nem,ne->m", shared, error)

    def add_coupled(self, jacobians: tuple[Array, ...], error: Array) -> None:
        """Add errors (K, E), the k-th of the frames k, k + 1, .., with a Jacobian (K, E, 6) for each of them."""
        count = len(error)
        for a, left in enumerate(jacobians):
            self.gradient[a : a + count] += np.einsum("kei,ke->ki", left, error)
            for b, right in enumerate(jacobians[a:]):
                self.blocks[b, a : a + count] += np.einsum("kei,kej->kij", right, left)

    def add_shared(self, weight: Array, error: Array) -> None:
        """Add errors (M,) of the shared unknowns alone, each weighted."""
        self.corner[np.diag_indices(len(weight))] += weight**2
        self.shared_gradient += weight**2 * error

    def step(self, damping: float) -> tuple[Array, Array]:
        """Return the step (N, 6) and (M,) that lowers the sum of squares, with Levenberg's damping of the diagonal."""
        frames, shared = len(self.gradient), len(self.shared_gradient)
        band = self._band()
        band[0] *= 1.0 + damping
        right = np.concatenate([self.gradient[..., None], self.border], axis=2).reshape(6 * frames, 1 + shared)
        solved = solveh_banded(band, right, lower=True, overwrite_ab=True, check_finite=False)
        border = self.border.reshape(6 * frames, shared)
        corner = self.corner * (1.0 + damping * np.eye(shared)) - border.T @ solved[:, 1:]
        common = np.linalg.solve(corner, self.shared_gradient - border.T @ solved[:, 0])
        own = solved[:, 0] - solved[:, 1:] @ common
        return -own.reshape(frames, 6), -common

    def _band(self) -> Array:
        """Return the lower band as LAPACK stores it: row d holds the d-th diagonal below the main one."""
        frames = len(self.gradient)
        band = np.zeros((6 * (_REACH + 1), 6 * frames))
        for d in range(_REACH + 1):
            for i in range(6):
                for j in range(6):
                    below = 6 * d + i - j
                    if below >= 0:
                        band[below, j::6][: frames - d] = self.blocks[d, : frames - d, i, j]
        return band
