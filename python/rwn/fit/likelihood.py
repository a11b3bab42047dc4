"""How likely what a fit leaves is, for choosing how recordings were made before it is known what physics is missing.

What a model leaves out moves slowly against the sample time and is the same under every choice, so the errors are
compared by what is new in them: their likelihood as autoregressions. Where a choice is made beside an explanation, one
under which the parameters have to leave what was declared pays for that; before anything is explained they leave
it under every choice.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.levenberg_marquardt import prior_cost
from rwn.fit.problem import Problem
from rwn.recording.intersample import between_ticks
from rwn.simulate.run import Run

Array = NDArray[np.float64]

ORDER = 8  # of the autoregressions
DECISIVE = float(np.log(1000.0))  # how much likelier another choice has to be than what is usual


def log_posterior(problem: Problem, this: Fit) -> float:
    """Of a fit, by what it leaves and by how far its parameters are from what was declared; up to a constant."""
    return log_likelihood(problem, this) - 0.5 * prior_cost(this.hypothesis.unknowns, this.minimum.values)


def log_likelihood(problem: Problem, this: Fit) -> float:
    """Of what a fit leaves, each signal an autoregression of its own; up to a constant.

    Errors of uneven rows are those of the samples that these would lie between: an autoregression is over even steps.
    """
    residuals = problem.residuals(this.vector, this.active)
    likelihood = 0.0
    for signal in dict.fromkeys(s for left in residuals for s in left):
        pairs = [(r, left[signal]) for r, left in zip(problem.runs, residuals, strict=True) if signal in left]
        compared = [x[np.isfinite(x)] for x in (_evenly(r, signal, left) for r, left in pairs)]
        windows = [np.lib.stride_tricks.sliding_window_view(x, ORDER + 1) for x in compared if x.size > ORDER]
        if windows:
            joined = np.concatenate(windows)
            before, now = joined[:, :-1], joined[:, -1]
            new = now - before @ np.linalg.lstsq(before, now)[0]
            likelihood -= 0.5 * sum(r.time.size for r, _ in pairs) * float(np.log(np.mean(new**2) + 1e-300))
    return likelihood


def _evenly(run: Run, signal: str, errors: Array) -> Array:
    """Errors (n,) of a signal at the ticks of a clock that the rows lie beside; NaN where none is known."""
    rows = between_ticks(run.time)
    if rows is None:
        return run.masked(signal, errors)
    even, lost = rows.samples(np.nan_to_num(errors), run.not_compared(signal))
    return np.where(lost, np.nan, even)
