"""What a file does not say and the caller must: its units and up axis; and the checks that catch a slip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings.recording import MIN_SAMPLES, Array, Axis, Recording

__all__ = ["LENGTH_UNITS", "TIME_UNITS", "Stated", "times_at_rate"]

LENGTH_UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}

_LIKELY_EXTENT = 5.0  # m; a limb's motion that is larger is more likely in another unit
_LIKELY_STEP = (1e-5, 1.0)  # s; between samples


@dataclass(frozen=True)
class Stated:
    """The caller's word on a file.

    Parameters
    ----------
    unit : "m", "cm", "mm", metres per unit as a number, or None
        None: `default_unit`, and a range above 5 m is refused as a likely slip.
    time_unit : "s", "ms", "us", "ns", seconds per unit as a number, or None
        None: seconds, and steps outside 10 us .. 1 s are refused as a likely slip.
    up_axis : "x", "y", "z" or None
        None: unknown.
    metres_by_format : bool
        The format says metres; without a stated `unit` that is what they are taken for, without a note.
    """

    unit: str | float | None = None
    time_unit: str | float | None = None
    up_axis: Axis | None = None
    metres_by_format: bool = False

    def recording(
        self, *, time: Array, position: Array, rotation: Array, body: str, source: str, notes: list[str]
    ) -> Recording:
        """Return the Recording in metres and seconds from 0; arrays as they stand in the file.

        Raises
        ------
        InvalidArgument
            An unknown unit, an implausible range or rate, or whatever `Recording` refuses.
        """
        length = _factor("unit", self.unit, LENGTH_UNITS)
        clock = _factor("time_unit", self.time_unit, TIME_UNITS)
        if len(time) < MIN_SAMPLES:
            raise InvalidArgument(f"{len(time)} samples, expected at least {MIN_SAMPLES}.")
        _check_finite_times(time)
        notes = [*notes, *self._notes(float(time[0]) * clock)]
        with np.errstate(over="ignore"):  # what overflows is refused as not finite
            time, position = (time - time[0]) * clock, position * length
        self._check_extent(position)
        made = Recording(
            time=time,
            position=position,
            rotation=rotation,
            body=body,
            source=source,
            up_axis=self.up_axis,
            history=tuple(notes),
        )
        self._check_step(made)
        return made

    def _notes(self, start: float) -> list[str]:
        notes = []
        if self.unit is not None and self.unit != "m":
            notes.append(f"positions converted from {_called(self.unit, 'm')} to m")
        elif self.unit is None and not self.metres_by_format:
            notes.append("no length unit stated: positions taken as metres")
        if self.time_unit is not None and self.time_unit != "s":
            notes.append(f"times converted from {_called(self.time_unit, 's')} to s")
        if start != 0.0:
            notes.append(f"time counted from the first sample at {start:.9g} s")
        return notes

    def _check_extent(self, position: Array) -> None:
        with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is for Recording to name
            extent = np.ptp(position, axis=0)
        axis = int(np.argmax(extent))
        if self.unit is None and extent[axis] > _LIKELY_EXTENT:
            raise InvalidArgument(
                f"position: {'xyz'[axis]} ranges over {extent[axis]:.4g} m, more than {_LIKELY_EXTENT:g}. "
                "Are these millimetres or centimetres? State unit='mm' or 'cm', or unit='m' if it is right."
            )

    def _check_step(self, made: Recording) -> None:
        step = float(np.median(np.diff(made.time)))
        low, high = _LIKELY_STEP
        if self.time_unit is None and not low <= step <= high:
            raise InvalidArgument(
                f"time: {step:.4g} s between samples, expected {low:g} to {high:g} s. "
                "State time_unit='ms', 'us' or 'ns', or time_unit='s' if it is right."
            )


def times_at_rate(count: int, rate: float | None) -> Array:
    """Return `count` times in s at a stated sampling rate [Hz].

    Raises
    ------
    InvalidArgument
        No rate stated, or one that is not a positive number.
    """
    if rate is None:
        raise InvalidArgument("rate: the file holds no times. State the sampling rate in Hz: rate=100.")
    if isinstance(rate, bool) or not isinstance(rate, int | float | np.number) or not 0.0 < rate < 1e6:
        raise InvalidArgument(f"rate: {rate!r}, expected a sampling rate in Hz above 0.")
    return np.arange(count) / float(rate)


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


def _called(unit: str | float, base: str) -> str:
    return unit if isinstance(unit, str) else f"units of {unit:g} {base}"
