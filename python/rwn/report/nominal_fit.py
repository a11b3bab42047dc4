"""The nominal parameters as a report shows them: as given, refitted alone, and together with the found effects."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from rwn.fit.intervals import HALF_WIDTH, Estimate, estimates
from rwn.fit.prior_weight import BELIEVABLE
from rwn.fit.residuals import Statistics
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit

UNTOLD = 0.9**0.5  # of the declared deviation, that is left where a tenth of the information is the recordings'


@dataclass(frozen=True, kw_only=True)
class FittedParameter:
    """A parameter of the model as given, an effect's as "effect.parameter": its value, its declared relative standard
    deviation (0: exact; None: not known at all), and as refitted."""

    nominal: float
    uncertainty: float | None
    refitted: Estimate  # the nominal structure alone
    corrected: Estimate | None = None  # together with the found effects

    @property
    def best(self) -> Estimate:
        """As refitted with what is found beside it, where something is."""
        return self.refitted if self.corrected is None else self.corrected

    @property
    def moved(self) -> float:
        """By how many declared standard deviations the refit moved it, relative or in its logarithm; 0 where exact."""
        return self.off(self.refitted)

    def off(self, fitted: Estimate) -> float:
        """By how many declared standard deviations a fit of it is off what was given (see `moved`)."""
        if not self.uncertainty or self.nominal <= 0.0:
            return 0.0
        ratio = fitted.value / self.nominal
        return min(abs(ratio - 1.0), abs(math.log(ratio)) if ratio > 0.0 else math.inf) / self.uncertainty

    def only_declared(self, fitted: Estimate) -> bool:
        """Whether the recordings tell less than a tenth of what is known of it; the rest was declared.

        What they moved beyond belief they tell, however wide its interval is.
        """
        if not self.uncertainty or fitted.interval is None or fitted.value <= 0.0 or self._beyond_belief(fitted.value):
            return False
        low, high = fitted.interval
        return bool((high - low) / (2.0 * HALF_WIDTH * fitted.value) > UNTOLD * self.uncertainty)

    @property
    def contradicted(self) -> bool:
        """Whether it left what was declared beyond belief together with the found effects."""
        return self.corrected is not None and self._beyond_belief(self.corrected.value)

    def _beyond_belief(self, value: float) -> bool:
        if not self.uncertainty or self.nominal <= 0.0:
            return False
        ratio = value / self.nominal
        return ratio <= 0.0 or abs(math.log(ratio)) > BELIEVABLE * self.uncertainty


@dataclass(frozen=True, kw_only=True)
class NominalFit:
    """The nominal structure refitted within its declared uncertainty."""

    parameters: Mapping[str, FittedParameter] = field(default_factory=dict)
    status: str = "converged"
    advice: str = ""


def nominal_fit(
    ranking: Ranking, chosen: RankedFit, left: Statistics, model: Model, *, samples: float | None = None
) -> NominalFit:
    """Nominal parameters: as given, refitted alone, and together with the found effects, which leave `left`."""
    alone = estimates(ranking.nominal_fit, ranking.before, samples=ranking.before.effective_with_misfit)
    together = estimates(chosen.final, left, samples=samples) if chosen.added else {}
    rows = {}
    given = dict(model.parameters) or dict(ranking.problem.prior.free)
    of_effects = model.effect_values
    for name, value in (given | {name: value for name, (_, value) in of_effects.items()}).items():
        declared = model.uncertainty.get(name, 0.0)
        if declared and name in of_effects and of_effects[name][0].cyclic:
            declared = declared / abs(value) if value else math.inf  # declared in radians
        unit = model.unit(name)
        rows[name] = FittedParameter(
            nominal=value,
            uncertainty=_finite(declared),
            refitted=replace(alone[name], unit=unit) if name in alone else Estimate(value=value, unit=unit),
            corrected=replace(together[name], unit=unit) if name in together else None,
        )
    status = ranking.nominal_fit.minimum.status
    return NominalFit(parameters=rows, status=status.name.lower().replace("_", "-"), advice=status.value)


def _finite(uncertainty: float) -> float | None:
    return uncertainty if math.isfinite(uncertainty) else None  # JSON has no infinity
