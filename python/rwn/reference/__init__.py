"""Reference implementations of the C++ core, in NumPy: slow, plain, written from the equations; tests compare both."""

from __future__ import annotations
