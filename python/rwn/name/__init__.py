"""Which effects explain the mismatch: first guesses, screening, forward selection, backward elimination."""

from __future__ import annotations
