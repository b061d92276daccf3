"""The options that say which motion of a file is meant, and what the file does not say; `imitate`, `inspect`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from dmpcpp.cli._add_options import add_options
from dmpcpp.errors import InvalidArgument

__all__ = ["NAMES", "NumberOrAll", "recording_options", "taken_recording"]


class NumberOrAll(click.ParamType):
    """A whole number from a least one, or "all"."""

    name = "number or all"

    def __init__(self, least: int) -> None:
        """Take the least number."""
        self.least = least

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int | str:
        """Return the number, or "all"."""
        return "all" if value == "all" else click.IntRange(self.least).convert(value, param, ctx)


_OPTIONS = (
    click.option("--body", metavar="NAME", help="Body whose motion is used; required if the file holds several."),
    click.option("--markers", metavar="A,B,C", help="Markers on one rigid body, three or more, for files of markers."),
    click.option("--format", "format", metavar="NAME", help="File format (default: recognised from name and content)."),
    click.option("--unit", metavar="m|cm|mm|in|F", help="Unit of lengths; a number is metres per unit."),
    click.option("--time-unit", metavar="s|ms|us|ns|F", help="Unit of times; a number is seconds per unit."),
    click.option(
        "--rate", type=float, metavar="HZ", help="Samples per second, of a file without times or in place of them."
    ),
    click.option(
        "--times",
        metavar="header|received",
        help="Stamps of a bag or MCAP file: message header (default) or reception time.",
    ),
    click.option(
        "--where",
        metavar="COLUMN=VALUE",
        help="Use only these rows of a table (or >=, <=, !=), several with commas; COLUMN=all: all takes.",
    ),
    click.option(
        "--episode",
        type=NumberOrAll(0),
        metavar="K|all",
        help="Episode of a data set; block of a table whose times restart; all: learn them together.",
    ),
    click.option(
        "--rotation",
        metavar="NAME",
        help="What an orientation's numbers are: quat_xyzw, quat_wxyz, rotvec, ZYX, zyx, .., rot6d or mat9.",
    ),
    click.option(
        "--layout", metavar="A,B,..", help="What columns without names hold: x,y,z,rotvec,gripper for instance."
    ),
    click.option(
        "--dataset", metavar="PATH[,PATH]", help="Arrays that hold the poses: one, or position and orientation."
    ),
    click.option(
        "--up-axis",
        "--up",
        metavar="x|y|z|image|..",
        help="The recording's axis that points up; of a video image (the first camera stands level), board or tag:ID.",
    ),
    click.option("--handedness", metavar="right|left", help="Handedness of the recording's frame (default: right)."),
    click.option("--quat-order", metavar="xyzw|wxyz", help="Order of the quaternions of an array."),
    click.option(
        "--euler-order", metavar="ORDER", help="Of columns rx, ry, rz: ZYX moving axes, zyx fixed ones, or rotvec."
    ),
    click.option("--angle-unit", metavar="deg|rad", help="Unit of columns rx, ry, rz."),
    click.option("--missing", metavar="empty|nan|WORD|N", help="How a missing sample is written in a table or array."),
    click.option(
        "--columns",
        metavar="time=..,x=..",
        help="Columns of a table by name or number: time, x, y, z, and qx, qy, qz, qw or rx, ry, rz.",
    ),
    click.option("--delimiter", metavar="C", help="Cell separator of a table; 'tab' for a tab."),
    click.option("--skip-lines", type=int, metavar="N", help="Lines before the header line of a table."),
    click.option(
        "--fixed-orientation",
        is_flag=True,
        default=None,
        help="Use a position, or one marker, without orientation; the tool keeps a fixed one.",
    ),
    click.option(
        "--sort-times",
        is_flag=True,
        default=None,
        help="Sort samples by their times, and of several at one time keep the first.",
    ),
    click.option("--mend-times", is_flag=True, default=None, hidden=True),  # its name before 0.2
    click.option(
        "--second-view", type=click.Path(path_type=Path), metavar="FILE", help="Second video, by another camera."
    ),
    click.option("--fov", metavar="69deg", help="Horizontal field of view of a video's camera; A,B: of two."),
    click.option(
        "--camera",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Calibration of a video's camera, TOML or JSON.",
    ),
    click.option(
        "--hand-length", metavar="190mm", help="Crease of the wrist to tip of the middle finger, of a hand in a video."
    ),
    click.option("--board", metavar="5x7:30mm", help="Printed board that lies still in both videos: squares and side."),
    click.option(
        "--extrinsics", type=click.Path(path_type=Path), metavar="FILE", help="How two cameras stand, TOML or JSON."
    ),
    click.option("--pitch", metavar="15deg", help="By how much the first camera looks down, with --up image."),
    click.option(
        "--tag", metavar="ID:SIZE", help="Printed tags to follow in a video: 0:60mm, 0-4:40mm,cube:50mm, FILE."
    ),
    click.option(
        "--mirrored", is_flag=True, default=None, help="The video is a mirror's, as selfie cameras make them."
    ),
    click.option("--index", type=int, metavar="I", help="Which demonstration of an array (N, T, ..), from 0."),
)
NAMES = (
    "body",
    "markers",
    "format",
    "unit",
    "time_unit",
    "rate",
    "times",
    "where",
    "episode",
    "rotation",
    "layout",
    "dataset",
    "up_axis",
    "handedness",
    "quat_order",
    "euler_order",
    "angle_unit",
    "missing",
    "columns",
    "delimiter",
    "skip_lines",
    "fixed_orientation",
    "sort_times",
    "second_view",
    "fov",
    "camera",
    "hand_length",
    "board",
    "extrinsics",
    "pitch",
    "tag",
    "mirrored",
    "index",
)


PREPARATION = ("start", "end", "longest_gap", "segment", "repetition", "resample")
"""Parameters of `motion.Preparation` that messages propose."""


def recording_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options to a command; `taken_recording` takes them out of its arguments."""
    return add_options(command, _OPTIONS)


def taken_recording(options: dict[str, Any]) -> dict[str, Any]:
    """Take the options out of a command's arguments: what `recordings.load` and `inspect` take beside the file."""
    if options.pop("mend_times"):
        click.echo("dmpcpp: --mend-times is --sort-times now.", err=True)
        options["sort_times"] = True
        click.get_current_context().params |= {"sort_times": True, "mend_times": None}  # what config.toml saves
    if second := options.pop("second", None):
        if options["second_view"] is not None:
            raise InvalidArgument("SECOND, --second-view: both are stated, expected one of them.")
        options["second_view"] = second
    taken = {name: value for name in NAMES if (value := options.pop(name)) is not None}
    for name in ("unit", "time_unit", "missing"):
        if name in taken:
            taken[name] = _number_or_word(taken[name])
    if "columns" in taken:
        taken["columns"] = _columns(taken["columns"])
    if "markers" in taken:
        taken["markers"] = [name.strip() for name in taken["markers"].split(",")]
    if taken.get("delimiter") in ("tab", "\\t"):
        taken["delimiter"] = "\t"
    return taken


def _number_or_word(text: str) -> str | float:
    try:
        value = float(text)
    except ValueError:
        return text
    return text if value != value else value  # the word nan is no number here


def _columns(text: str) -> dict[str, str | int]:
    columns: dict[str, str | int] = {}
    for part in text.split(","):
        name, equals, column = part.partition("=")
        if not equals or not column:
            raise InvalidArgument(f"--columns: '{part}', expected NAME=COLUMN such as x=3 or x=hand_x.")
        columns[name.strip()] = int(column) if column.strip().isdigit() else column.strip()
    return columns
