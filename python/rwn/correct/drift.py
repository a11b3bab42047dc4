"""Parameters that a drifting position does not bend.

A position in free run adds up every small torque that is missing, also one that nothing here names: plain least squares
moves friction and inertia until they follow its drift, which is not theirs, and predicts another recording worse. What
acts is decided before; the parameters are then those of fits to what is new in the position's error.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn.decide.decision import Decision, weighted_free_of_drift
from rwn.fit.budget import equal_shares
from rwn.fit.fit import Fit, refit
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.name.weights import RankedFit
from rwn.parallel import side_by_side
from rwn.prove.proof import proved
from rwn.simulate.run import Run


def free_of_drift(decision: Decision, heldout: Sequence[Run], *, seed: int) -> Decision:
    """The decision with parameters that follow no drift, where its position drifts and they do not predict worse."""
    ranking, leading = decision.ranking, decision.account.leading
    weighted = weighted_free_of_drift(ranking, leading)
    if weighted is None:
        return decision
    rows = list({id(r): r for r in (*ranking.fits, decision.chosen, leading)}.values())
    shares = equal_shares(weighted.work, len(rows))
    finals = side_by_side(lambda pair: refit(pair[0].final, weighted, share=pair[1]), zip(rows, shares, strict=True))
    again = {id(r): replace(r, final=final) for r, final in zip(rows, finals, strict=True)}

    def moved(this: RankedFit) -> RankedFit:
        return again[id(this)]

    chosen = moved(decision.chosen)
    if _log_change(weighted, heldout, decision.chosen.final, chosen.final) > 0.0:
        return decision
    ranking = replace(
        ranking, nominal_fit=moved(ranking.nothing_missing).final, fits=tuple(map(moved, ranking.fits)),
        weighted=weighted, counted=statistics(weighted, moved(leading).final),
    )  # fmt: skip
    account = replace(decision.account, leading=moved(leading))
    found = proved(ranking, chosen, heldout, seed=seed)
    return replace(decision, ranking=ranking, chosen=chosen, account=account, rows=found)


def _log_change(problem: Problem, runs: Sequence[Run], before: Fit, after: Fit) -> float:
    """Mean logarithm of the free-run errors of one fit over those of another, on runs that neither saw; 0 of none."""
    judge, errors = problem.on(runs), []
    for this in (before, after):
        left = judge.residuals(this.vector, this.active) if runs else []
        errors.append([float(np.sqrt(np.mean(np.square(x)))) for of in left for x in of.values()])
    pairs = [(a, b) for a, b in zip(*errors, strict=True) if a > 0.0 and b > 0.0]
    return float(np.mean([np.log(b / a) for a, b in pairs])) if pairs else 0.0
