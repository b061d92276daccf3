"""All takes of one file: the episodes of a data set, or the rows of a table that a column tells apart."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._keys import wanted
from dmpcpp.recordings._recording import Recording

__all__ = ["MOST", "each_take"]

ALL = "all"
MOST = 1000
"""Takes of one file; more are no demonstrations of one motion but a data set."""


def each_take(load: Callable[..., Recording], stated: Mapping[str, Any]) -> list[Recording]:
    """Return every take that `episode="all"` or `where="COLUMN=all"` asks for; one recording where neither does.

    Parameters
    ----------
    load : callable
        Called with what was stated; its question which take is meant (`NotStated.choices`) tells which there are.
    stated : mapping

    Raises
    ------
    InvalidArgument
        What `load` raises; a column that tells no takes apart; more than 1000 takes.
    """
    said = dict(stated)
    every = said.pop("episode", None) == ALL
    if not every and "episode" in stated:
        said["episode"] = stated["episode"]
    where = wanted(said.pop("where")) if said.get("where") is not None else {}
    columns = [name for name, value in where.items() if value == ALL]
    kept = {name: value for name, value in where.items() if value != ALL}
    said |= {"where": kept} if kept else {}
    if not every and not columns:
        return [load(**stated)]
    try:
        found = load(**said)
    except NotStated as question:
        if not question.choices or not (every or _column(question) in columns):
            raise
        if len(question.choices) > MOST:
            raise InvalidArgument(
                f"{question.argument}: {len(question.choices)} takes, expected at most {MOST}. Specify one of them."
            ) from None
        return [load(**_with(said, choice, kept)) for choice in question.choices]
    if columns:
        raise InvalidArgument(f"where: {columns[0]}=all, but no column {columns[0]!r} tells several takes apart.")
    return [found]


def _column(question: NotStated) -> str:
    return next(iter(question.choices[0].get("where", {})), "")


def _with(said: Mapping[str, Any], choice: Mapping[str, Any], kept: Mapping[str, str]) -> dict[str, Any]:
    """Return what was stated and one answer to the question which take is meant."""
    return {**said, **choice, **({"where": {**kept, **choice["where"]}} if "where" in choice else {})}
