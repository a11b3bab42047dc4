"""The beginning of every run, on which hypotheses are told apart before all samples are fitted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.simulate.run import Run

SCREENING_SAMPLES = 6000  # samples of a part on which effects are told apart
FIRST_SAMPLES = 2500  # samples of a part on which the starts of one effect are told apart, before they are fitted
LEAST_SHARE = 0.25  # least share of a run's squared error that has to lie in a part


def screening_part(problem: Problem, base: Fit) -> Problem:
    """The part of the problem on which effects are told apart: all of it where it is short."""
    length = sum(r.time.size for r in problem.runs)
    return problem if length <= SCREENING_SAMPLES else part(problem, base, SCREENING_SAMPLES)


def first_part(problem: Problem, base: Fit) -> Problem:
    """The part of the problem on which the starts of one effect are told apart, before they are fitted."""
    return part(problem, base, FIRST_SAMPLES)


def part(problem: Problem, base: Fit, samples: int) -> Problem:
    """The beginning of every run: so many samples in all, or until enough of what `base` leaves is in it."""
    return replace(problem, runs=tuple(_beginnings(problem, base, samples)))


def _beginnings(problem: Problem, base: Fit, samples: int) -> Iterator[Run]:
    residuals = problem.residuals(base.vector, base.active)
    for run, residual in zip(problem.runs, residuals, strict=True):
        energy = np.cumsum(sum((r / problem.noise[s].deviation) ** 2 for s, r in residual.items()))
        first = int(np.searchsorted(energy, LEAST_SHARE * energy[-1]))
        yield run.until(max(first, samples // len(problem.runs)))
