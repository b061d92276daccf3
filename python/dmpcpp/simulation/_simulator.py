"""What an execution asks of a physics engine: the small interface that every engine stands behind."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal, Protocol, Self

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import FLOOR as FLOOR
from dmpcpp.robot import ContactRules, InertiaRepair, Levers

GRAVITY = -9.81
"""m/s^2 along z of the URDF's root."""


@dataclass(frozen=True)
class Contact:
    """A link of the arm that touches another of its links, the floor or an object.

    Attributes
    ----------
    link, other : str
        Names of the two that touch; ``other`` is ``"floor"`` for the ground.
    depth : float
        How deep they overlap [m], >= 0.
    """

    link: str
    other: str
    depth: float


@dataclass(frozen=True)
class Clearance:
    """How far a link is from another link, the floor or an obstacle.

    Attributes
    ----------
    link, other : str
        As in ``Contact``.
    distance : float
        Between the collision shapes [m]; negative where they overlap.
    """

    link: str
    other: str
    distance: float


def kind_of(other: str, links: Collection[str]) -> Literal["self", "floor", "object"]:
    """What the ``other`` of a contact or clearance is, for a robot with these links."""
    if other in links:
        return "self"
    return "floor" if other == FLOOR else "object"


def checked_time_step(time_step: float) -> float:
    """Return a duration of one step [s] as a float; InvalidArgument for one that is not positive."""
    if not (np.isfinite(time_step) and time_step > 0.0):
        raise InvalidArgument(f"time_step: {time_step}, expected a positive number of seconds.")
    return float(time_step)


def refused(engine: str, arm: Arm, other: str, reason: str) -> InvalidArgument:
    """Return the error of an engine that cannot load an arm; what the engine says comes last."""
    return InvalidArgument(
        f"arm.urdf: {engine} cannot load '{arm.name}'. `dmpcpp check-urdf` looks for the defect; the other engine may "
        f"take it: simulator='{other}'. {engine} says: {reason}"
    )


class Simulator(Protocol):
    """An arm with a fixed base in a world with gravity, advanced one ``time_step`` at a time.

    Joint vectors have the order of ``arm.joint_names``. Every other moving joint of the robot (fingers) is
    held where it stands. Poses are 4x4 in the frame of ``arm.base``. Use it in a ``with`` statement: leaving
    closes it.
    """

    name: str
    """Engine and version, for the report."""
    arm: Arm
    time_step: float
    """Duration of one step [s]."""
    contact_rules: ContactRules
    """What is not looked at for contacts."""
    floor: float | None
    """Height of the ground in the frame of the URDF's root [m]; None for no ground."""
    obstacles: tuple[str, ...]
    """Names of what stands around the arm."""
    levers: Levers
    """How far each joint moves points of links."""
    unjudged_links: tuple[str, ...]
    """Links that the arm does not move and whose shapes cannot be read: their contacts are not judged."""
    inertia_repairs: tuple[InertiaRepair, ...]
    """Links whose inertia is not one of a rigid body and was replaced, and bodies that state none."""

    def reset(self, position: Array, velocity: Array) -> None:
        """Put the arm into a state: (n,) rad and (n,) rad/s."""

    def state(self) -> tuple[Array, Array]:
        """Measured joint position (n,) rad and velocity (n,) rad/s."""

    def inverse_dynamics(
        self,
        acceleration: Array,
        position: Array | None = None,
        velocity: Array | None = None,
    ) -> Array:
        """Torque (n,) Nm for ``acceleration`` (n,) rad/s^2, gravity and the URDF's damping included.

        In the state of the arm, or in one that is given: ``position`` (n,) rad and ``velocity`` (n,) rad/s.
        """

    def apply_torque(self, torque: Array) -> None:
        """Set the joint torque (n,) Nm of the next step."""

    def servo(self, velocity: Array) -> None:
        """Let the engine's own motors bring the joints to ``velocity`` (n,) rad/s by the end of the next step.

        If the effort limits allow: within them the motors give whatever torque that takes.
        """

    def servo_torque(self) -> Array:
        """Torque (n,) Nm that the engine's motors gave in the last step."""

    def step(self) -> None:
        """Advance by ``time_step``."""

    def tool_pose(self) -> Array:
        """Measured pose (4, 4) of ``arm.tip`` by the engine's own forward kinematics."""

    def masses(self) -> dict[str, float]:
        """Masses of the links as the engine has them [kg]."""

    def contacts(self) -> list[Contact]:
        """Contacts found in the last step: by Bullet at its start, by MuJoCo at its end."""

    def contacts_at(self, position: Array) -> list[Contact]:
        """Contacts with the arm put at ``position`` (n,) rad, at rest; no dynamics. It stays there."""

    def clearances_at(self, position: Array, within: float) -> list[Clearance]:
        """Pairs nearer than ``within`` [m] with the arm put at ``position`` (n,) rad, at rest. It stays there."""

    def __enter__(self) -> Self:
        """The world, open until the end of the block."""

    def __exit__(self, *failure: object) -> None:
        """Close it."""
