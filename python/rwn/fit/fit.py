"""A fit: a hypothesis and where the search for its unknowns ended."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.budget import shares_by_rank
from rwn.fit.hypothesis import OF_RUNS, Hypothesis
from rwn.fit.levenberg_marquardt import DAMPING, Minimum, minimise
from rwn.fit.problem import Problem
from rwn.fit.unknown import Unknown
from rwn.model.initial_state import INITIAL_POSITION
from rwn.parallel import side_by_side
from rwn.simulate.simulator import NormalEquations

Array = NDArray[np.float64]

COST_SAMPLE = 0.1  # part of every run that is simulated to learn what a step of a fit costs
IDLE = 1e-9  # strength, relative to its upper limit, that is none
LIMIT = 1e-3  # relative distance from a limit of a parameter that counts as lying on it
TO_THE_END = 60  # iterations of a fit that is to converge; most of them are never needed
NEAR_ITS_END = 8  # iterations of a fit that begins where a like one ended
BRIEFLY = 1  # iterations of a fit that is far from the best
FAR_BEHIND = 4.0  # cost in units of the best's, above which a fit is repeated briefly
KEPT = 12  # fits that are worth repeating under other conditions


@dataclass(frozen=True, kw_only=True)
class Fit:
    """A hypothesis and where its fit ended."""

    hypothesis: Hypothesis
    minimum: Minimum
    problem: Problem | None = field(default=None, repr=False, compare=False)  # that it was fitted to, where known

    @property
    def added(self) -> tuple[str, ...]:
        """Effects beside those of the nominal model."""
        return self.hypothesis.added

    @property
    def cost(self) -> float:
        """Weighted squared error and priors."""
        return self.minimum.cost

    @property
    def vector(self) -> Array:
        """The whole parameter vector (all,) at the minimum, in SI."""
        return self.hypothesis.with_values(self.minimum.values)

    @property
    def active(self) -> list[int]:
        """Indices of the switched-on effects."""
        return self.hypothesis.active

    @property
    def limits_met(self) -> tuple[str, ...]:
        """Shapes of the added effects that ran into a limit: there a law bends towards one that it is not.

        How strong an effect is says nothing of its law; its limits are those of belief.
        """
        shapes = {
            f"{effect.name}.{p.name}"
            for effect in (self.hypothesis.table[name] for name in self.added)
            for p in effect.every
            if not (p.strength or p.replaces or p.cyclic or p.idealised or p.natural or p in effect.instants)
        }
        pairs = zip(self.hypothesis.unknowns, self.minimum.values, strict=True)
        return tuple(u.name for u, v in pairs if u.name in shapes and _meets(u, v))

    @property
    def idle(self) -> tuple[str, ...]:
        """Added effects that ended without strength: they say nothing beyond what they take over."""
        pairs = zip(self.hypothesis.unknowns, self.minimum.values, strict=True)
        reached = {u.name: u.lower > 0.0 or abs(v) > IDLE * u.upper for u, v in pairs}
        strengths = {
            name: [reached[f"{name}.{p.name}"] for p in self.hypothesis.table[name].parameters if p.strength]
            for name in self.added
        }
        return tuple(name for name, strong in strengths.items() if strong and not any(strong))

    @property
    def windows(self) -> list[tuple[float, float]]:
        """Begin and end of every time window of the added effects, in units of the longest run."""
        longest = {u.name: u.upper for u in self.hypothesis.unknowns}
        windows = [[f"{n}.{p.name}" for p in self.hypothesis.table[n].instants] for n in self.added]
        ends = [[self.value(name) / longest[name] for name in names] for names in windows]
        return [(pair[0], pair[1]) for pair in ends if pair]

    @property
    def periods(self) -> list[float]:
        """Periods per revolution (per metre on a linear axis) of the added effects that have a number of them."""
        table = self.hypothesis.table
        return [v for n in self.added for p in table[n].every if p.order and (v := self.values_of(n).get(p.name))]

    @property
    def motor(self) -> dict[str, float]:
        """Uncertain nominal parameters as fitted; of one that an effect has taken over, the mean of what it has for it.

        So a fit without that effect begins with friction as large, and not with that of the data sheet.
        """
        pairs = zip(self.hypothesis.unknowns, self.minimum.values, strict=True)
        fitted = {u.name: float(v) for u, v in pairs if "." not in u.name and not u.nuisance}
        taken = {name: self._taken_over(name) for name in self.hypothesis.taken_over}
        return {name: float(np.mean(values)) for name, values in taken.items() if values} | fitted

    def _taken_over(self, nominal: str) -> list[float]:
        """What the added effects have for a nominal parameter."""
        pairs = ((name, p) for name in self.added for p in self.hypothesis.table[name].parameters)
        return [self.values_of(name)[p.name] for name, p in pairs if p.replaces == nominal]

    @property
    def farthest_move(self) -> float:
        """Largest move of a nominal parameter from its given value, in declared standard deviations."""
        return max(self.moves.values(), default=0.0)

    @property
    def moves(self) -> dict[str, float]:
        """Move of each parameter of which something was declared, in declared standard deviations."""
        moves = {}
        for u, value in zip(self.hypothesis.unknowns, self.minimum.values, strict=True):
            if u.prior is None or not np.isfinite(u.prior_std) or u.prior_std <= 0.0 or u.prior == 0.0:
                continue
            ratio = value / u.prior
            logarithmic = u.logarithmic and ratio > 0.0
            moves[u.name] = float(abs(np.log(ratio) if logarithmic else ratio - 1.0) / u.prior_std)
        return moves

    @property
    def unknowns_seen(self) -> int:
        """How many unknowns the recordings depend on: the offset of a current that nobody recorded is not one."""
        return int(np.count_nonzero(np.diag(self.minimum.data_information)))

    def values_of(self, name: str) -> dict[str, float]:
        """Parameters of one effect as fitted."""
        effect = self.hypothesis.table[name]
        values = {p.name: float(self.vector[effect.at(p.name)]) for p in effect.every}
        return {p.name: values[p.name] for p in effect.acting(values)}

    def starts(self, names: Iterable[str]) -> dict[str, dict[str, float]]:
        """Where an explanation by some of its effects begins: with their parameters and those of the measurement.

        Along with effects of the angle goes the angle at which each recording begins, where that is unknown, and along
        with all the level of each recording (measurement/levels.py).
        """
        measured = {u.name.partition(".")[0] for u in self.hypothesis.unknowns if u.nuisance}
        known = (*names, *(name for name in self.hypothesis.effects if name in measured))
        angles = self.initial_angles if any(self.hypothesis.table[name].turns for name in known) else {}
        return {name: self.values_of(name) for name in known} | {OF_RUNS: {**angles, **self.levels}}

    @property
    def levels(self) -> dict[str, float]:
        """The fitted levels of single recordings (fit/prior.py), by the name of the unknown."""
        pairs = zip(self.hypothesis.unknowns, self.minimum.values, strict=True)
        return {u.name: float(v) for u, v in pairs if u.level}

    @property
    def initial_angles(self) -> dict[str, float]:
        """The fitted angles at which recordings begin, by the name of the unknown."""
        pairs = zip(self.hypothesis.unknowns, self.minimum.values, strict=True)
        return {u.name: float(v) for u, v in pairs if u.nuisance and u.name.startswith(INITIAL_POSITION)}

    def carried_to(self, other: Hypothesis) -> Hypothesis:
        """Another hypothesis, begun from where this fit ended in the unknowns that both have."""
        pairs = zip(self.hypothesis.unknowns, self.minimum.values, strict=True)
        ended = {u.name: float(v) for u, v in pairs}
        begun = [ended.get(u.name, v) for u, v in zip(other.unknowns, other.start, strict=True)]
        return other.starting_at(np.array(begun))

    def value(self, name: str) -> float:
        """A fitted unknown by name ("inertia", "coulomb-friction.coulomb_torque")."""
        names = [u.name for u in self.hypothesis.unknowns]
        return float(self.minimum.values[names.index(name)])


def _meets(unknown: Unknown, value: float) -> bool:
    """Whether a value lies on a limit; at 0 a law merely loses a part (its damping, its strength)."""
    return any(limit != 0.0 and abs(value - limit) < LIMIT * abs(limit) for limit in (unknown.lower, unknown.upper))


def fit(
    problem: Problem, this: Hypothesis, *, max_iterations: int = TO_THE_END, tolerance: float = 1e-2,
    damping: float = DAMPING, share: float = np.inf, roughly: bool = False, ended: Fit | None = None,
) -> Fit:  # fmt: skip
    """Fits the unknowns of a hypothesis to the runs, by one iteration at least.

    `share`: what it may cost. `roughly`: the curvature need not be that of where it ends. `ended`: the fit from whose
    end this one goes on; where it was of the same problem, its end is not simulated again.
    """
    own = problem.metered()

    def evaluate(values: Array) -> NormalEquations:
        return own.normal(this.with_values(values), this.active, this.by)

    def probe(values: Array) -> NormalEquations:
        return own.normal(this.with_values(values), this.active, ())

    end = minimise(
        evaluate, this.start, this.unknowns, max_iterations=max_iterations, tolerance=tolerance, damping=damping,
        prior_scale=problem.inflation, probe=probe, enough=lambda: own.work.done >= share, roughly=roughly,
        known=_known_at(problem, this, ended),
    )  # fmt: skip
    problem.work.add(own.work.done)
    return Fit(hypothesis=this, minimum=end, problem=problem)


def _known_at(problem: Problem, this: Hypothesis, ended: Fit | None) -> NormalEquations | None:
    """The normal equations at the start of a hypothesis, where a fit of the same problem ended; None: not known."""
    end = ended.minimum.simulated if ended and ended.problem is problem else None
    if ended is None or end is None or (ended.active, ended.hypothesis.by) != (this.active, this.by):
        return None
    return end.normal if np.array_equal(ended.hypothesis.with_values(end.values), this.vector) else None


def fit_nominal(problem: Problem) -> Fit:
    """The nominal structure alone, from its given values."""
    return fit(problem, problem.as_given())


def refit(this: Fit, problem: Problem, *, iterations: int = TO_THE_END, share: float = np.inf) -> Fit:
    """The same hypothesis fitted to another problem (other weights, other runs), from where it ended."""
    start = this.hypothesis.starting_at(this.minimum.values)
    return fit(problem, start, max_iterations=iterations, share=share, ended=this)


def refit_all(these: Sequence[Fit], problem: Problem) -> list[Fit]:
    """Fits of another problem repeated on this one, those that are far behind the best by a few iterations."""
    bar = FAR_BEHIND * min((this.cost for this in these), default=np.inf)

    def again(pair: tuple[Fit, float]) -> Fit:
        this, share = pair
        behind = bool(this.added) and this.cost > bar
        return refit(this, problem, iterations=BRIEFLY if behind else TO_THE_END, share=share)

    # the nominal model is what all are compared with
    shares = shares_by_rank(problem.work, [this.cost if this.added else 0.0 for this in these])
    return side_by_side(again, zip(these, shares, strict=True))


def best_few(fits: Sequence[Fit]) -> list[Fit]:
    """The fits that are worth repeating under other conditions, best first."""
    return sorted(fits, key=lambda f: f.cost)[:KEPT]


def cost_of_a_step(problem: Problem, this: Hypothesis, at: Array | None = None) -> float:
    """What it costs to simulate all runs once, with derivatives; measured on the beginning of each.

    `at`: the parameter vector (all,); None: where the hypothesis starts.
    """
    runs = tuple(r.until(max(int(COST_SAMPLE * r.time.size), 1)) for r in problem.runs)
    own = replace(problem, runs=runs).metered()
    own.normal(this.vector if at is None else at, this.active, this.by)
    problem.work.add(own.work.done)
    return own.work.done / COST_SAMPLE
