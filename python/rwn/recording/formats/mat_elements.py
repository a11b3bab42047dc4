"""Whether a MATLAB file of version 5 to 7 is built as it must be; scipy reads beyond its memory in one that is not."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable
from pathlib import Path

Read = Callable[[int], bytes]

_HEADER, _TAG = 128, 8  # bytes
_ORDERS = {b"\x00\x01IM": "<", b"\x01\x00MI": ">"}  # of bytes, with the version before it
_HDF = {b"\x00\x02IM", b"\x02\x00MI"}  # version 7.3
_MATRIX, _COMPRESSED = 14, 15
_NUMBERS = {1, 2, 3, 4, 5, 6, 7, 9, 12, 13}
_TYPES = _NUMBERS | {_MATRIX, _COMPRESSED, 16, 17, 18}
_FLAGS = (6, 8)  # the tag that a matrix begins with: two numbers, of which the first tells its class
_COMPLEX = 0x800
_PARTS = {5: 3} | dict.fromkeys(range(6, 16), 1)  # elements of numbers by class: a sparse matrix, those of one type
_DEEPEST = 60  # structs in structs
_CHUNK = 1 << 16


class _Stream:
    """Bytes that are read, or passed over, up to an end."""

    def __init__(self, read: Read, order: str) -> None:
        self.read, self.order = read, order

    def take(self, count: int) -> bytes:
        found = self.read(count)
        if len(found) < count:
            raise ValueError("the file ends within an element")
        return found

    def tag(self) -> tuple[int, int]:
        kind, size = struct.unpack(f"{self.order}II", self.take(_TAG))
        return int(kind), int(size)

    def skip(self, count: int) -> None:
        while count > 0:
            count -= len(self.take(min(count, _CHUNK)))


def check_elements(path: Path) -> None:
    """Raises ValueError or zlib.error where a tag names a type that there is not, or more bytes than what holds it has.

    Versions 4 and 7.3 are left to others. Which it is, scipy reads off the first and the last bytes of the header, not
    off its text.
    """
    with path.open("rb") as file:
        head = file.read(_HEADER)
        version = head[124:]
        if 0 in head[:4] or version in _HDF:
            return
        if version not in _ORDERS:
            raise ValueError("a version that there is not")
        stream = _Stream(file.read, _ORDERS[version])
        left = path.stat().st_size - _HEADER
        while left >= _TAG:
            left -= _element(stream, left, 0)[1]


def _element(stream: _Stream, room: int, depth: int) -> tuple[int, int]:
    """Checks an element that must lie within `room` bytes; its type and how many it took, with what aligns the next."""
    kind, size = stream.tag()
    if kind >> 16:  # the short form: size and up to 4 bytes within the tag
        kind, size = kind & 0xFFFF, kind >> 16
        if kind not in _TYPES or size > 4:
            raise ValueError(f"a short element of type {kind} and {size} bytes")
        return kind, _TAG
    if kind not in _TYPES or size > room - _TAG or depth > _DEEPEST:
        raise ValueError(f"an element of type {kind} and {size} bytes")
    if kind == _COMPRESSED:
        _unpacked(stream, size, depth)
        return kind, _TAG + size  # these alone are not aligned
    if kind == _MATRIX:
        _matrix(stream, size, depth)
    else:
        stream.skip(size)
    padding = min(-size % 8, room - _TAG - size)
    stream.skip(padding)
    return kind, _TAG + size + padding


def _matrix(stream: _Stream, size: int, depth: int) -> None:
    """Checks what a matrix holds: behind its flags, dimensions and name, as many lists of numbers as its class has."""
    if not size:
        return
    size -= _TAG + _FLAGS[1]
    if size < 0 or stream.tag() != _FLAGS:
        raise ValueError("a matrix without flags")
    flags, _ = struct.unpack(f"{stream.order}II", stream.take(_FLAGS[1]))
    kinds = []
    while size >= _TAG:
        kind, took = _element(stream, size, depth + 1)
        kinds.append(kind)
        size -= took
    stream.skip(size)
    count = _PARTS.get(flags & 0xFF, 0)
    if count:
        count += bool(flags & _COMPLEX)
        numbers = kinds[2 : 2 + count]
        if len(numbers) < count or not _NUMBERS.issuperset(numbers):
            raise ValueError("a matrix without its numbers")


def _unpacked(stream: _Stream, size: int, depth: int) -> None:
    """Checks the element within a compressed one."""
    unpack = zlib.decompressobj()

    def read(count: int) -> bytes:
        nonlocal size
        found = b""
        while len(found) < count:
            packed = unpack.unconsumed_tail
            if not packed and size:
                packed = stream.take(min(size, _CHUNK))
                size -= len(packed)
            got = unpack.decompress(packed, count - len(found)) if not unpack.eof else b""
            if not got and (unpack.eof or not (size or unpack.unconsumed_tail)):
                break
            found += got
        return found

    inner = _Stream(read, stream.order)
    kind, inside = inner.tag()
    if kind != _MATRIX:
        raise ValueError(f"a compressed element of type {kind}")
    _matrix(inner, inside, depth + 1)
    stream.skip(size)
