"""A pinhole camera: pixels to rays and back. Pixels count from the centre of the first one, x right, y down."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["Camera"]

_ROUNDS = 12  # of the fixed point that takes distortion out; lenses of phones settle in five
_FOV = (np.radians(10.0), np.radians(150.0))  # a pinhole is no model of what is wider


@dataclass(frozen=True, eq=False)
class Camera:
    """A calibrated camera.

    Parameters
    ----------
    matrix : array (3, 3)
        Intrinsic matrix [px].
    size : (int, int)
        Width and height of the picture [px].
    distortion : array (5,)
        k1, k2, p1, p2, k3 of Brown's model, as OpenCV numbers them.
    """

    matrix: Array
    size: tuple[int, int]
    distortion: Array

    @staticmethod
    def of_fov(fov: float, size: tuple[int, int]) -> Camera:
        """Return the ideal camera with a horizontal field of view [rad].

        Raises
        ------
        InvalidArgument
            A field of view outside 10 to 150 deg.
        """
        if not _FOV[0] <= fov <= _FOV[1]:
            raise InvalidArgument(
                f"fov: {np.degrees(fov):.4g} deg, expected the horizontal field of view, 10 to 150 deg."
            )
        width, height = size
        focal = width / 2.0 / np.tan(fov / 2.0)
        matrix = np.array([[focal, 0.0, (width - 1) / 2.0], [0.0, focal, (height - 1) / 2.0], [0.0, 0.0, 1.0]])
        return Camera(matrix, size, np.zeros(5))

    @property
    def focal(self) -> float:
        """Mean focal length [px]."""
        return float((self.matrix[0, 0] + self.matrix[1, 1]) / 2.0)

    def rays(self, pixels: Array) -> Array:
        """Return normalised coordinates (.., 2), x / z and y / z without distortion, of pixels (.., 2)."""
        y = (pixels[..., 1] - self.matrix[1, 2]) / self.matrix[1, 1]
        x = (pixels[..., 0] - self.matrix[0, 2] - self.matrix[0, 1] * y) / self.matrix[0, 0]
        seen = np.stack([x, y], axis=-1)
        if not self.distortion.any():
            return seen
        straight = seen
        for _ in range(_ROUNDS):
            straight = seen - (self._distorted(straight) - straight)
        return straight

    def project(self, points: Array) -> Array:
        """Return the pixels (.., 2) of points (.., 3) [m] in the camera's axes: x right, y down, z forwards."""
        seen = points[..., :2] / points[..., 2:]
        if self.distortion.any():
            seen = self._distorted(seen)
        homogeneous = np.concatenate([seen, np.ones_like(seen[..., :1])], axis=-1)
        return np.asarray((homogeneous @ self.matrix.T)[..., :2])

    def resized(self, size: tuple[int, int]) -> Camera:
        """Return the camera of the same pictures at another size."""
        scale = size[0] / self.size[0]
        matrix = self.matrix.copy()
        matrix[:2, 2] += 0.5  # pixel centres are integers: the corner of the picture lies at -0.5
        matrix[:2] *= scale
        matrix[:2, 2] -= 0.5
        return Camera(matrix, size, self.distortion)

    def _distorted(self, seen: Array) -> Array:
        k1, k2, p1, p2, k3 = self.distortion
        x, y = seen[..., 0], seen[..., 1]
        r2 = x * x + y * y
        radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
        return np.stack(
            [
                x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
                y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
            ],
            axis=-1,
        )
