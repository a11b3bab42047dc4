"""Where the mismatch sits: unknown torque and voltage, their regions and what they depend on."""

from __future__ import annotations
