"""Results that are kept by the numbers that they were made from."""

from __future__ import annotations

from collections import OrderedDict
from hashlib import blake2b
from threading import Lock
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Result = TypeVar("Result")


class ByContent(Generic[Result]):
    """The last results, by what the arrays hold that each was made from.

    Recordings are prepared many times in a diagnosis, under one assumption after another that leaves most of their
    signals as they are. The arrays themselves are not kept.
    """

    def __init__(self, kept: int = 64) -> None:
        """`kept`: how many results are."""
        self._kept = kept
        self._known: OrderedDict[bytes, Result] = OrderedDict()
        self._lock = Lock()

    def key(self, *arrays: NDArray[np.generic]) -> bytes:
        """What tells these arrays (n,) from others."""
        digest = blake2b(digest_size=16)
        for array in arrays:
            digest.update(f"{array.dtype.str}{array.shape}".encode())
            digest.update(array.tobytes())
        return digest.digest()

    def get(self, key: bytes) -> Result | None:
        """What was kept, if anything was."""
        with self._lock:
            return self._known.get(key)

    def keep(self, key: bytes, result: Result) -> Result:
        """The result, which is kept; the oldest is forgotten."""
        with self._lock:
            self._known[key] = result
            while len(self._known) > self._kept:
                self._known.popitem(last=False)
        return result
