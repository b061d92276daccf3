"""A hand through a whole video: its landmarks with true times, and whether the camera stood still meanwhile."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._frames import Picture, Video
from dmpcpp.cameras._landmarks import Landmarks
from dmpcpp.cameras._opencv import opencv
from dmpcpp.cameras._tracker import Tracker
from dmpcpp.errors import InvalidArgument

__all__ = ["Stillness", "Watched", "watch_hand"]

_LEAST_FOUND = 12  # frames with a hand
_LEAST_SHARE = 0.3
_COUNTED_EVERY = 15  # frames between looks for a second hand
_TWO = 0.3  # share of the looks that show two hands
_SMALL = (192, 108)  # px, of the pictures whose background is compared
_LEFT, _RIGHT = 0.3, 0.7  # probability of a right hand: below, above, it is sure


@dataclass(frozen=True, eq=False)
class Watched:
    """What a camera saw, and how far its background moved, as a share of the picture's width."""

    landmarks: Landmarks
    moved: float


def watch_hand(
    video: Video,
    camera: Camera,
    *,
    hand: str | None = None,
    mirrored: bool = False,
    runtime: str | None = None,
    tell: Callable[[float], None] | None = None,
) -> Watched:
    """Track a hand through a video, frame by frame.

    Parameters
    ----------
    video : Video
    camera : Camera
        Of the video's size.
    hand : "left", "right" or None
        Which one; None: the only one, a right one.
    mirrored : bool
        Whether the video is a mirror's, as selfie cameras make them.
    runtime : str, optional
        See `load_net`.
    tell : callable, optional
        Called with the time [s] of each frame.

    Raises
    ------
    InvalidArgument
        No hand is seen, two are and none is named, or another one than is expected.
    """
    flip = mirrored != (hand == "left")  # a left hand is tracked as a right one, in a mirror
    tracker, still, rows = Tracker(runtime, sought="right" if hand else None), Stillness(), []
    counts: list[int] = []
    for k, (time, frame) in enumerate(video.frames()):
        picture = np.ascontiguousarray(frame[:, ::-1]) if flip else frame
        seen = tracker.track(picture)
        rows.append((time, seen))
        if k % _COUNTED_EVERY == 0:
            still.look(picture, None if seen is None else seen.pixels)
            if hand is None:
                counts.append(tracker.hands(picture))
        if tell:
            tell(time)
    lost = np.full((21, 2), np.nan), np.full((21, 3), np.nan), np.nan
    columns = zip(*((seen.pixels, seen.world, seen.right) if seen else lost for _, seen in rows), strict=True)
    pixels, world, right = map(np.array, columns)
    _require_one(pixels, right, counts, hand, mirrored)
    if flip:
        camera = _mirrored(camera)
    time = np.array([time for time, _ in rows])
    return Watched(Landmarks(time, pixels, world, right, camera, video.path.name), still.moved)


def _require_one(pixels: Array, right: Array, counts: list[int], hand: str | None, mirrored: bool) -> None:
    found = int(np.isfinite(pixels[:, 0, 0]).sum())
    if found < _LEAST_FOUND or found < _LEAST_SHARE * len(pixels):
        raise InvalidArgument(
            f"a hand is found in {found} of {len(pixels)} frames, expected most of them. Show the open hand to the "
            "camera, well lit and in focus, or use a printed tag (tag='0:60mm')."
        )
    if counts and np.mean(np.array(counts) > 1) > _TWO:
        raise InvalidArgument(
            "two hands are seen. State which one counts: body='right_hand' or body='left_hand', or keep the other out "
            "of the picture."
        )
    sure = float(np.nanmedian(right))
    if hand is None and sure < _RIGHT:
        which = "a left hand, or a mirrored video" if sure < _LEFT else "a hand of which it is not sure which one it is"
        raise InvalidArgument(
            f"the video shows {which} (right: {sure:.2f}). State body='left_hand', body='right_hand' or mirrored=True."
        )


def _mirrored(camera: Camera) -> Camera:
    matrix = camera.matrix.copy()
    matrix[0, 2] = camera.size[0] - 1 - matrix[0, 2]
    matrix[0, 1] = -matrix[0, 1]
    distortion = camera.distortion * [1.0, 1.0, 1.0, -1.0, 1.0]
    return Camera(matrix, camera.size, distortion)


class Stillness:
    """Whether a camera stands still: its background against that of the first look."""

    def __init__(self) -> None:
        """Begin without a look."""
        self._first: list[Array] | None = None
        self._shifts: list[float] = []

    @property
    def moved(self) -> float:
        """How far the background moved at most, as a share of the picture's width."""
        return max(self._shifts, default=0.0)

    def look(self, picture: Picture, hand: Array | None) -> None:
        """Compare a picture (H, W, 3); `hand` are landmarks (21, 2) [px] that are no background."""
        cv2 = opencv()
        small = cv2.resize(picture, _SMALL, interpolation=cv2.INTER_AREA).mean(axis=2)
        blocks = [small[y : y + 54, x : x + 64].copy() for y in (0, 54) for x in (0, 64, 128)]
        if self._first is None:
            self._first = blocks
            return
        window = cv2.createHanningWindow((64, 54), cv2.CV_64F)
        shifts, scale = [], _SMALL[0] / picture.shape[1]
        for k, (before, now) in enumerate(zip(self._first, blocks, strict=True)):
            x, y = 64 * (k % 3), 54 * (k // 3)
            if hand is not None and _near(hand * scale, x, y):
                continue
            if before.std() > 4.0:  # a plain wall tells nothing
                shift, response = cv2.phaseCorrelate(before, now, window)
                if response > 0.3:
                    shifts.append(float(np.hypot(*shift)))
        if len(shifts) >= 2:
            self._shifts.append(float(np.median(shifts)) / _SMALL[0])


def _near(points: Array, x: int, y: int) -> bool:
    low, high = points.min(axis=0) - 6.0, points.max(axis=0) + 6.0
    return bool(low[0] < x + 64 and high[0] > x and low[1] < y + 54 and high[1] > y)
