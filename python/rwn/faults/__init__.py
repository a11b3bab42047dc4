"""Faults of the recordings themselves: unit, sign, gear ratio, channels out of step."""

from __future__ import annotations
