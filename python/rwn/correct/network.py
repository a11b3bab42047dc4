"""Where nothing has a name, a wavelet network is the correction: one more term of the equations, as an own effect.

The network stands for a torque, or a voltage lost, that depends on one state. Its weights are fitted in free run beside
the nominal parameters, with exact sensitivities; what the nominal term of the same state could do as well is taken out
of it (arXiv 2511.01321), and its amplitude is fitted once more together with the nominal parameters.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from rwn.fit.fit import Fit, fit, refit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.problem import Problem
from rwn.fit.screening_part import screening_part
from rwn.model.model import Model
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.parallel import side_by_side
from rwn.prove.heldout import WORTH, HeldoutRow, helps
from rwn.prove.proof import proved
from rwn.simulate.run import Run
from rwn.unnamed_law.law import has_room, knowing, with_network
from rwn.unnamed_law.network_formula import NAME, PART, as_effect, nominal_share
from rwn.unnamed_law.place_screening import most_promising
from rwn.unnamed_law.places import Place, places

FEW, MANY = 7, 15  # wavelets while the states are compared, and of the network that is kept
FREE = 1.02  # cost of a network without its nominal part against one with it, up to which it goes without


@dataclass(frozen=True, kw_only=True)
class NetworkCorrection:
    """The network as the correction."""

    place: Place
    ranking: Ranking  # with the network among the effects that it knows
    chosen: RankedFit
    model: Model

    @property
    def values(self) -> dict[str, float]:
        """Parameters of the network as fitted."""
        (name,) = self.chosen.added
        return self.chosen.fit.values_of(name)

    @property
    def cost(self) -> float:
        """Weighted squared error and priors on the recordings that it was fitted to."""
        return self.chosen.fit.cost


def network_correction(ranking: Ranking, model: Model, *, at: Place | None = None) -> NetworkCorrection | None:
    """The network that explains most; None where none explains enough. `at`: this place and no other."""
    parts = -(-MANY // PART)
    if not has_room(model, parts):
        return None
    problem = ranking.problem
    part = screening_part(problem, ranking.nominal_fit)
    tried = [at] if at else most_promising(part, ranking.nominal_fit, places(problem, model), FEW)
    if not tried:
        return None
    networks = side_by_side(lambda place: _fit(part, ranking, model, place, FEW, 5), tried)
    for on, count, kept in ((part, FEW, 2), (problem, MANY, 1)):
        best_first = sorted(networks, key=lambda network: network.fit.cost)
        networks = side_by_side(partial(_grown, on, ranking, model, count), best_first[:kept])
    whole, apart = side_by_side(
        lambda orthogonal: _kept(ranking, model, networks[0], orthogonal=orthogonal), (False, True)
    )
    best = apart if apart.cost <= FREE * whole.cost else whole
    return best if best.cost < WORTH * ranking.nominal_fit.cost else None


def proved_network(
    ranking: Ranking, model: Model, heldout: Sequence[Run], *, seed: int
) -> tuple[NetworkCorrection, tuple[HeldoutRow, ...]] | None:
    """The network with its proof; None where there is none that helps on recordings that it was not fitted to."""
    made = network_correction(ranking, model)
    if made is None:
        return None

    def again(problem: Problem) -> tuple[Ranking, Fit] | None:
        other = _refitted_to(problem, ranking, model, made.place)
        return (other.ranking, other.chosen.fit) if other else None

    rows = proved(made.ranking, made.chosen, heldout, seed=seed, again=again)
    return (made, rows) if helps(rows) else None


@dataclass(frozen=True, kw_only=True)
class _Network:
    """Weights fitted at one place."""

    place: Place
    fit: Fit

    @property
    def weights(self) -> dict[str, float]:
        """Weights by name, in the order of the wavelets."""
        pairs = zip(self.fit.hypothesis.unknowns, self.fit.minimum.values, strict=True)
        return {u.name.split(".")[1]: float(v) for u, v in pairs if u.name.startswith(NAME)}


def _kept(ranking: Ranking, model: Model, network: _Network, *, orthogonal: bool) -> NetworkCorrection:
    """The network with these weights as one own effect, its amplitude fitted together with the nominal parameters.

    `orthogonal`: what the nominal term of the same state could do is that term's.
    """
    place, motor, weights = network.place, network.fit.motor, np.array(list(network.weights.values()))
    problem = ranking.problem
    share = nominal_share(problem, model, place, weights) if orthogonal else 0.0
    if share:
        motor = {**motor, place.parameter: motor[place.parameter] + place.sign * share}
    effect = as_effect(problem, model, place, weights, share=share)
    known = replace(model, own_effects=(*model.own_effects, effect))
    problem = knowing(problem, known)
    this = hypothesis(problem.prior, (effect.name,), problem.scales, motor=motor)
    end = fit(problem, this, max_iterations=20)
    chosen = RankedFit(fit=end, final=end, score=0.0, probability=0.0)
    return NetworkCorrection(
        place=place, ranking=replace(ranking, problem=problem, weighted=knowing(ranking.weighted, known)),
        chosen=chosen, model=known,
    )  # fmt: skip


def _refitted_to(
    problem: Problem, ranking: Ranking, model: Model, place: Place
) -> NetworkCorrection | None:
    """The network at `place` learned anew from other recordings, the nominal model fitted to these as well."""
    nominal = refit(ranking.nominal_fit, problem)
    return network_correction(replace(ranking, problem=problem, nominal_fit=nominal), model, at=place)


def _fit(
    problem: Problem, ranking: Ranking, model: Model, place: Place, count: int, iterations: int,
    start: _Network | None = None,
) -> _Network:  # fmt: skip
    """Weights of `count` wavelets beside the nominal parameters, from nothing or from those of a smaller network."""
    motor = (start.fit if start else ranking.nominal_fit).motor
    weights = start.weights if start else {}
    on, this = with_network(problem, model, place, count, motor=motor, weights=weights)
    return _Network(place=place, fit=fit(on, this, max_iterations=iterations))


def _grown(problem: Problem, ranking: Ranking, model: Model, count: int, network: _Network) -> _Network:
    """The same place with `count` wavelets, fitted further."""
    return _fit(problem, ranking, model, network.place, count, 20, start=network)
