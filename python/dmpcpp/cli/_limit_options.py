"""Options of the limits by which a run is judged, and of what is accepted unjudged."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from dmpcpp.cli._add_options import add_options
from dmpcpp.cli._flags import flag
from dmpcpp.errors import InvalidArgument

__all__ = ["accept_option", "dynamics_option", "limit_options", "names", "taken_limits"]

_KINDS = {
    "velocity": "rad/s or m/s",
    "acceleration": "rad/s^2 or m/s^2",
    "jerk": "rad/s^3 or m/s^3",
    "effort": "Nm or N",
}
_FIELDS = (*_KINDS, "tool_speed", "payload", "density", "limits")


def limit_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the limits of joints, tool and payload to a command; `taken_limits` takes them out of its arguments."""
    options = [
        click.option(
            f"--{kind}",
            metavar="VALUE|V1,V2,..|JOINT=VALUE,..",
            help=f"Limits of {kind} [{unit}]: one for all joints, one for each, or some by name (default: the URDF's "
            "or the maker's).",
        )
        for kind, unit in _KINDS.items()
    ]
    options += [
        click.option(
            "--tool-speed", type=click.FloatRange(0, min_open=True), metavar="M/S", help="Limit of the tool's speed."
        ),
        click.option(
            "--payload",
            metavar="KG[,X,Y,Z]",
            help="Mass at the tip, and its centre in the tip link's frame [m]; controller and plan know of it.",
        ),
        click.option(
            "--density",
            type=click.FloatRange(0, min_open=True),
            metavar="KG/M3",
            help="Take mass and inertia of links that state none from their collision shapes, of this density.",
        ),
        click.option(
            "--limits",
            type=click.Path(dir_okay=False, path_type=Path),
            metavar="FILE.yaml",
            help="Limits as in MoveIt's joint_limits.yaml; options beside it win.",
        ),
    ]
    return add_options(command, options)


def taken_limits(options: dict[str, Any]) -> dict[str, Any]:
    """Take the limits out of a command's arguments: what `arms.with_stated` takes by keyword, for JSON."""
    given = {name: value for name in _FIELDS if (value := options.pop(name)) is not None}
    stated: dict[str, Any] = {kind: _values(kind, given[kind]) for kind in _KINDS if kind in given}
    stated |= {name: given[name] for name in ("tool_speed", "density") if name in given}
    if "payload" in given:
        stated["payload"] = _payload(given["payload"])
    if "limits" in given:
        stated["file"] = str(given["limits"])
    return stated


def accept_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --accept."""
    return click.option(
        "--accept",
        metavar="CHECK[,CHECK]",
        multiple=True,
        help="Accept checks that cannot be judged, e.g. torque_ratio for an arm without effort limits; never one "
        "that failed.",
    )(command)


def dynamics_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --dynamics."""
    return click.option(
        "--dynamics",
        default="full",
        show_default=True,
        type=click.Choice(["full", "none"]),
        help="full: torque control; none: kinematics only, for an arm without inertias, torque not judged.",
    )(command)


def names(stated: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names in values such as "a,b" of an option that may be repeated; InvalidArgument for unknown ones."""
    from dmpcpp.checks import accepted_names

    return accepted_names(name.strip() for text in stated for name in text.split(",") if name.strip())


def _values(kind: str, text: str) -> list[float] | dict[str, float]:
    parts = [part.strip() for part in text.split(",")]
    try:
        if "=" in text:
            pairs = [part.rpartition("=") for part in parts]
            if not all(name for name, _, _ in pairs):
                raise ValueError
            return {name.strip(): float(value) for name, _, value in pairs}
        return [float(part) for part in parts]
    except ValueError:
        raise InvalidArgument(
            f"{flag(kind)}: '{text}', expected a number such as 2, one for each joint such as 2,2,2.5, or joint=2.5."
        ) from None


def _payload(text: str) -> list[float]:
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) not in (1, 4):
        raise InvalidArgument(f"--payload: '{text}', expected kg such as 1.5, or with its centre: 1.5,0,0,0.05.")
    return values
