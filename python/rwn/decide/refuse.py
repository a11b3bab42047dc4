"""Names that help on the fitted recordings and not on those that were kept back are taken off again."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from rwn.name.weights import RankedFit
from rwn.prove.heldout import HeldoutRow

Prove = Callable[[RankedFit], Sequence[HeldoutRow]]

NOT_TOLD_APART = 3.0  # ratio of probabilities
AS_GOOD = 1.1  # ratio of held-out squared errors within which the fitted recordings, or fewer effects, decide
PROVED = 0.4  # share of the held-out squared error that a name has to remove certainly where more than noise is left


def without_what_hurts(fits: Sequence[RankedFit], chosen: RankedFit, prove: Prove) -> RankedFit:
    """`chosen`, or its equal on the fitted recordings, or a part of these: what predicts held-out recordings best.

    An effect that is real helps on every recording; one that has absorbed an accident of the fitted ones need not.
    """
    first, error = _best(_contenders(fits, chosen), prove)
    parts = [h for h in fits if h.added and set(h.added) < set(first.added)]
    if not parts:
        return first
    part, part_error = _best(sorted(parts, key=lambda h: len(h.added)), prove)
    return part if part_error < error else first


def _best(rivals: Sequence[RankedFit], prove: Prove) -> tuple[RankedFit, float]:
    """The first that predicts held-out recordings as well as any, and its error."""
    errors = [heldout_error(prove(h)) for h in rivals]
    least = next(k for k, error in enumerate(errors) if error <= AS_GOOD * min(errors))
    return rivals[least], errors[least]


def _contenders(fits: Sequence[RankedFit], chosen: RankedFit) -> list[RankedFit]:
    """The chosen explanation and those as large that the fitted recordings do not tell from it."""
    return [
        chosen,
        *(
            h
            for h in fits
            if h is not chosen
            and len(h.added) == len(chosen.added)
            and h.probability > chosen.probability / NOT_TOLD_APART
        ),
    ]


def heldout_error(rows: Sequence[HeldoutRow]) -> float:
    """Squared error of the corrected against the refitted model, mean of signals; inf where it ran away.

    Where an axis shows its position alone, which drifts for small reasons, the driving force counts as a signal too.
    """
    drifts = not any(r.signal == "speed" for r in rows)
    shares = [
        (r.corrected / r.refitted) ** 2
        for r in rows
        if r.region == "all" and r.corrected is not None and r.refitted > 0.0 and (drifts or r.unit != "%")
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
