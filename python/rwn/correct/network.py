"""Where nothing has a name, a wavelet network is the correction: one more term of the equations, as an own effect.

The network stands for a torque, or a voltage lost, that depends on one state. Its weights are fitted in free run beside
the nominal parameters, with exact sensitivities; what the nominal term of the same state could do as well is taken out
of it (arXiv 2511.01321), and its amplitude is fitted once more together with the nominal parameters.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rwn import _core
from rwn.correct.network_formula import (
    NAME,
    PART,
    Place,
    as_effect,
    nominal_share,
    parts_of,
    places,
    size_of,
    states_of,
    unit_of_state,
)
from rwn.decide.refuse import heldout_error
from rwn.fit.fit import Fitted
from rwn.fit.hypothesis import Candidate, candidate, fit
from rwn.fit.preparation import Setup
from rwn.fit.problem import OutputError, Target
from rwn.fit.residuals import Hypothesis
from rwn.model.model import Model
from rwn.name.forward import Explanation
from rwn.name.screening import Search
from rwn.parallel import side_by_side
from rwn.prove.proof import proved
from rwn.report.diagnosis import HeldoutRow, Plot, Trace

Array = NDArray[np.float64]

FEW, MANY = 7, 15  # wavelets while the states are compared, and of the network that is kept
STIFF = 3.0  # standard deviation of the weights' prior, of the drive's largest torque or voltage
FREE = 1.02  # cost of a network without its nominal part against one with it, up to which it goes without
WORTH = 0.9  # cost of a fit with the network against the one without, above which it is not worth a file


@dataclass(frozen=True, kw_only=True)
class StandIn:
    """The network as the correction."""

    place: Place
    found: Explanation  # with the network among the effects that it knows
    chosen: Hypothesis
    model: Model

    @property
    def chosen_values(self) -> dict[str, float]:
        """Parameters of the network as fitted."""
        (name,) = self.chosen.fitted.added
        return self.chosen.fitted.values_of(name)

    @property
    def cost(self) -> float:
        """Weighted squared error and priors on the recordings that it was fitted to."""
        return self.chosen.fitted.cost


def stand_in(found: Explanation, model: Model, *, at: Place | None = None) -> StandIn | None:
    """The network that explains most; None where none explains enough. `at`: this place and no other."""
    parts = -(-MANY // PART)
    if not has_room(model, parts):
        return None
    tried = [at] if at else places(found.setup, model)
    part = replace(found, setup=replace(found.setup, problem=Search.of(found.setup).look(found.nominal)))
    heats = side_by_side(lambda place: _fit(part, model, place, FEW, 5), tried)
    for on, count, kept in ((part, FEW, 2), (found, MANY, 1)):
        best_first = sorted(heats, key=lambda heat: heat.fitted.cost)
        heats = side_by_side(partial(_grown, on, model, count), best_first[:kept])
    whole, apart = side_by_side(
        lambda orthogonal: _kept(found, model, heats[0], orthogonal=orthogonal), (False, True)
    )
    best = apart if apart.cost <= FREE * whole.cost else whole
    return best if best.cost < WORTH * found.nominal.cost else None


def has_room(model: Model, parts: int, *, beside: int = 0) -> bool:
    """Whether `parts` own effects more fit in, `beside` effects being active that the model does not have."""
    if model.kind == "lti" or len(model.own_effects) + parts > _core.max_own_effects:
        return False
    return len(model.effects) + beside + parts <= _core.max_active_effects


def proved_stand_in(
    found: Explanation, model: Model, heldout: Sequence[Target], *, seed: int
) -> tuple[StandIn, tuple[HeldoutRow, ...]] | None:
    """The network with its proof; None where there is none that helps on recordings that it was not fitted to."""
    made = stand_in(found, model)
    if made is None:
        return None

    def again(problem: OutputError) -> tuple[Explanation, Fitted] | None:
        other = _refitted_to(problem, found, model, made.place)
        return (other.found, other.chosen.fitted) if other else None

    rows = proved(made.found, made.chosen, heldout, made.model, seed=seed, again=again)
    return (made, rows) if _helps(rows) else None


def _helps(rows: Sequence[HeldoutRow]) -> bool:
    """Whether some signal is certainly better on what was not fitted, and none certainly worse."""
    gains = [r.gain_interval for r in rows if r.region == "all" and r.gain_interval is not None]
    better, worse = any(low > 0.0 for low, _ in gains), any(high < 0.0 for _, high in gains)
    return better and not worse and heldout_error(rows) < 1.0


@dataclass(frozen=True, kw_only=True)
class _Heat:
    """Weights fitted at one place."""

    place: Place
    fitted: Fitted

    @property
    def weights(self) -> dict[str, float]:
        """Weights by name, in the order of the wavelets."""
        pairs = zip(self.fitted.candidate.unknowns, self.fitted.minimum.values, strict=True)
        return {u.name.split(".")[1]: float(v) for u, v in pairs if u.name.startswith(NAME)}


def _kept(found: Explanation, model: Model, heat: _Heat, *, orthogonal: bool) -> StandIn:
    """The network with these weights as one own effect, its amplitude fitted together with the nominal parameters.

    `orthogonal`: what the nominal term of the same state could do is that term's.
    """
    place, motor, weights = heat.place, heat.fitted.motor, np.array(list(heat.weights.values()))
    share = nominal_share(found.setup, model, place, weights) if orthogonal else 0.0
    if share:
        motor = {**motor, place.nominal: motor[place.nominal] + place.sign * share}
    effect = as_effect(found.setup, model, place, weights, share=share)
    known = replace(model, own_effects=(*model.own_effects, effect))
    setup = _knowing(found.setup, known)
    this = candidate(setup.nominal, (effect.name,), setup.scales, motor=motor)
    fitted = Fitted(added=(effect.name,), candidate=this, minimum=fit(setup.problem, this, max_iterations=20))
    hypothesis = Hypothesis(fitted=fitted, final=fitted, score=0.0, probability=0.0, misfit=0.0)
    return StandIn(place=place, found=replace(found, setup=setup), chosen=hypothesis, model=known)


def _refitted_to(problem: OutputError, found: Explanation, model: Model, place: Place) -> StandIn | None:
    """The network at `place` learned anew from other recordings, the nominal model fitted to these as well."""
    setup = replace(found.setup, problem=problem)
    start = found.nominal.candidate.starting_at(found.nominal.minimum.values)
    base = replace(found.nominal, candidate=start, minimum=fit(problem, start))
    return stand_in(replace(found, setup=setup, nominal=base), model, at=place)


def _knowing(setup: Setup, model: Model) -> Setup:
    """The same setup with the own effects of `model`."""
    own = tuple(effect.core for effect in model.own_effects)
    return replace(
        setup,
        nominal=replace(setup.nominal, table=model.effect_table),
        whole=replace(setup.whole, own=own),
        problem=replace(setup.problem, own=own),
    )


def _fit(
    found: Explanation, model: Model, place: Place, count: int, iterations: int, start: _Heat | None = None
) -> _Heat:
    """Weights of `count` wavelets beside the nominal parameters, from nothing or from those of a smaller network."""
    motor = (start.fitted if start else found.nominal).motor
    weights = start.weights if start else {}
    setup, this = with_network(found.setup, model, place, count, motor=motor, weights=weights)
    end = fit(setup.problem, this, max_iterations=iterations)
    return _Heat(place=place, fitted=Fitted(added=(), candidate=this, minimum=end))


def with_network(
    setup: Setup, model: Model, place: Place, count: int, *, motor: Mapping[str, float],
    weights: Mapping[str, float] = MappingProxyType({}),
    effects: Mapping[str, Mapping[str, float]] = MappingProxyType({}),
) -> tuple[Setup, Candidate]:  # fmt: skip
    """The weights of `count` wavelets as unknowns beside the nominal parameters and `effects`, started at these values.

    The setup is `setup` with the network among the effects that it knows.
    """
    parts = parts_of(setup, model, place, count)
    setup = _knowing(setup, replace(model, own_effects=(*model.own_effects, *parts)))
    known = {part.name: {p.name: weights[p.name] for p in part.parameters if p.name in weights} for part in parts}
    this = candidate(setup.nominal, (*effects, *known), setup.scales, {**effects, **known}, motor)
    stiff = STIFF * size_of(setup, place)
    unknowns = tuple(
        replace(u, prior=0.0, prior_std=stiff) if u.name.startswith(NAME) else u for u in this.unknowns
    )
    return setup, replace(this, unknowns=unknowns)


def _grown(found: Explanation, model: Model, count: int, heat: _Heat) -> _Heat:
    """The same place with `count` wavelets, fitted further."""
    return _fit(found, model, heat.place, count, 20, start=heat)


def picture(made: StandIn) -> Plot:
    """The network over its state, as corrected.toml gives it."""
    effect, place = made.model.own_effects[-1], made.place
    states = states_of(made.found.setup, place)
    low, high = np.percentile(states, [0.05, 99.95])
    x = np.linspace(0.0, 2.0 * np.pi / place.periods, 400) if place.periods else np.linspace(low, high, 400)
    values = {p.name: p.start for p in effect.parameters} | made.chosen_values | {place.state: x}
    return Plot(
        slot="other", title=f"What corrected.toml holds for it: {place.words}",
        x_label=place.state, x_unit=unit_of_state(place),
        y_label="voltage lost" if place.term == "drop" else "force" if place.linear else "torque", y_unit=place.unit,
        traces=(Trace(name="wavelet network", role="corrected", x=x, y=effect.formula.evaluate(values)),),
        note="Fitted in free run together with the nominal parameters.",
    )  # fmt: skip
