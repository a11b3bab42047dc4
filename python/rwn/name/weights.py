"""How strongly recordings speak for one explanation against another when their residuals are coloured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rwn.fit.fit import Fit
from rwn.fit.residuals import EXACT_TO, Statistics

LOST = 1e12  # log of evidence against a fit whose simulation ran away: what no recording outweighs, and still a number


@dataclass(frozen=True, kw_only=True)
class RankedFit:
    """A fit with its probability among those that were tried."""

    fit: Fit
    final: Fit  # what is drawn and saved: `fit`, or the same refitted under coloured noise
    score: float  # log of evidence, up to a constant
    probability: float

    @property
    def added(self) -> tuple[str, ...]:
        """Effects beside those of the nominal model."""
        return self.fit.added


def log_odds(this: Fit, other: Fit, left: Statistics) -> float:
    """Log evidence for a fit against one by the same effects; `left`: by the first."""
    ranked = weigh([this, other], left, rivals=1)
    score = {id(r.fit): r.score for r in ranked}
    return score[id(this)] - score[id(other)]


def weighed_beside(this: Fit, best: RankedFit, left: Statistics) -> RankedFit:
    """A fit that was not ranked, by the same evidence as one that was and that it takes effects from.

    `left`: what all are counted by. A fit by fewer effects is no likelier than the one that was preferred to it.
    """
    lost = log_odds(best.final, this, left)
    probability = best.probability * float(np.exp(min(-lost, 0.0)))
    return RankedFit(fit=this, final=this, score=best.score - lost, probability=probability)


def weigh(
    fits: Sequence[Fit], left: Statistics, *, rivals: int, prior: Mapping[str, float] | None = None,
    finals: Sequence[Fit] | None = None,
) -> list[RankedFit]:  # fmt: skip
    """Probabilities of the fits, best first.

    BIC with the effective number of samples of the best explanation's residual (coloured residuals carry less), a
    uniform prior over how many effects are missing, shared over the `rivals` names. A simulation is exact to `EXACT_TO`
    of its squared error: fits that differ by less are alike, and what lies above it counts. `prior`: log prior
    odds per name. `finals`: what the fits became under coloured noise, to be weighed in their place.
    """
    finals = fits if finals is None else finals
    effective = left.effective_with_misfit
    squares = max(left.variance, np.finfo(float).tiny) * left.count
    scale, inexact = 2.0 * squares / max(effective, 2.0), EXACT_TO * squares
    least = min((f.cost for f in finals if np.isfinite(f.cost)), default=0.0)
    base = min(f.unknowns_seen for f in finals)
    scores = []
    for f in finals:
        unknowns = f.unknowns_seen - base
        names = sum((prior or {}).get(name, 0.0) for name in f.added)
        scores.append(
            -(min(max(f.cost - least - inexact, 0.0) / scale, LOST) if np.isfinite(f.cost) else LOST)
            - 0.5 * unknowns * np.log(max(effective, 2.0))
            - len(f.added) * np.log(rivals)
            + names
        )
    weights = np.exp(np.array(scores) - max(scores))
    weights /= weights.sum()
    rows = [
        RankedFit(fit=f, final=g, score=float(s), probability=float(p))
        for f, g, s, p in zip(fits, finals, scores, weights, strict=True)
    ]
    return sorted(rows, key=lambda r: -r.score)
