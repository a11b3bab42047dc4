"""What tests of the naming share."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from demo_problem import demo_problem
from rwn.fit.fit import Fit, fit_nominal
from rwn.fit.problem import Problem
from rwn.name.screening import screen


@pytest.fixture(scope="module")
def problem() -> Problem:
    """The recording of the demo, prepared."""
    return demo_problem()


@pytest.fixture(scope="module")
def fit_with(problem: Problem) -> Callable[[str], Fit]:
    """It, explained by one effect."""
    return lambda name: screen(problem, fit_nominal(problem), [name])[0]
