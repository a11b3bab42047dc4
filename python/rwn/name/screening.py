"""Fits every effect that might be missing: many starts, few iterations each, the promising ones to the end."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rwn.fit.budget import shares_by_rank, shares_of_steps
from rwn.fit.fit import Fitted
from rwn.fit.hypothesis import Candidate, Nominal, candidate, cost_of_a_step, fit
from rwn.fit.levenberg_marquardt import FitStatus, Minimum
from rwn.fit.preparation import Setup
from rwn.fit.problem import OutputError, Target
from rwn.fit.secant import settled
from rwn.name.initial_guesses.guesses import Starts
from rwn.name.starts import (
    HOPELESS,
    Racer,
    Row,
    apart,
    best_of_each,
    hopeless_from,
    kind_of,
    misleads,
    promising,
    worth_an_iteration,
)
from rwn.parallel import side_by_side

RESOLUTION = 0.1  # change of cost that no comparison of explanations rests on
KEPT = 12  # explanations that are worth fitting again
SLIGHT = 0.98  # cost in units of the base's, from which a start where the error is rough has gained nothing
IN_PASSING = 6  # iterations that show where a fit goes
HARDLY = 1  # the same where it looks hopeless
TO_THE_END = 60  # iterations, most of them never needed
STEEP = 0.5  # share of its first cost that a fit may have left after these, to go on whatever the others have
GLANCE, LOOK = 2500, 6000  # samples on which starts of one effect are told apart, beside others and alone
ASTRAY = 10.0  # what a start may leave of the others after a glance, in units of what it left before
GLANCED = 0.25  # least share of a recording's squared error that has to lie in them


@dataclass(frozen=True, kw_only=True)
class Search:
    """What the candidates of one problem have in common."""

    problem: OutputError
    nominal: Nominal
    scales: Mapping[str, float]
    patience: int = 1  # how many times the usual iterations a start gets before it is given up

    @classmethod
    def of(cls, setup: Setup, *, problem: OutputError | None = None) -> Search:
        """The search of a prepared problem, or of `problem` in its place (other weights, other recordings)."""
        return cls(problem=problem or setup.problem, nominal=setup.nominal, scales=setup.scales)

    def fit_nominal(self) -> Fitted:
        """The nominal structure alone."""
        this = candidate(self.nominal, (), self.scales)
        return Fitted(added=(), candidate=this, minimum=fit(self.problem, this))

    def fit_start(self) -> Candidate:
        """The nominal structure as given, not fitted."""
        return candidate(self.nominal, (), self.scales)

    def explain(
        self, base: Fitted, names: Iterable[str], *, keep: int = 2, best: float = np.inf
    ) -> list[Fitted]:
        """`base` with each of `names` added, fitted from several starts; best first.

        `best`: least cost of other explanations by as many effects; what comes nowhere near it is fitted in passing.
        """
        fitting = [n for n in names if n not in base.candidate.effects and _has_room(base.candidate, n)]
        starts = side_by_side(lambda name: self._starts(base, name, orders=keep + 1), fitting)
        racers = [racer for of_one in starts for racer in of_one]
        look = self.look(base)
        rows = self._race(self._glance(base, racers, keep), iterations=4 * self.patience, problem=look)
        start = base.cost if look is self.problem else self.refit(base, look).cost
        rows = apart(promising(best_of_each(rows, keep, orders=keep), start), look.samples)
        best_here = best * start / base.cost if np.isfinite(best) else best
        near = self._over_rough(rows, look, start, best_here)
        finals = self._to_the_end(near, look, best_here=best_here, best=best)
        found = [
            Fitted(added=(*base.added, racer.name), candidate=racer.candidate, minimum=m)
            for racer, m in sorted(finals, key=lambda row: row[1].cost)
        ]
        return list({f.added: f for f in reversed(found)}.values())[::-1]

    def _glance(self, base: Fitted, racers: Sequence[Racer], keep: int) -> list[Racer]:
        """At most `keep` starts of each kind: those that an iteration brings furthest.

        A part of the recordings has to do; alone a longer one, since a soft bristle is lost on a short one.
        """
        counts = Counter(map(kind_of, racers))
        crowded = [r for r in racers if counts[kind_of(r)] > keep]
        if not crowded:
            return list(racers)
        crowded = self._sighted(crowded, self.part(base, GLANCE))
        part = self.part(base, GLANCE) if base.added or self.patience > 1 else self.look(base)
        rows = self._race(crowded, iterations=self.patience, problem=part)
        began = {id(racer): start for start, (racer, _) in zip(crowded, rows, strict=True)}
        kept = [(racer, began[id(racer)]) for racer, _ in best_of_each(rows, keep, orders=keep + 1)]
        return [*(r for r in racers if counts[kind_of(r)] <= keep), *self._not_astray(kept, self.look(base))]

    def _not_astray(self, pairs: Sequence[tuple[Racer, Racer]], look: OutputError) -> list[Racer]:
        """Of each pair, after and before a glance, the latter where a fit to a part has lost the rest.

        One that is merely worse there has often learned something.
        """

        def chosen(pair: tuple[Racer, Racer]) -> Racer:
            after, before = (look.error(r.candidate.vector, r.candidate.active) for r in pair)
            return pair[1] if after > ASTRAY * before else pair[0]

        return side_by_side(chosen, pairs)

    def _sighted(self, racers: Sequence[Racer], part: OutputError) -> list[Racer]:
        """Where derivatives mislead from afar, the few best of an effect's starts before anything is fitted.

        That is for periodic effects, each order by itself, for delays, and where a contact makes the error rough.
        """
        astray = [r for r in racers if misleads(r)]
        ends = side_by_side(lambda r: part.error(r.candidate.vector, r.candidate.active), astray)
        ranked = [r for r, _ in sorted(zip(astray, ends, strict=True), key=lambda pair: pair[1])]
        return [*(r for r in racers if not misleads(r)), *worth_an_iteration(ranked)]

    def look(self, base: Fitted) -> OutputError:
        """The part of the problem on which effects are told apart: all of it where it is short."""
        length = sum(t.time.size for t in self.problem.targets)
        return self.problem if length <= LOOK else self.part(base, LOOK)

    def part(self, base: Fitted, samples: int) -> OutputError:
        """The problem on the beginning of every recording."""
        return replace(self.problem, targets=tuple(self._beginnings(base, samples)))

    def _beginnings(self, base: Fitted, samples: int) -> Iterator[Target]:
        """So many samples in all, or until enough of what `base` leaves is in it."""
        problem = self.problem
        residuals = problem.residuals(base.vector, base.candidate.active)
        for target, residual in zip(problem.targets, residuals, strict=True):
            energy = np.cumsum(sum((r / problem.noise[s]) ** 2 for s, r in residual.items()))
            first = int(np.searchsorted(energy, GLANCED * energy[-1]))
            yield target.until(max(first, samples // len(problem.targets)))

    def _race(
        self, racers: Sequence[Racer], *, iterations: int, problem: OutputError | None = None
    ) -> list[Row]:
        """Some iterations of every racer; each row starts the next leg where this one ended."""
        costs = side_by_side(lambda racer: cost_of_a_step(problem or self.problem, racer.candidate), racers)
        shares = shares_of_steps(self.problem.work, costs)
        return side_by_side(
            lambda pair: self._leg(pair[0], iterations, problem, share=pair[1]), zip(racers, shares, strict=True)
        )

    def _leg(self, racer: Racer, iterations: int, problem: OutputError | None = None, *, share: float) -> Row:
        here = problem or self.problem
        m = fit(
            here, racer.candidate, max_iterations=iterations, tolerance=RESOLUTION, damping=racer.damping, share=share
        )
        return racer.after(m), m

    def _to_the_end(
        self, rows: Sequence[Row], look: OutputError, *, best_here: float, best: float
    ) -> list[Row]:
        """Every racer fitted to all recordings, until it converges or, where it is hopeless and gains little, hardly.

        `rows`: how far they came on the look, where they go on for a while. `best_here`, `best`: the least costs that
        are known on the look and on all recordings.
        """
        bar = hopeless_from(rows, best_here)

        def here(row: Row, share: float) -> Row:
            return self._leg(row[0], IN_PASSING, look, share=share) if _goes_on(row[1], bar) else row

        rows = self._by_rank(here, rows)
        bar = hopeless_from(rows, best_here)

        def on_all(row: Row, share: float) -> Row:
            racer, m = row
            if look is self.problem and not _under_way(m):
                return row
            return self._leg(racer, TO_THE_END if _goes_on(m, bar) else HARDLY, share=share)

        rows = self._by_rank(on_all, rows)
        bar = hopeless_from(rows, best)

        def late(row: Row, share: float) -> Row:
            racer, m = row
            hardly = _under_way(m) and m.iterations <= HARDLY
            return self._leg(racer, TO_THE_END, share=share) if hardly and _goes_on(m, bar) else row

        return self._by_rank(late, rows)

    def _by_rank(self, leg: Callable[[Row, float], Row], rows: Sequence[Row]) -> list[Row]:
        """A leg of every row, which may cost the more the better the row is."""
        shares = shares_by_rank(self.problem.work, [m.cost for _, m in rows])
        return side_by_side(lambda pair: leg(*pair), zip(rows, shares, strict=True))

    def _over_rough(
        self, rows: Sequence[Row], problem: OutputError, base_cost: float, best: float
    ) -> list[Row]:
        """Starts whose error is rough, that have gained something and are not hopeless, brought near their minimum."""
        bar = min(SLIGHT * base_cost, max(hopeless_from(rows, best), STEEP * base_cost))

        def near(row: Row, share: float) -> Row:
            racer, m = row
            if m.cost < bar:
                m = settled(problem, racer.candidate, m, turns=1, share=share)
            return racer.after(m), m

        return self._by_rank(near, rows)

    def refit(
        self, this: Fitted, problem: OutputError, *, iterations: int = TO_THE_END, share: float = np.inf
    ) -> Fitted:
        """The same explanation fitted to another problem (other weights, other recordings)."""
        start = this.candidate.starting_at(this.minimum.values)
        end = fit(problem, start, max_iterations=iterations, share=share)
        return Fitted(added=this.added, candidate=start, minimum=end)

    def refit_all(self, these: Sequence[Fitted]) -> list[Fitted]:
        """Explanations of another search fitted to this one's problem, the hopeless ones by a few iterations."""
        bar = HOPELESS * min((this.cost for this in these), default=np.inf)

        def again(pair: tuple[Fitted, float]) -> Fitted:
            this, share = pair
            hopeless = bool(this.added) and this.cost > bar
            return self.refit(this, self.problem, iterations=HARDLY if hopeless else TO_THE_END, share=share)

        # the nominal model is what all are compared with
        shares = shares_by_rank(self.problem.work, [this.cost if this.added else 0.0 for this in these])
        return side_by_side(again, zip(these, shares, strict=True))

    def _starts(self, base: Fitted, name: str, *, orders: int) -> list[Racer]:
        here = Starts(problem=self.problem, nominal=self.nominal, scales=self.scales)
        return here.of(base, name, orders=orders)


def foremost(fits: Sequence[Fitted]) -> list[Fitted]:
    """The explanations that are worth fitting again under other conditions, best first."""
    return sorted(fits, key=lambda f: f.cost)[:KEPT]


def _has_room(this: Candidate, name: str) -> bool:
    """One effect at most can bring a second mass."""
    return not this.table[name].second_mass or not any(this.table[other].second_mass for other in this.effects)


def _goes_on(m: Minimum, bar: float) -> bool:
    """Whether a fit is not hopeless, or has gained much of late."""
    return m.cost < max(bar, STEEP * m.first)


def _under_way(m: Minimum) -> bool:
    return m.status is FitStatus.ITERATION_LIMIT
