"""Things to be handled: what an engine needs to know of an object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp.errors import InvalidArgument


@dataclass(frozen=True)
class Friction:
    """Coulomb friction of a surface; an engine combines those of two that touch (Bullet by their product).

    Attributes
    ----------
    lateral : float
        Against sliding [1], >= 0.
    spinning, rolling : float
        Against turning about the contact's normal and about an axis in its plane [m], >= 0.
    """

    lateral: float
    spinning: float = 0.0
    rolling: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no friction."""
        for name in ("lateral", "spinning", "rolling"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise InvalidArgument(f"{name}: {getattr(self, name)}, expected a number >= 0.")


@dataclass(frozen=True)
class Cylinder:
    """A solid cylinder of even density, upright while its axis is z.

    Attributes
    ----------
    radius, height : float
        [m], > 0.
    mass : float
        [kg], > 0.
    friction : Friction
    """

    radius: float = 0.03
    height: float = 0.16
    mass: float = 0.3
    friction: Friction = Friction(0.8, spinning=1e-3, rolling=1e-4)

    def __post_init__(self) -> None:
        """Refuse what is no body."""
        for name in ("radius", "height", "mass"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise InvalidArgument(f"{name}: {getattr(self, name)}, expected a positive number.")
