"""The errors that dmpcpp raises on purpose; each message says what came, what was expected and what to do."""

from dmpcpp._core import FileError, InvalidArgument

__all__ = ["FileError", "InvalidArgument", "MissingDependency"]


class MissingDependency(ImportError):
    """An optional package is not installed; the message names the extra that brings it."""
