"""Robots by the address that people type: sim, franka://HOST."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.running._franka import FrankaRobot
from dmpcpp.running._robot import Robot
from dmpcpp.running._simulated import SimulatedRobot

__all__ = ["SCHEMES", "is_simulated", "robot_at"]

SCHEMES: dict[str, Callable[..., Robot]] = {"franka": FrankaRobot}
"""Drivers of real robots by the scheme of their address; each is made of a host."""


def is_simulated(address: str) -> bool:
    """Whether an address means the library's own physics."""
    return address == "sim"


def robot_at(address: str, arm: Arm, stands: Array, **simulated: Any) -> Robot:
    """Return the robot of an address; nothing is connected yet.

    Parameters
    ----------
    address : str
        "sim", or a scheme of SCHEMES with a host: "franka://192.168.1.10". There is no default host and no search.
    arm : Arm
    stands : (n,)
        Joints in which a simulated robot stands first.
    simulated
        Keywords of `SimulatedRobot`.

    Raises
    ------
    InvalidArgument
        An unknown scheme, or no host.
    """
    if is_simulated(address):
        return SimulatedRobot(arm, stands, **simulated)
    parts = urlsplit(address)
    if parts.scheme not in SCHEMES:
        known = ", ".join(["sim", *(f"{scheme}://HOST" for scheme in SCHEMES)])
        raise InvalidArgument(f"robot: '{address}', expected one of {known}.")
    if not parts.hostname or parts.path.strip("/") or parts.port is not None:
        raise InvalidArgument(f"robot: '{address}', expected a host alone, such as {parts.scheme}://192.168.1.10.")
    return SCHEMES[parts.scheme](parts.hostname)
