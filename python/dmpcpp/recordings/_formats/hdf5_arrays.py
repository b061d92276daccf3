"""The arrays of numbers in an HDF5 file, and their bounds: nothing outside the file is opened, nothing unpacks without
limit.

Only hard links are followed. Virtual data sets, external storage, references and object types are left out. A chunk is
unpacked only by the filters below, and a gzip chunk only if it unpacks to what its shape says.
"""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._datasets import LARGEST

__all__ = ["arrays_in", "read_array", "unpacks_within"]

_MOST_ARRAYS = 20_000
_LARGEST_CHUNK = 64 * 1024 * 1024  # bytes unpacked
_DEFLATE, _LZF = 1, 32000
_FILTERS = {_DEFLATE: "gzip", 2: "shuffle", 3: "fletcher32", 5: "nbit", 6: "scaleoffset", _LZF: "lzf"}
_PACKERS = (_DEFLATE, _LZF)
_LZF_GAIN = 88  # bytes that one packed byte can become: 264 of 3
_CHECKSUM = 64  # bytes, more than any
_MOST_CHUNKS = 1_000_000
_REPACK = "Pack the file again: h5repack -f GZIP=4 IN OUT."


def arrays_in(h5py: Any, file: Any) -> dict[str, tuple[int, ...]]:
    """Return the shapes of the arrays of numbers in an open file, by path."""
    found: dict[str, tuple[int, ...]] = {}
    waiting: list[tuple[str, Any]] = [("", file)]
    seen: set[Any] = set()
    while waiting and len(found) < _MOST_ARRAYS and len(seen) < _MOST_ARRAYS:
        prefix, group = waiting.pop()
        for name in sorted(group, reverse=True):
            if group.get(name, getlink=True).__class__ is not h5py.HardLink:
                continue
            item = group[name]
            if isinstance(item, h5py.Group):
                if item.id not in seen:
                    seen.add(item.id)
                    waiting.append((f"{prefix}{name}/", item))
            elif isinstance(item, h5py.Dataset) and _is_plain(item):
                found[f"{prefix}{name}"] = tuple(item.shape)
    return dict(sorted(found.items()))


def read_array(name: str, data: Any) -> Array:
    """Return a data set as float64.

    Raises
    ------
    InvalidArgument
        Its chunks are too large, packed by another filter, or unpack to more than their shape.
    """
    if data.chunks is not None:
        _check_chunks(name, data)
    return np.asarray(data[()], dtype=np.float64)


def _is_plain(item: Any) -> bool:
    """Return whether a data set holds numbers that stand in the file itself."""
    return item.dtype.kind in "fiu" and bool(item.shape) and not item.is_virtual and item.external is None


def _check_chunks(name: str, data: Any) -> None:
    nominal = int(np.prod(data.chunks, dtype=object)) * data.dtype.itemsize
    if nominal > _LARGEST_CHUNK or data.id.get_num_chunks() > _MOST_CHUNKS:
        count = data.id.get_num_chunks()
        raise InvalidArgument(
            f"{name}: {count} chunks of {nominal} bytes, expected at most {_MOST_CHUNKS} of {_LARGEST_CHUNK}. {_REPACK}"
        )
    settings = data.id.get_create_plist()
    filters = [settings.get_filter(k)[0] for k in range(settings.get_nfilters())]
    known = ", ".join(_FILTERS.values())
    wrong = next((f"HDF5 filter {number}" for number in filters if number not in _FILTERS), None)
    if wrong or sum(number in _PACKERS for number in filters) > 1:
        raise InvalidArgument(f"{name}: packed by {wrong or 'two filters'}, expected one of {known}. {_REPACK}")
    if any(number in _PACKERS for number in filters):
        _check_packed(name, data, filters, nominal)


def _check_packed(name: str, data: Any, filters: list[int], nominal: int) -> None:
    """Refuse a chunk that unpacks to more than its numbers; a checksum may stand behind them."""
    limit = nominal + _CHECKSUM
    chunks: list[Any] = []
    data.id.chunk_iter(chunks.append)
    for chunk in chunks:
        gain = _LZF_GAIN if _LZF in filters else 1
        if chunk.size > limit + nominal // 100 or chunk.size * gain > LARGEST:
            raise InvalidArgument(f"{name}: a chunk of {chunk.size} bytes for {nominal} bytes of numbers.")
        if _DEFLATE in filters and not chunk.filter_mask >> filters.index(_DEFLATE) & 1:
            packed = data.id.read_direct_chunk(chunk.chunk_offset)[1]
            if not unpacks_within(packed, limit):
                raise InvalidArgument(f"{name}: a chunk is damaged or unpacks to more than {nominal} bytes.")


def unpacks_within(packed: bytes, limit: int, window: int = zlib.MAX_WBITS) -> bool:
    """Return whether zlib data, or with `window` of `zlib.decompressobj` gzip's, unpack to at most `limit` bytes."""
    unpacker = zlib.decompressobj(window)
    try:
        fits = len(unpacker.decompress(packed, limit + 1)) <= limit
    except zlib.error:
        return False
    return fits and (window <= zlib.MAX_WBITS or not unpacker.unused_data)  # gzip goes on with the next member
