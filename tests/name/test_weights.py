"""Explanations weighed against each other, also where simulations ran away."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rwn.fit.residuals import EXACT_TO, Statistics
from rwn.name.weights import LOST, weigh, weighed_beside

LEFT = Statistics(count=1000, variance=4.0, correlation_time=10.0, structured=("speed",))
AWAY = Statistics(count=1000, variance=np.inf, correlation_time=1000.0, structured=("speed",))


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


@pytest.mark.parametrize(("less", "is_less_likely"), [(5000.0, True), (3990.0, False)])
def test_a_fit_that_was_not_ranked_is_weighed_as_those_that_were(less: float, is_less_likely: bool) -> None:
    """By the same evidence; a simpler one that was fitted later is no likelier than what it takes its effects from."""
    best, *_ = weigh([_fit(4000.0, "a", "b"), _fit(9000.0)], LEFT, rivals=1)
    found = weighed_beside(_fit(less, "a"), best, LEFT)
    gained = found.score - best.score
    ranked = {r.added: r.score for r in weigh([_fit(4000.0, "a", "b"), _fit(less, "a")], LEFT, rivals=1)}
    assert gained == pytest.approx(ranked[("a",)] - ranked[("a", "b")])
    assert (gained < 0.0) is is_less_likely
    assert found.probability == pytest.approx(best.probability * np.exp(min(gained, 0.0)))


WHITE = Statistics(count=20_000, variance=0.5, correlation_time=1.0)
EXACT = EXACT_TO * 0.5 * 20_000  # squares, in units of the noise that was expected, to which a simulation is exact


@pytest.mark.parametrize(("less", "name"), [(0.9, "plain"), (2.5, "law")])
def test_what_lies_above_the_errors_of_a_simulation_counts_in_all_samples(less: float, name: str) -> None:
    """In units of the noise that is left, not of the noise that was expected."""
    plain, law = _fit(10_000.0 + less * EXACT, "plain"), _fit(10_000.0, "law")
    law.unknowns_seen = 2
    rows = {r.added: r.score for r in weigh([plain, law], WHITE, rivals=1)}
    gained = max(less - 1.0, 0.0) * EXACT / (2.0 * 0.5)
    assert rows[("law",)] - rows[("plain",)] == pytest.approx(gained - 0.5 * np.log(20_000.0))
    assert (rows[("law",)] > rows[("plain",)]) is (name == "law")
