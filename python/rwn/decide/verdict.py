"""The verdict: what acts, nothing missing, something without a name, or nothing to be learned from these recordings."""

from __future__ import annotations

from typing import Literal

import numpy as np

from rwn.decide import excitation
from rwn.decide.account import Account, Remainder
from rwn.fit.intervals import deviations
from rwn.fit.residuals import MOST_SAMPLES
from rwn.name.ranking import Ranking

Verdict = Literal[
    "missing-physics", "adequate", "unexplained", "insufficient-excitation", "recording-mistake"
]

# squared error above the noise, in units of it, from which structure in what is left is of any size: what chance makes
# of as many independent samples as a residual that is noise alone counts for
MATERIAL = float(np.sqrt(2.0 / MOST_SAMPLES))


def verdict_of(ranking: Ranking, found: Account, left: Remainder) -> Verdict:
    """`left`: what the refitted nominal model leaves, where nothing is stated."""
    if found.stated:
        return "missing-physics"
    if left.signals and left.error > 1.0 + MATERIAL:
        return "unexplained"
    held = not excitation.moves(ranking.problem.whole)
    return "insufficient-excitation" if held or _nothing_learned(ranking) else "adequate"


def _nothing_learned(ranking: Ranking) -> bool:
    this = ranking.nominal_fit
    return excitation.learns_nothing(this.hypothesis, deviations(this, ranking.before), this.minimum.values)
