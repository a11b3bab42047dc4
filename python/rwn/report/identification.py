"""How well an identified model fits, in words."""

from __future__ import annotations

from collections.abc import Iterator

from rwn.fit.prior_weight import BELIEVABLE
from rwn.identify import Identification, at_a_bound
from rwn.model.model import Model
from rwn.report.nominal_fit import FittedParameter
from rwn.report.text import estimate, listing, number, parameter_in_words, percent, symbol, times_given


def lines(fit: Identification, nominal: Model) -> Iterator[str]:
    """Parameters with intervals, what is explained, and what to doubt."""
    for name, value in fit.parameters.items():
        yield f"{name:<22} {estimate(value)}"
    for row in fit.explained:
        how = f"{_share(row.explained)} of the variance of the {row.signal} is explained"
        yield f"{row.recording}: {how}, rms error {number(row.error)} {symbol(row.unit)}".rstrip()
    yield f"what is left has {number(fit.residual_over_noise, 2)} times the rms of the noise (1: nothing but noise)"
    yield from (f"{finding.recording}: {finding.words} ({finding.done})" for finding in fit.findings)
    yield from (f"warning: {text}" for text in (*fit.warnings, *_doubts(fit, nominal)))


def _doubts(fit: Identification, nominal: Model) -> Iterator[str]:
    """What moved to a bound or far off was seen, however unsure its value is."""
    if not fit.parameters:
        yield "nothing was fitted: the model declares nothing uncertain; say what is under [uncertainty]"
    at_bound = [name for name, value in fit.parameters.items() if at_a_bound(value)]
    unseen = [name for name in fit.not_identifiable if name not in at_bound]
    if at_bound:
        yield f"{listing([parameter_in_words(n) for n in at_bound])} ran into a bound: the value is that of the bound"
    if unseen:
        names = listing([parameter_in_words(n) for n in unseen])
        yield f"these recordings add nothing to what was declared of {names}"
    yield from _held(fit, nominal)
    for name, value in fit.parameters.items():
        if name in nominal.uncertainty and nominal.parameters.get(name):
            moved = FittedParameter(
                nominal=nominal.parameters[name], uncertainty=nominal.uncertainty[name], refitted=value
            ).moved
            if moved > BELIEVABLE:
                factor = value.value / nominal.parameters[name]
                yield (
                    f"{parameter_in_words(name)} moved to {times_given(factor)}, {number(moved, 2)} "
                    "declared deviations: check data sheet and units"
                )


def _held(fit: Identification, nominal: Model) -> Iterator[str]:
    """Parameters of effects that are taken as exact: the intervals of all others are too narrow by what is not.

    One of 0 does not act, as the effects that are not declared at all.
    """
    values = nominal.effect_values
    held = [name for name, (_, value) in values.items() if value != 0.0 and not nominal.uncertainty.get(name)]
    if held and fit.parameters:
        names = listing([parameter_in_words(name) for name in held])
        yield (
            f"{names} {'is' if len(held) == 1 else 'are'} taken as exact, and the intervals are as narrow as if that "
            f"were so: say how far it is believed under [uncertainty], for instance {held[0]} = 0.1"
        )


def _share(explained: float) -> str:
    return percent(explained) if explained > 0.0 else "nothing"
