"""From what the stages found to a Diagnosis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from rwn import _core
from rwn._core import __version__
from rwn.correct.correction import Correction
from rwn.decide import excitation
from rwn.decide.account import Account
from rwn.decide.decision import Decision
from rwn.decide.next_experiment import separated_by
from rwn.decide.shaft_alone import ShaftAlone
from rwn.decide.statement import Statement, statement
from rwn.faults.fault import Fault
from rwn.faults.held_shaft import withstood
from rwn.fit.fit import Fit
from rwn.fit.fitted_model import with_uncertainty
from rwn.fit.intervals import estimates
from rwn.fit.levenberg_marquardt import FitStatus
from rwn.fit.prior_weight import BELIEVABLE
from rwn.fit.problem import Problem
from rwn.measurement.noise_spectrum import FASTEST
from rwn.mismatch_map.dependence import Law, laws
from rwn.mismatch_map.regions import regions
from rwn.model.model import Model
from rwn.name.found_effect import found_effects
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import LEFT_OUT
from rwn.report import figures
from rwn.report.diagnosis import Diagnosis
from rwn.report.diagnosis_data import Alternative, Beneath, Location
from rwn.report.file_units import Units, regions_in_file_units
from rwn.report.fitted_filter import FittedFilter, fitted_filters
from rwn.report.next_steps import NEAR
from rwn.report.nominal_fit import nominal_fit
from rwn.report.text import (
    listing,
    located,
    located_briefly,
    not_tried_in_words,
    parameter_in_words,
    plain_name,
    quantity,
    shaft_in_words,
    times_given,
)
from rwn.simulate.run import Run
from rwn.simulate.unknown_inputs import UnknownInputs, unknown_inputs


def assemble(
    correction: Correction, faults: Sequence[Fault], model: Model, heldout: Sequence[Run], *, units: Units, seed: int,
    elapsed: float,
) -> Diagnosis:  # fmt: skip
    """The diagnosis, of a model that has the network among its own effects where one stands in.

    `units`: of the signals in the files, in which it is said where the mismatch is.
    """
    decision = correction.decision
    ranking, chosen, rows, said = decision.ranking, decision.chosen, decision.rows, statement(decision, faults)
    model = correction.network.model if correction.network else model
    problem, nominal = ranking.problem.in_free_run(), ranking.nominal_fit
    named = decision.verdict == "missing-physics"
    stated, samples = decision.account.stated, _independent_samples(decision)
    sure = {e.name: e.probability for e in stated}
    physics = found_effects(ranking, chosen, sure, decision.left, samples=samples) if named else ()
    effects = (*said.faults, *physics, *((said.coarse,) if said.coarse else ()))
    alternatives = _alternatives(ranking, chosen)
    equation = effects[0].equation if effects else ""
    winding = decision.shaft is not None and decision.shaft.moves_as_recorded
    inputs = [replace(u, lacking="voltage" if winding else "torque") for u in _unknown_inputs(nominal, problem)]
    # a transfer function has none, and what the winding lacks is no torque
    torque_unknown = said.verdict != "adequate" and not model.drive.coefficients and not winding
    depends = laws(problem, nominal, inputs, linear=model.linear) if torque_unknown else ()
    known = correction.by_free_run.fit if correction.by_free_run else correction.final
    filters = fitted_filters(chosen.final, decision.left, ranking.problem.filters, samples=samples)
    shown = correction.by_free_run or chosen
    drawn = figures.plots(
        ranking, shown, correction.final, heldout, inputs, depends, correction.network, linear=model.linear
    )
    return Diagnosis(
        verdict=said.verdict,
        equation=equation,
        effects=effects,
        set=said.names,
        beneath=Beneath(verdict=said.beneath.verdict, set=said.beneath.names) if said.beneath else None,
        explanation=_explanation(decision),
        alternatives=alternatives,
        location=_location(equation, inputs, depends, model, shaft=decision.shaft, units=units),
        nominal_fit=nominal_fit(ranking, chosen, decision.left, model, samples=samples),
        heldout=rows,
        curves=drawn,
        sensor_filters=filters,
        warnings=(
            *_contradictions(chosen, model), *_refuted(decision.account),
            *_warnings(ranking, chosen, rows, filters), *correction.warnings,
        ),
        next_experiment=_next_experiment(decision, said, alternatives, named=named),
        adequate_probability=ranking.nothing_missing.probability,
        account=decision.account.effects,
        not_tried=ranking.not_tried,
        remainder=decision.remainder,
        seed=seed,
        version=__version__,
        elapsed=elapsed,
        stand_in=correction.stands_in,
        added=tuple(name for name in correction.final.added if name in correction.model.effects),
        corrected=with_uncertainty(correction.model, estimates(known, decision.left, samples=samples)),
    )


def _location(
    equation: str, inputs: Sequence[UnknownInputs], depends: Sequence[Law], model: Model, *, shaft: ShaftAlone | None,
    units: Units,
) -> Location:  # fmt: skip
    """Where the mismatch is, in the units of the files."""
    where = regions_in_file_units(regions(inputs, linear=model.linear), units, linear=model.linear)
    motion = not model.drive.coefficients
    place, briefly = (
        in_words(where, depends, linear=model.linear, motion=motion, shaft=shaft)
        for in_words in (located, located_briefly)
    )
    return Location(equation=equation, regions=where, description=place, briefly=briefly)


def _independent_samples(decision: Decision) -> float:
    """For how many the recordings count in the values of what is stated: by misfit, and as parts of them agree."""
    return decision.left.effective_with_misfit / decision.account.birge**2


def _unknown_inputs(this: Fit, problem: Problem) -> list[UnknownInputs]:
    """What the equations of a fit leave over along each recording."""
    return [
        unknown_inputs(problem.drive, problem.simulator, r, problem.started(r, this.vector, this.active), this.active)
        for r in problem.runs
    ]


def _explanation(decision: Decision) -> Alternative | None:
    """What is stated, weighed as its alternatives are; None where that is nothing at all."""
    if decision.verdict not in ("missing-physics", "adequate"):
        return None
    return Alternative(effects=decision.chosen.added, probability=decision.chosen.probability)


def _alternatives(ranking: Ranking, chosen: RankedFit) -> tuple[Alternative, ...]:
    """The next explanations, each with the experiment that would tell it from the chosen one."""
    return tuple(
        Alternative(
            effects=r.added, probability=r.probability, separated_by=separated_by((*chosen.added, *r.added))
        )
        for r in ranking.fits[:6]
        if r is not chosen and r.added and r.probability > 1e-3
    )


def _next_experiment(
    decision: Decision, said: Statement, alternatives: Sequence[Alternative], *, named: bool
) -> str:
    """What would tell the rivals apart, of the faults first; else what is stated from the next explanations."""
    drive = said.beneath or said
    problem, shaft = decision.ranking.problem, decision.shaft
    if drive.verdict == "insufficient-excitation":
        wanted = excitation.advice(problem.whole)
        torque = withstood(problem.whole, problem.drive, problem.prior.motor)
        if torque and not excitation.moves(problem.whole):
            unit = "N" if problem.drive.linear else "N m"
            wanted = f"Nothing moved under up to {quantity(torque, unit)}: friction or a brake holds it. {wanted}"
    elif shaft is not None and not shaft.moves_as_recorded:
        wanted = f"Look at the shaft first: {shaft_in_words(shaft)}."
    elif drive.verdict == "unexplained" and shaft is None and all(r.current.size for r in problem.whole):
        wanted = problem.drive.halves(problem.prior.motor)
    else:
        wanted = separated_by(drive.names) if len(drive.names) > 1 else ""
    wanted = wanted or from_near(alternatives, named=named)
    first = separated_by(said.names) if said.beneath and len(said.names) > 1 else ""
    return "; ".join(filter(None, (first, wanted)))


def from_near(alternatives: Sequence[Alternative], *, named: bool) -> str:
    """What would tell what is stated from the explanations that are nearly as likely."""
    near = (other.separated_by for other in alternatives if named and other.probability >= NEAR)
    return "; ".join(dict.fromkeys(filter(None, near)))


def _does_not_run(ranking: Ranking) -> list[str]:
    """What keeps the model as given from being simulated at all."""
    problem = ranking.problem.in_free_run()
    given = problem.as_given()
    runs = [problem.simulate(r, given.vector, given.active).status for r in problem.runs]
    failed = dict.fromkeys(status for status in runs if status != "ok")
    return [f"the model as given does not run ({status}): {_core.simulation_advice(status)}" for status in failed]


def _warnings(
    ranking: Ranking, chosen: RankedFit, rows: Sequence[HeldoutRow], filters: Sequence[FittedFilter]
) -> tuple[str, ...]:
    texts = _does_not_run(ranking)
    if chosen.added and rows and all(LEFT_OUT in r.recording for r in rows):
        texts.append(
            "no held-out recording was given: the proof is by cross-validation, each part simulated by fits without it"
        )
    explained = {f.signal for f in filters}  # a filter that is fitted colours the noise that went through it
    for signal, noise in ranking.weighted.noise.items():
        if signal == "position" and noise.reflection:
            texts.append("the position drifts in free run: parameters are fitted to the steps of its error, not to it")
        elif signal not in explained and noise.reflection and abs(noise.reflection[0]) > FASTEST:
            texts.append(
                f"what is left of the {signal} lasts (its correlation from sample to sample is "
                f"{noise.reflection[0]:.2f}): the corrected model was fitted to what is new in it"
            )
    if chosen.added and chosen.final.minimum.status is FitStatus.ITERATION_LIMIT:
        texts.append(
            "the fit of what is stated ended before it converged: its intervals may be too narrow; --effort 3 lets it "
            "go on where what the search may cost has ended it"
        )
    texts += [not_tried_in_words(them) for them in ranking.not_tried]
    for f in ranking.at_a_limit[:1]:
        met = [parameter_in_words(name) for name in f.limits_met]
        texts.append(
            f"{' + '.join(map(plain_name, f.added))} fits better, but {listing(met)} ended at a "
            "limit of its range, where the law stands in for another one: it is not named"
        )
    return tuple(texts)


def _refuted(found: Account) -> Iterator[str]:
    """What would be likelier, had a half of the drive by itself not told otherwise."""
    for effect in found.effects:
        name = plain_name(effect.name)
        if effect.against == "shaft":
            yield (
                f"driven by the recorded current, the shaft alone moves as it did without {name}, and not as with it: "
                "the winding or what feeds it lacks something instead"
            )
        elif effect.against:
            yield (
                f"along the recorded motion, the winding alone carries its current as without {name}, and not as "
                "with it: the shaft or its load lacks something instead"
            )


def _contradictions(chosen: RankedFit, model: Model) -> Iterator[str]:
    """What an explanation moves beyond what the data sheet leaves room for."""
    for u, value in zip(chosen.final.hypothesis.unknowns, chosen.final.minimum.values, strict=True):
        declared = model.uncertainty.get(u.name, 0.0)
        if u.prior is not None and u.prior > 0.0 and 0.0 < declared < np.inf:
            off = abs(np.log(value / u.prior)) / declared if value > 0.0 else np.inf
            if off > BELIEVABLE:
                said = f"data sheet and recordings contradict each other in {parameter_in_words(u.name)}"
                far = f", {off:.1f} declared deviations" if np.isfinite(off) else ""
                yield f"{said}: it moved to {times_given(value / u.prior, declared=declared)}{far}"
