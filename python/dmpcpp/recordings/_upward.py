"""Which axis points up, by evidence: a standing person's head is above the feet."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.recordings._recording import Axis

__all__ = ["above_or_below", "upward"]

_ABOVE = re.compile(r"(?:.*[:_ ])?(?:head(?:end)?\d?|neck\d?|[lr][fb]hd|c7|clav|head_?top)", re.IGNORECASE)
_BELOW = re.compile(
    r"(?:.*[:_ ])?(?:(?:l|r|left|right)?_?(?:foot|toe|ankle|heel|ank|hee|mt\d?|toebase)(?:_?(?:l|r|left|right))?)",
    re.IGNORECASE,
)
_ALONG = 0.85  # share of the way from feet to head along one axis; a person who bends or lies shows less


def above_or_below(name: str) -> int:
    """Return 1 for a joint or marker of head or neck, -1 for one of a foot, 0 for any other."""
    return 1 if _ABOVE.fullmatch(name) else -1 if _BELOW.fullmatch(name) else 0


def upward(names: Sequence[str], position: Array) -> Axis | None:
    """Return the axis along which the head is above the feet in the median of all frames, None without evidence.

    Parameters
    ----------
    names : sequence of str
        Of joints or markers, M of them.
    position : array (T, M, 3)
        In any unit; NaN where not seen.
    """
    side = np.array([above_or_below(name) for name in names])
    if not (side > 0).any() or not (side < 0).any():
        return None
    with np.errstate(all="ignore"):
        seen = ~np.isnan(position[:, side != 0]).any(axis=(1, 2))
    if not seen.any():
        return None
    way = np.median(position[seen][:, side > 0].mean(axis=1) - position[seen][:, side < 0].mean(axis=1), axis=0)
    length = float(np.linalg.norm(way))
    k = int(np.argmax(np.abs(way)))
    return ("x", "y", "z")[k] if length > 0.0 and way[k] > _ALONG * length else None
