"""Explanations weighed against each other, also where simulations ran away."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rwn.fit.residuals import Statistics
from rwn.name.weights import LOST, weigh

LEFT = Statistics(count=1000, variance=4.0, correlation_time=10.0, coloured=9.0)
AWAY = Statistics(count=1000, variance=np.inf, correlation_time=1000.0, coloured=np.inf)


def _fit(cost: float, *added: str) -> Any:
    return SimpleNamespace(cost=cost, added=added, unknowns_seen=len(added))


@pytest.mark.parametrize("left", [LEFT, AWAY])
@pytest.mark.parametrize("costs", [(np.inf, np.inf, np.inf), (4000.0, np.inf, 5000.0), (np.inf, np.inf, 4000.0)])
def test_fits_that_ran_away_have_scores_and_probabilities_that_are_numbers(
    costs: tuple[float, ...], left: Statistics
) -> None:
    fits = [_fit(cost, *names) for cost, names in zip(costs, ((), ("a",), ("b",)), strict=True)]
    rows = weigh(fits, left, rivals=10)
    assert np.isfinite([r.score for r in rows]).all()
    assert sum(r.probability for r in rows) == pytest.approx(1.0)
    kept = [cost for cost in costs if np.isfinite(cost)]
    if kept:
        assert np.isfinite(rows[0].fit.cost)
        assert all(r.probability == 0.0 for r in rows if not np.isfinite(r.fit.cost))
    else:
        assert rows[0].added == (), "the data tell nothing, so that fewer effects are likelier"


def test_no_fit_that_can_be_simulated_is_weighed_below_one_that_ran_away() -> None:
    rows = weigh([_fit(1.0), _fit(1e30, "a"), _fit(np.inf, "a")], LEFT, rivals=10)
    assert [r.fit.cost for r in rows][:2] == [1.0, 1e30]
    assert rows[1].score == pytest.approx(rows[2].score)
    assert rows[1].score > -1.01 * LOST
