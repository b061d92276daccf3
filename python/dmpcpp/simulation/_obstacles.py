"""Things that stand in an arm's way: fixed, known by a name, never moved."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from dmpcpp.errors import InvalidArgument
from dmpcpp.simulation._simulator import FLOOR


@dataclass(frozen=True)
class Box:
    """A fixed box with its sides along the axes of the root's frame.

    Attributes
    ----------
    name : str
        As contacts name it; not that of a link, and not "floor".
    size : (float, float, float)
        Along x, y, z [m], > 0.
    centre : (float, float, float)
        [m] in the root's frame.

    Raises
    ------
    InvalidArgument
        A size that is not positive, or a number that is not finite.
    """

    name: str
    size: tuple[float, float, float]
    centre: tuple[float, float, float]

    def __post_init__(self) -> None:
        """Refuse what is no box."""
        for name in ("size", "centre"):
            value = getattr(self, name)
            if np.shape(value) != (3,) or not np.isfinite(value).all():
                raise InvalidArgument(f"{name} of box '{self.name}': {value}, expected three finite numbers [m].")
        if min(self.size) <= 0.0:
            raise InvalidArgument(f"size of box '{self.name}': {self.size}, expected three positive numbers [m].")


def refuse_names(obstacles: Sequence[Box], links: Collection[str]) -> None:
    """Refuse a name that contacts would take for something else: of a link, of the floor, of another obstacle."""
    for k, box in enumerate(obstacles):
        taken = {*links, FLOOR, *(other.name for other in obstacles[:k])}
        if box.name in taken:
            raise InvalidArgument(
                f"obstacles[{k}].name: '{box.name}' is a link, the floor or another obstacle. Give it its own."
            )
