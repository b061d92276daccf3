"""What a motion gains without what moves in it faster than a hand usually does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from dmpcpp import motion
from dmpcpp._core import PoseDemonstration, PoseDmp
from dmpcpp.errors import InvalidArgument
from dmpcpp.learning import learn
from dmpcpp.metrics import compare
from dmpcpp.recordings import Recording

__all__ = ["Calmer", "calmer"]

_CUTOFF = 4.0  # Hz; trackers and videos wobble above, hands seldom move there
_WORTHWHILE = 3.0  # times: slower than recorded, and how far the largest acceleration falls


@dataclass(frozen=True)
class Calmer:
    """The same motion below a frequency.

    Attributes
    ----------
    cutoff : float
        Hz.
    sharpness : float
        Largest acceleration of the motion as it is over that below the cutoff.
    moved, turned : float
        m and rad RMS that the low-pass changes.
    duration, instead : float
        s, as executed, and as it would be executed below the cutoff.
    """

    cutoff: float
    sharpness: float
    moved: float
    turned: float
    duration: float
    instead: float

    def describe(self) -> str:
        """Return what to do, with both durations."""
        return (
            f"Executed in {self.duration:.3g} s; low_pass={self.cutoff:g} makes it {self.instead:.3g} s: below "
            f"{self.cutoff:g} Hz accelerations are {self.sharpness:.2g} times smaller, and positions change by "
            f"{1e3 * self.moved:.2g} mm, orientations by {np.degrees(self.turned):.2g} deg rms."
        )

    def to_dict(self) -> dict[str, Any]:
        """For JSON; Hz, m, rad, s."""
        return dict(vars(self))


def calmer(
    recording: Recording, learned: PoseDemonstration, slowdown: float, slowed: Callable[[PoseDmp], float]
) -> Calmer | None:
    """Return what a low-pass of 4 Hz brings, where a motion is carried out more than 3 times slower than recorded and
    its largest acceleration would fall by more than 3; None elsewhere.

    `learned` is the motion as it was learned; `slowed` returns the duration [s] in which a model of it is executed.
    """
    if slowdown <= _WORTHWHILE or recording.rate <= 2.0 * _CUTOFF:
        return None
    even = recording if motion.evenly_sampled(recording) else motion.resample(recording, recording.rate)
    try:
        below = motion.demonstration(motion.low_pass(even, _CUTOFF))
    except InvalidArgument:  # too short for a filter
        return None
    sharpness = max(a / b for a, b in zip(_peaks(learned), _peaks(below), strict=True) if b > 0.0)
    if sharpness <= _WORTHWHILE:
        return None
    try:
        instead = slowed(learn(below))
    except InvalidArgument:  # a hint that cannot be had is no reason to stop
        return None
    if instead >= slowdown * learned.duration:
        return None
    changed = compare(motion.demonstration(even).pose, below.pose)
    return Calmer(_CUTOFF, sharpness, changed.position_rmse, changed.angle_rmse, slowdown * learned.duration, instead)


def _peaks(demonstration: PoseDemonstration) -> tuple[float, float]:
    """Return the largest acceleration [m/s^2] and angular acceleration [rad/s^2]."""
    at = demonstration.time
    linear = np.linalg.norm(demonstration.position.at(at).acceleration, axis=1)
    turning = np.linalg.norm(demonstration.orientation.at(at).angular_acceleration, axis=1)
    return float(linear.max()), float(turning.max())
