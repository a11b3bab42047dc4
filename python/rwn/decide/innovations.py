"""What a fit leaves, by what is new in each error: as if all that lasts in the errors were disturbances.

A torque that wanders, and that has no name, is followed by whatever law is slow: plain least squares then finds that
law certain. What is new in each error, beyond what those before it let expect, such a law does not make less.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rwn.fit.fit import NEAR_ITS_END, Fit, refit
from rwn.fit.problem import Problem
from rwn.fit.unknown import prior_cost
from rwn.measurement.likelihood import log_likelihoods, under_own_colour

ROUNDS = 4  # of fits under a noise that is estimated anew
NO_MORE = 1.0  # logarithm of a likelihood from which a round is no better than the one before


class Innovations(NamedTuple):
    """How likely what is new in the errors of a fit is, and what its unknowns cost."""

    likelihoods: dict[str, float]  # logarithms, by signal; up to a constant
    prior_cost: float
    unknowns: int  # that the recordings depend on

    @property
    def log_posterior(self) -> float:
        """Of the fit, all signals together; up to a constant."""
        return sum(self.likelihoods.values()) - 0.5 * self.prior_cost

    def log_odds(self, other: Innovations, samples: int) -> float:
        """Log evidence for the fit against another of the same `samples`.

        Mean of signals, which answer one disturbance together. Schwarz's penalty (1978) is of all samples.
        """
        gained = float(np.mean([self.likelihoods[s] - other.likelihoods[s] for s in self.likelihoods]))
        penalty = 0.5 * (self.unknowns - other.unknowns) * float(np.log(max(samples, 1)))
        return gained - penalty - 0.5 * (self.prior_cost - other.prior_cost)


def innovations(problem: Problem, this: Fit, *, share: float) -> Innovations:
    """Of a fit under the colour of its own errors, estimated anew from fit to fit (Cochrane, Orcutt 1949).

    A slow disturbance bends plain least squares. `share`: what each of these fits may cost.
    """
    best = _left_by(problem, this)
    for _ in range(ROUNDS):
        this = refit(this, under_own_colour(problem, this), iterations=NEAR_ITS_END, share=share)
        found = _left_by(problem, this)
        if found.log_posterior < best.log_posterior + NO_MORE:
            break
        best = found
    return best


def _left_by(problem: Problem, this: Fit) -> Innovations:
    """Without the position where other signals tell the motion too: it adds up what the speed shows already."""
    found = log_likelihoods(problem, this)
    return Innovations(
        likelihoods={s: v for s, v in found.items() if s != "position"} or found,
        prior_cost=prior_cost(this.hypothesis.unknowns, this.minimum.values),
        unknowns=this.unknowns_seen,
    )
