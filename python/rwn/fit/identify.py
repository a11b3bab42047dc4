"""Parameters of a model of known structure, from recordings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from rwn.correct.corrected_model import corrected_model, deviations, estimates
from rwn.fit import residuals as evidence
from rwn.fit.fit import Fitted
from rwn.fit.preparation import noise_levels, prepare
from rwn.model.model import Model
from rwn.name.screening import Search
from rwn.recording.recording import Recording
from rwn.report.diagnosis import Estimate


@dataclass(frozen=True, kw_only=True)
class Fit:
    """A fitted model with what can be said of it."""

    model: Model
    parameters: Mapping[str, Estimate]
    status: str
    advice: str
    not_identifiable: tuple[str, ...]  # these recordings say less of them than the data sheet does
    residual_over_noise: float  # rms, 1: nothing but noise is left


def identify(recordings: Sequence[Recording], model: Model) -> Fit:
    """Fits the uncertain parameters of `model` to the free run over all recordings.

    Intervals are 95 %, widened for what the residual's variance and colour say; declared uncertainties are priors.
    """
    setup = prepare(recordings, model)
    search = Search.of(setup)
    fitted = search.fit_nominal()
    levels = noise_levels(
        setup.problem.targets, setup.problem.residuals(fitted.vector, fitted.candidate.active)
    )
    search = replace(search, problem=replace(setup.problem, noise=levels))
    fitted = search.fit_nominal()
    left = evidence.statistics(search.problem, fitted)
    status = fitted.minimum.status
    return Fit(
        model=corrected_model(fitted, model),
        parameters=estimates(fitted, left.variance, left.correlation_time),
        status=status.name.lower().replace("_", "-"),
        advice=status.value,
        not_identifiable=_unseen(fitted, left.variance, left.correlation_time),
        residual_over_noise=left.variance**0.5,
    )


def _unseen(fitted: Fitted, variance: float, correlation_time: float) -> tuple[str, ...]:
    spread = deviations(fitted, variance, correlation_time)
    rows = []
    for u, value, std in zip(fitted.candidate.unknowns, fitted.minimum.values, spread, strict=True):
        declared = u.prior_std * abs(u.prior) if u.prior else float("inf")
        if not u.nuisance and (std > 0.9 * declared or std > abs(value) > 0.0):
            rows.append(u.name)
    return tuple(rows)
