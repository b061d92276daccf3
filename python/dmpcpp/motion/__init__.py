"""Recordings cleaned, cut, compared and averaged: functions that take a Recording and return one that says what was
done.

>>> from dmpcpp import motion, recordings
>>> punch = recordings.clip("punch")                              # doctest: +SKIP
>>> motion.crop(motion.resample(punch, rate=100), 0.2, 1.2).history[-1]   # doctest: +SKIP
'cropped to 0.2 .. 1.2 s'

Samples that were lost stand as NaN in a Recording; `outliers` makes some more of them, `fill` and `split` take them
out. Every other step asks for whole recordings.
"""

from dmpcpp.motion._alignment import Spread, aligned, mean, medoid, spread
from dmpcpp.motion._cleaning import LONGEST_GAP, Gap, fill, gaps, gaps_in, outliers, skipped, split
from dmpcpp.motion._ends import without_repeated_ends
from dmpcpp.motion._long import one_motion, thinned
from dmpcpp.motion._plausibility import implausible, plausible
from dmpcpp.motion._poses import (
    complete,
    continuous,
    demonstration,
    poses,
    quaternions,
    relative_to,
    relative_to_pose,
    turn_angles,
)
from dmpcpp.motion._preparation import Preparation, prepare, prepare_all
from dmpcpp.motion._rests import rests, without_rests
from dmpcpp.motion._rhythm import one_cycle
from dmpcpp.motion._segmentation import cycles, segments, spans_of_cycles, spans_of_segments, speed
from dmpcpp.motion._smoothing import Noise, evenly_sampled, low_pass, noise, smooth, white_noise
from dmpcpp.motion._timing import crop, refine, resample

__all__ = [
    "LONGEST_GAP",
    "Gap",
    "Noise",
    "Preparation",
    "Spread",
    "aligned",
    "complete",
    "continuous",
    "crop",
    "cycles",
    "demonstration",
    "evenly_sampled",
    "fill",
    "gaps",
    "gaps_in",
    "implausible",
    "low_pass",
    "mean",
    "medoid",
    "noise",
    "one_cycle",
    "one_motion",
    "outliers",
    "plausible",
    "poses",
    "prepare",
    "prepare_all",
    "quaternions",
    "refine",
    "relative_to",
    "relative_to_pose",
    "resample",
    "rests",
    "segments",
    "skipped",
    "smooth",
    "spans_of_cycles",
    "spans_of_segments",
    "speed",
    "split",
    "spread",
    "thinned",
    "turn_angles",
    "white_noise",
    "without_repeated_ends",
    "without_rests",
]
