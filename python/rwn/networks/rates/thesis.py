"""The thesis's adaptive learning rates (3.31-3.89, 4.30-4.124, E.1-E.24)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from rwn import _core
from rwn.networks.rates.rule import DEFAULTS, check_fraction

_DEFAULTS = DEFAULTS["thesis"]


@dataclass(frozen=True, kw_only=True)
class Thesis:
    """mu_g = fraction * 2 / bound_g^2, bound_g an upper bound of ||dy/dtheta_g||.

    fraction: of the bound, 0 < fraction < 1 in the thesis.
    maxima: `running` as in the thesis (the first samples then see tiny signals and get enormous rates),
        `pre-pass` (a cycle with frozen parameters, then held) or `pre-pass-then-running`.
    shared: divides the fraction among the groups that learn; the thesis does not.
    printed: the bounds as printed; False: the wavelet's own max|phi|, max|phi'|, max|z phi'| instead of 1,
        and the right E2 in (4.66-4.75).
    """

    name: ClassVar[str] = "thesis"
    fraction: float = _DEFAULTS["fraction"]
    maxima: Literal["running", "pre-pass", "pre-pass-then-running"] = _DEFAULTS["maxima"]
    shared: bool = _DEFAULTS["shared"]
    printed: bool = _DEFAULTS["printed"]

    def __post_init__(self) -> None:
        check_fraction("fraction", self.fraction)
        self.core_for(())  # raises for an unknown kind of maxima

    def core_for(self, groups: tuple[str, ...]) -> _core.ThesisRates:  # noqa: ARG002
        """The same rule in the C++ core."""
        return _core.ThesisRates(
            fraction=self.fraction, maxima=self.maxima, shared=self.shared, printed=self.printed
        )
