"""What a diagnosis comes to: the account of what acts, the explanation that it states, its proof and the verdict."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations

import numpy as np

from rwn.decide.account import Account, Remainder, account, remainder
from rwn.decide.other_law import curve_beside
from rwn.decide.verdict import Verdict, verdict_of
from rwn.fit.fit import Fit, fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.network_places import Place
from rwn.model.model import Model
from rwn.name.forward import FAR_OFF
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.prove.heldout import HeldoutRow, hurts, log_change
from rwn.prove.proof import compared, proved
from rwn.simulate.run import Run


@dataclass(frozen=True, kw_only=True)
class Decision:
    """The stated explanation with its verdict and proof."""

    ranking: Ranking
    account: Account
    chosen: RankedFit  # the effects that are stated together, or the nominal model
    remainder: Remainder  # what it leaves
    verdict: Verdict
    rows: tuple[HeldoutRow, ...]
    other: Place | None = None  # where a law without a name is seen in what is left

    @property
    def is_poor(self) -> bool:
        """Whether nothing explains the recordings, or what is stated does not follow the motion."""
        return self.verdict == "unexplained" or self.remainder.error > FAR_OFF


def decide(ranking: Ranking, heldout: Sequence[Run], model: Model, *, seed: int) -> Decision:
    """What is stated, proved on `heldout` or by cross-validation.

    An effect that certainly makes recordings worse that were kept back is not stated.
    """
    found = account(ranking, heldout, model)
    chosen = _together(ranking, found)
    while refused := _refused(ranking, chosen, found, heldout, seed=seed):
        found, chosen = refused
    rows = proved(ranking, chosen, heldout, seed=seed)
    left = remainder(ranking, chosen.final)
    verdict = verdict_of(ranking, found, left)
    curve = curve_beside(ranking.problem, chosen.fit, model) if left.signals else None
    other = curve.place if curve is not None and curve.is_a_law else None
    return Decision(
        ranking=ranking, account=found, chosen=chosen, remainder=left, verdict=verdict, rows=rows, other=other
    )


def _refused(
    ranking: Ranking, chosen: RankedFit, found: Account, heldout: Sequence[Run], *, seed: int
) -> tuple[Account, RankedFit] | None:
    """The account and explanation without those effects that make worse what was kept back, and most so.

    Where both run away nothing is won without them.
    """
    worse = []
    for names in _parts(chosen.added) if heldout else ():
        account = found.withdrawn(names)
        less = _together(ranking, account)
        rows = compared(ranking, less.final, chosen.final, heldout, seed=seed)
        if hurts(rows) and not np.isnan(by := log_change(rows)):
            worse.append((by, account, less))
    return max(worse, key=lambda row: row[0])[1:] if worse else None


def _parts(names: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """One of the names, several, and all."""
    return chain.from_iterable(combinations(names, count) for count in range(1, len(names) + 1))


def _together(ranking: Ranking, found: Account) -> RankedFit:
    """The explanation by the stated effects alone."""
    names = {e.name for e in found.stated}
    known = next((r for r in ranking.fits if set(r.added) == names), None)
    if known is not None:
        return known
    leading = found.leading
    plain = _without_the_rest(ranking, leading.fit, names)
    return replace(leading, fit=plain, final=plain)


def _without_the_rest(ranking: Ranking, this: Fit, names: set[str]) -> Fit:
    problem = ranking.problem
    kept = tuple(n for n in this.added if n in names)
    starts = this.starts(kept)
    return fit(problem, hypothesis(problem.prior, kept, problem.scales, starts, this.motor))
