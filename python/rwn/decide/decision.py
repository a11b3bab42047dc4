"""What a diagnosis comes to: the account of what acts, the explanation that it states, its proof and the verdict."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import isfinite

from rwn.decide.account import Account, Remainder, account, remainder
from rwn.decide.excitation import moves
from rwn.decide.other_law import curve_beside
from rwn.decide.shaft_alone import ShaftAlone, shaft_alone
from rwn.decide.verdict import Verdict, verdict_of
from rwn.fit.budget import one_stage
from rwn.fit.driving_force import DrivingForceProblem
from rwn.fit.fit import Fit, fit, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.intervals import estimates
from rwn.fit.problem import Problem
from rwn.fit.residual_noise import without_drift
from rwn.fit.residuals import Statistics, statistics
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit, weighed_beside
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import proved
from rwn.simulate.run import Run
from rwn.unnamed_law.places import Place


@dataclass(frozen=True, kw_only=True)
class Decision:
    """The stated explanation with its verdict and proof."""

    ranking: Ranking
    account: Account
    chosen: RankedFit  # the effects that are stated together, or the nominal model
    remainder: Remainder  # what is said of what it leaves
    verdict: Verdict
    rows: tuple[HeldoutRow, ...]
    other: Place | None = None  # where a law without a name is seen in what is left
    shaft: ShaftAlone | None = None  # what is left with and without the winding, where nothing explains it
    heldout: tuple[Run, ...] = ()  # recordings that were kept back

    @cached_property
    def left(self) -> Statistics:
        """What the chosen effects leave, with the error of recordings kept back where misfit shows more in these.

        Intervals go by it: values bend so that the recordings they are fitted to show little of what is missing.
        """
        problem, final = self.ranking.weighted, self.chosen.final
        fitted = statistics(problem, final)
        unseen = statistics(problem.on(self.heldout), final, drift=False) if self.heldout else fitted
        if unseen.misfit <= fitted.misfit or not isfinite(unseen.variance):  # one that ran away has no size
            return fitted
        return replace(fitted, variance=max(unseen.variance, fitted.variance), structured=unseen.structured)


def decide(ranking: Ranking, heldout: Sequence[Run], model: Model, *, seed: int) -> Decision:
    """What is stated, proved on `heldout` or by cross-validation."""
    ranking, found, chosen = _stated(ranking, account(ranking, heldout, model))
    if not moves(ranking.problem.whole):  # whatever holds a shaft does it alike
        found, chosen = replace(found, effects=()), found.leading
    rows = proved(ranking, chosen, heldout, seed=seed)
    left = remainder(ranking, chosen.final)
    verdict = verdict_of(ranking, found, left)
    curve = curve_beside(ranking.problem, chosen.fit, model) if left.signals else None
    other = curve.place if curve is not None and curve.is_a_law else None
    return Decision(
        ranking=ranking, account=found, chosen=chosen, remainder=left, verdict=verdict, rows=rows, other=other,
        shaft=shaft_alone(chosen.final, ranking.problem, model) if verdict == "unexplained" else None,
        heldout=tuple(heldout),
    )  # fmt: skip


def _stated(ranking: Ranking, found: Account) -> tuple[Ranking, Account, RankedFit]:
    """The effects that are stated, fitted without the others; with the ranking and the account that go with them.

    A law whose shape runs into a limit without the others bends towards another law: it is taken out of the account,
    and its fit is kept among those of the ranking that are at a limit. An effect whose strength may as well be zero
    (95 %), beside those that are stated and in the leading explanation too, is not stated, the one that removes least
    first.
    """
    while True:
        chosen = together(ranking, found.leading, {e.name for e in found.stated})
        if bent := {name.split(".")[0] for name in chosen.fit.limits_met}:
            ranking = replace(ranking, at_a_limit=(chosen.fit, *ranking.at_a_limit))
            found = found.without(bent)
        elif absent := _maybe_absent(ranking, found, chosen):
            found = found.undetermined(absent[-1])
        else:
            return ranking, found, chosen


def _free_of_drift(ranking: Ranking, found: Account, chosen: RankedFit) -> tuple[Fit, Statistics]:
    """An explanation as it is known best, and what the leading one leaves.

    Where a position drifts, it is fitted to its steps, and what is left is its own.
    """
    weighted = weighted_free_of_drift(ranking, found.leading)
    if weighted is None:
        return chosen.final, ranking.counted
    final = refit(chosen.final, weighted, share=one_stage(weighted.work))
    return final, statistics(weighted, final)


def weighted_free_of_drift(ranking: Ranking, leading: RankedFit) -> Problem | None:
    """The problem that compares a position by its steps; None where the leading explanation lets none drift."""
    problem = ranking.weighted
    if isinstance(problem, DrivingForceProblem) or problem.drive.coefficients:
        return None
    return without_drift(problem, leading.final)


def _maybe_absent(ranking: Ranking, found: Account, chosen: RankedFit) -> list[str]:
    """The stated effects that may be absent, by the explanation that is stated and by the leading one.

    Without the effects that are not stated a fit may end anywhere; with them, what is alike is not told apart.
    """
    stated = [e.name for e in found.stated]
    absent = _holding_zero(ranking, found, chosen, stated)
    return _holding_zero(ranking, found, found.leading, absent) if absent else []


def _holding_zero(ranking: Ranking, found: Account, chosen: RankedFit, names: Sequence[str]) -> list[str]:
    """The effects of which the intervals of all strengths hold the zero at which an effect is absent.

    By noise and by how far fits to the halves disagree: what is left besides takes no name away.
    """
    final, left = _free_of_drift(ranking, found, chosen)
    # halves that followed a drift lie as far apart as that took them
    birge = found.birge if final is chosen.final else 1.0
    numbers, known = estimates(final, left, samples=left.effective / birge**2), final.hypothesis.table
    absent = []
    for name in names:
        strengths = (f"{name}.{p.name}" for p in known[name].parameters if p.strength)
        intervals = [numbers[s].interval for s in strengths if s in numbers]
        if intervals and all(i is not None and i[0] <= 0.0 <= i[1] for i in intervals):
            absent.append(name)
    return absent


def together(ranking: Ranking, leading: RankedFit, names: Collection[str]) -> RankedFit:
    """The explanation by some effects of the leading one alone: as it was ranked, or fitted from where that ended."""
    known = next((r for r in ranking.fits if set(r.added) == set(names)), None)
    if known is not None:
        return known
    return weighed_beside(_without_the_rest(ranking, leading.fit, names), leading, ranking.counted)


def _without_the_rest(ranking: Ranking, this: Fit, names: Collection[str]) -> Fit:
    problem = ranking.problem
    kept = tuple(n for n in this.added if n in names)
    starts = this.starts(kept)
    return fit(problem, hypothesis(problem.prior, kept, problem.scales, starts, this.motor))
