"""OpenCV, where it is installed."""

from __future__ import annotations

from typing import Any

from dmpcpp.errors import MissingDependency

__all__ = ["opencv"]


def opencv() -> Any:
    """Return the module cv2, one thread of it: results do not depend on the machine, and others have the rest.

    Raises
    ------
    MissingDependency
        It is not installed.
    """
    try:
        import cv2
    except ImportError as error:
        raise MissingDependency(f'videos are read with OpenCV: pip install "dmpcpp[cameras]" ({error}).') from None
    cv2.setNumThreads(1)
    return cv2
