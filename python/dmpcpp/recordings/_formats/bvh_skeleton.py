"""The part of a BVH file above MOTION: joints with their offsets and channels."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from dmpcpp._text import number
from dmpcpp.errors import InvalidArgument

__all__ = ["CHANNELS", "Joint", "skeleton"]

CHANNELS = tuple(f"{axis}{what}" for what in ("position", "rotation") for axis in "XYZ")
_MOST_JOINTS = 10000  # of a file that means it


@dataclass
class Joint:
    """A joint: where it sits in its parent's frame, and which columns of a frame move it."""

    name: str
    parent: str | None
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    channels: tuple[str, ...] = ()
    first_column: int = 0


def skeleton(lines: list[tuple[int, str]]) -> dict[str, Joint]:
    """Return the joints by name in the order of the file, a parent before its children.

    Parameters
    ----------
    lines : list of (line number, text)
        From HIERARCHY to above MOTION.

    Raises
    ------
    InvalidArgument
        Naming the line.
    """
    return _Skeleton(lines).joints


class _Skeleton:
    """The words of a skeleton, read from the first to the last; `open` holds the joints whose braces are open."""

    def __init__(self, lines: list[tuple[int, str]]) -> None:
        self.joints: dict[str, Joint] = {}
        self.open: list[Joint | None] = []  # None for an End Site, which only has an offset
        self.columns = 0
        self.words = _words(lines)
        self.line = 0
        take: dict[str, Callable[[], None]] = {
            "ROOT": self._root,
            "JOINT": self._joint,
            "End": self._end_site,
            "OFFSET": self._offset,
            "CHANNELS": self._channels,
            "}": self._close,
            "HIERARCHY": lambda: None,  # the title, nothing to take
        }
        for line, word in self.words:
            self.line = line
            if word not in take:
                raise self._error(f"{word[:20]!r}, expected JOINT, End Site, OFFSET, CHANNELS or }}")
            take[word]()
        if self.open or not self.joints:
            raise self._error("the skeleton ends in the middle, or holds no joint")

    def _root(self) -> None:
        if self.open:
            raise self._error("a ROOT inside of a joint")
        self._enter(None)

    def _joint(self) -> None:
        parent = self._innermost()
        if parent is None:
            raise self._error("a JOINT inside of an End Site")
        self._enter(parent.name)

    def _end_site(self) -> None:
        self._innermost()
        self._name()
        self.open.append(None)

    def _offset(self) -> None:
        joint = self._innermost()
        x, y, z = (number(self._next("a number"), self.line, "OFFSET") for _ in range(3))
        if joint is not None:
            joint.offset = (x, y, z)

    def _channels(self) -> None:
        joint = self._innermost()
        count = self._next("the number of channels")
        if joint is None or joint.channels or count not in tuple("0123456"):
            raise self._error(f"{count[:20]!r} channels, expected 0 to 6, once in a joint")
        joint.channels = tuple(self._next("a channel").capitalize() for _ in range(int(count)))
        joint.first_column = self.columns
        self.columns += len(joint.channels)
        if not set(joint.channels) <= set(CHANNELS) or len(set(joint.channels)) < len(joint.channels):
            shown = ", ".join(joint.channels)[:80]
            raise self._error(f"channels {shown}, expected different ones of {', '.join(CHANNELS)}")

    def _close(self) -> None:
        self._innermost()
        self.open.pop()

    def _enter(self, parent: str | None) -> None:
        name = self._name()
        if not name or name in self.joints or len(self.joints) >= _MOST_JOINTS:
            raise self._error(f"a joint called {name[:40]!r}, expected a name that no other joint has")
        self.joints[name] = Joint(name, parent)
        self.open.append(self.joints[name])

    def _name(self) -> str:
        """Return the words up to the brace that opens a joint."""
        words = []
        while (word := self._next("{")) != "{":
            words.append(word)
        return " ".join(words)

    def _next(self, expected: str) -> str:
        line, word = next(self.words, (self.line, ""))
        if not word:
            raise self._error(f"the skeleton ends, expected {expected}")
        self.line = line
        return word

    def _innermost(self) -> Joint | None:
        if not self.open:
            raise self._error("outside of any joint")
        return self.open[-1]

    def _error(self, what: str) -> InvalidArgument:
        return InvalidArgument(f"line {self.line}: {what}.")


def _words(lines: list[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    for line, text in lines:
        for word in text.replace("{", " { ").replace("}", " } ").split():
            yield line, word
