"""What the pictures share: colours, strokes, one motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import dmpcpp
import numpy as np
from dmpcpp import plot
from dmpcpp.show.plot._page import INK, plain
from numpy.typing import NDArray

Array = NDArray[np.float64]

BLUE, ORANGE, GREEN, RED, PINK, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"  # Okabe and Ito
STROKES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1.5, 1, 1.5)))
TIME = np.linspace(0.0, 2.0, 201)
"""s, of the motion that most pictures show."""


def lift() -> Array:
    """Return positions (201, 3) [m] of a hand that lifts something over an edge."""
    s = TIME / TIME[-1]
    along = s**3 * (10 - 15 * s + 6 * s**2)  # minimum jerk
    return np.c_[0.4 * along, 0.1 * np.sin(2 * np.pi * along), 0.25 * np.sin(np.pi * along) ** 2]


def learned(**options: Any) -> dmpcpp.Dmp:
    """Return that motion, learned."""
    return dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, lift()), **options)


def columns(count: int, width: float = 8.0, height: float = 3.4, **how: Any) -> tuple[Any, Sequence[Any]]:
    """Return a page and `count` axes side by side; `rows=True` puts them one above the other."""
    rows = how.pop("rows", False)
    page = plot.figure(width, height)
    page.set_layout_engine("constrained")
    cells = page.subplots(count if rows else 1, 1 if rows else count, squeeze=False, **how).ravel()
    for axes in cells:
        plain(axes)
    return page, cells


def label(axes: Any, x: str, y: str, title: str = "") -> None:
    """Name both axes and, on the left above them, what they show."""
    axes.set_xlabel(x, color=INK)
    axes.set_ylabel(y, color=INK)
    if title:
        axes.set_title(title, loc="left", fontsize=10, color=INK)


def legend(axes: Any, **how: Any) -> None:
    """Say which line is which, without a box."""
    axes.legend(**({"frameon": False, "fontsize": 8.5, "labelcolor": INK} | how))
