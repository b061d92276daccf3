"""How a model goes to starts and goals that were not demonstrated: by which scaling, and why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dmpcpp._core import InvalidArgument, PoseDmp, PoseDmpSequence, Scaling

__all__ = ["ChosenScaling", "with_scaling"]

_ABOUT = {
    Scaling.none: "the spring alone leads to a new goal, so the motion may go back first; scaling='advance' does not",
    Scaling.per_axis: "each axis is multiplied by its way",
    Scaling.per_axis_relative: "each axis is multiplied by its way over the demonstrated one",
    Scaling.rotation_dilation: "the motion is turned and dilated with the way to its goal",
    Scaling.advance: "new goals are approached as the demonstration advances, whatever its shape",
}


@dataclass(frozen=True)
class ChosenScaling:
    """A scaling and why it was taken.

    Attributes
    ----------
    name : str
        Of a `Scaling`.
    reason : str
    notes : tuple of str
        Where its guard steps in on the way to the goal, axis by axis.
    """

    name: str
    reason: str
    notes: tuple[str, ...] = ()

    def describe(self) -> str:
        """Return one line."""
        return f"scaling: {self.name}, {self.reason}."

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {"name": self.name, "reason": self.reason, "notes": list(self.notes)}


def with_scaling(
    model: PoseDmp | PoseDmpSequence, scaling: str | Scaling = "automatic", goal: ArrayLike | None = None
) -> tuple[PoseDmp | PoseDmpSequence, ChosenScaling]:
    """Return the model under a scaling; "automatic" is the one that it was learned with.

    Parameters
    ----------
    model : PoseDmp or PoseDmpSequence
    scaling : str or Scaling
    goal : (4, 4), optional
        Where it shall go; the demonstrated one unless given.

    Raises
    ------
    InvalidArgument
        An unknown scaling, one that the form of orientations does not bear, or a goal that is no pose.
    """
    automatic = scaling in ("automatic", Scaling.automatic)
    if isinstance(model, PoseDmpSequence):
        if not automatic:
            raise InvalidArgument(f"scaling: {scaling} of a sequence, expected automatic: each motion has its own.")
        return model, ChosenScaling("automatic", "of each motion its own", ())
    led = model if automatic else model.with_scaling(scaling)
    taken = led.options.scaling
    notes = led.scaling_notes(None if goal is None else np.asarray(goal, dtype=np.float64))
    why = "with which the model was learned" if automatic else "as stated"
    return led, ChosenScaling(taken.name, f"{why}: {_ABOUT[taken]}", tuple(notes))
