"""Histories: what was changed, what was assumed, and what should be doubted, line by line."""

from __future__ import annotations

from typing import Literal, get_args

__all__ = ["Kind", "Note"]

Kind = Literal["changed", "assumed", "warning"]


class Note(str):
    """One line of a history, a text that knows its kind.

    Attributes
    ----------
    kind : {"changed", "assumed", "warning"}
        What was done; what was taken for granted because nobody specified it; what may be wrong.
    text : str
        Without the word "WARNING: " that the line of a warning begins with.
    about : str
        The parameter that specifies it otherwise, where there is one: "unit".
    """

    kind: Kind
    text: str
    about: str

    def __new__(cls, kind: Kind, text: str, about: str = "") -> Note:
        """Raise ValueError for an unknown kind."""
        if kind not in get_args(Kind):
            raise ValueError(f"kind: {kind!r}, expected one of {', '.join(get_args(Kind))}.")
        note = super().__new__(cls, f"WARNING: {text}" if kind == "warning" else text)
        note.kind, note.text, note.about = kind, text, about
        return note

    def __reduce__(self) -> tuple[type[Note], tuple[Kind, str, str]]:
        """Go through a pickle with kind and parameter."""
        return type(self), (self.kind, self.text, self.about)

    @staticmethod
    def of(line: str) -> Note:
        """Return a note as it is; text by how it begins: "WARNING: ", or "taken: unit: " for an assumption."""
        if isinstance(line, Note):
            return line
        if line.lower().startswith("warning:"):
            return Note("warning", line[len("warning:") :].lstrip())
        if line.startswith("taken: "):
            return Note("assumed", line, about=line.split(": ")[1])
        return Note("changed", line)
