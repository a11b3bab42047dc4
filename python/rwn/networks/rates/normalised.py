"""Rates normalised by the actual sensitivity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from rwn import _core
from rwn.networks.rates.rule import DEFAULTS, check_fraction

_DEFAULTS = DEFAULTS["normalised"]


@dataclass(frozen=True, kw_only=True)
class Normalised:
    """mu_g(n) = fraction s_g^2 / (regularisation M + S(n)), S = sum_g s_g^2 ||P_g||^2, M its maximum in a
    pre-pass.

    fraction: 0 < fraction < 2 with `follow_state`, of the order of 1 - rho without.
    regularisation: keeps weakly excited samples (and their noise) from moving the parameters.
    scales: s_g by group name, how far a group may be off; None takes them from the network and the recording.
    """

    name: ClassVar[str] = "normalised"
    fraction: float = _DEFAULTS["fraction"]
    regularisation: float = _DEFAULTS["regularisation"]
    scales: Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        check_fraction("fraction", self.fraction)
        check_fraction("regularisation", self.regularisation)

    def core_for(self, groups: tuple[str, ...]) -> _core.NormalisedRates:
        """The same rule in the C++ core. Raises ValueError where it does not fit the network's groups."""
        scales = self.scales or {}
        unknown = sorted(set(scales) - set(groups))
        if unknown:
            raise ValueError(f"scales: unknown group {unknown[0]!r}; this network has {', '.join(groups)}")
        values = [float(scales.get(group, 0.0)) for group in groups] if self.scales else []
        return _core.NormalisedRates(
            fraction=self.fraction, regularisation=self.regularisation, scales=values
        )
