"""Names that help on the fitted recordings and not on those that were kept back are taken off again."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from rwn.diagnosis import HeldoutRow
from rwn.evidence import Hypothesis

Prove = Callable[[Hypothesis], Sequence[HeldoutRow]]

PROVED = 0.5  # share of the held-out squared error that a name has to remove certainly where more than noise is left


def without_what_hurts(hypotheses: Sequence[Hypothesis], chosen: Hypothesis, prove: Prove) -> Hypothesis:
    """The part of `chosen` that predicts held-out recordings best; `chosen` itself where every part of it helps there.

    An effect that is real helps on every recording; one that has absorbed an accident of the fitted ones need not.
    """
    parts = [h for h in hypotheses if h.fitted.added and set(h.fitted.added) < set(chosen.fitted.added)]
    if not parts:
        return chosen
    best = min(parts, key=lambda h: heldout_error(prove(h)))
    return best if heldout_error(prove(best)) < heldout_error(prove(chosen)) else chosen


def heldout_error(rows: Sequence[HeldoutRow]) -> float:
    """Squared error of the corrected against the refitted free run, mean of signals; inf where it ran away."""
    shares = [
        (r.corrected / r.refitted) ** 2
        for r in rows
        if r.region == "all" and r.corrected is not None and r.unit != "%" and r.refitted > 0.0
    ]
    return float(np.mean(shares)) if shares and np.isfinite(shares).all() else np.inf


def removed_certainly(rows: Sequence[HeldoutRow]) -> float:
    """Share of the held-out squared error that is removed at the low end of the interval, mean of signals."""
    lows = [
        r.gain_interval[0] if r.gain_interval is not None else -1.0
        for r in rows
        if r.region == "all" and r.unit != "%" and r.corrected is not None
    ]
    if not lows or not np.isfinite(lows).all() or min(lows) <= 0.0:
        return 0.0
    return float(np.mean([1.0 - (1.0 - low) ** 2 for low in lows]))
