"""Rates from the l1 norm of the impulse response C A^r E."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rwn import _core
from rwn.networks.rates.rule import DEFAULTS, check_fraction

_DEFAULTS = DEFAULTS["impulse-response"]


@dataclass(frozen=True, kw_only=True)
class ImpulseResponse:
    """mu_g = fraction * 2 / bound_g^2 with the tight bound: l1 norm of the impulse response times the
    largest drive of a pre-pass over the first cycle; then held.

    fraction: None is (1 - rho)/4, which leaves a change of the parameters the time to act.
    shared: divides the fraction among the groups that learn.
    """

    name: ClassVar[str] = "impulse-response"
    fraction: float | None = None
    shared: bool = _DEFAULTS["shared"]

    def __post_init__(self) -> None:
        if self.fraction is not None:
            check_fraction("fraction", self.fraction)

    def core_for(self, groups: tuple[str, ...]) -> _core.ImpulseResponseRates:  # noqa: ARG002
        """The same rule in the C++ core."""
        return _core.ImpulseResponseRates(fraction=self.fraction or 0.0, shared=self.shared)
