"""Columns of numbers from an array, as `_cells.Cells` gives them from text."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from dmpcpp._text import Cells
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["NumberTable"]


@dataclass(frozen=True)
class NumberTable(Cells):
    """An array (T, n); its rows are numbered from 0. NaN is a lost sample where that was specified, else an error."""

    values: Array | None = None

    @classmethod
    def of(cls, values: Array) -> NumberTable:
        """Return the table of an array (T, n)."""
        return cls(rows=[(k, []) for k in range(len(values))], values=np.asarray(values, dtype=np.float64))

    def numbers(self, columns: Sequence[int], names: Sequence[str]) -> Array:
        """Return columns as numbers (T, len(columns)).

        Raises
        ------
        InvalidArgument
            A number that is not finite, or a column that is not there.
        """
        assert self.values is not None
        if max(columns) >= self.values.shape[1]:
            raise InvalidArgument(f"an array of {self.values.shape[1]} columns, expected at least {max(columns) + 1}.")
        values = self.values[:, list(columns)].copy()
        wrong = ~np.isfinite(values)
        if self.nan:
            wrong &= ~np.isnan(values)
        if wrong.any():
            k, column = (int(i) for i in np.argwhere(wrong)[0])
            advice = " If this marks a lost sample, specify missing='nan'." if np.isnan(values[k, column]) else ""
            raise InvalidArgument(f"row {k}, {names[column]}: {values[k, column]}, expected a finite number.{advice}")
        return values
