"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from dmpcpp._engines import default_engine
from dmpcpp.cli._add_options import add_options
from dmpcpp.cli._flags import flag
from dmpcpp.cli._recording_options import NumberOrAll
from dmpcpp.errors import InvalidArgument

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dmpcpp.motion import Preparation

# Of --simulator.
DEFAULT_ENGINE = default_engine()
SHOWN_ENGINE = "bullet; mujoco without PyBullet"


def preparation_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options to a command; `taken_preparation` takes them out of its arguments."""
    options = (
        click.option("--start", type=float, default=0.0, metavar="S", help="Start of the motion [s]."),
        click.option("--end", type=float, metavar="S", help="End of the motion [s]."),
        click.option(
            "--longest-gap",
            type=click.FloatRange(0, min_open=True),
            default=0.2,
            show_default=True,
            metavar="S",
            help="Fill gaps in the recording up to this long [s]; refuse longer ones.",
        ),
        click.option("--keep-outliers", is_flag=True, help="Keep outliers."),
        click.option(
            "--segment",
            type=click.IntRange(1),
            metavar="K",
            help="Use only the K-th segment between rests, counted from 1.",
        ),
        click.option(
            "--repetition",
            type=NumberOrAll(1),
            metavar="K|all",
            help="Use only the K-th whole cycle (away from the start and back), counted from 1; all: learn "
            "them together (fit, imitate).",
        ),
        click.option(
            "--resample", type=click.FloatRange(0, min_open=True), metavar="HZ", help="Resample at this rate."
        ),
        click.option(
            "--low-pass",
            type=click.FloatRange(0, min_open=True),
            metavar="HZ",
            help="Low-pass cutoff (zero-phase Butterworth).",
        ),
        click.option(
            "--smooth/--no-smooth",
            default=None,
            help="Smooth the recording, or never smooth it (default: smooth when measurement noise would "
            "disturb learning).",
        ),
        click.option(
            "--kind",
            type=click.Choice(["capture", "tracker", "video"]),
            help="What recorded the motion (default: as the file says): what a tracker or a video shows above 4 Hz is "
            "left out, unless --low-pass or --no-smooth is specified.",
        ),
        click.option("--keep-rests", is_flag=True, help="Learn the rests before and behind the motion, too."),
    )
    return add_options(command, options)


def taken_preparation(options: dict[str, Any]) -> tuple[Preparation, bool]:
    """Take the options out of a command's arguments: the preparation, and whether learning may smooth."""
    from dmpcpp.motion import Preparation

    smooth: bool | None = options.pop("smooth")
    taken = {name: options.pop(name) for name in _FIELDS}
    keep_outliers: bool = options.pop("keep_outliers")
    how = Preparation(**taken, outliers=not keep_outliers, keep_noise=smooth is False, smooth=smooth is True)
    return how, smooth is not False


_FIELDS = ("start", "end", "longest_gap", "segment", "repetition", "resample", "low_pass", "kind")


_SCALE = (0.25, 1.0)
_ANCHORS = ("anchor_start", "anchor_goal", "anchor_shoulder")
_POINT, _POSE = "X,Y,Z", "X,Y,Z[,RX,RY,RZ]"


def placing_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options to a command; `taken_placing` takes them out of its arguments."""
    options = (
        click.option("--no-place", is_flag=True, help="Skip placement: poses are already tip poses in the base frame."),
        click.option(
            "--scale",
            metavar="S|MIN:MAX",
            help="Scale of positions, or its range (default: 0.25:1; smaller if none is feasible).",
        ),
        click.option(
            "--in-front/--no-in-front",
            default=True,
            show_default=True,
            help="Place the motion in front of the arm (x of its base), as far as joints and contacts let it.",
        ),
        click.option(
            "--tool-tilt",
            type=click.FloatRange(0.0),
            metavar="DEG",
            help="How far the tool may be turned in the hand (default: any rotation).",
        ),
        click.option(
            "--anchor-start",
            metavar=_POSE,
            help="Start point of the motion [m, arm's base frame]; with a rotation vector [deg] also the tool's "
            "orientation there.",
        ),
        click.option("--anchor-goal", metavar=_POSE, help="Goal of the motion, likewise."),
        click.option(
            "--anchor-shoulder",
            metavar=_POINT,
            help="Position of the person's shoulder [m, arm's base frame]; needs --shoulder.",
        ),
        click.option("--shoulder", metavar=_POINT, help="Position of the shoulder in the recording [m]."),
        click.option("--yaw", type=float, metavar="DEG", help="Yaw of an anchored motion (default: searched)."),
        click.option(
            "--tool-rotation",
            metavar="RX,RY,RZ",
            help="Tool rotation relative to the hand [deg, rotation vector] (anchored motions; default: searched).",
        ),
    )
    return add_options(command, options)


def taken_placing(options: dict[str, Any]) -> dict[str, Any]:
    """Take the options out of a command's arguments: `place` and `scale` of `imitation.imitate`."""
    no_place: bool = options.pop("no_place")
    if no_place and options["scale"]:
        raise InvalidArgument("--scale: not together with --no-place, which takes the poses as they are.")
    scale = scale_range(options.pop("scale"))
    in_front, tilt = options.pop("in_front"), options.pop("tool_tilt")
    given = {name: options.pop(name) for name in (*_ANCHORS, "shoulder", "yaw", "tool_rotation")}
    given = {name: value for name, value in given.items() if value is not None}
    _consistent(given, no_place)
    anchor = next((name for name in _ANCHORS if name in given), None)
    if tilt is not None and (no_place or anchor):
        raise InvalidArgument("--tool-tilt: of a placement that is searched; not with --no-place or an anchor.")
    if anchor is None and (no_place or (in_front and tilt is None)):
        return {"place": not no_place, "scale": scale}
    if anchor is None:
        tool = {} if tilt is None else {"tool_tilt": tilt}
        return {"place": partial(_placed, scale, options["seed"], in_front=in_front, **tool)}
    return {"place": _anchored(anchor, given, scale or _SCALE, options["seed"])}


def _consistent(given: dict[str, Any], no_place: bool) -> None:
    """Refuse options that do not go together."""
    anchors = [flag(name) for name in _ANCHORS if name in given]
    if len(anchors) > 1:
        raise InvalidArgument(f"{' and '.join(anchors)}: expected one anchor.")
    if given and no_place:
        raise InvalidArgument(f"{flag(next(iter(given)))}: not together with --no-place.")
    if given and not anchors:
        raise InvalidArgument(
            f"{flag(next(iter(given)))}: of an anchored motion; state {', '.join(map(flag, _ANCHORS))}."
        )
    if ("anchor_shoulder" in given) != ("shoulder" in given):
        raise InvalidArgument("--anchor-shoulder and --shoulder: expected both, where it comes to lie and where it is.")


def _anchored(anchor: str, given: dict[str, Any], scale: tuple[float, float], seed: int) -> Callable[..., Any]:
    import numpy as np
    from scipy.spatial.transform import Rotation

    on = _numbers("shoulder", given["shoulder"], 3) if "shoulder" in given else anchor.removeprefix("anchor_")
    at = _numbers(anchor, given[anchor], *((3,) if "shoulder" in given else (3, 6)))
    if len(at) == 6:
        pose = np.eye(4)
        pose[:3, :3] = Rotation.from_rotvec(at[3:], degrees=True).as_matrix()
        pose[:3, 3] = at[:3]
        at = pose
    tool = given.get("tool_rotation")
    if tool is not None:
        if at.ndim == 2:
            raise InvalidArgument(f"--tool-rotation: {flag(anchor)} has an orientation already; state one of the two.")
        tool = Rotation.from_rotvec(_numbers("tool_rotation", tool, 3), degrees=True).as_matrix()
    yaw = np.radians(given["yaw"]) if "yaw" in given else None
    return partial(_searched, anchor, at=at, on=on, scale=scale, yaw=yaw, tool_rotation=tool, seed=seed)


def _placed(scale: tuple[float, float] | None, seed: int, recording: Any, arm: Any, **how: Any) -> Any:
    """Return a placement that is searched in a way of the user's; angles in deg."""
    import numpy as np

    from dmpcpp.planning import place

    if "tool_tilt" in how:
        how["tool_tilt"] = np.radians(how["tool_tilt"])
    return place(recording, arm, seed, scale=scale, **how)


def _searched(anchor: str, *recording_and_arm: Any, **how: Any) -> Any:
    """Return the placement of an anchored motion; an error about the anchor names its option."""
    from dmpcpp.planning import anchor_within_reach

    try:
        return anchor_within_reach(*recording_and_arm, **how)
    except InvalidArgument as error:
        if error.argument != "at":
            raise
        raise InvalidArgument(str(error).replace("at:", f"{flag(anchor)}:", 1)) from None


def _numbers(name: str, text: str, *counts: int) -> NDArray[Any]:
    import numpy as np

    try:
        values = np.array([float(part) for part in text.split(",")])
    except ValueError:
        values = np.empty(0)
    if len(values) not in counts or not np.isfinite(values).all():
        expected = " or ".join(map(str, counts))
        raise InvalidArgument(f"{flag(name)}: '{text}', expected {expected} numbers such as 0.4,0,0.5.")
    return values


def scale_range(text: str | None) -> tuple[float, float] | None:
    """Return the smallest and the largest scale: '0.5' or '0.4:0.8'; None unless given."""
    if text is None:
        return None
    low, _, high = text.partition(":")
    try:
        return float(low), float(high or low)
    except ValueError:
        raise InvalidArgument(
            f"--scale: '{text}', expected a number such as 0.5, or a range such as 0.4:0.8."
        ) from None
