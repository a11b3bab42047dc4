"""The proof of a correction: on held-out recordings, or where there are none on what each fit did not see."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from rwn.fit.fit import Fitted
from rwn.fit.problem import OutputError, Target
from rwn.fit.residuals import Hypothesis
from rwn.model.model import Model
from rwn.name.forward import Explanation
from rwn.name.screening import Search
from rwn.parallel import side_by_side
from rwn.prove.heldout import Contender, heldout_rows
from rwn.report.diagnosis import HeldoutRow

Again = Callable[[OutputError], tuple[Explanation, Fitted] | None]
Fold = tuple[OutputError, Target, int]  # what is fitted, what is simulated, first sample that was not fitted

LEFT_OUT = "(left out)"  # marks what a fold did not fit
FITTED_PART = 0.7  # of a lone recording, when its rest has to serve as proof


def proved(
    found: Explanation, chosen: Hypothesis, heldout: Sequence[Target], model: Model, *, seed: int,
    again: Again | None = None,
) -> tuple[HeldoutRow, ...]:  # fmt: skip
    """Rows on the held-out recordings; without any, every recording is judged by fits that did not see it.

    `again`: how the correction is found anew from some of the recordings (default: its parameters are fitted anew);
    nothing is proved where it finds none.
    """
    if heldout:
        return _rows(found, found.nominal, chosen.final, heldout, model, seed=seed)

    def fold(case: Fold) -> tuple[HeldoutRow, ...] | None:
        problem, target, first = case
        if again is not None:
            other = again(problem)
            if other is None:
                return None
            return _rows(other[0], other[0].nominal, other[1], [target], model, seed=seed, first=first)
        search = Search.of(found.setup, problem=problem)
        nominal = search.refit(found.nominal, problem)
        weighted = replace(found.weighted, targets=problem.targets)
        fitted = search.refit(chosen.final, weighted) if chosen.fitted.added else chosen.final
        return _rows(found, nominal, fitted, [target], model, seed=seed, first=first)

    parts = side_by_side(fold, _folds(found))
    return tuple(row for part in parts for row in part or ()) if None not in parts else ()


def hurts(rows: Sequence[HeldoutRow]) -> bool:
    """Whether the correction makes held-out simulation certainly worse."""
    main = [r for r in rows if r.region == "all" and r.gain_interval is not None]
    if any(r.corrected is not None and not np.isfinite(r.corrected) for r in main):
        return True  # it runs away
    return bool(main) and all(r.gain_interval[1] < 0.0 for r in main if r.gain_interval)


def _rows(
    found: Explanation, refitted: Fitted, fitted: Fitted, targets: Sequence[Target], model: Model, *, seed: int,
    first: int = 0,
) -> tuple[HeldoutRow, ...]:  # fmt: skip
    setup = found.setup
    given = Search.of(setup).fit_start()
    units = {
        "current": "A",
        "speed": "m/s" if model.linear else "rad/s",
        "position": "m" if model.linear else "rad",
    }
    return heldout_rows(
        setup.whole,
        targets,
        Contender(vector=given.vector, active=tuple(given.active)),
        _contender(refitted),
        _contender(fitted) if fitted.added else None,
        units=units,
        seed=seed,
        first=first,
    )


def _contender(fitted: Fitted) -> Contender:
    return Contender(vector=fitted.vector, active=tuple(fitted.candidate.active))


def _folds(found: Explanation) -> Iterator[Fold]:
    """One recording left out at a time, or the last part of a lone one."""
    problem, whole = found.setup.problem, found.setup.whole
    if len(whole.targets) > 1:
        for k, target in enumerate(whole.targets):
            others = tuple(t for j, t in enumerate(problem.targets) if j != k)
            yield replace(problem, targets=others), replace(target, name=f"{target.name} {LEFT_OUT}"), 0
        return
    first = int(FITTED_PART * whole.targets[0].time.size)
    begin = whole.targets[0].time[first]
    late = replace(whole.targets[0], name=f"{whole.targets[0].name} from {begin:.3g} s {LEFT_OUT}")
    yield replace(problem, targets=(problem.targets[0].until(first),)), late, first
