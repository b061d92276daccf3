"""NumPy files: the headers of .npy and .npz first, then only the arrays that are needed, and never a pickle."""

from __future__ import annotations

import warnings
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

import numpy as np

from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.recordings._datasets import Allowance

__all__ = ["NumpyFile", "read_arrays"]

_MOST_ARRAYS = 20_000
_PACKED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)  # others unpack into memory without a bound
_NUMBERS = "fiu"


@dataclass(frozen=True)
class _Header:
    """What the header of an array claims."""

    shape: tuple[int, ...]
    kind: np.dtype


@dataclass
class NumpyFile:
    """The arrays of a .npz by name, or of a .npy as "pose"; each is read when it is asked for.

    Raises
    ------
    FileError
        The file is missing or cannot be read.
    InvalidArgument
        It is damaged, holds one name twice, or claims more than the file can hold.
    """

    path: Path
    headers: dict[str, _Header] = field(default_factory=dict)
    allowance: Allowance = field(default_factory=Allowance)

    def __post_init__(self) -> None:
        """Read the headers."""
        with _reported(self.path):
            for name, file, size in _members(self.path):
                if name in self.headers:
                    raise InvalidArgument(f"the array {name!r} stands twice in the file.")
                self.headers[name] = _header(file, size)

    @property
    def shapes(self) -> dict[str, tuple[int, ...]]:
        """Shapes of the arrays of numbers."""
        return {name: head.shape for name, head in self.headers.items() if head.kind.kind in _NUMBERS}

    @property
    def pickles(self) -> list[str]:
        """Names of the arrays of objects, which are not opened."""
        return [name for name, head in self.headers.items() if head.kind.hasobject]

    def get(self, name: str) -> np.ndarray:
        """Return an array: numbers as float64, text as it is.

        Raises
        ------
        InvalidArgument
            It is damaged, holds objects, or with the others needs more than a recording may.
        """
        head = self.headers[name]
        if head.kind.hasobject:
            raise InvalidArgument(f"the array {name!r} is a pickle, which can run any code and is never opened.")
        self.allowance.take(name, head.shape, head.kind)
        with _reported(self.path):
            for held, file, _ in _members(self.path, name):
                if held == name:
                    array = np.lib.format.read_array(file, allow_pickle=False)
                    return array.astype(np.float64) if array.dtype.kind in _NUMBERS else array
        raise InvalidArgument(f"no array {name!r} any more; the file was changed while it was read.")


def read_arrays(path: Path) -> dict[str, np.ndarray]:
    """Return all arrays of a .npz by name, or of a .npy as "pose"; numbers as float64, text as it is.

    Raises
    ------
    FileError, InvalidArgument
        See `NumpyFile`.
    """
    file = NumpyFile(path)
    return {name: np.asarray(file.get(name)) for name in file.headers}


@contextmanager
def _reported(path: Path) -> Iterator[None]:
    """Make whatever NumPy and zipfile raise at a damaged file one of the library's two errors."""
    try:
        yield
    except InvalidArgument:
        raise
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    except Exception as error:  # a dozen types, SyntaxError and zlib.error too
        raise InvalidArgument(f"not a readable NumPy file ({type(error).__name__}: {error}).") from None


def _members(path: Path, only: str | None = None) -> Iterator[tuple[str, BinaryIO, int]]:
    """Yield name, open file and size [bytes] of each array, or of one."""
    with path.open("rb") as file:
        if not zipfile.is_zipfile(file):
            file.seek(0)
            yield "pose", file, path.stat().st_size
            return
        with zipfile.ZipFile(file) as archive:
            infos = archive.infolist()
            if len(infos) > _MOST_ARRAYS:
                raise InvalidArgument(f"{len(infos)} arrays, expected at most {_MOST_ARRAYS}.")
            for info in infos:
                name = info.filename.removesuffix(".npy")
                if only not in (None, name):
                    continue
                if info.compress_type not in _PACKED:
                    raise InvalidArgument(f"the array {name!r} is packed as no NumPy file is. Save it again.")
                with archive.open(info) as member:
                    yield name, member, info.file_size  # type: ignore[misc]


def _header(file: BinaryIO, size: int) -> _Header:
    """Return what an array's header claims, which must fit the file."""
    version = np.lib.format.read_magic(file)
    header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a header written by Python 2
        shape, _, kind = header(file)
    claimed = int(np.prod([int(n) for n in shape], dtype=object)) * kind.itemsize
    if not kind.hasobject and (claimed > size or min(shape, default=0) < 0):
        raise InvalidArgument(f"an array of {claimed} bytes of {kind} in {size} bytes of file.")
    return _Header(tuple(int(n) for n in shape), kind)
