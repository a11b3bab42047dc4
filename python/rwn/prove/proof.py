"""The proof of a correction: on held-out recordings, or where there are none on what each fit did not see."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from rwn.fit.fit import Fit, refit
from rwn.fit.hypothesis import Hypothesis
from rwn.fit.problem import Problem
from rwn.name.ranking import Ranking
from rwn.name.weights import RankedFit
from rwn.parallel import side_by_side
from rwn.prove.heldout import HeldoutRow, heldout_rows
from rwn.simulate.run import Run

Again = Callable[[Problem], tuple[Ranking, Fit] | None]
Fold = tuple[Problem, Run, int]  # what is fitted, what is simulated, first sample that was not fitted

LEFT_OUT = "(left out)"  # marks what a fold did not fit
FITTED_PART = 0.7  # of a lone recording, when its rest has to serve as proof


class Proof(NamedTuple):
    """An explanation, and how it does on recordings that it was not fitted to."""

    explanation: RankedFit
    rows: tuple[HeldoutRow, ...]


def proved(
    ranking: Ranking, chosen: RankedFit, heldout: Sequence[Run], *, seed: int, again: Again | None = None
) -> tuple[HeldoutRow, ...]:
    """Rows on the held-out runs; without any, every recording is judged by fits that did not see it.

    `again`: how the correction is found anew from some of the recordings (default: its parameters are fitted anew);
    nothing is proved where it finds none.
    """
    if heldout:
        return compared(ranking, ranking.nominal_fit, chosen.final, heldout, seed=seed)

    def fold(case: Fold) -> tuple[HeldoutRow, ...] | None:
        problem, run, first = case
        if again is not None:
            other = again(problem)
            if other is None:
                return None
            return compared(other[0], other[0].nominal_fit, other[1], [run], seed=seed, first=first)
        nominal = refit(ranking.nominal_fit, problem)
        weighted = replace(ranking.weighted, runs=problem.runs)
        fitted = refit(chosen.final, weighted) if chosen.added else chosen.final
        return compared(ranking, nominal, fitted, [run], seed=seed, first=first)

    parts = side_by_side(fold, _folds(ranking.problem))
    return tuple(row for part in parts for row in part or ()) if None not in parts else ()


def compared(
    ranking: Ranking, refitted: Fit, fitted: Fit, runs: Sequence[Run], *, seed: int, first: int = 0
) -> tuple[HeldoutRow, ...]:
    """Rows of two fits on runs that neither saw, `refitted` in the place of the nominal model's; see `heldout_rows`."""
    problem = ranking.problem.in_free_run()
    linear = problem.drive.linear
    units = {"current": "A", "speed": "m/s" if linear else "rad/s", "position": "m" if linear else "rad"}
    return heldout_rows(
        problem,
        runs,
        problem.as_given(),
        _at_minimum(refitted),
        _at_minimum(fitted) if fitted.added else None,
        units=units,
        seed=seed,
        first=first,
    )


def _at_minimum(this: Fit) -> Hypothesis:
    return this.hypothesis.starting_at(this.minimum.values)


def _folds(problem: Problem) -> Iterator[Fold]:
    """One recording left out at a time, or the last part of a lone one."""
    whole = problem.whole
    if len(whole) > 1:
        for k, run in enumerate(whole):
            others = tuple(r for j, r in enumerate(problem.runs) if j != k)
            alone = replace(run, name=f"{run.name} {LEFT_OUT}", start_unknowns=(), levels=())
            yield replace(problem, runs=others), alone, 0
        return
    first, last = (int(FITTED_PART * r.time.size) for r in (whole[0], problem.runs[0]))  # a fit may take fewer samples
    late = replace(whole[0], name=f"last {1.0 - FITTED_PART:.0%} of {whole[0].name} {LEFT_OUT}".replace("%", " %"))
    yield replace(problem, runs=(problem.runs[0].until(last),)), late, first
