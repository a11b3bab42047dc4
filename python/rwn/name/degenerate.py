"""Explanations that a plainer one says as well: an effect without strength, a load at all times, half a period."""

from __future__ import annotations

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.name.observable import revolutions

WHOLE = 0.99  # share of the recording's time from which a window counts as all of it
BRIEF = 10  # fewest samples that a load disturbance lasts


def adds(this: Fit, problem: Problem) -> bool:
    """Whether every effect of a fit says something that the fit without it does not."""
    return not (this.idle or _covers_all_or_a_moment(this, problem) or _is_no_period_long(this, problem))


def _covers_all_or_a_moment(this: Fit, problem: Problem) -> bool:
    """Whether a load is said to act from end to end of the recordings, which has a name of its own, or for a moment.

    A stray sample is no load.
    """
    brief = BRIEF / max(r.time.size for r in problem.whole)
    return any(not brief < end - begin < WHOLE for begin, end in this.windows)


def _is_no_period_long(this: Fit, problem: Problem) -> bool:
    """Whether something is said to be periodic of which no recording travels a period."""
    travel = revolutions(problem)
    return any(periods * travel < 1.0 for periods in this.periods)
