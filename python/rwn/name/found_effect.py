"""Effects that a diagnosis reports, as plain data, and how they come from a ranking."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from rwn.fit.intervals import Estimate, estimates
from rwn.fit.residuals import Statistics
from rwn.model.drives.drive import Drive
from rwn.model.vocabulary import Effect
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.recording.units import linear_unit

SURE = 0.99  # probability that is stated of a quantisation step, which is read off the values


@dataclass(frozen=True, kw_only=True)
class FoundEffect:
    """One physics that the nominal model lacks, or one fault of the recordings."""

    name: str
    equation: str  # "mechanical" | "electrical" | "actuator" | "sensor" | "recording"
    probability: float
    parameters: Mapping[str, Estimate] = field(default_factory=dict)
    formula: str = ""  # as in the effect table: "T sign(w)"
    meaning: str = ""  # one sentence for people: "dry friction that does not depend on speed"
    signals: tuple[str, ...] = ()  # of a fault of the recordings: those that it is in
    recordings: tuple[str, ...] = ()  # of a fault of some of the recordings: their files, or names


def found_effects(
    ranking: Ranking, chosen: RankedFit, probabilities: Mapping[str, float], left: Statistics, *,
    samples: float | None = None,
) -> tuple[FoundEffect, ...]:  # fmt: skip
    """The effects of an explanation with parameters and intervals, in the order of `probabilities` (name: it acts).

    `left`: what it leaves. `samples`: see `covariance`.
    """
    final = chosen.final
    numbers, known = estimates(final, left, samples=samples), final.hypothesis.table
    drive = ranking.problem.drive
    numbers = {name: replace(e, unit=_unit(name, e.unit, drive, known)) for name, e in numbers.items()}
    rows = []
    for name, probability in probabilities.items():
        effect = known[name]
        parameters = {
            p.name: numbers[f"{name}.{p.name}"] for p in effect.every if f"{name}.{p.name}" in numbers
        }
        for p in effect.parameters:
            if p.fixed:
                value = float(final.vector[effect.at(p.name)])
                parameters[p.name] = Estimate(value=value, unit=drive.unit_of(effect, p.unit))
        rows.append(
            FoundEffect(
                name=name,
                equation=effect.mismatch,
                probability=probability,
                parameters=parameters,
                formula=effect.equation,
                meaning=effect.meaning,
            )
        )
    return tuple(rows)


def coarse_speed(ranking: Ranking) -> FoundEffect | None:
    """A speed signal that is rounded to steps, read off its values."""
    steps = ranking.speed_steps
    if not steps:
        return None
    effect = next(e for e in ranking.problem.prior.table.values() if e.jumps)
    step = float(np.median(steps))
    unit, interval = effect.parameters[0].unit, (min(steps) * 0.9999, max(steps) * 1.0001)
    resolution = Estimate(value=step, unit=unit, interval=interval)
    return FoundEffect(
        name=effect.name, equation=effect.mismatch, probability=SURE, formula=effect.equation, meaning=effect.meaning,
        parameters={effect.parameters[0].name: resolution},
    )  # fmt: skip


def _unit(parameter: str, unit: str, drive: Drive, known: Mapping[str, Effect]) -> str:
    """The unit of a parameter of a model on this drive, where the tables have `unit`."""
    owner = known.get(parameter.split(".")[0])
    if owner is not None:
        return drive.unit_of(owner, unit)
    return linear_unit(unit) if drive.linear else unit
