"""The correction: what is named, or what stands in for what has no name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations

import numpy as np

from rwn.correct.drift import free_of_drift
from rwn.correct.free_run import by_free_run
from rwn.correct.network import NetworkCorrection, proved_network
from rwn.decide.decision import Decision, together
from rwn.fit.fit import Fit
from rwn.fit.fitted_model import fitted_model
from rwn.model.model import Model
from rwn.name.measurement import NEXT_TO_NOTHING
from rwn.name.weights import RankedFit
from rwn.prove.heldout import disagreeing, heldout_error, helps, hurts, log_change
from rwn.prove.proof import Proof, compared, proved
from rwn.simulate.run import Run

NO_NETWORK = (
    "no wavelet network over one state helps on recordings that were not fitted: corrected.toml holds the refitted "
    "nominal model"
)
NOT_HELPING = (
    "on recordings that were not fitted the simulation is better without {names}, as fitted here: corrected.toml "
    "leaves it out"
)
DISAGREE = (
    "the recordings that were not fitted contradict each other: with what is stated {better} is simulated better and "
    "{worse} worse; where they are not of the same machine in the same state, give those that are"
)
RIVAL_HELPS = (
    "on recordings that were not fitted the simulation is better with {instead} in the place of {names}, which is not "
    "told from it: corrected.toml holds that"
)
ONE_EVENT = (
    "{names} acted for a while in the one recording that was fitted, and nothing shows that it comes again: "
    "corrected.toml, which is for any recording, holds the rest"
)
BY_FREE_RUN = (
    "what is stated was found by the driving force, with the parameters that this tells; corrected.toml holds {} "
    "fitted to the free run, which predicts better what was not fitted"
)


@dataclass(frozen=True, kw_only=True)
class Correction:
    """A decision with the model that it corrects to."""

    decision: Decision  # of the explanation or the network that the model holds
    model: Model  # what corrected.toml holds
    final: Fit  # whose values it has
    network: NetworkCorrection | None = None
    by_free_run: RankedFit | None = None  # what was found by the driving force, as `final` fitted to the free run
    stands_in: str = ""  # what stands in the model for what has no name
    warnings: tuple[str, ...] = ()


def correct(decision: Decision, heldout: Sequence[Run], model: Model, *, seed: int) -> Correction:
    """The model with what is stated; where nothing is, with a network or the leading names, what is best proved."""
    if decision.chosen.added and not decision.account.stated:  # something holds the shaft, and nothing tells what
        known = replace(fitted_model(decision.chosen.final, model), effects=model.effects)
        return Correction(decision=decision, model=known, final=decision.chosen.final)
    decision = free_of_drift(decision, heldout, seed=seed)
    if decision.verdict == "unexplained":
        found = _without_a_name(decision, heldout, model, seed=seed)
        if found:
            drawn = found.network.place if found.network else None
            return replace(found, warnings=_seen(decision) if decision.other != drawn else ())
    warnings = _seen(decision)
    if decision.verdict == "unexplained" and not model.drive.coefficients:
        warnings = (*warnings, NO_NETWORK)
    calm = _without_events(decision, heldout, model, seed=seed)
    if calm:
        return replace(calm, warnings=(*warnings, *calm.warnings))
    kept, rows = _proved_part(decision, heldout, seed=seed)
    left_out = tuple(name for name in decision.chosen.added if name not in kept.added)
    if left_out:
        instead = " + ".join(name for name in kept.added if name not in decision.chosen.added)
        said = RIVAL_HELPS if instead else NOT_HELPING
        warnings = (*warnings, said.format(names=" + ".join(left_out), instead=instead))
        better, worse = disagreeing(decision.rows)
        if better:
            warnings = (*warnings, DISAGREE.format(better=", ".join(better), worse=", ".join(worse)))
        decision = replace(decision, rows=rows)
    moved = by_free_run(decision, kept, seed=seed)
    if moved is None:
        return Correction(decision=decision, model=fitted_model(kept.final, model), final=kept.final, warnings=warnings)
    final, rows = moved.explanation.final, moved.rows
    if heldout:
        rows = compared(decision.ranking, decision.ranking.nominal_fit, final, heldout, seed=seed)
    return Correction(
        decision=replace(decision, rows=rows), model=fitted_model(final, model), final=final,
        by_free_run=moved.explanation, warnings=(*warnings, BY_FREE_RUN.format(" + ".join(final.added))),
    )  # fmt: skip


def _without_events(decision: Decision, heldout: Sequence[Run], model: Model, *, seed: int) -> Correction | None:
    """What is stated without what acted for a while, where one recording alone was fitted: it is of that run.

    None where nothing did, or where what was kept back is no better without it, or is then worse than by the refitted
    nominal model.
    """
    ranking, joint = decision.ranking, decision.chosen.final
    table, alone = ranking.problem.prior.table, len(ranking.problem.whole) == 1
    events = tuple(name for name in joint.added if table[name].instants) if alone else ()
    if not events:
        return None
    calm, rows = _silenced(joint, events), decision.rows
    if heldout:
        rows = compared(ranking, ranking.nominal_fit, calm, heldout, seed=seed)
        changes = (log_change(compared(ranking, joint, calm, heldout, seed=seed)), log_change(rows))
        if max(changes) >= 0.0:
            return None
    return Correction(
        decision=replace(decision, rows=rows), final=calm, model=_without(fitted_model(calm, model), events),
        warnings=(ONE_EVENT.format(names=" + ".join(events)),),
    )  # fmt: skip


def _silenced(this: Fit, names: Sequence[str]) -> Fit:
    """A fit with some of its effects of no strength, and all else as it ended."""
    strengths = {f"{name}.{p.name}" for name in names for p in this.hypothesis.table[name].parameters if p.strength}
    unknowns = zip(this.hypothesis.unknowns, this.minimum.values, strict=True)
    values = np.array([0.0 if u.name in strengths else v for u, v in unknowns])
    return replace(this, minimum=replace(this.minimum, values=values))


def _without(model: Model, names: Sequence[str]) -> Model:
    """A model without some effects, its parameters as they are."""
    effects = {name: values for name, values in model.effects.items() if name not in names}
    known = {name: by for name, by in model.uncertainty.items() if name.partition(".")[0] not in names}
    return replace(model, effects=effects, uncertainty=known)


def _seen(decision: Decision) -> tuple[str, ...]:
    """The law without a name that is seen in what is left, in words, where that is worth a sentence."""
    other = decision.other if decision.remainder.share >= NEXT_TO_NOTHING else None
    return (f"{other.words} explains most of what is left: it has no name here",) if other else ()


def _proved_part(decision: Decision, heldout: Sequence[Run], *, seed: int) -> Proof:
    """What is stated, or the part of it that is best on recordings that were not fitted.

    That an effect acts does not make its fitted parameters good enough to predict with, and a load that acted in one
    recording is none in another.
    """
    chosen, ranking = decision.chosen, decision.ranking

    def proof(this: RankedFit) -> Proof:
        return Proof(this, decision.rows if this is decision.chosen else proved(ranking, this, heldout, seed=seed))

    while less := _better_part(decision, chosen, heldout, seed=seed):
        chosen = less
    whole = proof(chosen)
    if not chosen.added or log_change(whole.rows) < 0.0:
        return whole
    parts = [r for r in ranking.fits if r.added and set(r.added) < set(chosen.added)]
    others = [proof(r) for r in (*parts, *(r for r in ranking.fits if _in_place(decision, chosen, r)))]
    best = min(others, key=lambda other: log_change(other.rows), default=whole)
    return best if log_change(best.rows) < 0.0 else proof(ranking.nothing_missing)


def _in_place(decision: Decision, chosen: RankedFit, other: RankedFit) -> bool:
    """Whether an explanation is the chosen one with stated effects or, in their place, rivals of these."""
    stated = [e for e in decision.account.stated if e.name in chosen.added]
    told = [sum(name in other.added for name in (e.name, *e.rivals)) for e in stated]
    return len(other.added) == len(chosen.added) == sum(told) and set(told) == {1}


def _better_part(decision: Decision, chosen: RankedFit, heldout: Sequence[Run], *, seed: int) -> RankedFit | None:
    """The part of an explanation to which its other effects do most harm on recordings kept back; None: to none.

    A comparison in which both run away says nothing.
    """
    ranking, worse = decision.ranking, []
    for names in _parts(chosen.added) if heldout else ():
        less = together(ranking, decision.account.leading, names)
        rows = compared(ranking, less.final, chosen.final, heldout, seed=seed)
        if hurts(rows) and not np.isnan(by := log_change(rows)):
            worse.append((by, less))
    return max(worse, key=lambda pair: pair[0])[1] if worse else None


def _parts(names: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """All of the names but one, but several, and none."""
    return chain.from_iterable(combinations(names, count) for count in reversed(range(len(names))))


def _without_a_name(decision: Decision, heldout: Sequence[Run], model: Model, *, seed: int) -> Correction | None:
    """A wavelet network or the leading names, whichever is better on recordings that were not fitted, if any helps."""
    found: list[tuple[float, Correction]] = []
    proof = proved_network(decision.ranking, model, heldout, seed=seed)
    if proof:
        network, rows = proof
        by_network = replace(decision, ranking=network.ranking, chosen=network.chosen, rows=rows)
        made = Correction(
            decision=by_network, model=fitted_model(network.chosen.final, network.model), final=network.chosen.final,
            network=network,
            stands_in=f"{network.place.drawn_by}, {network.place.words}",
        )  # fmt: skip
        found.append((heldout_error(rows), made))
    leading, against = decision.account.leading, {e.name for e in decision.account.effects if e.against}
    if against:  # what a half of the drive contradicts would stand in the wrong one
        leading = together(decision.ranking, leading, set(leading.added) - against)
    if leading.added:
        rows = proved(decision.ranking, leading, heldout, seed=seed)
        if helps(rows):
            names = " + ".join(leading.added)
            made = Correction(
                decision=replace(decision, chosen=leading, rows=rows), model=fitted_model(leading.final, model),
                final=leading.final,
                stands_in=f"{names}, which helps on what was not fitted and need not be what acts",
            )  # fmt: skip
            found.append((heldout_error(rows), made))
    return min(found, key=lambda pair: pair[0])[1] if found else None
