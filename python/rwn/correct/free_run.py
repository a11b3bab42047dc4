"""A correction whose names were found by the driving force, fitted to what it is for: the free run.

The force that a motion took tells what acts. A simulation adds up over minutes what the force tells within its noise,
so it asks more of the same parameters, and tells apart laws of friction that the force does not. Its error as a
function of them is not smooth (a contact met a little earlier changes all that follows): it is fitted from several
starts, by secants first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from rwn.decide.decision import Decision
from rwn.fit.driving_force import DrivingForceProblem
from rwn.fit.fit import Fit, fit, refit
from rwn.fit.hypothesis import Hypothesis, hypothesis
from rwn.fit.prior_weight import variance_inflation
from rwn.fit.problem import Problem
from rwn.fit.secant import down_secants
from rwn.name.initial_guesses.guesses import initial_guesses
from rwn.name.weights import RankedFit
from rwn.prove.heldout import HeldoutRow, log_change
from rwn.prove.proof import LEFT_OUT, Proof, compared
from rwn.recording.signals import DRIVING_FORCE
from rwn.simulate.run import Run

TURNS = 2  # of secants
PARTS = 4  # of a lone recording; its first and its last are predicted from the others


def by_free_run(decision: Decision, chosen: RankedFit, *, seed: int) -> Proof | None:
    """What was found by the driving force, or what that does not tell from it, fitted to the free run.

    Its `fit` is that of the driving force, its `final` that of the free run; the rows are on parts of the recordings,
    each predicted by a fit that did not see it. The one that predicts best what was not fitted; None where that is the
    driving force's own fit, or where the force is explained no better by it than by the refitted nominal model.
    """
    problem = decision.ranking.weighted
    if not (isinstance(problem, DrivingForceProblem) and chosen.added):
        return None
    known = _predicted(decision, chosen, by_motion=False, seed=seed)
    found = [(r, _predicted(decision, r, by_motion=True, seed=seed)) for r in _indistinguishable(decision, chosen)]
    best, rows = min(found, key=lambda pair: _log_ratio(pair[1]))
    force = [r for r in rows if r.signal == DRIVING_FORCE]
    if _log_ratio(rows) >= _log_ratio(known) or (force and log_change(force) >= 0.0):
        return None
    final = fitted_to_motion(problem.in_free_run(), problem.whole, best.final, _leading_effect(decision, best))
    return Proof(replace(best, final=final), rows)


def fitted_to_motion(problem: Problem, runs: Sequence[Run], this: Fit, name: str) -> Fit:
    """An explanation fitted to the free run of recordings, from the start that leads furthest.

    It begins where `this` ended, and with the effect `name` at its first guesses. Priors, those of the runs' starts
    with them, weigh against errors that last.
    """
    problem = replace(problem.on(runs), inflation=1.0)
    starts = list(_starts(problem, this, name))
    plain = min((fit(problem, start) for start in starts), key=lambda f: f.cost)
    problem = replace(problem, inflation=variance_inflation(problem, plain))
    ends = [refit(down_secants(problem, fit(problem, start), turns=TURNS), problem) for start in starts]
    return min(ends, key=lambda f: f.cost)


def _indistinguishable(decision: Decision, chosen: RankedFit) -> list[RankedFit]:
    """The explanation, and those with a rival of its leading effect in the place of it."""
    leading = next((e for e in decision.account.stated if e.name in chosen.added), None)
    if leading is None:
        return [chosen]
    rest = set(chosen.added) - {leading.name}
    rivals = [rest | {rival} for rival in leading.rivals]
    return [chosen, *(r for r in decision.ranking.fits if set(r.added) in rivals)]


def _leading_effect(decision: Decision, this: RankedFit) -> str:
    """The effect of an explanation that is its leading one, or in the place of that."""
    names = [n for e in decision.account.stated for n in (e.name, *e.rivals)]
    return next((n for n in names if n in this.added), this.added[0])


def _predicted(decision: Decision, this: RankedFit, *, by_motion: bool, seed: int) -> tuple[HeldoutRow, ...]:
    """Rows on parts of the recordings, each predicted by a fit of the rest."""
    ranking, problem = decision.ranking, decision.ranking.weighted
    rows: list[HeldoutRow] = []
    for known, unseen in _splits(problem.whole):
        part = problem.on(known)
        fitted = refit(this.final, part)
        if by_motion:
            fitted = fitted_to_motion(problem.in_free_run(), known, fitted, _leading_effect(decision, this))
        rows += compared(ranking, refit(ranking.nominal_fit, part), fitted, [unseen], seed=seed)
    return tuple(rows)


def _log_ratio(rows: Sequence[HeldoutRow]) -> float:
    """Mean logarithm of the free-running errors over those of the refitted nominal model."""
    found = log_change([r for r in rows if r.signal != DRIVING_FORCE])
    return found if np.isfinite(found) else np.inf


def _starts(problem: Problem, this: Fit, name: str) -> Iterator[Hypothesis]:
    yield this.hypothesis.starting_at(this.minimum.values)
    rest = tuple(n for n in this.added if n != name)
    known = this.starts(rest)
    base = fit(problem, hypothesis(problem.prior, rest, problem.scales, known, this.motor))
    for guess in initial_guesses(problem, base, problem.prior.table[name], count=1):
        yield hypothesis(problem.prior, this.added, problem.scales, {**known, name: guess}, this.motor)


def _splits(whole: Sequence[Run]) -> Iterator[tuple[tuple[Run, ...], Run]]:
    """What is fitted, and what is predicted: each recording from the others; either end of a lone one from the rest."""
    if len(whole) > 1:
        for k, run in enumerate(whole):
            yield tuple(r for j, r in enumerate(whole) if j != k), replace(run, name=f"{run.name} {LEFT_OUT}")
        return
    (run,) = whole
    part, rows = run.time.size // PARTS, run.time.size
    for place, known, unseen in (
        ("last", run.until(rows - part), run.since(rows - part)),
        ("first", run.since(part), run.until(part)),
    ):
        yield (known,), replace(unseen, name=f"{place} quarter of {run.name} {LEFT_OUT}")
