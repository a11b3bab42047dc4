"""What `rwn simulate` errs by on a recording that was judged with numbers of its own: levels, or a told input."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.prove.heldout import HeldoutRow, errors_alone, rms, without_levels
from rwn.simulate.run import Run


def as_simulated(
    rows: Sequence[HeldoutRow], problem: Problem, judged: Sequence[Run], alone: Sequence[Run], corrected: Fit
) -> tuple[HeldoutRow, ...]:
    """The rows, those of whole recordings that were `judged` with numbers of their own with the error without these.

    Args:
        rows: of the held-out recordings.
        problem: whose priors say which numbers a recording has of its own.
        judged: the held-out recordings, as the rows judge them.
        alone: the same with nothing that their own motion told.
        corrected: whose values the corrected model has.
    """
    plain = without_levels(problem.in_free_run())
    this = corrected.hypothesis.starting_at(corrected.minimum.values)
    has_levels = any(own.level for own in problem.prior.of_runs)
    errors = {
        run.name: (bare, errors_alone(plain, replace(bare, levels=(), own_levels=()), this))
        for run, bare in zip(judged, alone, strict=True)
        if has_levels or run.own_levels or run.applied_input is not bare.applied_input
    }

    def with_error(row: HeldoutRow) -> HeldoutRow:
        if row.region != "all" or row.recording not in errors:
            return row
        run, left = errors[row.recording]
        if row.signal not in left:
            return row
        late = np.arange(run.time.size) >= run.judged_from
        return replace(row, simulated=rms(left[row.signal][late & ~run.not_compared(row.signal)]))

    return tuple(with_error(row) for row in rows)
