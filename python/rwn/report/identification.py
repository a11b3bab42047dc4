"""How well an identified model fits, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from rwn.fit.intervals import Estimate
from rwn.fit.prior_weight import BELIEVABLE
from rwn.identify import Identification
from rwn.model.model import Model
from rwn.recording.columns import si_unit
from rwn.recording.recording import Recording
from rwn.recording.signals import COLUMNS
from rwn.recording.units import factor
from rwn.report.nominal_fit import FittedParameter
from rwn.report.text import estimate, listing, number, percent, symbol, times_given, unknown_name
from rwn.simulate.simulation import simulate

CUT = 1e-6  # relative; intervals are wider than AGREEMENT of a value on either side
DESCRIBES = 0.5  # share of a signal's variance that a model must explain, to be said to describe it


@dataclass(frozen=True, kw_only=True)
class ExplainedSignal:
    """How much of one recorded signal the fitted model explains in free run, and the rms of what it does not."""

    recording: str
    signal: str
    explained: float  # share of the variance; negative where it is worse than the mean
    error: float  # rms, in `unit`
    unit: str  # that of the file, else SI


def explained_signals(fit: Identification, recordings: Sequence[Recording]) -> tuple[ExplainedSignal, ...]:
    """What the fitted model explains of every recorded output."""
    rows = []
    for recording in recordings:
        made = simulate(fit.model, recording).signals
        for signal in (s for s in made if s in recording.signals):
            measured = np.array(recording.signals[signal])
            measured[recording.missing.get(signal, np.zeros(measured.size, dtype=bool))] = np.nan
            spread = float(np.nanvar(measured))
            error = float(np.nanmean((measured - made[signal]) ** 2))
            explained = 1.0 - error / spread if spread > 0.0 else float(error == 0.0)
            rms, unit = _as_recorded(error**0.5, signal, recording)
            rows.append(
                ExplainedSignal(recording=recording.name, signal=signal, explained=explained, error=rms, unit=unit)
            )
    return tuple(rows)


def _as_recorded(value: float, signal: str, recording: Recording) -> tuple[float, str]:
    """A value in SI in the unit that the file has for the signal, and that unit."""
    si = si_unit(COLUMNS[signal], recording.linear)
    unit = recording.units.get(signal, si)
    return value / factor(unit, si, where=recording.name), unit


def failure(fit: Identification, signals: Sequence[ExplainedSignal]) -> str:
    """Why the fit is no model of these recordings; empty where it is one."""
    said = [f"the fit did not converge ({fit.status}): {fit.advice.rstrip('.')}"] if fit.status != "converged" else []
    explained = [row.explained if np.isfinite(row.explained) else -np.inf for row in signals]
    if explained and max(explained) < DESCRIBES:
        said.append(
            f"the fitted model explains {_share(max(explained))} of the variance of any recorded signal: check signs, "
            "units and columns, or let rwn diagnose find such a mistake or what is missing"
        )
    limits = [unknown_name(n) for n, e in fit.parameters.items() if "." not in n and e.value != 0.0 and _at_a_bound(e)]
    if limits:
        said.append(
            f"{listing(limits)} ran to the end of the search, a thousand times the given value or a thousandth: check "
            "signs, units and columns, or let rwn diagnose find what is wrong with them"
        )
    return "; ".join(said)


def lines(fit: Identification, signals: Sequence[ExplainedSignal], nominal: Model) -> Iterator[str]:
    """Parameters with intervals, what is explained, and what to doubt."""
    for name, value in fit.parameters.items():
        yield f"{name:<22} {estimate(value)}"
    for row in signals:
        how = f"{_share(row.explained)} of the variance of the {row.signal} is explained"
        yield f"{row.recording}: {how}, rms error {number(row.error)} {symbol(row.unit)}".rstrip()
    yield f"what is left has {number(fit.residual_over_noise, 2)} times the rms of the noise (1: nothing but noise)"
    yield from (f"{finding.recording}: {finding.words} ({finding.done})" for finding in fit.findings)
    yield from (f"warning: {text}" for text in (*fit.warnings, *_doubts(fit, nominal)))


def _doubts(fit: Identification, nominal: Model) -> Iterator[str]:
    """What moved to a bound or far off was seen, however unsure its value is."""
    at_bound = [name for name, value in fit.parameters.items() if _at_a_bound(value)]
    unseen = [name for name in fit.not_identifiable if name not in at_bound]
    if at_bound:
        yield f"{listing([unknown_name(n) for n in at_bound])} ran into a bound: the value is that of the bound"
    if unseen:
        names = listing([unknown_name(n) for n in unseen])
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
                    f"{unknown_name(name)} moved to {times_given(factor)}, {number(moved, 2)} "
                    "declared deviations: check data sheet and units"
                )


def _held(fit: Identification, nominal: Model) -> Iterator[str]:
    """Parameters of effects that are taken as exact: the intervals of all others are too narrow by what is not.

    One of 0 does not act, as the effects that are not declared at all.
    """
    values = nominal.effect_values
    held = [name for name, (_, value) in values.items() if value != 0.0 and not nominal.uncertainty.get(name)]
    if held and fit.parameters:
        names = listing([unknown_name(name) for name in held])
        yield (
            f"{names} {'is' if len(held) == 1 else 'are'} taken as exact, and the intervals are as narrow as if that "
            f"were so: say how far it is believed under [uncertainty], for instance {held[0]} = 0.1"
        )


def _at_a_bound(value: Estimate) -> bool:
    """Whether its interval ends at it, as it does where it is cut at a bound alone."""
    return value.interval is not None and any(math.isclose(value.value, end, rel_tol=CUT) for end in value.interval)


def _share(explained: float) -> str:
    return percent(explained) if explained > 0.0 else "nothing"
