"""What every learning-rate rule offers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, TypeAlias

from rwn import _core

CoreRule: TypeAlias = (
    _core.FixedRates | _core.ThesisRates | _core.TightenedRates | _core.ImpulseResponseRates | _core.NormalisedRates
)
GUARANTEES: dict[str, str] = dict(_core.rate_rules())
DEFAULTS: dict[str, dict[str, Any]] = _core.rate_defaults()


class RateRule(Protocol):
    """A learning-rate rule: an immutable set of options with a name."""

    name: ClassVar[str]

    def core_for(self, groups: tuple[str, ...]) -> CoreRule:
        """The same rule in the C++ core, for a network with these groups of parameters."""
        ...


@dataclass(frozen=True, kw_only=True)
class RateReport:
    """What was wrong with a rule's bounds during a run: worst values, and at how many of `samples`.

    spectral_radius: largest rho(A); `unstable` counts rho(A) >= 1, where no bound holds.
    condition: largest cond(M); `defective` counts cond(M) > 1e8, where eigenvalues of A (nearly) meet and the
        printed bound freezes learning.
    recurrence: largest |c/d| max|phi'|; `recurrent` counts values of 1 and above, where V1-V3 have no bound.
    smallest_dilation: smallest |d|; a dilation near zero makes its wavelet a spike that nothing bounds.
    """

    spectral_radius: float
    condition: float
    recurrence: float
    smallest_dilation: float
    samples: int
    unstable: int
    defective: int
    recurrent: int

    @classmethod
    def of(cls, core: _core.RateReport) -> RateReport:
        """From the core's report."""
        return cls(**{name: getattr(core, name) for name in cls.__dataclass_fields__})

    @property
    def warnings(self) -> tuple[str, ...]:
        """One sentence for each thing that took its meaning from the bounds; empty when there was none."""
        found = []
        if self.unstable:
            found.append(f"rho(A) reached {self.spectral_radius:.6g} (>= 1) at {self.unstable} samples")
        if self.defective:
            found.append(f"M was (nearly) defective, cond {self.condition:.3g}, at {self.defective} samples")
        if self.recurrent:
            found.append(f"|c/d| max|phi'| reached {self.recurrence:.3g} (>= 1) at {self.recurrent} samples")
        if self.smallest_dilation < 1e-6:
            found.append(f"a dilation came within {self.smallest_dilation:.3g} of zero")
        return tuple(found)


def check_fraction(name: str, value: float, *, zero: bool = False) -> None:
    """Raises ValueError unless 0 < value (0 <= value if `zero`)."""
    if not (value > 0 or (zero and value == 0)):
        raise ValueError(f"{name} must be positive, got {value}")
