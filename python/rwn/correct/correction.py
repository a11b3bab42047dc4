"""The correction: what is named, or what stands in for what has no name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rwn.correct.network import NetworkCorrection, proved_network
from rwn.decide.decision import Decision
from rwn.decide.refuse import removed_certainly
from rwn.decide.verdict import is_certain
from rwn.fit.fitted_model import fitted_model
from rwn.model.model import Model
from rwn.simulate.run import Run

NO_NETWORK = (
    "no wavelet network over one state helps on recordings that were not fitted: corrected.toml holds the refitted "
    "nominal model"
)


@dataclass(frozen=True, kw_only=True)
class Correction:
    """A decision with the model that it corrects to."""

    decision: Decision  # of the explanation or the network that the model holds
    model: Model  # what corrected.toml holds
    network: NetworkCorrection | None = None
    stands_in: str = ""  # what stands in the model for what has no name
    warnings: tuple[str, ...] = ()


def correct(decision: Decision, heldout: Sequence[Run], model: Model, *, seed: int) -> Correction:
    """The model with what is named; where nothing is, with a network or the leading name if one is proved to help."""
    if decision.verdict == "unexplained":
        found = _without_a_name(decision, heldout, model, seed=seed)
        if found:
            return found
    warnings: tuple[str, ...] = ()
    if decision.other:
        warnings = (
            f"{decision.other.words} explains most of what is left: the name may only be the nearest of those that rwn "
            "knows",
        )
    elif decision.verdict == "unexplained" and not model.drive.coefficients:
        warnings = (NO_NETWORK,)
    return Correction(decision=decision, model=fitted_model(decision.chosen.final, model), warnings=warnings)


def _without_a_name(
    decision: Decision, heldout: Sequence[Run], model: Model, *, seed: int
) -> Correction | None:
    """A wavelet network that helps on recordings that were not fitted; without one, the name that leads."""
    proof = proved_network(decision.ranking, model, heldout, seed=seed)
    if proof:
        network, rows = proof
        by_network = replace(decision, ranking=network.ranking, chosen=network.chosen, rows=rows)
        return Correction(
            decision=by_network, model=fitted_model(network.chosen.final, network.model), network=network,
            stands_in=f"a wavelet network, {network.place.words}",
        )  # fmt: skip
    leading = decision.leading
    if leading and leading.chosen.added and is_certain(leading.rows):
        names, part = " + ".join(leading.chosen.added), f"{removed_certainly(leading.rows):.0%}"
        words = f"{names}, proved to remove {part} of the held-out squared error and not the whole"
        return Correction(
            decision=replace(leading, verdict=decision.verdict), model=fitted_model(leading.chosen.final, model),
            stands_in=words,
        )  # fmt: skip
    return None
