"""The filters of sensors that a diagnosis found in the noise and fitted beside whatever is missing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rwn.fit.fit import Fit
from rwn.fit.intervals import HALF_WIDTH, Estimate, deviations
from rwn.fit.residuals import Statistics
from rwn.model.vocabulary import analog_filters


@dataclass(frozen=True, kw_only=True)
class FittedFilter:
    """A first-order filter of one measured signal; how it was measured, no physics that the model lacks."""

    signal: str
    time_constant: Estimate  # [s]


def fitted_filters(
    this: Fit, left: Statistics, digital: Mapping[str, float], *, samples: float | None = None
) -> tuple[FittedFilter, ...]:
    """The filters that a fit holds as part of the measurement; none that a model has itself.

    With 95 % intervals (`samples`: see `covariance`), but for `digital` ones [s] by signal, undone in the recordings.
    """
    unknowns = this.hypothesis.unknowns
    fitted = {u.name: k for k, u in enumerate(unknowns) if u.nuisance}
    spread = deviations(this, left, samples=samples)
    rows = [FittedFilter(signal=s, time_constant=Estimate(value=tau, unit="s")) for s, tau in digital.items()]
    for signal, lag in analog_filters(this.hypothesis.table).items():
        k = fitted.get(f"{lag.name}.{lag.parameters[0].name}")
        if k is None:
            continue
        value = float(this.minimum.values[k])
        factor = float(np.exp(min(HALF_WIDTH * spread[k] / value, 50.0)))
        rows.append(
            FittedFilter(
                signal=signal,
                time_constant=Estimate(value=value, unit=unknowns[k].unit, interval=(value / factor, value * factor)),
            )
        )
    return tuple(rows)
