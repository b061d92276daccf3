"""The parameter section of a C3D file, and its three orders of bytes.

Source: The C3D File Format User Guide (Motion Lab Systems, 2008), "The parameter section".
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from numpy.typing import NDArray

__all__ = ["ByteOrder", "Parameters", "byte_order", "read_parameters"]

_BLOCK = 512
_PROCESSORS = {84: "intel", 85: "dec", 86: "mips"}
_TEXT, _BYTE, _INTEGER, _FLOAT = -1, 1, 2, 4


@dataclass(frozen=True)
class ByteOrder:
    """How the processor that wrote the file stored its numbers: "intel", "dec" or "mips"."""

    processor: str

    def integers(self, raw: bytes) -> NDArray[np.uint16]:
        """Return unsigned 16-bit integers."""
        return np.frombuffer(raw, dtype=">u2" if self.processor == "mips" else "<u2")

    def signed(self, raw: bytes) -> NDArray[np.int16]:
        """Return signed 16-bit integers."""
        return np.frombuffer(raw, dtype=">i2" if self.processor == "mips" else "<i2")

    def floats(self, raw: bytes) -> Array:
        """Return 32-bit floating point numbers as float64; what is not a number comes out as one that is not finite."""
        if self.processor == "dec":  # VAX F: the two words swapped, and an exponent larger by 2
            words = np.frombuffer(raw, dtype="<u2").reshape(-1, 2)[:, ::-1]
            return np.frombuffer(words.tobytes(), dtype="<f4").astype(np.float64) / 4.0
        with np.errstate(invalid="ignore"):  # signalling NaNs
            return np.frombuffer(raw, dtype=">f4" if self.processor == "mips" else "<f4").astype(np.float64)


@dataclass(frozen=True)
class _Parameter:
    kind: int
    shape: tuple[int, ...]
    data: bytes


class Parameters:
    """The parameters of a file by group and name, upper case."""

    def __init__(self, order: ByteOrder, found: dict[tuple[str, str], _Parameter], notes: tuple[str, ...] = ()) -> None:
        """Take the parameters as they stand in the file, and what there is to tell of them."""
        self._order, self._found, self.notes = order, found, notes

    def has(self, group: str, name: str) -> bool:
        """Return whether the file holds it."""
        return (group, name) in self._found

    def integer(self, group: str, name: str, otherwise: int) -> int:
        """Return an unsigned 16-bit integer."""
        raw = self._raw(group, name, _INTEGER)
        return int(self._order.integers(raw[:2])[0]) if len(raw) >= 2 else otherwise

    def long(self, group: str, name: str) -> int:
        """Return 32 bits in two integers, the low one first."""
        words = self._order.integers(self._raw(group, name, _INTEGER)[:4])
        return sum(int(word) << (16 * k) for k, word in enumerate(words))

    def number(self, group: str, name: str, otherwise: float) -> float:
        """Return a floating point number."""
        raw = self._raw(group, name, _FLOAT)
        return float(self._order.floats(raw[:4])[0]) if len(raw) >= 4 else otherwise

    def texts(self, group: str, name: str) -> tuple[str, ...]:
        """Return texts: one, or one for each of the second dimension."""
        parameter = self._found.get((group, name))
        if parameter is None or parameter.kind != _TEXT:
            return ()
        length = parameter.shape[0] if parameter.shape else 1
        if length == 0:
            return ()
        pieces = [parameter.data[k : k + length] for k in range(0, len(parameter.data), length)]
        return tuple(piece.decode("utf-8", "replace").strip(" \0") for piece in pieces)

    def _raw(self, group: str, name: str, kind: int) -> bytes:
        parameter = self._found.get((group, name))
        return parameter.data if parameter is not None and parameter.kind == kind else b""


def byte_order(content: bytes) -> ByteOrder:
    """Return the byte order that the parameter section names.

    Raises
    ------
    InvalidArgument
        The section is not in the file, or names no processor.
    """
    start = _start(content)
    processor = content[start + 3] if start + 4 <= len(content) else 0
    if processor not in _PROCESSORS:
        raise InvalidArgument(f"processor type {processor} at byte {start + 3}, expected one of {sorted(_PROCESSORS)}.")
    return ByteOrder(_PROCESSORS[processor])


def read_parameters(content: bytes, order: ByteOrder) -> Parameters:
    """Return the parameters; entries behind one that is damaged are not reached.

    Raises
    ------
    InvalidArgument
        The section ends in the middle of an entry.
    """
    start = _start(content)
    section = content[start : start + max(content[start + 2], 1) * _BLOCK]
    groups: dict[int, str] = {}
    entries: list[tuple[int, str, _Parameter]] = []
    skipped: list[str] = []
    at = 4
    while at + 2 <= len(section) and section[at] != 0:
        length, identity = abs(_signed(section[at])), _signed(section[at + 1])
        name = section[at + 2 : at + 2 + length].decode("latin-1").upper()
        body = at + 2 + length
        step = order.integers(section[body : body + 2] if body + 2 <= len(section) else b"\0\0")[0]
        if identity > 0:
            try:
                entries.append((identity, name, _parameter(section, body + 2)))
            except InvalidArgument:
                if not _is_entry(section, body + int(step)):
                    raise
                skipped.append(name)
        else:
            groups[-identity] = name
        if step == 0:
            break
        at = body + int(step)
    found = {(groups.get(identity, ""), name): parameter for identity, name, parameter in entries}
    notes = (f"parameters of unknown type left out: {', '.join(skipped[:8])}",) if skipped else ()
    return Parameters(order, found, notes)


def _is_entry(section: bytes, at: int) -> bool:
    """Return whether a parameter or group with a readable name begins there, or the section ends."""
    if at + 2 > len(section):
        return False
    if section[at] == 0:
        return True
    name = section[at + 2 : at + 2 + abs(_signed(section[at]))]
    return len(name) == abs(_signed(section[at])) and all(32 < byte < 127 for byte in name)


def _parameter(section: bytes, at: int) -> _Parameter:
    if at + 2 > len(section):
        raise InvalidArgument("the parameter section ends in the middle of an entry. The file is damaged.")
    kind, count = _signed(section[at]), section[at + 1]
    shape = tuple(section[at + 2 : at + 2 + count])
    size = abs(kind)
    for extent in shape:
        size = min(size * extent, len(section) + 1)
    data = section[at + 2 + count : at + 2 + count + size]
    if kind not in (_TEXT, _BYTE, _INTEGER, _FLOAT) or len(shape) < count or len(data) < size:
        raise InvalidArgument("the parameter section holds an entry of unknown type or size. The file is damaged.")
    return _Parameter(kind, shape, data)


def _start(content: bytes) -> int:
    start = (content[0] - 1) * _BLOCK
    if start < _BLOCK or start + 4 > len(content):
        raise InvalidArgument(f"parameters from byte {start} on, in a file of {len(content)}. It is damaged.")
    return start


def _signed(byte: int) -> int:
    return byte - 256 if byte > 127 else byte
