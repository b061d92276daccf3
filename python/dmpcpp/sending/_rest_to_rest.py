"""What a robot can be sent: a motion with a lead-in and a lead-out, exactly at rest at both ends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.sending._between import JointMotion, interpolated
from dmpcpp.sending._lead import Backwards, Clear, lead_out

__all__ = ["PHASES", "RestToRest", "from_rest_to_rest", "phases_of"]

PHASES = ("lead-in", "motion", "lead-out")
_LONGEST_STEP = 0.05  # s between samples of a lead


@dataclass(frozen=True, eq=False)
class RestToRest:
    """Joints over time with velocity and acceleration exactly 0 at the first and the last sample.

    Attributes
    ----------
    time : (T,) s
        On the clock of the motion: a lead-in comes before its first sample.
    position, velocity, acceleration : (T, n)
        rad, rad/s, rad/s^2; the quintic through them is the motion.
    joint_names : tuple of str
    motion : slice
        The samples of the motion, bit for bit.
    slowed : (float, float)
        s that the begin and the end of the path take longer, where no lead fits; a lead leaves them at 0.
    joints : JointMotion
        The motion that it was made of.
    fits : bool
        Whether leads were found that hold the limits and touch nothing.
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    joint_names: tuple[str, ...]
    motion: slice
    joints: JointMotion
    slowed: tuple[float, float] = (0.0, 0.0)
    fits: bool = True

    @property
    def phase(self) -> tuple[str, ...]:
        """One of PHASES for every sample."""
        return phases_of(self.motion, len(self.time))

    @property
    def origin(self) -> float:
        """The time of the motion's first sample [s]; where its begin is slowed down, as if it were not."""
        return float(self.time[0] + self.slowed[0] if self.slowed[0] > 0.0 else self.time[self.motion.start])

    @property
    def path(self) -> tuple[float, float]:
        """When the arm gets onto the path of the motion and when it leaves it [s]."""
        first, last = self.time[self.motion][[0, -1]]
        begin = self.time[0] if self.slowed[0] > 0.0 else first
        return float(begin), float(self.time[-1] if self.slowed[1] > 0.0 else last)

    def note(self) -> str:
        """Return one sentence where the ends of the path were slowed down, else ""."""
        named = [
            f"{which} by {1e3 * cost:.0f} ms"
            for which, cost in zip(("begin", "end"), self.slowed, strict=True)
            if cost > 0.0
        ]
        if not named:
            return ""
        return (
            f"no lead beside the path fits; along the path the motion is slowed down at its {' and its '.join(named)}"
        )

    def to_dict(self) -> dict[str, Any]:
        """For JSON: the durations of the leads [s], and what ends that are slowed down cost [s]."""
        first, last = self.time[self.motion][[0, -1]]
        lead_in, lead_out = float(first - self.time[0]), float(self.time[-1] - last)
        return {"lead_in": lead_in, "lead_out": lead_out, "slowed": list(self.slowed)}

    def at_rate(self, rate: float) -> RestToRest:
        """Sample it evenly at ``rate`` [Hz] from its first sample on; the last one stands at its end or behind it."""
        begin, end = self.time[0], self.time[-1]
        steps = np.arange(1 + int(np.ceil((end - begin) * rate - 1e-6)))
        at = begin + steps / rate
        states = list(interpolated(self, np.minimum(at, end)))
        over = at >= end - 1e-6 / rate  # the last step lies behind the end, or on it up to rounding
        states[0][over], states[1][over], states[2][over] = self.position[-1], 0.0, 0.0
        first, last = self.time[self.motion][[0, -1]]
        inside = np.searchsorted(at, (first - 1e-9, last + 1e-9))
        return RestToRest(at, *states, self.joint_names, slice(*map(int, inside)), self.joints, self.slowed, self.fits)


def phases_of(motion: slice, samples: int) -> tuple[str, ...]:
    """One of PHASES for each of so many samples."""
    before, during = motion.start, motion.stop - motion.start
    return (PHASES[0],) * before + (PHASES[1],) * during + (PHASES[2],) * (samples - before - during)


def from_rest_to_rest(arm: Arm, joints: JointMotion, clear: Clear | None = None) -> RestToRest:
    """Lead a motion in from rest and out to rest.

    The leads start with the motion's own velocity and acceleration, keep the limits of position, velocity,
    acceleration, jerk (where stated) and effort, and touch nothing. Where none does, the end of the path itself is
    slowed down: the arm stays on the path, which takes longer.

    Parameters
    ----------
    arm : Arm
    joints : JointTrajectory
        (T, n), T >= 2.
    clear : callable, optional
        Whether the arm touches nothing along joints (N, n); by default that is not looked at.
    """
    steps = np.diff(joints.time)[[0, -1]]  # a motion that is slower in its middle has longer steps there
    steps /= np.ceil(steps / _LONGEST_STEP - 1e-9)
    before = lead_out(arm, Backwards(joints), float(steps[0]), clear)
    after = lead_out(arm, joints, float(steps[1]), clear)
    begin, end = before.replaced, len(joints.time) - after.replaced
    parts = {
        "time": (joints.time[begin] - before.after[::-1], joints.time[end - 1] + after.after),
        "position": (before.position[::-1], after.position),
        "velocity": (-before.velocity[::-1] + 0.0, after.velocity),  # a lead-in is a lead-out seen backwards
        "acceleration": (before.acceleration[::-1], after.acceleration),
    }
    whole = {
        name: np.concatenate([lead_in, getattr(joints, name)[begin:end], behind])
        for name, (lead_in, behind) in parts.items()
    }
    first = len(before.after)
    return RestToRest(
        **whole,
        joint_names=tuple(joints.joint_names),
        motion=slice(first, first + end - begin),
        joints=joints,
        slowed=(before.cost, after.cost),
        fits=before.fits and after.fits,
    )
