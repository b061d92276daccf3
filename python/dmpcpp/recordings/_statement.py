"""What the caller states about a file because the file does not say it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Literal

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._markers import Markers
from dmpcpp.recordings._orientation import QuatOrder
from dmpcpp.recordings._recording import Axis, Recording
from dmpcpp.recordings._time_order import in_order
from dmpcpp.recordings._world import Frame, Handedness, World

__all__ = ["Stated", "times_at_rate"]


@dataclass(frozen=True)
class Stated:
    """The caller's word on a file; each reader takes those fields that its format leaves open.

    Parameters
    ----------
    unit : "m", "cm", "mm", "in", metres per unit as a number, or None
        Of lengths. None: what the file says, metres where it says nothing; then a range above 5 m or below
        0.02 mm is refused as a likely slip. A number is never questioned.
    time_unit : "s", "ms", "us", "ns", seconds per unit as a number, or None
        None: what the file says, or seconds, and steps outside 0.2 ms .. 0.4 s are refused as a likely slip.
    up_axis : "x", "y", "z" or None
        The axis of the recording's world that points up. None: what the file says, or unknown.
    handedness : "right", "left" or None
        Of the world's axes. None: right. A left-handed recording is mirrored along a horizontal axis, for which
        `up_axis` must be known.
    rate : float, optional
        Samples per second [Hz] of a file without times. Stated of one that has them, it wins: samples are taken at even
        times, and the history tells what was left aside, with a warning where that differs by more than 20 %.
    quat_order : "xyzw", "wxyz" or None
        Order of the quaternions of an array.
    euler_order : str, optional
        Order of three rotations about the axes as scipy writes it: "XYZ" about the moving axes, first the left
        one; "xyz" about the axes of the world. For columns `rx`, `ry`, `rz`.
    angle_unit : "deg", "rad" or None
        Of the columns `rx`, `ry`, `rz`.
    missing : "empty", "nan", another word, a number or None
        How a table or an array writes a sample that was lost: an empty cell, `nan`, a word such as "NA", or a number
        in place of all three coordinates. None: such cells are an error.
    columns : mapping, optional
        From "time", "x", "y", "z" and "qx", "qy", "qz", "qw" (or "rx", "ry", "rz") to the name of a column or
        its number counted from 0.
    delimiter : str, optional
        Between the cells of a table; " " stands for any blanks.
    skip_lines : int, optional
        Lines before the header line of a table.
    index : int, optional
        Which demonstration of an array (N, T, ...), from 0.
    fixed_orientation : bool, optional
        Whether a position without an orientation is enough: the orientation is then the identity throughout.
    mend_times : bool, optional
        Whether samples are put in the order of their times, and of several at one time the first counts. Otherwise
        such times are an error; a sample that is merely written twice is left out in any case.
    """

    unit: str | float | None = None
    time_unit: str | float | None = None
    up_axis: Axis | None = None
    handedness: Handedness | None = None
    rate: float | None = None
    quat_order: QuatOrder | None = None
    euler_order: str | None = None
    angle_unit: Literal["deg", "rad"] | None = None
    missing: str | float | None = None
    columns: Mapping[str, str | int] | None = None
    delimiter: str | None = None
    skip_lines: int | None = None
    index: int | None = None
    fixed_orientation: bool | None = None
    mend_times: bool | None = None

    def names(self) -> tuple[str, ...]:
        """Return the names of what was stated."""
        return tuple(field.name for field in fields(self) if getattr(self, field.name) is not None)

    def recording(
        self,
        *,
        time: Array,
        position: Array,
        rotation: Array,
        body: str,
        source: str,
        notes: list[str],
        world: World | None = None,
    ) -> Recording:
        """Return the Recording in metres and seconds from 0; arrays as they stand in the file, NaN where lost.

        Raises
        ------
        InvalidArgument
            An unknown unit, an implausible range or rate, or whatever `Recording` refuses.
        """
        frame = self._frame(world)
        kept, mended = in_order(time, position, rotation, mend=self.mend_times)
        time, position, rotation = time[kept], position[kept], rotation[kept]
        made = Recording(
            time=frame.times(time),
            position=frame.points(position),
            rotation=frame.rotations(rotation),
            body=body,
            source=source,
            up_axis=frame.up_axis,
            history=(*notes, *mended, *_lost(np.isnan(position).all(axis=1)), *frame.notes(time)),
        )
        frame.check_step(made.time)
        return made

    def marker_set(
        self,
        *,
        time: Array,
        position: Array,
        names: tuple[str, ...],
        source: str,
        notes: list[str],
        world: World | None = None,
    ) -> Markers:
        """Return the Markers in metres and seconds from 0; `position` (T, M, 3) as it stands in the file.

        Raises
        ------
        InvalidArgument
            See `recording`.
        """
        frame = self._frame(world)
        kept, mended = in_order(time, position, mend=self.mend_times)
        time, position = time[kept], position[kept]
        made = Markers(
            names=names,
            time=frame.times(time),
            position=frame.points(position),
            source=source,
            up_axis=frame.up_axis,
            history=(*notes, *mended, *frame.notes(time)),
        )
        frame.check_step(made.time)
        return made

    def without(self, *names: str) -> Stated:
        """Return a copy in which the fields of these names are not stated."""
        return replace(self, **dict.fromkeys(names))

    def _frame(self, world: World | None) -> Frame:
        return Frame(self.unit, self.time_unit, self.up_axis, self.handedness, world or World())


def times_at_rate(count: int, rate: float | None) -> Array:
    """Return `count` times in s at a stated sampling rate [Hz].

    Raises
    ------
    NotStated
        No rate stated.
    InvalidArgument
        One that is not a positive number.
    """
    if rate is None:
        raise NotStated("rate", "rate: the file holds no times. State the sampling rate in Hz: rate=100.")
    if isinstance(rate, bool) or not isinstance(rate, int | float | np.number) or not 0.0 < rate < 1e6:
        raise InvalidArgument(f"rate: {rate!r}, expected a sampling rate in Hz above 0.")
    return np.arange(count) / float(rate)


def _lost(missing: np.ndarray) -> list[str]:
    count = int(missing.sum())
    return [f"{count} of {len(missing)} samples are missing (the first: {int(np.argmax(missing))})"] if count else []
