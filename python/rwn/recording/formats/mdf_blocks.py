"""The blocks of an ASAM MDF 4 file and the links between them, before a library follows these.

A block has a head of 24 bytes (what it is, its length, how many links) and its links; the first link of those that form
a list leads to the next one. Source: ASAM MDF 4.1, block structure.
"""

from __future__ import annotations

import struct
from typing import BinaryIO

_FIRST = 64  # where the block of the header stands
_HEAD = struct.Struct("<4s4xQQ")


def is_version_4(stream: BinaryIO) -> bool:
    """Whether the header is one of MDF 4."""
    stream.seek(_FIRST)
    return stream.read(4) == b"##HD"


def refuse_circles(stream: BinaryIO) -> None:
    """Raises ValueError where a list of blocks leads back into itself: asammdf would follow it for ever."""
    following = _following(stream)
    ended = set[int]()
    for begin in following:
        path, at = list[int](), begin
        while at in following and at not in ended:
            path.append(at)
            ended.add(at)
            at = following[at]
        if at in path:
            raise ValueError(f"the block at byte {at} follows itself")


def _following(stream: BinaryIO) -> dict[int, int]:
    """The first link of every block that links lead to, by its place."""
    size = stream.seek(0, 2)
    found: dict[int, int] = {}
    to_read = [_FIRST]
    while to_read:
        at = to_read.pop()
        if at in found or not 0 < at <= size - _HEAD.size - 8:
            continue
        stream.seek(at)
        kind, length, count = _HEAD.unpack(stream.read(_HEAD.size))
        if not kind.startswith(b"##"):
            count, length = 1, _HEAD.size + 8  # no block, but what follows it is read all the same
        many = max(0, min(count, (length - _HEAD.size) // 8, (size - at - _HEAD.size) // 8))
        links = struct.unpack(f"<{many}Q", stream.read(8 * many))
        found[at] = links[0] if links else 0
        to_read += links
    return found
