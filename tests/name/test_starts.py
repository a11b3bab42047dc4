"""Starts of one effect, and which of them go on."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

import rwn
from rwn.fit.fit import Fit
from rwn.fit.levenberg_marquardt import FitStatus, Minimum
from rwn.name.starts import (
    FittedStart,
    Start,
    best_of_each,
    distinct_ends,
)

DEMO = Path(rwn.__file__).parent / "demo"
SAMPLES = 100
BEST = (1.0, 2.0)


def _attempt(name: str, values: tuple[float, float], cost: float, order: float = 0.0) -> FittedStart:
    information = np.diag([1e4, 1.0])
    minimum = Minimum(
        values=np.array(values), chi2=cost, cost=cost, first=2.0 * cost, information=information,
        data_information=information, status=FitStatus.CONVERGED, iterations=3,
    )  # fmt: skip
    nothing = cast(Any, None)
    return FittedStart(Start(name, order, 0, nothing), Fit(hypothesis=nothing, minimum=minimum))


@pytest.mark.parametrize(
    ("other", "kept"),
    [
        (("drag", (1.0001, 2.5), 100.3), 1),
        (("drag", (1.1, 2.0), 100.3), 2),  # as good, elsewhere
        (("drag", (1.0001, 2.5), 105.0), 2),  # near, and not yet as good
        (("lag", BEST, 100.0), 2),
    ],
    ids=["met", "another minimum", "under way", "another effect"],
)
def test_of_starts_that_have_met_the_better_goes_on(other: tuple[str, tuple[float, float], float], kept: int) -> None:
    attempts = [_attempt(*other), _attempt("drag", BEST, 100.0)]
    left = distinct_ends(attempts, SAMPLES)
    assert len(left) == kept
    assert any(a.start.name == "drag" and a.cost == 100.0 for a in left)


def test_where_the_error_is_large_starts_have_met_from_farther_off() -> None:
    attempts = [_attempt("drag", BEST, 1e4), _attempt("drag", (1.0, 7.0), 1e4 + 50.0)]
    assert len(distinct_ends(attempts, SAMPLES)) == 1
    assert len(distinct_ends(attempts, int(1e4))) == 2


def test_of_a_periodic_effect_the_best_start_of_the_best_orders_goes_on() -> None:
    costs = ((7.0, 5.0), (7.0, 4.0), (14.0, 3.0), (9.0, 6.0))
    ripple = [_attempt("ripple", BEST, cost, order) for order, cost in costs]
    attempts = [*ripple, *(_attempt("drag", BEST, cost) for cost in (9.0, 7.0, 8.0))]
    kept = [(a.start.name, a.start.order, a.cost) for a in best_of_each(attempts, 2, orders=2)]
    assert kept == [("ripple", 14.0, 3.0), ("ripple", 7.0, 4.0), ("drag", 0.0, 7.0), ("drag", 0.0, 8.0)]
