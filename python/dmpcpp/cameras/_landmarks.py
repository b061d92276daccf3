"""What one camera saw of a hand: 21 landmarks a frame, with times, and the camera that saw them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dmpcpp._typing import Array
from dmpcpp.cameras._camera import Camera

__all__ = ["CHAIN", "PALM", "Landmarks", "chain_length"]

PALM = (0, 1, 5, 9, 13, 17)
"""Landmarks that hardly move against one another: wrist, base of the thumb, knuckles."""

CHAIN = (0, 9, 10, 11, 12)
"""From the wrist to the tip of the middle finger: what a hand's length is measured along."""

_NOISE = 0.02  # of the palm's length: 3 px of a palm of 150
_LEAST_NOISE = 1.0  # px


@dataclass(frozen=True, eq=False)
class Landmarks:
    """A hand as one camera saw it.

    Parameters
    ----------
    time : array (T,)
        s, strictly increasing, of each frame.
    pixels : array (T, 21, 2)
        Landmarks [px]; NaN in frames without a hand.
    world : array (T, 21, 3)
        The net's landmarks [m] about the middle of the hand, axes of the camera; NaN likewise.
    right : array (T,)
        Probability of a right hand; NaN likewise.
    camera : Camera
    name : str
        Of the video.
    """

    time: Array
    pixels: Array
    world: Array
    right: Array
    camera: Camera
    name: str = "video"

    @property
    def found(self) -> NDArray[np.bool_]:
        """In which frames (T,) a hand was found."""
        return np.asarray(np.isfinite(self.pixels).all(axis=(1, 2)))

    @property
    def palm_pixels(self) -> float:
        """Median length [px] of the palm, from the wrist to the knuckle of the middle finger: the scale of errors."""
        length = np.linalg.norm(self.pixels[:, 9] - self.pixels[:, 0], axis=1)
        return float(np.nanmedian(length)) if np.isfinite(length).any() else float("nan")

    @property
    def deviation(self) -> float:
        """Standard deviation of a landmark's ray along an axis that nets leave: 2 % of the palm in the picture."""
        return max(_NOISE * self.palm_pixels, _LEAST_NOISE) / self.camera.focal

    @property
    def rays(self) -> Array:
        """Normalised coordinates (T, 21, 2) of the landmarks."""
        return self.camera.rays(self.pixels)

    def at(self, time: Array) -> Landmarks:
        """Return the landmarks at other times (N,), linear between neighbouring frames; NaN where one is missing."""
        k = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        share = (time - self.time[k]) / (self.time[k + 1] - self.time[k])
        outside = (share < -1e-9) | (share > 1.0 + 1e-9)

        def between(values: Array) -> Array:
            weight = share.reshape(-1, *[1] * (values.ndim - 1))
            mixed = (1.0 - weight) * values[k] + weight * values[k + 1]
            mixed[np.abs(share) < 1e-9] = values[k][np.abs(share) < 1e-9]
            mixed[outside] = np.nan
            return np.asarray(mixed)

        return replace(
            self, time=time, pixels=between(self.pixels), world=between(self.world), right=between(self.right)
        )

    def part(self, kept: NDArray[np.bool_] | slice) -> Landmarks:
        """Return some of the frames."""
        return replace(
            self, time=self.time[kept], pixels=self.pixels[kept], world=self.world[kept], right=self.right[kept]
        )


def chain_length(points: Array) -> float:
    """Return the median length [m] over frames (T, 21, 3) from the wrist to the tip of the middle finger, along it."""
    chain = points[:, CHAIN]
    lengths = np.linalg.norm(np.diff(chain, axis=1), axis=2).sum(axis=1)
    return float(np.nanmedian(lengths))
