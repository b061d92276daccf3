"""Markers: points that a motion capture system follows, each a position without an orientation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._recording import MIN_SAMPLES, Axis

__all__ = ["Markers", "distinct"]


@dataclass(frozen=True, eq=False)
class Markers:
    """The motion of a set of markers in one world frame.

    Parameters
    ----------
    names : tuple of str
        One name a marker, M of them, all different.
    time : array (T,)
        s, starts at 0, strictly increasing, T >= 8.
    position : array (T, M, 3)
        m; NaN in all three where a marker was not seen.
    source : str
        Where it comes from, usually a file name.
    up_axis : "x", "y", "z" or None
        The world axis that points up; None when neither the format nor the caller said it.
    history : tuple of str
        What was done to the data on the way here.

    Raises
    ------
    InvalidArgument
        Naming the array, the index, the value found and the value expected.
    """

    names: tuple[str, ...]
    time: Array
    position: Array
    source: str = ""
    up_axis: Axis | None = None
    history: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Take the arrays over as read-only float64 and check them."""
        object.__setattr__(self, "names", tuple(self.names))
        for name in ("time", "position"):
            array = np.array(getattr(self, name), dtype=np.float64, order="C")
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        expected = (len(self.time), len(self.names), 3)
        if self.time.ndim != 1 or self.position.shape != expected:
            raise InvalidArgument(f"position: shape {self.position.shape}, expected {expected}: times, names, x y z.")
        if len(set(self.names)) < len(self.names):
            raise InvalidArgument(f"names: {', '.join(self.names)}; expected names that differ.")
        _check_time(self.time)
        _check_position(self.position, self.names)
        if self.up_axis not in (None, "x", "y", "z"):
            raise InvalidArgument(f"up_axis: {self.up_axis!r}, expected 'x', 'y', 'z' or None.")

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.time)

    def __repr__(self) -> str:
        """Return one line: how many markers, how long, from where."""
        return (
            f"Markers({len(self.names)} markers, {len(self)} samples, {self.duration:.3f} s, "
            f"{self.rate:.1f} Hz, source={self.source!r})"
        )

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return float(self.time[-1])

    @property
    def rate(self) -> float:
        """Return the mean sampling rate [Hz]."""
        return (len(self) - 1) / self.duration

    @property
    def missing(self) -> NDArray[np.bool_]:
        """Where a marker was not seen (T, M)."""
        return np.asarray(np.isnan(self.position).all(axis=2))

    def chosen(self, names: Sequence[str]) -> Markers:
        """Return the markers of these names, in their order.

        A name may leave out the subject in front of it, `WRIST` for `Anna:WRIST`, where only one marker ends so.

        Raises
        ------
        InvalidArgument
            One of them is not there; the message lists those that are.
        """
        whole = {} if isinstance(names, str) else {name: self._whole(name) for name in names}
        unknown = [name for name in whole if whole[name] not in self.names]
        if unknown or isinstance(names, str):
            asked = ", ".join(map(repr, unknown)) or repr(names)
            raise InvalidArgument(f"markers: no marker {asked}. The file holds: {', '.join(self.names)}.")
        columns = [self.names.index(whole[name]) for name in names]
        return replace(self, names=tuple(whole[name] for name in names), position=self.position[:, columns])

    def _whole(self, name: str) -> str:
        """Return the name of the only marker that a name without its subject can mean; else the name as it is."""
        ending = [held for held in self.names if held.endswith(f":{name}")]
        return ending[0] if name not in self.names and len(ending) == 1 else name


def distinct(names: Sequence[str]) -> tuple[str, ...]:
    """Return the names with " (2)", " (3)" .. after those that came before; empty ones called "unnamed"."""
    made: list[str] = []
    counts: dict[str, int] = {}
    for name in (name.strip() or "unnamed" for name in names):
        counts[name] = counts.get(name, 0) + 1
        candidate = name if counts[name] == 1 else f"{name} ({counts[name]})"
        while candidate in made:
            candidate += "'"
        made.append(candidate)
    return tuple(made)


def _check_time(time: Array) -> None:
    if len(time) < MIN_SAMPLES:
        raise InvalidArgument(f"time: {len(time)} samples, expected at least {MIN_SAMPLES}.")
    with np.errstate(over="ignore", invalid="ignore"):
        wrong = ~(np.diff(time) > 0.0)
    if wrong.any() or not np.isfinite(time[-1]):
        k = int(np.argmax(wrong)) + 1
        raise InvalidArgument(
            f"time[{k}]: {time[k]:.9g} s after {time[k - 1]:.9g} s, expected finite, strictly increasing times."
        )
    if time[0] != 0.0:
        raise InvalidArgument(f"time[0]: {time[0]:.9g} s, expected 0. Subtract time[0] from all times.")


def _check_position(position: Array, names: tuple[str, ...]) -> None:
    wrong = ~np.isfinite(position) & ~np.isnan(position).all(axis=2)[:, :, None]
    if wrong.any():
        k, marker, axis = (int(i) for i in np.argwhere(wrong)[0])
        raise InvalidArgument(
            f"position[{k}] of {names[marker]}: {'xyz'[axis]} is {position[k, marker, axis]}, expected a finite "
            "number, or NaN in all three where the marker was not seen."
        )
