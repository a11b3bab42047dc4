"""The thesis's rule with the wavelet's own bounds (ours)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from rwn import _core
from rwn.networks.rates.rule import DEFAULTS, check_fraction

_DEFAULTS = DEFAULTS["tightened"]


@dataclass(frozen=True, kw_only=True)
class Tightened:
    """`Thesis` with the wavelet's own max|phi|, max|phi'| and max|z phi'| in place of 1, 1 and (3.73): bounds for
    every wavelet, and for the Gaussian derivative larger rates of w, d and c.

    Options and errors as in `Thesis`.
    """

    name: ClassVar[str] = "tightened"
    fraction: float = _DEFAULTS["fraction"]
    maxima: Literal["running", "pre-pass", "pre-pass-then-running"] = _DEFAULTS["maxima"]
    shared: bool = _DEFAULTS["shared"]
    eigen: bool = _DEFAULTS["eigen"]

    def __post_init__(self) -> None:
        check_fraction("fraction", self.fraction)
        self.core_for(())  # raises for an unknown kind of maxima

    def core_for(self, groups: tuple[str, ...]) -> _core.TightenedRates:  # noqa: ARG002
        """The same rule in the C++ core."""
        return _core.TightenedRates(fraction=self.fraction, maxima=self.maxima, shared=self.shared, eigen=self.eigen)
