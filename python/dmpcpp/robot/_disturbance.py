"""What a controller does not know of the arm that it drives, and of what it measures."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields

import numpy as np

from dmpcpp.errors import InvalidArgument


@dataclass(frozen=True)
class Disturbance:
    """Everything in which the simulated world differs from the controller's idea of it; by default nothing.

    The same disturbance gives the same run, bit for bit.

    Attributes
    ----------
    mass_error : float
        Every link is by this share heavier or lighter than the controller believes, drawn by ``seed``, its
        inertia with it; 0 to 1 (excluded).
    payload : float
        An unknown sphere of 3 cm radius at the tip [kg], >= 0.
    payload_offset : (float, float, float)
        Its centre in the frame of the tip [m].
    damping : float
        Viscous friction of every joint on top of the URDF's [Nms/rad], >= 0.
    friction : float
        Coulomb friction of every joint [Nm], >= 0, solved inside the step by the engine. The engine's own
        motors (modes other than computed torque) are not slowed by it in Bullet.
    sensor_delay : float
        Age of the joint states that the controller sees [s], >= 0, rounded to whole steps.
    position_noise, velocity_noise : float
        Standard deviation of Gaussian noise on what the controller sees [rad, rad/s], >= 0.
    control_rate : float or None
        How often the controller acts [Hz]; its command is held meanwhile. None: at every step. It must divide
        the rate of the simulation.
    seed : int
        Of masses and noise, >= 0.

    Raises
    ------
    InvalidArgument
        A number out of its range.
    """

    mass_error: float = 0.0
    payload: float = 0.0
    payload_offset: tuple[float, float, float] = (0.0, 0.0, 0.1)
    damping: float = 0.0
    friction: float = 0.0
    sensor_delay: float = 0.0
    position_noise: float = 0.0
    velocity_noise: float = 0.0
    control_rate: float | None = None
    seed: int = 0

    def __post_init__(self) -> None:
        """Refuse what is out of range."""
        amounts = ("mass_error", "payload", "damping", "friction", "sensor_delay", "position_noise", "velocity_noise")
        for name in (*amounts, "seed"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise InvalidArgument(f"{name}: {getattr(self, name)}, expected a number >= 0.")
        if self.mass_error >= 1.0:
            raise InvalidArgument(f"mass_error: {self.mass_error}, expected a share below 1.")
        if self.control_rate is not None and not 0.0 < self.control_rate < np.inf:
            raise InvalidArgument(f"control_rate: {self.control_rate}, expected a positive number of Hz.")
        if np.shape(self.payload_offset) != (3,) or not np.isfinite(self.payload_offset).all():
            raise InvalidArgument(f"payload_offset: {self.payload_offset}, expected three finite numbers.")

    @property
    def changes_arm(self) -> bool:
        """Whether the arm itself differs from the controller's model of it."""
        return any((self.mass_error, self.payload, self.damping, self.friction))

    def mass_factors(self, links: Iterable[str]) -> dict[str, float]:
        """True mass over the believed one, for every link: 1 + mass_error or 1 - mass_error."""
        links = list(links)
        signs = np.random.default_rng(self.seed).choice([-1.0, 1.0], len(links))
        return {link: 1.0 + float(sign) * self.mass_error for link, sign in zip(links, signs, strict=True)}

    def __str__(self) -> str:
        """The fields that are not at their default."""
        changed = {f.name: getattr(self, f.name) for f in fields(self) if getattr(self, f.name) != f.default}
        return ", ".join(f"{name} {value}" for name, value in changed.items()) or "none"
