"""A reach of a right arm as a BVH file: lengths in cm, y up, as motion-capture software writes them."""

from __future__ import annotations

import numpy as np

from dmpcpp.examples._motions import minimum_jerk

__all__ = ["reach"]

_FRAMES = 61
_STEP = 1 / 30  # s
_SKELETON = """HIERARCHY
ROOT Hips
{
  OFFSET 0.0 95.0 0.0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT RightArm
  {
    OFFSET -18.0 45.0 0.0
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT RightForeArm
    {
      OFFSET -30.0 0.0 0.0
      CHANNELS 3 Zrotation Xrotation Yrotation
      JOINT RightHand
      {
        OFFSET -26.0 0.0 0.0
        CHANNELS 3 Zrotation Xrotation Yrotation
        End Site
        {
          OFFSET -8.0 0.0 0.0
        }
      }
    }
  }
}
"""
# Degrees at the start and at the end of the reach: shoulder, elbow, wrist; each turned about z, x, y.
_START = np.array([62.0, 0.0, 8.0, 10.0, 0.0, 55.0, 0.0, 5.0, 0.0])
_END = np.array([28.0, 6.0, 48.0, 4.0, 12.0, 30.0, -12.0, 30.0, 8.0])
_HIPS = (0.0, 95.0, 0.0, 0.0, 0.0, 0.0)


def reach() -> str:
    """Return the text of the file: 2 s at 30 Hz, elbow and wrist a little behind the shoulder."""
    time = np.arange(_FRAMES) * _STEP
    delay = np.repeat([0.0, 0.1, 0.2], 3)
    way = minimum_jerk((time[:, None] - delay) / 1.8)
    angles = _START + way * (_END - _START)
    lines = [" ".join(f"{value:.3f}" for value in (*_HIPS, *row)) for row in angles]
    return f"{_SKELETON}MOTION\nFrames: {_FRAMES}\nFrame Time: {_STEP:.6f}\n" + "\n".join(lines) + "\n"
