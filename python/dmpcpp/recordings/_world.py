"""The units and axes of a file made metres, seconds and a right-handed world, with checks that catch a slip."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._recording import MIN_SAMPLES, Axis
from dmpcpp.recordings._stamps import usual_step

__all__ = ["LENGTH_UNITS", "LIKELY_STEP", "TIME_UNITS", "Frame", "Handedness", "World", "seconds"]

Handedness = Literal["right", "left"]

LENGTH_UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254}
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}

_LARGEST_EXTENT = 5.0  # m; a limb's motion that is larger is more likely in another unit
_FARTHEST = 100.0  # m; nobody walks farther within a motion capture volume
_LEAST_EXTENT = 2e-5  # m; what moves less is below the noise of every recording system: more likely another unit
_AT_REST = 1e-9  # m; what moves less does not move at all, and its unit cannot be told
LIKELY_STEP = (2e-4, 0.4)
"""s, between samples: 1 kHz in ms is 1, 100 Hz in minutes 1.7e-4."""


@dataclass(frozen=True)
class World:
    """What a file or its format says by itself.

    Parameters
    ----------
    unit, time_unit : str, float or None
        As in `Stated`.
    up_axis : "x", "y", "z" or None
    handedness : "right" or None
        None: neither the file nor its format says it.
    """

    unit: str | float | None = None
    time_unit: str | float | None = None
    up_axis: Axis | None = None
    handedness: Handedness | None = "right"


class Frame:
    """The units and axes of a file: the caller's word, else the file's, else the default."""

    def __init__(
        self,
        stated_unit: str | float | None,
        stated_time_unit: str | float | None,
        up_axis: Axis | None,
        handedness: Handedness | None,
        world: World,
    ) -> None:
        """Agree on units and axes.

        Raises
        ------
        InvalidArgument
            An unknown unit or handedness; a left-handed world whose up axis is unknown (`NotStated`).
        """
        self.stated_unit, self.world = stated_unit, world
        self.unit = world.unit if stated_unit is None else stated_unit
        self.time_unit = world.time_unit if stated_time_unit is None else stated_time_unit
        self.length = _factor("unit", self.unit, LENGTH_UNITS)
        self.clock = seconds(self.time_unit)
        self.up_axis: Axis | None = world.up_axis if up_axis is None else up_axis
        self.mirror = self._mirror(handedness)
        self.hand_assumed = handedness is None and world.handedness is None

    def times(self, time: Array) -> Array:
        """Return the times in s, the first 0."""
        if len(time) < MIN_SAMPLES:
            raise InvalidArgument(f"{len(time)} samples, expected at least {MIN_SAMPLES}.")
        _check_finite_times(time)
        with np.errstate(over="ignore"):  # what overflows is refused as not finite
            return (time - time[0]) * self.clock

    def points(self, position: Array, *, markers: bool = False) -> Array:
        """Return the points (..., 3) in m and right-handed, their range checked; of markers that of each by itself."""
        with np.errstate(over="ignore"):
            points = position * self.length
        self._check_extent(points, markers)
        return points if self.mirror is None else points * self.mirror

    def rotations(self, rotation: Array) -> Array:
        """Return the rotations (T, 3, 3), right-handed."""
        return rotation if self.mirror is None else self.mirror[:, None] * rotation * self.mirror

    def notes(self, time: Array) -> list[Note]:
        """Return what was converted and what was assumed."""
        notes = []
        if self.unit is None:
            notes.append(Note("assumed", "no length unit given: positions taken as metres", about="unit"))
        elif self.unit != "m":
            notes.append(Note("changed", f"positions converted from {_called(self.unit, 'm')} to m"))
        if self.stated_unit is not None and self.world.unit not in (None, self.stated_unit):
            notes.append(Note("changed", f"the file gives {_called(self.world.unit, 'm')}; the unit specified is used"))
        if self.time_unit not in (None, "s"):
            notes.append(Note("changed", f"times converted from {_called(self.time_unit, 's')} to s"))
        if time[0] != 0.0:
            notes.append(Note("changed", f"time counted from the first sample at {float(time[0]) * self.clock:.9g} s"))
        if self.hand_assumed:
            notes.append(
                Note(
                    "assumed",
                    "taken: handedness: right (logs of Unity and of most headsets are left-handed)",
                    about="handedness",
                )
            )
        if self.mirror is not None:
            notes.append(Note("changed", f"left-handed world mirrored along {'xyz'[int(np.argmin(self.mirror))]}"))
        return notes

    def check_step(self, time: Array) -> None:
        """Refuse steps that suggest another unit of time; `time` in s."""
        step = usual_step(time)
        low, high = LIKELY_STEP
        if self.time_unit is None and not low <= step <= high:
            raise InvalidArgument(
                f"time: {step:.4g} s between samples, expected {low:g} to {high:g} s. "
                "State time_unit='ms', 'us' or 'ns', or time_unit='s' if it is right."
            )

    def _mirror(self, handedness: Handedness | None) -> Array | None:
        if handedness not in (None, "right", "left"):
            raise InvalidArgument(f"handedness: {handedness!r}, expected 'right' or 'left'.")
        if handedness != "left":
            return None
        if self.up_axis is None:
            raise NotStated("up_axis", "up_axis: a left-handed world is mirrored sideways. State up_axis as well.")
        signs = np.ones(3)
        signs["xyz".index("y" if self.up_axis == "z" else "z")] = -1.0
        return signs

    def _check_extent(self, points: Array, markers: bool) -> None:
        """Refuse a range that suggests another unit, unless the caller said the unit as a number.

        A unit that the file states is contradicted only where a person cannot move so far.
        """
        if isinstance(self.stated_unit, int | float) or not points.size:
            return
        extent = _extent(points if markers else points.reshape(-1, 1, 3))
        axis = int(np.argmax(extent))
        largest = _LARGEST_EXTENT if self.world.unit is None else _FARTHEST
        if self.stated_unit is None and extent[axis] > largest:
            raise self._marked(points, largest) or self._too_far(axis, float(extent[axis]))
        if _AT_REST < extent[axis] < _LEAST_EXTENT:
            raise InvalidArgument(
                f"position: {'xyz'[axis]} ranges over {extent[axis]:.3g} m only, less than {_LEAST_EXTENT:g}, taken as "
                f"{_called(self.unit or 'm', 'm')}. State another unit, or if it is right the unit as a number of "
                f"metres: unit={self.length:g}."
            )

    def _marked(self, points: Array, largest: float) -> InvalidArgument | None:
        """Return the error for one number in all coordinates of some points, without which the range is usual."""
        flat = points.reshape(-1, 3)
        alike = (flat == flat[:, :1]).all(axis=1) & (np.abs(flat[:, 0]) > largest)
        mark = float(flat[np.argmax(alike), 0])
        marked = alike & (flat[:, 0] == mark)
        if not marked.any() or marked.all() or _extent(flat[~marked][:, None]).max() > largest:
            return None
        return InvalidArgument(
            f"position: {int(marked.sum())} samples are {mark / self.length:.9g} in all three coordinates (the first: "
            f"{int(np.argmax(marked))}). If this marks lost samples, specify missing={mark / self.length:.9g}."
        )

    def _too_far(self, axis: int, extent: float) -> InvalidArgument:
        """Return the error for a range that no hand covers, with the units that would make it one."""
        said = f"position: {'xyz'[axis]} ranges over {extent:.4g} m"
        raw = extent / self.length
        fitting = [name for name in ("mm", "cm", "in", "m") if 0.05 <= raw * LENGTH_UNITS[name] <= _LARGEST_EXTENT]
        others = " or ".join(f"unit={name!r}" for name in fitting if name != self.unit)
        if self.world.unit is not None:
            other = f" Specify {others} if they are that" if others else ""
            own = _called(self.world.unit, "m")
            return InvalidArgument(
                f"{said}, more than {_FARTHEST:g}, in the unit that the file states, {own}. Are the numbers in another "
                f"unit?{other or ' Check the columns'}, or unit={self.length:g} if the file is right."
            )
        others = others or "unit='mm'"
        return InvalidArgument(
            f"{said}, more than {_LARGEST_EXTENT:g}. Are these millimetres, centimetres or inches? State {others}, or "
            "unit='m' if it is right."
        )


def _extent(points: Array) -> Array:
    """Return the largest range (3,) of any of the points (T, M, 3); infinite values are for Recording to name."""
    finite = np.isfinite(points).all(axis=-1, keepdims=True)
    low = np.where(finite, points, np.inf).min(axis=0)
    high = np.where(finite, points, -np.inf).max(axis=0)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(np.maximum(high - low, 0.0).max(axis=0))


def seconds(unit: str | float | None) -> float:
    """Return the seconds in a unit of time; 1 where there is none.

    Raises
    ------
    InvalidArgument
        An unknown unit.
    """
    return _factor("time_unit", unit, TIME_UNITS)


def _check_finite_times(time: Array) -> None:
    if not np.isfinite(time).all():
        k = int(np.argmin(np.isfinite(time)))
        raise InvalidArgument(f"time[{k}]: {time[k]}, expected a finite number.")


def _factor(name: str, unit: str | float | None, known: dict[str, float]) -> float:
    if unit is None:
        return 1.0
    if isinstance(unit, str):
        if unit in known:
            return known[unit]
    elif not isinstance(unit, bool) and isinstance(unit, int | float) and 0.0 < unit < np.inf:
        return float(unit)
    raise InvalidArgument(f"{name}: {unit!r}, expected one of {', '.join(known)} or a positive factor.")


def _called(unit: str | float | None, base: str) -> str:
    return unit if isinstance(unit, str) else f"units of {unit:g} {base}"
