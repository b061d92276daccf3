"""The arrays of numbers in a zarr file, folder or zip, and their bounds: metadata first, then single arrays.

Zarr formats 2 and 3 as the package zarr reads them. Only the codecs below unpack anything, and each chunk is tried into
a buffer of its nominal size first, so that no chunk unpacks without limit.
"""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.recordings._datasets import Allowance, needed
from dmpcpp.recordings._formats.hdf5_arrays import unpacks_within

__all__ = ["ZarrFile", "is_folder"]

_MARKS = (".zgroup", "zarr.json", ".zattrs", ".zmetadata")
_ARRAY_MARKS = (".zarray", "zarr.json")
_LONGEST = 1024 * 1024  # bytes of one file of metadata
_LONGEST_IN_ALL = 64 * 1024 * 1024
_MOST_ARRAYS = 10_000
_LARGEST_CHUNK = 64 * 1024 * 1024  # bytes unpacked
_SPARE = 4096  # bytes by which a packed chunk may exceed its numbers
_GZIP = 16 + zlib.MAX_WBITS
_PACKERS = ("blosc", "zlib", "gzip", "zstd", "lz4")
_KEEP_SIZE = ("bytes", "endian", "transpose", "shuffle", "delta", "crc32c")
_STORED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)


@dataclass(frozen=True)
class _Entry:
    """What the metadata of an array say; `codecs` in the order in which they pack."""

    shape: tuple[int, ...]
    kind: np.dtype
    chunk: int  # bytes unpacked
    codecs: tuple[str, ...]


@dataclass
class ZarrFile:
    """The arrays of numbers of a file by path.

    Raises
    ------
    FileError
        It cannot be read.
    InvalidArgument
        It is damaged or holds no arrays of numbers.
    """

    path: Path
    entries: dict[str, _Entry] = field(default_factory=dict)
    allowance: Allowance = field(default_factory=Allowance)

    def __post_init__(self) -> None:
        """Read the metadata."""
        found = {name: _entry(text) for name, text in _metadata(self.path).items()}
        self.entries = {name: entry for name, entry in sorted(found.items()) if entry is not None}
        if not self.entries:
            raise InvalidArgument("a zarr file without arrays of numbers.")

    @property
    def shapes(self) -> dict[str, tuple[int, ...]]:
        """Shapes of the arrays."""
        return {name: entry.shape for name, entry in self.entries.items()}

    def get(self, name: str) -> Array:
        """Return an array as float64; all that are read take at most 256 MB.

        Raises
        ------
        InvalidArgument
            It is larger, damaged, or packed by a codec that is not on the list.
        """
        entry = self.entries[name]
        self.allowance.take(name, entry.shape, entry.kind)
        zarr = needed("zarr", "Zarr files")
        _check_codecs(name, entry)
        try:
            for content in _chunks(self.path, name, entry.chunk + _SPARE):
                _check_chunk(name, entry, content)
            if self.path.is_dir():
                return np.asarray(zarr.open_array(str(self.path), path=name, mode="r")[...], dtype=np.float64)
            with zarr.storage.ZipStore(str(self.path), mode="r") as store:
                return np.asarray(zarr.open_array(store, path=name, mode="r")[...], dtype=np.float64)
        except InvalidArgument:
            raise
        except Exception as error:  # of a damaged file zarr and its codecs raise anything
            raise InvalidArgument(f"{name}: not readable ({type(error).__name__}: {str(error)[:120]}).") from None


def is_folder(path: Path) -> bool:
    """Return whether a path is the folder of a zarr file."""
    return path.is_dir() and any((path / mark).is_file() for mark in _MARKS)


def _metadata(path: Path) -> dict[str, bytes]:
    """Return the metadata of all arrays, by the arrays' paths."""
    try:
        found = list(_metadata_files(path))
    except InvalidArgument:
        raise
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    except Exception as error:  # zipfile meets a damaged file with half a dozen types
        raise InvalidArgument(f"not a readable zarr file ({type(error).__name__}: {str(error)[:120]}).") from None
    named = dict(found)
    if len(named) < len(found):
        raise InvalidArgument("an array with two files of metadata, in formats 2 and 3; which of them counts is open.")
    return named


def _metadata_files(path: Path) -> Iterator[tuple[str, bytes]]:
    left = _LONGEST_IN_ALL
    for name, size, read in _array_files(path) if path.is_dir() else _array_members(path):
        if size > _LONGEST:
            continue
        left -= size
        if left < 0:
            raise InvalidArgument(f"metadata of more than {_LONGEST_IN_ALL} bytes.")
        yield name, read()


def _array_files(folder: Path) -> Iterator[tuple[str, int, Any]]:
    """Yield path, size and content of the metadata below a folder; the folders of chunks are not entered."""
    count = 0
    for root, folders, files in os.walk(folder):
        marks = [Path(root) / name for name in _ARRAY_MARKS if name in files and (Path(root) / name).is_file()]
        for mark in marks:
            yield mark.parent.relative_to(folder).as_posix(), mark.stat().st_size, mark.read_bytes
        count += len(marks)
        is_array = ".zarray" in files or any(b'"array"' in mark.read_bytes()[:_LONGEST] for mark in marks)
        folders[:] = [] if is_array or count >= _MOST_ARRAYS else sorted(folders)


def _array_members(path: Path) -> Iterator[tuple[str, int, Any]]:
    with zipfile.ZipFile(path) as archive:
        infos = [info for info in archive.infolist() if info.filename.rsplit("/", 1)[-1] in _ARRAY_MARKS]
        for info in infos[:_MOST_ARRAYS]:
            name = info.filename.rsplit("/", 1)[0] if "/" in info.filename else ""
            yield name, info.file_size, lambda info=info: archive.read(_plain(info))


def _plain(info: zipfile.ZipInfo) -> zipfile.ZipInfo:
    """Refuse a member of an archive that unpacks without a bound."""
    if info.compress_type not in _STORED:
        raise InvalidArgument(f"{info.filename}: packed as no zarr file is. Save it again.")
    return info


def _entry(text: bytes) -> _Entry | None:
    """Return what the metadata of an array of numbers say, None of anything else."""
    try:
        content: Mapping[str, Any] = json.loads(text)
        shape = tuple(int(n) for n in content["shape"])
        kind = np.dtype(str(content.get("dtype", content.get("data_type"))))
        grid = content.get("chunks") or content["chunk_grid"]["configuration"]["chunk_shape"]
        chunk = int(np.prod([int(n) for n in grid], dtype=object)) * kind.itemsize
        codecs = _codecs(content)
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError):
        return None
    if kind.kind not in "fiu" or not shape or min(shape) < 0 or len(shape) > 4:
        return None
    return _Entry(shape, kind, chunk, codecs)


def _codecs(content: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the names of the codecs in the metadata of format 2 or 3."""
    if "codecs" in content:
        return tuple(str(codec["name"]).removeprefix("numcodecs.") for codec in content["codecs"])
    compressor = content.get("compressor")
    listed = [*(content.get("filters") or []), *([compressor] if compressor else [])]
    return tuple(str(codec["id"]) for codec in listed)


def _check_codecs(name: str, entry: _Entry) -> None:
    """Refuse codecs that are not on the list: some run code, others unpack without a bound."""
    wrong = [codec for codec in entry.codecs if codec not in (*_PACKERS, *_KEEP_SIZE)]
    packers = [codec for codec in entry.codecs if codec in _PACKERS]
    behind = entry.codecs[entry.codecs.index(packers[0]) + 1 :] if packers else ()
    if wrong or len(packers) > 1 or behind not in ((), ("crc32c",)):
        raise InvalidArgument(
            f"{name}: packed by {', '.join(wrong or entry.codecs)}, expected one of {', '.join(_PACKERS)}, or nothing. "
            "Save the array with one of them."
        )
    if entry.chunk > _LARGEST_CHUNK:
        raise InvalidArgument(f"{name}: chunks of {entry.chunk} bytes, expected at most {_LARGEST_CHUNK}.")


def _chunks(path: Path, name: str, longest: int) -> Iterator[bytes]:
    """Yield the chunks of an array as they are stored."""
    if path.is_dir():
        for root, _, files in os.walk(path / name):
            for chunk in (Path(root) / file for file in files if file not in (*_ARRAY_MARKS, *_MARKS)):
                if not chunk.is_file() or chunk.stat().st_size > longest:
                    raise InvalidArgument(f"{chunk.name}: no chunk of at most {longest} bytes.")
                yield chunk.read_bytes()
        return
    with zipfile.ZipFile(path) as archive:
        for info in archive.infolist():
            if not info.filename.startswith(f"{name}/") or info.filename.rsplit("/", 1)[-1] in (*_ARRAY_MARKS, *_MARKS):
                continue
            if info.file_size > longest:
                raise InvalidArgument(f"{info.filename}: no chunk of at most {longest} bytes.")
            yield archive.read(_plain(info))


def _check_chunk(name: str, entry: _Entry, content: bytes) -> None:
    """Refuse a chunk that unpacks to more than its numbers."""
    packer = next((codec for codec in entry.codecs if codec in _PACKERS), None)
    if packer is None:
        return
    content = content[:-4] if entry.codecs[-1] == "crc32c" else content
    if packer in ("zlib", "gzip"):
        sound = unpacks_within(content, entry.chunk, _GZIP if packer == "gzip" else zlib.MAX_WBITS)
    else:
        sound = _fills(packer, content, entry.chunk)
    if not sound:
        raise InvalidArgument(f"{name}: a chunk is damaged or unpacks to more than {entry.chunk} bytes.")


def _fills(packer: str, content: bytes, size: int) -> bool:
    """Return whether a chunk fits a buffer of its nominal size."""
    try:
        needed("numcodecs", "Zarr files").get_codec({"id": packer}).decode(content, out=bytearray(size))
    except (RuntimeError, ValueError):
        return False
    return True
