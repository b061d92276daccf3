"""Numbers with commas between them, as options take them."""

from __future__ import annotations

import math

from dmpcpp.errors import InvalidArgument

__all__ = ["numbers"]


def numbers(option: str, text: str, *counts: int) -> tuple[float, ...]:
    """Return the finite numbers of `text`; `counts` are how many there may be, any unless given.

    Raises
    ------
    InvalidArgument
        Naming the option.
    """
    try:
        values = tuple(float(part) for part in text.split(","))
    except ValueError:
        values = ()
    if not values or not all(map(math.isfinite, values)) or (counts and len(values) not in counts):
        how_many = f"{' or '.join(map(str, counts))} " if counts else ""
        raise InvalidArgument(
            f"{option}: '{text}', expected {how_many}finite numbers with commas between them, such as 0.5,0,0.4."
        )
    return values
