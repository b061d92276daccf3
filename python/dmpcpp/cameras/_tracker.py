"""A hand's 21 landmarks through a video: a palm detector where no hand is known yet, then a net on a turned square.

Written from public facts about the two networks: F. Zhang et al., MediaPipe Hands: On-device Real-time Hand Tracking,
arXiv:2006.10214 (2020), and the shapes of their tensors. Pixels, x right, y down, centres at integers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dmpcpp._typing import Array
from dmpcpp.cameras._frames import Picture
from dmpcpp.cameras._hand_model import net_files
from dmpcpp.cameras._net import Image, load_net
from dmpcpp.cameras._opencv import opencv

__all__ = ["Seen", "Tracker"]

_PALM, _HAND = 192, 224  # px, of the nets' inputs
_SURE = 0.5  # least score of a palm, and presence of a hand
_SAME = 0.3  # intersection over union of boxes of one palm
_AROUND = (0, 1, 2, 3, 5, 6, 9, 10, 13, 14, 17, 18)  # landmarks that the next square is laid around


@dataclass(frozen=True, eq=False)
class Seen:
    """A hand in a frame: landmarks (21, 2) [px], world landmarks (21, 3) [m], probability of a right hand, presence;
    `others` palms stand in the picture beside it, where the detector looked.
    """

    pixels: Array
    world: Array
    right: float
    presence: float


@dataclass(frozen=True, eq=False)
class _Square:
    """A square region: centre (2,) [px], side [px], angle [rad] by which it is turned."""

    centre: Array
    side: float
    angle: float

    def matrix(self, size: int) -> Array:
        """Return the affine map (2, 3) from pixels of its crop of `size` to those of the frame."""
        scale = self.side / size
        cosine, sine = scale * np.cos(self.angle), scale * np.sin(self.angle)
        turn = np.array([[cosine, -sine], [sine, cosine]])
        middle = np.full(2, size / 2.0)
        return np.concatenate([turn, (self.centre - turn @ middle)[:, None]], axis=1)


class Tracker:
    """Follows one hand: the surest palm that comes first, then the hand found last."""

    def __init__(self, runtime: str | None = None, sought: str | None = None) -> None:
        """Load the networks; `runtime` as in `load_net`. With `sought` "right" a left hand is passed over."""
        self._sought = sought
        palm, hand = net_files()
        self._detect = load_net(palm, ("Identity", "Identity_1"), runtime)
        self._landmarks = load_net(hand, ("Identity", "Identity_1", "Identity_2", "Identity_3"), runtime)
        self._square: _Square | None = None
        self._anchors = _anchors()

    def track(self, picture: Picture) -> Seen | None:
        """Return the hand in a frame (H, W, 3), blue first; None where there is none."""
        seen = self._in(picture, self._square) if self._square is not None else None
        if seen is None:
            seen = self._first(picture)
        self._square = None if seen is None else _around(seen.pixels)
        return seen

    def _first(self, picture: Picture) -> Seen | None:
        """Return the hand of the surest palm; of several palms where one kind of hand is sought, the first of it."""
        palms = self.palms(picture)[: 1 if self._sought is None else 4]
        found = [seen for _, square in palms if (seen := self._in(picture, square)) is not None]
        if self._sought is None or len(palms) < 2:
            return found[0] if found else None
        return next((seen for seen in found if seen.right > 0.5), None)

    def hands(self, picture: Picture) -> int:
        """Return how many hands a picture shows."""
        found: list[Array] = []
        for _, square in self.palms(picture)[:4]:
            seen = self._in(picture, square)
            if seen is None:
                continue
            size = np.linalg.norm(seen.pixels[9] - seen.pixels[0])
            if all(np.linalg.norm(other[[0, 9]] - seen.pixels[[0, 9]], axis=1).mean() > 0.7 * size for other in found):
                found.append(seen.pixels)
        return len(found)

    def palms(self, picture: Picture) -> list[tuple[float, _Square]]:
        """Return the palms of a frame, the surest first, as scores and squares around the hands."""
        height, width = picture.shape[:2]
        scale = _PALM / max(height, width)
        shift = np.array([_PALM - scale * width, _PALM - scale * height]) / 2.0
        # pixel centres are integers in both pictures: u' + 0.5 = scale (u + 0.5) + shift
        to_net = np.array([[scale, 0.0, shift[0] + 0.5 * scale - 0.5], [0.0, scale, shift[1] + 0.5 * scale - 0.5]])
        boxes, scores = self._detect(_warped(picture, np.linalg.inv(_square3(to_net))[:2], _PALM))
        score = 1.0 / (1.0 + np.exp(-np.clip(scores[:, 0].astype(float), -100.0, 100.0)))
        sure = score > _SURE
        found = boxes[sure].astype(float) / _PALM
        points = found.reshape(len(found), 9, 2)
        points[:, 0] += self._anchors[sure]
        points[:, 2:] += self._anchors[sure][:, None]
        merged = _merged(points, score[sure])
        return [(best, _of_palm(*self._to_frame(each, scale, shift))) for best, each in merged]

    @staticmethod
    def _to_frame(points: Array, scale: float, shift: Array) -> tuple[Array, Array, Array]:
        """Return centre, size and keypoints in pixels of the frame, of points (9, 2) from 0 to 1 of the net's input."""
        pixels = (points * _PALM - shift) / scale - 0.5
        return pixels[0], points[1] * _PALM / scale, pixels[2:]

    def _in(self, picture: Picture, square: _Square) -> Seen | None:
        """Return the hand in a square of a frame."""
        matrix = square.matrix(_HAND)
        points, presence, right, world = self._landmarks(_warped(picture, matrix, _HAND))
        if float(presence[0]) < _SURE:
            return None
        crop = points.reshape(21, 3).astype(float)[:, :2]
        pixels = crop @ matrix[:, :2].T + matrix[:, 2]
        turn = np.eye(3)
        cosine, sine = np.cos(square.angle), np.sin(square.angle)
        turn[:2, :2] = [[cosine, -sine], [sine, cosine]]
        return Seen(pixels, world.reshape(21, 3).astype(float) @ turn.T, float(right[0]), float(presence[0]))


def _anchors() -> Array:
    """Return the centres (2016, 2) of the detector's anchors, from 0 to 1."""
    grids = []
    for count, each in ((24, 2), (12, 6)):
        centre = (np.arange(count) + 0.5) / count
        x, y = np.meshgrid(centre, centre)
        grids.append(np.repeat(np.stack([x.ravel(), y.ravel()], axis=1), each, axis=0))
    return np.concatenate(grids)


def _merged(points: Array, score: Array) -> list[tuple[float, Array]]:
    """Return palms (9, 2) with their scores: of boxes of one palm the mean weighted by score."""
    found = []
    left = np.argsort(-score)
    while len(left):
        same = _overlap(points[left], points[left[0]]) > _SAME
        same[0] = True
        group = left[same]
        found.append((float(score[left[0]]), np.average(points[group], axis=0, weights=score[group])))
        left = left[~same]
    return found


def _overlap(boxes: Array, box: Array) -> Array:
    """Return intersection over union (N,) of boxes (N, 9, 2), centre and size first, with one of them."""
    low = np.maximum(boxes[:, 0] - boxes[:, 1] / 2.0, box[0] - box[1] / 2.0)
    high = np.minimum(boxes[:, 0] + boxes[:, 1] / 2.0, box[0] + box[1] / 2.0)
    shared = np.prod(np.maximum(high - low, 0.0), axis=1)
    return np.asarray(shared / np.maximum(np.prod(boxes[:, 1], axis=1) + np.prod(box[1]) - shared, 1e-12))


def _of_palm(centre: Array, size: Array, keypoints: Array) -> _Square:
    """Return the square around a hand, from the box and the keypoints of its palm."""
    angle = _upright(keypoints[2] - keypoints[0])
    return _Square(centre + 0.5 * size[1] * _up(angle), 2.6 * float(size.max()), angle)


def _around(pixels: Array) -> _Square:
    """Return the square around a hand, from its landmarks."""
    knuckles = ((pixels[5] + pixels[13]) / 2.0 + pixels[9]) / 2.0
    angle = _upright(knuckles - pixels[0])
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, -sine], [sine, cosine]])
    own = pixels[list(_AROUND)] @ turn
    low, high = own.min(axis=0), own.max(axis=0)
    size = high - low
    return _Square(turn @ ((low + high) / 2.0) + 0.1 * size[1] * _up(angle), 2.0 * float(size.max()), angle)


def _upright(direction: Array) -> float:
    """Return the angle of a crop in which a direction of the frame points up."""
    angle = np.pi / 2.0 - np.arctan2(-direction[1], direction[0])
    return float((angle + np.pi) % (2.0 * np.pi) - np.pi)


def _up(angle: float) -> Array:
    return np.array([np.sin(angle), -np.cos(angle)])


def _square3(matrix: Array) -> Array:
    return np.vstack([matrix, [0.0, 0.0, 1.0]])


def _warped(picture: Picture, matrix: Array, size: int) -> Image:
    """Return the crop (size, size, 3), RGB from 0 to 1, whose pixels an affine map (2, 3) takes to the frame's."""
    cv2: Any = opencv()
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    crop: NDArray[np.uint8] = cv2.warpAffine(picture, matrix, (size, size), flags=flags)
    return np.ascontiguousarray(crop[:, :, ::-1], dtype=np.float32) / np.float32(255.0)
