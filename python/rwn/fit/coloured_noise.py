"""Fits of a transfer function under coloured noise: what it leaves are disturbances that last, not independent samples.

An error counts as what is new in it beyond a share of the one before (generalised least squares; Cochrane, Orcutt
1949). Plain least squares bends the coefficients after every slow disturbance of the fitted samples. The share is that
of a plain fit: estimated anew from fit to fit it runs to 1, where the level counts for nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rwn.fit.fit import Fit, refit_all
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics, statistics
from rwn.recording.noise import Noise

MOST = 0.99  # share of the error before that is believed


def final_fits(
    problem: Problem, fits: Sequence[Fit], left: Statistics
) -> tuple[Problem, Sequence[Fit], Statistics]:
    """The problem, fits and rest that count in the end: as they are, of a transfer function under coloured noise.

    `left`: statistics of the best of the plain `fits`, which may leave nothing but noise. What follows the recordings
    less than a model that stands still, as one that ran away, leaves more than disturbances.
    """
    plain = min(fits, key=lambda f: f.cost)
    if not problem.drive.coefficients or left.at_the_floor or not _follows(problem, plain):
        return problem, fits, left
    weighted = under_coloured_noise(problem, plain)
    finals = refit_all(fits, weighted)
    return weighted, finals, statistics(weighted, min(finals, key=lambda f: f.cost))


def _follows(problem: Problem, this: Fit) -> bool:
    """Whether a fit leaves less than the motion itself of every signal."""
    off = dict.fromkeys(problem.noise, 0.0)
    moved = dict(off)
    for run, left in zip(problem.runs, problem.residuals(this.vector, this.active), strict=True):
        for signal, error in left.items():
            compared = ~run.not_compared(signal)
            off[signal] += float(np.linalg.norm(error[compared]) ** 2)
            moved[signal] += float(np.linalg.norm(run.signal(signal)[compared]) ** 2)
    return all(off[signal] <= moved[signal] for signal in off)


def under_coloured_noise(problem: Problem, this: Fit) -> Problem:
    """`problem` weighted by what is new in each error that a plain fit leaves."""
    noise = dict(problem.noise)
    residuals = problem.residuals(this.vector, this.active)
    for signal in dict.fromkeys(s for left in residuals for s in left):
        parts = [left[signal] for left in residuals if signal in left]
        pairs = np.concatenate([np.stack([x[:-1], x[1:]]) for x in parts], axis=1)
        before, after = pairs[:, np.isfinite(pairs).all(axis=0)]
        share = float(np.clip(before @ after / max(float(before @ before), 1e-300), 0.0, MOST))
        level = max(float(np.sqrt(np.mean((after - share * before) ** 2))), 1e-12)
        noise[signal] = Noise(level=level, reflection=(share,))
    return replace(problem, noise=noise, inflation=1.0)
