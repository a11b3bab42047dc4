"""NumPy twins of the C++ core: slow, plain, written from the equations; the tests hold both together."""

from __future__ import annotations
