"""The errors that dmpcpp raises on purpose; each message says what came, what was expected and what to do."""

from __future__ import annotations

from dmpcpp._core import FileError, IkResult, InvalidArgument, PathReport

__all__ = ["FileError", "IkError", "InvalidArgument", "MissingDependency", "NotStated"]


class IkError(RuntimeError):
    """``solve`` or ``follow``, asked to be strict, did not meet every pose.

    Attributes
    ----------
    report : IkResult or PathReport
        What it did come to, and why not further.
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


class NotStated(InvalidArgument):
    """A file does not say something and the caller has to; `names` lists the parameters that do."""

    def __init__(self, names: str | tuple[str, ...], message: str) -> None:
        """Take the parameter or parameters, one of which is to be stated, and the message."""
        super().__init__(message)
        self.names = (names,) if isinstance(names, str) else names

    def __reduce__(self) -> tuple[type[NotStated], tuple[tuple[str, ...], str]]:
        """Go through a pickle with the names."""
        return type(self), (self.names, str(self))
