"""A body's recorded motion: times, positions and orientations in SI units, with what was done to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["MIN_SAMPLES", "Array", "Axis", "Recording", "SourceKind"]

Axis = Literal["x", "y", "z"]
SourceKind = Literal["", "capture", "tracker", "video"]
"""What recorded a motion: motion capture or a guided arm; a tracker that estimates poses; a video. "": not known."""

MIN_SAMPLES = 8
"""Fewer samples do not describe a motion."""

_LARGEST_EXTENT = 1000.0  # m; no motion of a person's limb, whatever its unit
_ROTATION_TOLERANCE = 1e-6  # largest element of R^T R - I; readers orthonormalise before they get here


@dataclass(frozen=True, eq=False)
class Recording:
    """The motion of one body, checked: whoever holds a Recording holds ordered, proper data.

    A sample that the recording system lost stays in its place as NaN in all of position and rotation, so that a
    gap is seen for what it is; `missing` says which. Every other number is finite.

    Parameters
    ----------
    time : array_like (T,)
        s, starts at 0, strictly increasing, T >= 8.
    position : array_like (T, 3)
        m, of the body's origin in the recording's world frame; NaN where the sample is missing.
    rotation : array_like (T, 3, 3)
        Proper rotations, body -> world; NaN where the sample is missing. At least two samples are there.
    body : str
        Which body of the source this is.
    source : str
        Where it comes from, usually a file name.
    up_axis : "x", "y", "z" or None
        The world axis that points up; None when neither the format nor the caller said it.
    history : tuple of Note
        What was done to the data on the way here, one sentence a step, oldest first.
    channels : mapping of str to array (T,)
        Other quantities at the same times, such as a gripper's width, in the file's units; NaN where missing.
    measured : array_like (T,) of bool, optional
        Which samples were measured, not filled in; all unless given. A missing one never was.
    kind : "", "capture", "tracker" or "video"
        What recorded it, where that is known.
    accuracy : (float, float), optional
        Root mean square errors [m], [rad] that its reader expects, of position and orientation; None: not known.

    Raises
    ------
    InvalidArgument
        Naming the array, the index, the value found and the value expected.

    The arrays are copied to float64 and read-only; make a changed copy with `with_`.
    """

    time: Array
    position: Array
    rotation: Array
    body: str = "body"
    source: str = ""
    up_axis: Axis | None = None
    history: tuple[str, ...] = ()  # of Note: plain text counts as something that was changed
    channels: Mapping[str, Array] = field(default_factory=dict)
    measured: NDArray[np.bool_] = None  # type: ignore[assignment]  # an array once it is made
    kind: SourceKind = ""
    accuracy: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        """Take the arrays over as read-only float64 and check them."""
        object.__setattr__(self, "time", _owned("time", self.time))
        object.__setattr__(self, "position", _owned("position", self.position))
        object.__setattr__(self, "rotation", _owned("rotation", self.rotation))
        object.__setattr__(self, "history", tuple(map(Note.of, self.history)))
        object.__setattr__(self, "channels", {name: _owned(name, values) for name, values in self.channels.items()})
        _check_shapes(self.time, self.position, self.rotation)
        _check_time(self.time)
        missing = self.missing
        object.__setattr__(self, "measured", _measured(self.measured, missing))
        if len(self.time) - missing.sum() < 2:
            raise InvalidArgument(
                f"position: {missing.sum()} of {len(self.time)} samples are missing (NaN), expected at least two that "
                "are there. Is it the right body?"
            )
        _check_finite("position", self.position, missing)
        _check_finite("rotation", self.rotation, missing)
        _check_position(self.position[~missing])
        _check_rotation(self.rotation, missing)
        if self.up_axis not in (None, "x", "y", "z"):
            raise InvalidArgument(f"up_axis: {self.up_axis!r}, expected 'x', 'y', 'z' or None.")
        if self.kind not in get_args(SourceKind):
            raise InvalidArgument(
                f"kind: {self.kind!r}, expected capture, tracker, video, or '' where it is not known."
            )

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.time)

    def __repr__(self) -> str:
        """Return one line: what it is, how long, from where."""
        return (
            f"Recording({self.body!r}, {len(self)} samples, {self.duration:.3f} s, "
            f"{self.rate:.1f} Hz, source={self.source!r})"
        )

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return float(self.time[-1])

    @property
    def rate(self) -> float:
        """Return the mean sampling rate [Hz]; the samples need not be evenly spaced."""
        return (len(self) - 1) / self.duration

    @property
    def missing(self) -> NDArray[np.bool_]:
        """Which samples are missing (T,): NaN in all of position and rotation."""
        rotation = np.isnan(self.rotation).all(axis=(1, 2))
        return np.asarray(np.isnan(self.position).all(axis=1) & rotation)

    @property
    def approximate(self) -> str:
        """Why the poses are a sketch and no measurement, "" where they are not."""
        return next((note.text for note in map(Note.of, self.history) if note.about == "approximate"), "")

    def part(self, kept: slice | NDArray[np.bool_] | NDArray[np.int_], note: str) -> Recording:
        """Return the samples that are kept, channels too, counted from a time of 0, with `note` in the history."""
        time = self.time[kept]
        return self.with_(
            note,
            time=time - time[0],
            position=self.position[kept],
            rotation=self.rotation[kept],
            channels={name: values[kept] for name, values in self.channels.items()},
            measured=self.measured[kept],
        )

    def with_(self, note: str, **changes: object) -> Recording:
        """Return a copy with the fields in `changes` replaced and `note` appended to its history.

        Other times drop the channels, and what was measured, unless these are given, too.
        """
        if "time" in changes:
            changes = {"channels": {}, "measured": None, **changes}
        return replace(self, history=(*self.history, note), **changes)  # type: ignore[arg-type]


def _owned(name: str, values: ArrayLike) -> Array:
    """Return a read-only float64 C-contiguous copy; an array that is one already is taken as it is."""
    if type(values) is np.ndarray and values.dtype == np.float64 and not values.flags.writeable and values.base is None:
        return np.ascontiguousarray(values)
    try:
        array = np.array(values, dtype=np.float64, order="C")
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidArgument(f"{name}: not an array of numbers ({error}).") from None
    array.setflags(write=False)
    return array


def _measured(given: ArrayLike | None, missing: NDArray[np.bool_]) -> NDArray[np.bool_]:
    measured = np.ones(len(missing), dtype=bool) if given is None else np.array(given)
    if measured.shape != missing.shape or measured.dtype != bool:
        raise InvalidArgument(
            f"measured: shape {measured.shape} of {measured.dtype}, expected ({len(missing)},) of bool, one for each "
            "time."
        )
    measured &= ~missing
    measured.setflags(write=False)
    return measured


def _check_shapes(time: Array, position: Array, rotation: Array) -> None:
    if time.ndim != 1:
        raise InvalidArgument(f"time: shape {time.shape}, expected (T,).")
    if len(time) < MIN_SAMPLES:
        raise InvalidArgument(
            f"time: {len(time)} samples, expected at least {MIN_SAMPLES}. Record longer, or at a higher rate."
        )
    for name, array, tail in (("position", position, (3,)), ("rotation", rotation, (3, 3))):
        expected = (len(time), *tail)
        if array.shape != expected:
            raise InvalidArgument(f"{name}: shape {array.shape}, expected {expected} as there are {len(time)} times.")


def _check_finite(name: str, array: Array, missing: NDArray[np.bool_] | None = None) -> None:
    wrong = ~np.isfinite(array)
    if missing is not None:
        wrong[missing] = False
    if not wrong.any():
        return
    index = np.argwhere(wrong)[0]
    where = ", ".join(str(i) for i in index)
    advice = "" if missing is None else " A missing sample is NaN in all of position and rotation."
    raise InvalidArgument(
        f"{name}[{where}]: {array[tuple(index)]}, expected a finite number. Cut the sample out or fill it.{advice}"
    )


def _check_time(time: Array) -> None:
    _check_finite("time", time)
    with np.errstate(over="ignore"):
        steps = np.diff(time)
    if (steps <= 0.0).any():
        k = int(np.argmax(steps <= 0.0)) + 1
        raise InvalidArgument(
            f"time[{k}]: {time[k]:.9g} s after {time[k - 1]:.9g} s, expected strictly increasing times. "
            "Remove the repeated or misplaced samples."
        )
    if time[0] != 0.0:
        raise InvalidArgument(f"time[0]: {time[0]:.9g} s, expected 0. Subtract time[0] from all times.")


def _check_position(position: Array) -> None:
    with np.errstate(over="ignore"):
        extent = np.ptp(position, axis=0)
    axis = int(np.argmax(extent))
    if extent[axis] > _LARGEST_EXTENT:
        raise InvalidArgument(
            f"position: {'xyz'[axis]} ranges over {extent[axis]:.3g} m, expected at most {_LARGEST_EXTENT:g} "
            "m. Check the length unit and the columns."
        )


def _check_rotation(rotation: Array, missing: NDArray[np.bool_]) -> None:
    rotation = np.where(missing[:, None, None], np.eye(3), rotation)
    with np.errstate(over="ignore", invalid="ignore"):
        gram = np.swapaxes(rotation, 1, 2) @ rotation
        error = np.abs(gram - np.eye(3)).max(axis=(1, 2))
    off = ~(error <= _ROTATION_TOLERANCE)
    if off.any():
        k = int(np.argmax(off))
        raise InvalidArgument(
            f"rotation[{k}]: |R^T R - I| = {error[k]:.3g}, expected at most {_ROTATION_TOLERANCE:g}. "
            "Orthonormalise the matrices."
        )
    determinant = np.einsum("ti,ti->t", rotation[:, 0], np.cross(rotation[:, 1], rotation[:, 2]))
    if (determinant < 0.0).any():
        k = int(np.argmax(determinant < 0.0))
        raise InvalidArgument(
            f"rotation[{k}]: det(R) = {determinant[k]:.3f}, expected +1 (a reflection). Check the axis order."
        )
