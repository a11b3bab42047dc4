"""Whether a quantity differs from recording to recording, asked beside an explanation."""

from __future__ import annotations

from typing import NamedTuple

from rwn.fit.fit import Fit, refit
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics, statistics
from rwn.measurement.levels import ITERATIONS, Level, beside_levels
from rwn.measurement.likelihood import DECISIVE, log_posterior
from rwn.name.weights import log_odds


class LevelsTest(NamedTuple):
    """What comes of the test whether a quantity has a level of its own in each recording."""

    log_odds: float  # evidence for the levels
    problem: Problem  # with the levels
    fit: Fit
    left: Statistics

    @property
    def is_decisive(self) -> bool:
        """Whether they are there."""
        return self.log_odds > DECISIVE


def uneven_beside(problem: Problem, best: Fit, level: Level, explanation: Fit | None = None) -> LevelsTest:
    """The levels beside an explanation, with the lesser evidence of two that err otherwise where more is missing.

    That of effects counts samples of the error, as if what is missing were noise that lasts; the likelihood of
    autoregressions counts what is new in it. Both against the best explanation without levels, which is the one that
    the levels are beside unless another is given.
    """
    on, this = beside_levels(problem, explanation or best, level)
    left, alike = statistics(on, this), refit(best, problem, iterations=ITERATIONS)
    new = log_posterior(on, this) - log_posterior(problem, alike)
    return LevelsTest(log_odds=min(log_odds(this, best, left), new), problem=on, fit=this, left=left)
