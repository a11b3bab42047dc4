"""How likely what a fit leaves is by what is new in each error: how recordings were made, and whether effects act.

What a model leaves out moves slowly against the sample time and is the same under every choice, so the errors are
compared by what is new in them: their likelihood as autoregressions. Where a choice is made beside an explanation, one
under which the parameters have to leave what was declared pays for that; before anything is explained they leave
it under every choice. What is new in errors that are more than noise is no noise either: it counts as few samples as
the evidence for effects does.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics
from rwn.fit.unknown import prior_cost
from rwn.recording.interpolated import between_ticks
from rwn.recording.noise import autoregression
from rwn.simulate.run import Run

Array = NDArray[np.float64]

ORDER = 8  # of the autoregressions
DECISIVE = float(np.log(1000.0))  # how much likelier another choice has to be than what is usual


def is_decisive(gained: float, left: Statistics) -> bool:
    """Whether a gain of log-likelihood is decisive, counted in as many samples as what is left is worth.

    `left`: by the choice for which it speaks.
    """
    return gained * min(left.most_independent / max(left.count, 1), 1.0) > DECISIVE


def log_posterior(problem: Problem, this: Fit) -> float:
    """Of a fit, by what it leaves and by how far its parameters are from what was declared; up to a constant."""
    return log_likelihood(problem, this) - 0.5 * prior_cost(this.hypothesis.unknowns, this.minimum.values)


def under_own_colour(problem: Problem, this: Fit) -> Problem:
    """`problem` weighted by what is new in each error of a fit, as if all that lasts in them were disturbances."""
    residuals, noise = problem.residuals(this.vector, this.active), dict(problem.noise)
    for signal in dict.fromkeys(s for left in residuals for s in left):
        pairs = [(r, left[signal]) for r, left in zip(problem.runs, residuals, strict=True) if signal in left]
        noise[signal] = autoregression([r.masked(signal, left) for r, left in pairs], ORDER)
    return replace(problem, noise=noise)


def log_likelihood(problem: Problem, this: Fit) -> float:
    """Of what a fit leaves, all signals together, and of the switches of an input among all that it might have been.

    Up to a constant.
    """
    ways = sum(run.applied_input.log_ways for run in problem.runs if run.applied_input)
    return sum(log_likelihoods(problem, this).values()) - ways


def log_likelihoods(problem: Problem, this: Fit) -> dict[str, float]:
    """Of what a fit leaves of each signal, an autoregression of its own; up to a constant.

    An autoregression is over even steps: errors of uneven rows are those of the samples that these would lie between,
    and the noise of a row, where it was not interpolated, is larger there the farther it lies from its tick.
    Noise that an input inferred from the errors has taken up is put back first: it makes nothing likelier.
    """
    residuals = problem.residuals(this.vector, this.active)
    likelihoods = {}
    for signal in dict.fromkeys(s for left in residuals for s in left):
        pairs = [(r, left[signal]) for r, left in zip(problem.runs, residuals, strict=True) if signal in left]
        even = [_evenly(r, signal, left / r.noise_left(signal)) for r, left in pairs]
        windows = [np.lib.stride_tricks.sliding_window_view(x, ORDER + 1) for x, _ in even if x.size > ORDER]
        if windows:
            joined = np.concatenate(windows)
            noise = np.concatenate([w[ORDER:] for x, w in even if x.size > ORDER])
            before, now = joined[:, :-1], joined[:, -1]
            weights = np.linalg.lstsq(before, now)[0]
            new = now - before @ weights
            samples = sum(r.time.size for r, _ in pairs)
            likelihoods[signal] = -0.5 * samples * _log_variance(new, noise, 1.0 + float(weights @ weights))
    return likelihoods


def _log_variance(new: Array, noise: Array, noises: float) -> float:
    """Minus twice the log-likelihood per sample of normal innovations (n,) at their likeliest size, up to a constant.

    `noise`: variance of the noise of each row (n,), 1 on the scale of the errors where none is amplified; `noises`: how
    many rows' noise adds up in an innovation. What else is `new` in an error is as large in all rows.
    """
    whole = float(np.mean(new**2)) + 1e-300
    share = min(noises * float(np.mean(noise)) / whole, 1.0)
    relative = 1.0 + share * (noise / np.mean(noise) - 1.0)
    return float(np.log(np.mean(new**2 / relative) + 1e-300) + np.mean(np.log(relative)))


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
