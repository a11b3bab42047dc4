"""The thesis's adaptive learning rates (3.31-3.89, 4.30-4.124, E.1-E.24)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from rwn import _core
from rwn.networks.rates.rule import DEFAULTS, check_fraction

_DEFAULTS = DEFAULTS["thesis"]


@dataclass(frozen=True, kw_only=True)
class Thesis:
    """mu_g = fraction * 2 / bound_g^2, bound_g an upper bound of ||dy/dtheta_g|| as the thesis prints it: with
    max|phi| = max|phi'| = 1 for every wavelet and |z| <= (|x| + |c| + |m|)/|d| (3.73).

    fraction: of the bound, 0 < fraction < 1 in the thesis.
    maxima: `running` as in the thesis (the first samples then see tiny signals and get enormous rates),
        `pre-pass` (a cycle with frozen parameters, then held) or `pre-pass-then-running`.
    shared: divides the fraction among the groups that learn; the thesis does not.
    misprint: the bound of v3 with |v3| as (4.66-4.75) print it, where |v2| is right; it is then no bound, and
        Table 19 shows that the thesis's own program did not have it.
    eigen: rho(A) and cond(M) by Eigen's eigendecomposition at every sample instead of in closed form; the same
        to 2e-13, and slower (`make bench` says by how much). A recurrent network has no A and ignores it.
    Raises ValueError for a fraction that is not positive or an unknown kind of maxima.
    """

    name: ClassVar[str] = "thesis"
    fraction: float = _DEFAULTS["fraction"]
    maxima: Literal["running", "pre-pass", "pre-pass-then-running"] = _DEFAULTS["maxima"]
    shared: bool = _DEFAULTS["shared"]
    misprint: bool = _DEFAULTS["misprint"]
    eigen: bool = _DEFAULTS["eigen"]

    def __post_init__(self) -> None:
        check_fraction("fraction", self.fraction)
        self.core_for(())  # raises for an unknown kind of maxima

    def core_for(self, groups: tuple[str, ...]) -> _core.ThesisRates:  # noqa: ARG002
        """The same rule in the C++ core."""
        return _core.ThesisRates(
            fraction=self.fraction,
            maxima=self.maxima,
            shared=self.shared,
            misprint=self.misprint,
            eigen=self.eigen,
        )
