"""What the caller states about a file because the file does not say it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._markers import Markers
from dmpcpp.recordings._orientation import QuatOrder
from dmpcpp.recordings._rate import left_aside, times_at_rate
from dmpcpp.recordings._recording import MIN_SAMPLES, Axis, Recording
from dmpcpp.recordings._soundness import check_one_body, held_values, lost_zeros, zero_note
from dmpcpp.recordings._stamps import without_bursts
from dmpcpp.recordings._time_order import block, in_order
from dmpcpp.recordings._upward import upward
from dmpcpp.recordings._world import Frame, Handedness, World

__all__ = ["Stated"]


@dataclass(frozen=True)
class Stated:
    """Facts the file does not record; each reader uses those that its format leaves open.

    Parameters
    ----------
    unit : "m", "cm", "mm", "in", metres per unit as a number, or None
        Of lengths. None: what the file says, metres where it says nothing; then a range above 5 m or below
        0.02 mm is refused as a likely slip. A number is never questioned.
    time_unit : "s", "ms", "us", "ns", seconds per unit as a number, or None
        None: what the file says, or seconds, and steps outside 0.2 ms .. 0.4 s are refused as a likely slip.
    up_axis : "x", "y", "z" or None
        The axis of the recording's world that points up. None: what the file says, or unknown. Of a video "image" (the
        first camera stands level), "board" or "tag:ID" (it lies on the table).
    handedness : "right", "left" or None
        Of the world's axes. None: right. A left-handed recording is mirrored along a horizontal axis, for which
        `up_axis` must be known.
    rate : float, optional
        Samples per second [Hz] of a file without times. Stated of one that has them, it wins: samples are taken at even
        times, and the history says what was left aside, with a warning where that differs by more than 20 %.
    times : "header", "received", "log" or None
        Which stamps of a bag or MCAP file count: those in the headers of the messages (None), or when the recorder
        received each message ("log" is another name for it).
    where : str or mapping, optional
        Rows of a table that count: "COLUMN=VALUE", or with >=, <=, >, < or !=; several joined by ",". "COLUMN=all" is
        for `load_all`.
    episode : int, optional
        Which episode of a data set, by its index; of a table whose times begin anew, which block, from 0. "all" is for
        `load_all`.
    rotation : str, optional
        What the numbers of an orientation are: "quat_xyzw", "quat_wxyz", "rotvec" (rotation vector), an order of Euler
        angles, "rot6d" (first two rows of the matrix), "rot6d_columns" or "mat9". Another name for `quat_order` and
        `euler_order` where it is one of theirs.
    layout : str or sequence of str, optional
        What the columns without names hold, in their order: "x", "y", "z", "time", "gripper", "skip", a rotation as
        above, "euler", "mat12" (3 x 4) or "mat16" (4 x 4, row by row).
    dataset : str, optional
        Which arrays of a file of named arrays hold the poses: one name, or "POSITION,ORIENTATION".
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
    sort_times : bool, optional
        Whether samples are put in the order of their times, and of several at one time the first counts. Otherwise
        such times are an error; a sample that is merely written twice is left out in any case.
    second_view : path, optional
        A second video of the same motion, by another camera.
    fov : str or float, optional
        Horizontal field of view of a video's camera: "69deg", or rad; of two cameras "69deg,60deg" where they differ.
    camera : path, optional
        A calibration file, TOML or JSON: matrix, size, distortion; or a list `cameras` of these.
    hand_length : str or float, optional
        From the crease of the wrist to the tip of the middle finger: "190mm", or m.
    board : str, optional
        A ChArUco board that lies still in both pictures: "5x7:30mm", columns x rows and the side of a square.
    extrinsics : path, optional
        How two cameras stand, TOML or JSON: rotation, translation [m], x_2 = rotation x_1 + translation.
    pitch : str or float, optional
        By how much the first camera looks down: "15deg", or rad; with up_axis="image".
    tag : str, optional
        Printed tags that are followed in place of the hand: "0:60mm", "0-4:40mm,cube:50mm", or a TOML file.
    mirrored : bool, optional
        Whether a video is a mirror's, as selfie cameras make them.
    """

    unit: str | float | None = None
    time_unit: str | float | None = None
    up_axis: Axis | str | None = None
    handedness: Handedness | None = None
    rate: float | None = None
    times: Literal["header", "received", "log"] | None = None
    where: str | Mapping[str, object] | None = None
    episode: int | Literal["all"] | None = None
    rotation: str | None = None
    layout: str | Sequence[str] | None = None
    dataset: str | None = None
    quat_order: QuatOrder | None = None
    euler_order: str | None = None
    angle_unit: Literal["deg", "rad"] | None = None
    missing: str | float | None = None
    columns: Mapping[str, str | int] | None = None
    delimiter: str | None = None
    skip_lines: int | None = None
    index: int | None = None
    fixed_orientation: bool | None = None
    sort_times: bool | None = None
    second_view: str | PathLike[str] | None = None
    fov: str | float | None = None
    camera: str | PathLike[str] | None = None
    hand_length: str | float | None = None
    board: str | None = None
    extrinsics: str | PathLike[str] | None = None
    pitch: str | float | None = None
    tag: str | None = None
    mirrored: bool | None = None

    def __post_init__(self) -> None:
        """Read `rotation` as `quat_order` or `euler_order` where it is one of theirs."""
        if self.episode == "all":
            raise InvalidArgument(
                "episode: 'all' is several recordings, which `fit` and `imitate` learn together "
                "(`recordings.load_all`). Specify one of them: episode=0."
            )
        said = self.rotation
        if said is None:
            return
        if said in ("quat_xyzw", "quat_wxyz"):
            self._take("quat_order", said.removeprefix("quat_"))
        elif isinstance(said, str) and (said == "rotvec" or sorted(said.lower()) == ["x", "y", "z"]):
            self._take("euler_order", said)
        elif said not in ("rot6d", "rot6d_columns", "mat9"):
            raise InvalidArgument(
                f"rotation: {said!r}, expected quat_xyzw, quat_wxyz, rotvec, ZYX or another order of Euler angles, "
                "rot6d, rot6d_columns or mat9."
            )

    def _take(self, name: str, value: str) -> None:
        other = getattr(self, name)
        if other not in (None, value):
            raise InvalidArgument(f"rotation, {name}: {self.rotation!r} and {other!r}, expected one of them.")
        object.__setattr__(self, name, value)

    def names(self) -> tuple[str, ...]:
        """Return the names of what was stated."""
        said = [field.name for field in fields(self) if getattr(self, field.name) is not None]
        if self.rotation in ("quat_xyzw", "quat_wxyz"):
            said.remove("quat_order")
        elif self.rotation not in (None, "rot6d", "rot6d_columns", "mat9"):
            said.remove("euler_order")
        return tuple(said)

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
        channels: Mapping[str, Array] | None = None,
    ) -> Recording:
        """Return the Recording in metres and seconds from 0; arrays as they stand in the file, NaN where lost.

        Raises
        ------
        InvalidArgument
            An unknown unit, an implausible range or rate, or whatever `Recording` refuses.
        """
        frame = self._frame(world)
        kept, sorted_notes = self._kept(frame, time, position, rotation)
        time, rate_notes = self._even(time[kept], frame)
        position, rotation = frame.points(position[kept]), frame.rotations(rotation[kept])
        lost, doubts = self._lost(frame.times(time), position, rotation)
        position, rotation = _blanked(position, lost), _blanked(rotation, lost)
        check_one_body(position[~np.isnan(position).any(axis=1)])
        missing = _lost(np.isnan(position).all(axis=1))
        made = Recording(
            time=frame.times(time),
            position=position,
            rotation=rotation,
            body=body,
            source=source,
            up_axis=frame.up_axis,
            history=(*rate_notes, *notes, *sorted_notes, *doubts, *missing, *frame.notes(time)),
            channels={name: values[kept] for name, values in (channels or {}).items()},
        )
        frame.check_step(made.time)
        return made

    def _kept(self, frame: Frame, time: Array, *values: Array) -> tuple[NDArray[np.int_], list[str]]:
        """Return which samples count, in the order of time, and what was done for it."""
        rows, notes = block(time, self.episode)
        if self.rate is not None:
            return rows, notes
        kept, sorted_notes = in_order(
            time[rows], *(array[rows] for array in values), sort=self.sort_times, clock=frame.clock
        )
        rows = rows[kept]
        if len(rows) >= MIN_SAMPLES and np.isfinite(time[rows]).all():
            kept, burst_notes = without_bursts(time[rows], values[0][rows], frame.clock)
            rows, sorted_notes = rows[kept], [*sorted_notes, *burst_notes]
        return rows, [*notes, *sorted_notes]

    def _even(self, time: Array, frame: Frame) -> tuple[Array, list[str]]:
        """Return the times, even ones at the stated rate in their place, and a note."""
        if self.rate is None:
            return time, []
        even = times_at_rate(len(time), self.rate)
        return even / frame.clock, [left_aside(self.rate, lambda: time, frame.time_unit)]

    def _lost(self, time: Array, position: Array, rotation: Array) -> tuple[NDArray[np.bool_], list[str]]:
        """Return which samples are zeros or held values in place of lost ones; `missing="nan"` keeps them."""
        if self.missing == "nan":
            return np.zeros(len(time), dtype=bool), []
        zeros = lost_zeros(position)
        held, notes = held_values(time, _blanked(position, zeros), rotation)
        return zeros | held, [*zero_note(zeros), *notes]

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
        kept, sorted_notes = self._kept(frame, time, position)
        time, rate_notes = self._even(time[kept], frame)
        position = frame.points(position[kept], markers=True)
        names, position, zero_notes = (
            _without_zeros(names, position) if self.missing != "nan" else (names, position, [])
        )
        seen_up = upward(names, position) if frame.up_axis is None else None
        told_up = [f"up axis {seen_up}: the head is above the feet along it"] if seen_up else []
        made = Markers(
            names=names,
            time=frame.times(time),
            position=position,
            source=source,
            up_axis=frame.up_axis or seen_up,
            history=(*rate_notes, *notes, *sorted_notes, *zero_notes, *told_up, *frame.notes(time)),
        )
        frame.check_step(made.time)
        return made

    def order(self, usual: QuatOrder) -> tuple[QuatOrder, list[str]]:
        """Return the order of quaternions: as specified, else the usual one of a format whose columns have no names."""
        if self.quat_order is None:
            return usual, [Note("assumed", f"taken: quat_order: {usual}, as the format defines it", about="quat_order")]
        return self.quat_order, []

    def without(self, *names: str) -> Stated:
        """Return a copy in which the fields of these names are not stated."""
        return replace(self, **dict.fromkeys(names))

    def _frame(self, world: World | None) -> Frame:
        return Frame(self.unit, self.time_unit, self.up_axis, self.handedness, world or World())


def _lost(missing: np.ndarray) -> list[str]:
    count = int(missing.sum())
    return [f"{count} of {len(missing)} samples are missing (the first: {int(np.argmax(missing))})"] if count else []


def _blanked(values: Array, lost: NDArray[np.bool_]) -> Array:
    """Return values (T, ...) with NaN where lost (T,); the array itself where nothing was."""
    if not lost.any():
        return values
    values = values.copy()
    values[lost] = np.nan
    return values


def _without_zeros(names: tuple[str, ...], position: Array) -> tuple[tuple[str, ...], Array, list[str]]:
    """Return the markers that are not 0 throughout, their zeros among other positions as lost, and notes."""
    absent = (np.isnan(position) | (position == 0.0)).all(axis=(0, 2)) & (position == 0.0).any(axis=(0, 2))
    if absent.all():
        return names, position, []
    notes = []
    if absent.any():
        left_out = ", ".join(name for name, gone in zip(names, absent, strict=True) if gone)
        notes = [f"markers left out, 0 throughout: {left_out}"]
        names, position = tuple(np.array(names)[~absent].tolist()), position[:, ~absent]
    for k, name in enumerate(names):
        lost = lost_zeros(position[:, k])
        if lost.any():
            position = position.copy() if not position.flags.writeable else position
            position[lost, k] = np.nan
            notes += zero_note(lost, f"samples of {name}")
    return names, position, notes
