"""What a search left untried for what it may cost."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class NotTried:
    """Effects that were not tried beside those of an explanation."""

    beside: tuple[str, ...]
    effects: tuple[str, ...]
