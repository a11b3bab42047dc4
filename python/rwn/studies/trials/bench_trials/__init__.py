"""Bench trials: recordings as loggers of real benches leave them, with named physics and some that has no name."""

from __future__ import annotations
