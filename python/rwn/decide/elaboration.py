"""Whether an elaborate law says more than its plain one, as friction of two levels says more than dry friction.

Such a name makes two claims: that the plain law acts, and that it is not all. The second has evidence of its own: what
the elaborate law adds to the plain one in its place. A mimic adds little, or on the samples that were fitted alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rwn.decide.calibration import ACTS, calibration
from rwn.decide.evidence import CrossValidation
from rwn.name.backward import family, plainer
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit


@dataclass(frozen=True, kw_only=True)
class NestedLawTest:
    """What comes of the test of each elaborate law of an explanation against its plain one: what adds to it stays."""

    leading: RankedFit
    validation: CrossValidation  # of it
    odds: dict[tuple[str, str], float]  # of a rival against a name of it


def elaborated(
    ranking: Ranking, leading: RankedFit, validated: Callable[[RankedFit], CrossValidation]
) -> NestedLawTest:
    """The explanation, with the next best law in the place of each elaborate one that adds nothing to its plain one."""
    validation, odds = validated(leading), dict[tuple[str, str], float]()
    for name in leading.added:
        others, idle = frozenset(leading.added) - {name}, dict[str, float]()
        (plain_name,) = plainer([name])
        plain = _explained(ranking, others, plain_name)
        while name != plain_name and plain is not None:
            adds = calibration().probability(validation.evidence(name, (), instead=plain))
            if adds > ACTS:
                odds[name, plain_name] = (1.0 - adds) / adds
                break
            idle[name] = adds
            found = [_explained(ranking, others, n) for n in sorted(family(plain_name) - {plain_name, *idle})]
            instead = max([plain, *(f for f in found if f)], key=lambda r: r.score)
            # the evidence against rivals is that of the plain claim, which the idle law made too
            leading = replace(instead, score=max(leading.score, instead.score))
            validation = validated(leading)
            (name,) = set(leading.added) - others
        of_plain = odds.get((name, plain_name), 1.0)
        odds |= {(name, n): of_plain * p / (1.0 - p) for n, p in idle.items()}
    return NestedLawTest(leading=leading, validation=validation, odds=odds)


def _explained(ranking: Ranking, others: frozenset[str], name: str) -> RankedFit | None:
    """The explanation by some effects and one more, if it was tried and did not diverge."""
    found = (r for r in ranking.fits if name not in others and set(r.added) == others | {name})
    return next((r for r in found if np.isfinite(r.score)), None)
