"""How likely names are before anything is fitted: what elaborates plain friction, and steady loads."""

from __future__ import annotations

import numpy as np

from rwn.fit.problem import Problem
from rwn.name.backward import elaborations

ELABORATE = 5.0  # how much likelier plain friction is than an elaboration of it


def prior_odds(problem: Problem) -> dict[str, float]:
    """Log prior odds that differ from uniform, by name.

    Plain friction is likelier than any one of the laws that elaborate it, and than a load that a bench motor carries.
    """
    load = np.log(len(problem.prior.table)) + 1.0 if loaded(problem) else -np.log(ELABORATE)
    return dict.fromkeys(steady_loads(problem), load) | dict.fromkeys(elaborations(), -np.log(ELABORATE))


def loaded(problem: Problem) -> bool:
    """Whether a steady load is the rule: gravity or an offset on a machine axis, and where recordings show several."""
    return problem.drive.force or bool(problem.prior.added_to)


def steady_loads(problem: Problem) -> list[str]:
    """The names of loads that never change."""
    return [name for name, effect in problem.prior.table.items() if effect.steady]
