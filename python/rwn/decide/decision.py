"""What a diagnosis comes to: the chosen explanation with its proof and verdict, and what stands in without a name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rwn.correct.network import picture, proved_stand_in
from rwn.correct.network_formula import Place
from rwn.decide.other_law import another_law
from rwn.decide.refuse import removed_certainly, without_what_hurts
from rwn.decide.verdict import choose, is_certain, refused, verdict_of, verdict_without_a_name
from rwn.fit.problem import Target
from rwn.fit.residuals import Hypothesis
from rwn.model.model import Model
from rwn.name.forward import Explanation, Progress
from rwn.prove.proof import proved
from rwn.report.diagnosis import HeldoutRow, Plot, Verdict

NO_NETWORK = (
    "no wavelet network over one state helps on recordings that were not fitted: corrected.toml holds the refitted "
    "nominal model"
)


@dataclass(frozen=True, kw_only=True)
class Conclusion:
    """An explanation with its verdict and proof."""

    found: Explanation
    chosen: Hypothesis  # what corrected.toml holds
    verdict: Verdict
    rows: tuple[HeldoutRow, ...]
    model: Model  # with the network among its own effects where one stands in
    stand_in: str = ""
    curves: tuple[Plot, ...] = ()
    another: bool = False  # another law is seen in what the name leaves
    warnings: tuple[str, ...] = ()


def conclude(
    found: Explanation, heldout: Sequence[Target], model: Model, *, seed: int, say: Progress
) -> Conclusion:
    """The explanation that is named, or none and what stands in for it; proved on `heldout`, or by cross-validation."""

    def prove(h: Hypothesis) -> tuple[HeldoutRow, ...]:
        return proved(found, h, heldout, model, seed=seed)

    chosen = choose(found)
    if heldout:
        chosen = without_what_hurts(found.hypotheses, chosen, prove)
    rows = prove(chosen)
    verdict = verdict_of(found, chosen, certain=is_certain(rows))
    leading = end = Conclusion(found=found, chosen=chosen, verdict=verdict, rows=rows, model=model)
    if chosen.fitted.added and (verdict != "missing-physics" or refused(found, chosen, rows)):
        # a name that is not given is not shown or proved; it may still stand in for what has no name
        nothing = found.nothing_missing
        without = verdict if verdict == "unexplained" else verdict_without_a_name(found)
        end = replace(leading, chosen=nothing, verdict=without, rows=prove(nothing))
    if end.verdict == "missing-physics":
        place = another_law(found, chosen, model)
        return replace(end, another=True, warnings=(_nearest(place),)) if place else end
    if end.verdict != "unexplained":
        return end
    say("drawing what has no name", 0.9)
    return _with_stand_in(end, leading, heldout, seed=seed)


def _with_stand_in(
    end: Conclusion, leading: Conclusion, heldout: Sequence[Target], *, seed: int
) -> Conclusion:
    """`end` with a wavelet network that helps on recordings that were not fitted; without one, the name that leads."""
    network = proved_stand_in(end.found, end.model, heldout, seed=seed)
    if network:
        drawn, rows = network
        return replace(
            end, found=drawn.found, chosen=drawn.chosen, model=drawn.model, rows=rows, curves=(picture(drawn),),
            stand_in=f"a wavelet network, {drawn.place.words}",
        )  # fmt: skip
    if leading.chosen.fitted.added and is_certain(leading.rows):
        return replace(leading, verdict=end.verdict, stand_in=_in_words(leading))
    return end if end.model.kind == "lti" else replace(end, warnings=(NO_NETWORK,))


def _nearest(place: Place) -> str:
    return f"{place.words} explains most of what is left: the name may only be the nearest of those that rwn knows"


def _in_words(leading: Conclusion) -> str:
    names, part = " + ".join(leading.chosen.fitted.added), f"{removed_certainly(leading.rows):.0%}"
    return f"{names}, proved to remove {part} of the held-out squared error and not the whole"
