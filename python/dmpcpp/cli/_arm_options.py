"""The options that choose an arm, for every command that has one; `taken_arm` makes the arm of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from dmpcpp.cli._add_options import add_options
from dmpcpp.cli._limit_options import limit_options, taken_limits
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from dmpcpp._core import Arm
    from dmpcpp.robot import Surroundings

__all__ = [
    "arm_choice_options",
    "arm_options",
    "contact_options",
    "follow_option",
    "obstacle_options",
    "optional_arm_options",
    "taken_arm",
    "taken_choice",
    "taken_surroundings",
]

_FIELDS = ("base", "tip", "tool", "package_path")

_CHOICE = (
    click.option(
        "--base",
        metavar="LINK",
        help="Base link of the arm (default: the URDF's root, above a floating joint below it).",
    ),
    click.option(
        "--tip",
        metavar="LINK",
        help="Link that follows the hand (default: the tool at the end of the longest chain; the output names it).",
    ),
    click.option(
        "--tool",
        metavar="X,Y,Z[,ROLL,PITCH,YAW]",
        help="Frame that follows the hand instead of the tip, in the tip's frame [m, rad], as a URDF's <origin>.",
    ),
    click.option(
        "--package-path",
        multiple=True,
        metavar="DIR|NAME=DIR",
        help="Where packages of package:// paths are; repeatable. ROS_PACKAGE_PATH and AMENT_PREFIX_PATH count, too.",
    ),
)


def arm_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add --arm, which is the panda unless given, and what belongs to it."""
    return _decorated(command, default="panda", show_default=True, help="A known arm (`dmpcpp arms`) or a URDF file.")


def optional_arm_options(what: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Return a decorator that adds --arm, which need not be given; `what` is what it is for."""
    return lambda command: _decorated(command, help=what)


def arm_choice_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add what belongs to --arm, for a command with an --arm of its own."""
    return add_options(command, (*_CHOICE, limit_options))


def _decorated(command: Callable[..., None], **arm: Any) -> Callable[..., None]:
    return add_options(command, (click.option("--arm", metavar="NAME|FILE.urdf", **arm), *_CHOICE, limit_options))


def follow_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --follow."""
    return click.option(
        "--follow",
        metavar="position|axis[:x|y|z]|pose",
        help="The part of the hand's pose that the arm follows: the position, the position and one axis of the tool "
        "(default z), or the whole pose (default; an arm with fewer than six joints needs this option).",
    )(command)


def contact_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add --floor, --ignore-contact and --obstacle."""
    options = (
        click.option(
            "--floor",
            metavar="Z|none",
            help="Height of the floor in the frame of the URDF's root [m], or none (default: 0, or below what stands "
            "lower).",
        ),
        click.option(
            "--ignore-contact",
            "ignored",
            multiple=True,
            metavar="A,B",
            help="Two links that may touch, or a link and floor; repeatable. An .srdf beside the URDF is read, too.",
        ),
    )
    return obstacle_options(add_options(command, options))


def obstacle_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add --obstacle and --obstacle-margin."""
    options = (
        click.option(
            "--obstacle",
            multiple=True,
            metavar="SHAPE|FILE",
            help="What the arm must not touch: sphere:X,Y,Z,R, box:X,Y,Z,SX,SY,SZ[,QW,QX,QY,QZ], capsule:X1,Y1,Z1,X2,"
            "Y2,Z2,R, plane:X,Y,Z,NX,NY,NZ [m, in the frame of the URDF's root], a .yaml list or a scene's .urdf; "
            "repeatable.",
        ),
        click.option(
            "--obstacle-margin",
            metavar="M",
            default=0.01,
            show_default=True,
            type=click.FloatRange(0.0, 10.0, min_open=True),
            help="How far a planned motion stays away from each --obstacle [m].",
        ),
    )
    return add_options(command, options)


def taken_surroundings(options: dict[str, Any]) -> Surroundings:
    """Take --floor, --ignore-contact and --obstacle out of a command's arguments."""
    from dmpcpp.robot import Surroundings, obstacles_of

    floor, pairs = options.pop("floor"), options.pop("ignored")
    ignored = tuple(tuple(name.strip() for name in pair.split(",")) for pair in pairs)
    for pair, text in zip(ignored, pairs, strict=True):
        if len(pair) != 2 or not all(pair):
            raise InvalidArgument(f"--ignore-contact: '{text}', expected two links such as head,right_l1.")
    obstacles, margin = obstacles_of(options.pop("obstacle")), options.pop("obstacle_margin")
    if floor is None or floor == "none":
        return Surroundings("auto" if floor is None else None, ignored, obstacles, margin)
    try:
        height = float(floor)
    except ValueError:
        height = math.nan
    if not math.isfinite(height):
        raise InvalidArgument(f"--floor: '{floor}', expected a height in m such as -0.05, or none.")
    return Surroundings(height, ignored, obstacles, margin)


def taken_choice(options: dict[str, Any]) -> dict[str, Any]:
    """Take what belongs to --arm out of a command's arguments: what `arms.load` takes by keyword, for JSON."""
    given = {name: options.pop(name) for name in _FIELDS}
    if given["tool"] is not None:
        from dmpcpp.cli._numbers import numbers

        given["tool"] = list(numbers("--tool", given["tool"], 3, 6))
    given["package_path"] = list(given["package_path"])
    return {**given, "limits": taken_limits(options)}


def taken_arm(options: dict[str, Any]) -> Arm:
    """Take --arm and what belongs to it out of a command's arguments: the arm."""
    from dmpcpp.robot import arms

    return arms.load(options.pop("arm"), **taken_choice(options))
