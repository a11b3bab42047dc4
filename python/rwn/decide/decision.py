"""What a diagnosis comes to: the chosen explanation with its proof and verdict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rwn.decide.other_law import other_law
from rwn.decide.refuse import without_what_hurts
from rwn.decide.verdict import Verdict, choose, is_certain, refused, verdict_of, verdict_without_a_name
from rwn.fit.network_formula import Place
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.prove.heldout import HeldoutRow
from rwn.prove.proof import proved
from rwn.simulate.run import Run


@dataclass(frozen=True, kw_only=True)
class Decision:
    """An explanation with its verdict and proof."""

    ranking: Ranking
    chosen: RankedFit  # what is named, or the nominal model
    verdict: Verdict
    rows: tuple[HeldoutRow, ...]
    leading: Decision | None = None  # the explanation that led, where it is not named
    other: Place | None = None  # where another law is seen in what the name leaves


def decide(ranking: Ranking, heldout: Sequence[Run], model: Model, *, seed: int) -> Decision:
    """The explanation that is named, or none; proved on `heldout`, or by cross-validation."""

    def prove(r: RankedFit) -> tuple[HeldoutRow, ...]:
        return proved(ranking, r, heldout, seed=seed)

    chosen = choose(ranking)
    if heldout:
        chosen = without_what_hurts(ranking.fits, chosen, prove)
    rows = prove(chosen)
    verdict = verdict_of(ranking, chosen, certain=is_certain(rows))
    leading = end = Decision(ranking=ranking, chosen=chosen, verdict=verdict, rows=rows)
    if chosen.added and (verdict != "missing-physics" or refused(ranking, chosen, rows)):
        # a name that is not given is not shown or proved; it may still stand in for what has no name
        nothing = ranking.nothing_missing
        without = verdict if verdict == "unexplained" else verdict_without_a_name(ranking)
        end = Decision(ranking=ranking, chosen=nothing, verdict=without, rows=prove(nothing))
    if end.verdict == "missing-physics":
        return replace(end, other=other_law(ranking, chosen, model))
    return replace(end, leading=leading)
