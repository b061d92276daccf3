"""The pictures of a video one by one, upright, each with its true time. Never more than one is held."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dmpcpp.cameras._opencv import opencv
from dmpcpp.errors import FileError, InvalidArgument

__all__ = ["Picture", "Video", "open_video"]

Picture = NDArray[np.uint8]

_MOST_FRAMES = 108_000  # an hour at 30 Hz
_LEAST_FRAMES = 8
_STILL = 1e-6  # s; a time that does not go on is none


@dataclass(frozen=True)
class Video:
    """A video that can be read: its path, and the size (width, height) of its pictures [px], upright."""

    path: Path
    size: tuple[int, int]
    rate: float

    def frames(self) -> Iterator[tuple[float, Picture]]:
        """Yield the time [s] and the picture (H, W, 3), blue first, of each frame.

        Raises
        ------
        InvalidArgument
            Fewer than 8 frames, or more than an hour of them.
        """
        capture = _opened(self.path)
        count, last = 0, -np.inf
        try:
            while True:
                read, picture = capture.read()
                if not read:
                    break
                time = capture.get(opencv().CAP_PROP_POS_MSEC) / 1e3
                time = time if time > last + _STILL else last + 1.0 / self.rate  # some containers time no last frame
                if picture.ndim != 3 or (picture.shape[1], picture.shape[0]) != self.size:
                    raise InvalidArgument(f"frame {count}: another size than the first. Convert the video to one size.")
                yield time, picture
                count, last = count + 1, time
                if count > _MOST_FRAMES:
                    raise InvalidArgument(f"more than {_MOST_FRAMES} frames. Cut the motion out of the video.")
        finally:
            capture.release()
        if count < _LEAST_FRAMES:
            raise InvalidArgument(f"{count} frame(s) can be decoded, expected at least {_LEAST_FRAMES}. Record longer.")


def open_video(path: Path) -> Video:
    """Return a video that can be decoded.

    Raises
    ------
    FileError
        The file is missing.
    InvalidArgument
        It cannot be decoded.
    """
    if not path.is_file():
        raise FileError(f"{path}: there is no such file.")
    capture = _opened(path)
    try:
        read, picture = capture.read()
        rate = float(capture.get(opencv().CAP_PROP_FPS))
    finally:
        capture.release()
    if not read or picture is None:
        raise InvalidArgument("no frame can be decoded. Convert the video: ffmpeg -i IN -c:v libx264 OUT.mp4.")
    return Video(path, (picture.shape[1], picture.shape[0]), rate if 1.0 <= rate <= 1000.0 else 30.0)


def _opened(path: Path) -> Any:
    cv2 = opencv()
    if hasattr(cv2, "utils") and hasattr(cv2.utils, "logging"):
        cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    return cv2.VideoCapture(str(path), cv2.CAP_FFMPEG)
