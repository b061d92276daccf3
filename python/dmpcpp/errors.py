"""The errors that dmpcpp raises on purpose; each message says what came, what was expected and what to do.

``InvalidArgument.argument`` is the name of the argument that cannot be used, "" if no single argument is at fault.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from dmpcpp._core import FileError, IkResult, InvalidArgument, PathReport

__all__ = ["FileError", "IkError", "InvalidArgument", "MissingDependency", "NotStated", "within"]


class IkError(RuntimeError):
    """Raised by ``solve`` and ``follow`` with strict=True when a pose was not reached.

    Attributes
    ----------
    report : IkResult or PathReport
        The closest that was reached, and why.
    """

    def __init__(self, message: str, report: IkResult | PathReport) -> None:
        """Keep the report beside the message."""
        super().__init__(message)
        self.report = report

    def __reduce__(self) -> tuple[type[IkError], tuple[str, IkResult | PathReport]]:
        """Go through a pickle with the report, as an error of a worker process does."""
        return type(self), (str(self), self.report)


class MissingDependency(ImportError):
    """An optional package is not installed; the message names the extra that brings it."""


def within(place: str, error: InvalidArgument) -> InvalidArgument:
    """Return the error with a place (a file's name) before its message; it keeps its type and its argument."""
    if isinstance(error, NotStated):
        return NotStated(error.names, f"{place}: {error}", error.choices)
    found = type(error)(f"{place}: {error}")
    found.argument = error.argument
    return found


class NotStated(InvalidArgument):
    """A file lacks a fact that the caller must supply; `names` lists the parameters that supply it.

    Where the question is which take of a file is meant, `choices` are the answers: {"episode": 2} or
    {"where": {"take": "2"}} for each.
    """

    def __init__(self, names: str | tuple[str, ...], message: str, choices: Sequence[Mapping[str, Any]] = ()) -> None:
        """Take the parameter or parameters, one of which must be given, the message and possible answers."""
        super().__init__(message)
        self.choices = tuple(choices)
        self.names = (names,) if isinstance(names, str) else names
        self.argument = self.names[0]

    def __reduce__(self) -> tuple[type[NotStated], tuple[Any, ...]]:
        """Go through a pickle with the names and answers."""
        return type(self), (self.names, str(self), self.choices)
