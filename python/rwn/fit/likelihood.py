"""How likely what a fit leaves is, for choosing how recordings were made before it is known what physics is missing.

What a model leaves out moves slowly against the sample time and is the same under every choice, so the errors are
compared by what is new in them: their likelihood as autoregressions. Where a choice is made beside an explanation, one
under which the parameters have to leave what was declared pays for that; before anything is explained they leave
it under every choice. Such errors are not noise, and a few sharp moments may make any choice a million times likelier:
one that is certain is so by the scatter of its gain from block to block too.
"""

from __future__ import annotations

from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.levenberg_marquardt import prior_cost
from rwn.fit.problem import Problem
from rwn.fit.residuals import LEVEL
from rwn.recording.intersample import between_ticks
from rwn.simulate.run import Run

Array = NDArray[np.float64]

ORDER = 8  # of the autoregressions
DECISIVE = float(np.log(1000.0))  # how much likelier another choice has to be than what is usual
BLOCKS = 30  # of the rows: enough for a deviation to be known to a tenth, each longer than an error lasts
CERTAINLY = NormalDist().inv_cdf(1.0 - LEVEL)  # deviations


def log_posterior(problem: Problem, this: Fit) -> float:
    """Of a fit, by what it leaves and by how far its parameters are from what was declared; up to a constant."""
    return float(np.sum(log_posteriors(problem, this)))


def log_posteriors(problem: Problem, this: Fit) -> Array:
    """The same by blocks of rows, (BLOCKS,)."""
    moved = 0.5 * prior_cost(this.hypothesis.unknowns, this.minimum.values)
    return log_likelihoods(problem, this) - moved / BLOCKS


def log_likelihood(problem: Problem, this: Fit) -> float:
    """Of what a fit leaves, each signal an autoregression of its own; up to a constant."""
    return float(np.sum(log_likelihoods(problem, this)))


def certainly_likelier(one: Array, other: Array) -> bool:
    """Whether logarithms (BLOCKS,) under one choice are decisively above those under another (Vuong 1989, 1 %)."""
    gains = one - other
    return bool(np.sum(gains) > max(DECISIVE, CERTAINLY * float(np.std(gains, ddof=1)) * np.sqrt(gains.size)))


def log_likelihoods(problem: Problem, this: Fit) -> Array:
    """Of what a fit leaves, each signal an autoregression of its own; of each of as many blocks of rows, (BLOCKS,).

    An autoregression is over even steps: errors of uneven rows are those of the samples that these would lie between,
    and the noise of a row, where it was not interpolated, is larger there the farther it lies from its tick.
    """
    residuals = problem.residuals(this.vector, this.active)
    blocks = np.zeros(BLOCKS)
    for signal in dict.fromkeys(s for left in residuals for s in left):
        pairs = [(r, left[signal]) for r, left in zip(problem.runs, residuals, strict=True) if signal in left]
        even = [_evenly(r, signal, left) for r, left in pairs]
        windows = [np.lib.stride_tricks.sliding_window_view(x, ORDER + 1) for x, _ in even if x.size > ORDER]
        if windows:
            joined = np.concatenate(windows)
            noise = np.concatenate([w[ORDER:] for x, w in even if x.size > ORDER])
            before, now = joined[:, :-1], joined[:, -1]
            weights = np.linalg.lstsq(before, now)[0]
            new = now - before @ weights
            samples = sum(r.time.size for r, _ in pairs)
            logarithms = _log_densities(new, noise, 1.0 + float(weights @ weights))
            blocks += [samples / new.size * np.sum(of_block) for of_block in np.array_split(logarithms, BLOCKS)]
    return blocks


def _log_densities(new: Array, noise: Array, noises: float) -> Array:
    """Of what is new in errors (n,), normal with the variance that is likeliest; up to a constant.

    `noise`: of the rows (n,), 1 on the scale of the errors where none is amplified; `noises`: of how many rows it is
    made up. The rest of what is new is no noise, and alike in all rows.
    """
    whole = float(np.mean(new**2)) + 1e-300
    share = min(noises * float(np.mean(noise)) / whole, 1.0)
    relative = 1.0 + share * (noise / np.mean(noise) - 1.0)
    variance = relative * (np.mean(new**2 / relative) + 1e-300)
    return np.asarray(-0.5 * (np.log(variance) + new**2 / variance - 1.0))


def _evenly(run: Run, signal: str, errors: Array) -> tuple[Array, Array]:
    """Errors of a signal at the ticks of a clock that the rows lie beside, and the variance of their noise, (m,) each.

    Without those that are not known.
    """
    rows = between_ticks(run.time)
    if rows is None:
        known = np.isfinite(run.masked(signal, errors))
        return errors[known], np.ones(int(known.sum()))
    even, lost = rows.samples(np.nan_to_num(errors), run.not_compared(signal))
    return even[~lost], rows.amplification[~lost]
