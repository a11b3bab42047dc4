"""Blind trials: an independent plant conceals physics, the tool looks for it, the score says how well."""

from __future__ import annotations
