"""Rates given by the user."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from rwn import _core


@dataclass(frozen=True)
class Fixed:
    """One rate per group; groups that are not named have rate 0.

    Structured network: v1..v5, w, m, d, c. Recurrent network: b, a, w, m, d, c.
    """

    name: ClassVar[str] = "fixed"
    rates: Mapping[str, float]

    def values(self, groups: tuple[str, ...]) -> list[float]:
        """The rates in the order of `groups`; raises ValueError for a name that is not among them."""
        unknown = sorted(set(self.rates) - set(groups))
        if unknown:
            raise ValueError(f"rates: unknown group {unknown[0]!r}; this network has {', '.join(groups)}")
        return [float(self.rates.get(group, 0.0)) for group in groups]

    def core_for(self, groups: tuple[str, ...]) -> _core.FixedRates:
        """The same rule in the C++ core."""
        return _core.FixedRates(self.values(groups))
