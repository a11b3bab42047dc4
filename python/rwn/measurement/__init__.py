"""How recordings were made: input between samples, filters and delays of sensors, levels by file, a coarse speed."""

from __future__ import annotations
